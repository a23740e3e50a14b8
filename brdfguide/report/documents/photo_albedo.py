"""A reflectance beside a chart in a photograph as a document."""

from ...physics.colorchecker import cie_lightness
from .findings import finding
from .plain import plain

SCHEMA = "brdfguide/albedo/1"


def document(found) -> dict:
    """Of a `photographs.chart_answer.ChartAnswer`: named `albedo` only where a second picture looked for gloss."""
    key = "albedo" if found.is_albedo else "reflectance_factor"
    luminance = min(max(found.luminance, 0.0), 1.0)
    return plain(
        {
            "schema": SCHEMA,
            key: dict(zip("RGB", found.value, strict=True)),
            "stderr": dict(zip("RGB", found.doubt * abs(found.value), strict=True)),
            "doubt_relative": dict(zip("RGB", found.doubt, strict=True)),
            "luminance_factor": found.luminance,
            "lightness": cie_lightness(luminance),
            "data_set": found.data_set,
            "other_data_set": {name: dict(zip("RGB", value, strict=True)) for name, value in found.others.items()},
            "pictures_differ": found.differ,
            "pictures": [
                {
                    "file": shown.picture.name,
                    "value": dict(zip("RGB", each, strict=True)),
                    "corners_px": shown.placed.corners.tolist(),
                    "lamp_chart_widths": dict(
                        zip(("x", "y", "height"), shown.charts[found.data_set].lamp, strict=True)
                    ),
                    "residual_rms": shown.charts[found.data_set].rms,
                    "chi": shown.charts[found.data_set].chi,
                }
                for shown, each in zip(found.shown, found.each, strict=True)
            ],
            "warnings": [finding(each) for each in found.findings],
        }
    )

"""What was found about a data file, as a document."""

import numpy as np

from ...data.measurement import Measurement
from .data import data_block
from .findings import finding
from .plain import plain

SHOWN_INCIDENCES = 14
STATUS = {"error": "contradictory", "outside": "outside", "warning": "flagged"}  # the gravest first
RECIPROCITY = ("reciprocal", "not-reciprocal", "dark-level", "dim-values-off", "cosine-weighted", "cosine-i-weighted")


def document(measurement: Measurement, found, corrections) -> dict:
    """`brdfguide inspect --json`: the file as it was read, what was found, and what a fit would change."""
    by_code = {each.code: dict(each.numbers) for each in found}
    energy = by_code.get("reflectance") or by_code.get("reflectance-factor") or by_code.get("too-bright")
    turned = _rotation(by_code)
    return plain({
        "schema": "brdfguide/inspect/1",
        "data": data_block(measurement),
        "coverage": {**by_code.get("coverage", {}), "by_theta_i": incidences(measurement)},
        "reciprocity": next((by_code[code] for code in RECIPROCITY if code in by_code), None),
        "energy": energy,
        **({} if turned is None else {"rotation": turned}),
        "noise_relative": by_code.get("noise", {}).get("relative"),
        "findings": [finding(each) for each in found],
        "corrections": [finding(each) for each in corrections],
        "status": status((*measurement.findings, *found)),
    })  # fmt: skip


def _rotation(by_code: dict) -> dict | None:
    """What turning the sample showed, or its lobe alone; None where neither tells anything."""
    grain, spread = by_code.get("grain"), by_code.get("anisotropic") or by_code.get("isotropic")
    if grain is None and not spread:
        return None
    return {"anisotropic": grain is not None or "anisotropic" in by_code, **(spread or {}), **(grain or {})}


def status(found) -> str:
    """inside, flagged, outside or contradictory."""
    there = {each.severity for each in found}
    return next((word for severity, word in STATUS.items() if severity in there), "inside")


def incidences(measurement: Measurement) -> list[dict]:
    """For each incidence: how much was measured, and where it is brightest; bands where there are very many."""
    geom = measurement.geom
    theta_i = geom.theta_i_deg[:, 0]
    groups = measurement.theta_i_groups
    if len(groups) > 3 * SHOWN_INCIDENCES:
        width = 90 / (SHOWN_INCIDENCES + 1)
        band = np.floor(theta_i / width).astype(int)
        groups = {float((k + 0.5) * width): np.flatnonzero(band == k) for k in np.unique(band)}
    level = np.where(measurement.usable, measurement.brdf, 0.0).max(axis=1)
    signed, phi = geom.signed_theta_r_deg[:, 0], np.remainder(geom.phi_deg[:, 0], 360.0)
    rows = []
    for angle, members in groups.items():
        peak = members[np.argmax(level[members])]
        rows.append(
            {
                "theta_i_deg": round(angle, 1),
                "directions": len(members),
                "theta_r_from_deg": float(signed[members].min()),
                "theta_r_to_deg": float(signed[members].max()),
                "missing": int(np.count_nonzero(~measurement.usable[members])),
                "peak_per_sr": float(level[peak]) if level[peak] > 0 else None,
                "peak_theta_r_deg": float(signed[peak]),
                "peak_phi_deg": float(phi[peak]),
            }
        )
    return rows

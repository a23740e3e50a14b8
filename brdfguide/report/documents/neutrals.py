"""An albedo by comparison as a document."""

from ...physics import colorchecker as chart
from .findings import remark_on

SCHEMA = "brdfguide/albedo/1"


def chart_document(data_set: str) -> dict:
    """The neutrals in both data sets, with the lightness in one of them."""
    return {
        "schema": SCHEMA,
        "patches": [
            {
                "patch": name,
                **{each: chart.patch(name, each) for each in chart.DATA_SETS},
                "lightness": chart.cie_lightness(chart.patch(name, data_set)),
            }
            for name in chart.PATCHES
        ],
    }


def of_ratio(ratio: float, reference: float) -> dict:
    """By a photometer."""
    return _document(chart.from_ratio(ratio, reference), f"{ratio:g} of a reference of {reference:g}")


def of_neutral(name: str, data_set: str) -> dict:
    """As light as a neutral."""
    return _document(chart.patch(name, data_set), f"{name}, {data_set}", data_set, lambda each: chart.patch(name, each))


def of_two(first: str, second: str, position: float, data_set: str) -> dict:
    """Between two neutrals, in lightness."""
    how = f"{position:g} of the way from {first} to {second} in lightness, {data_set}"
    value = chart.between(first, second, position, data_set)
    return _document(value, how, data_set, lambda each: chart.between(first, second, position, each))


def _document(value: float, how: str, data_set: str | None = None, by=None) -> dict:
    """`by(data set)` is the same comparison by another's chart."""
    others = [each for each in chart.DATA_SETS if by and each != data_set]
    return {
        "schema": SCHEMA,
        "albedo": value,
        "luminance_factor": value,
        "lightness": chart.cie_lightness(value),
        "from": how,
        "data_set": data_set,
        "other_data_set": {each: by(each) for each in others} or None,
        "warnings": [remark_on("brightness-not-linear", chart.NOT_LINEAR)],
    }

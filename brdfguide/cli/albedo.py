"""`brdfguide albedo`: Lambertian albedo from a comparison with known reflectances."""

from typing import Annotated

from typer import Option

from ..errors import InputError
from ._options import JsonOption, QuietOption, note, print_json

EXAMPLES = "Examples: brdfguide albedo --patch 'neutral 5' | brdfguide albedo --between white 'neutral 8' --position 0.3"


def albedo(
    patch: Annotated[str | None, Option("--patch", help="The ColorChecker neutral that looks as light.")] = None,
    between: Annotated[tuple[str, str] | None, Option("--between", help="Two neutrals it lies between.")] = None,
    position: Annotated[float, Option("--position", help="0 at the first of the two, 1 at the second.")] = 0.5,
    ratio: Annotated[float | None, Option("--ratio", help="Photometer: surface over reference.")] = None,
    reference: Annotated[float | None, Option("--reference", help="Reflectance of that reference.")] = None,
    data_set: Annotated[str, Option("--data-set", help="Whose chart: average or iso17321.")] = "average",
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Albedo by comparison with a ColorChecker's neutrals or a photometer's reference; none of them: the chart."""
    from .. import albedo as chart
    from ..report import table

    asked = [name for name, given in (("--patch", patch), ("--between", between), ("--ratio", ratio)) if given is not None]
    if len(asked) > 1:
        raise InputError(f"{' and '.join(asked)} are different comparisons; give one")
    if (ratio is None) != (reference is None):
        raise InputError("--ratio and --reference go together")
    chart.patch("white", data_set)
    if not asked:
        rows = [(name, *(f"{chart.patch(name, each):.4f}" for each in chart.DATA_SETS), f"{chart.lightness(chart.patch(name, data_set)):.1f}") for name in chart.PATCHES]
        document = {"schema": "brdfguide/albedo/1", "patches": [{"patch": r[0], "average": float(r[1]), "iso17321": float(r[2])} for r in rows]}
        print_json(document) if json else print(table.columns(("patch", *chart.DATA_SETS, "L*"), rows, right=(1, 2, 3)))
        return
    if ratio is not None:
        value, how = chart.from_ratio(ratio, reference), f"{ratio:g} of a reference of {reference:g}"
    elif between is not None:
        value, how = chart.between(*between, position, data_set), f"{position:g} of the way from {between[0]} to {between[1]} in lightness, {data_set}"
    else:
        value, how = chart.patch(patch, data_set), f"{patch}, {data_set}"
    other = next(each for each in chart.DATA_SETS if each != data_set)
    also = chart.patch(patch, other) if patch else chart.between(*between, position, other) if between else None
    document = {
        "schema": "brdfguide/albedo/1", "albedo": value, "luminance_factor": value, "lightness": chart.lightness(value), "from": how,
        "data_set": None if ratio is not None else data_set, "other_data_set": {other: also} if also is not None else None,
        "warnings": [{"code": "brightness-not-linear", "text": chart.NOT_LINEAR}],
    }  # fmt: skip
    if json:
        print_json(document)
        return
    print(f"albedo {value:.4f}   Y {100 * value:.2f} %   L* {chart.lightness(value):.1f}   ({how})")
    if also is not None:
        print(f"       {also:.4f} by {other}")
    note(f"note: {chart.NOT_LINEAR}", quiet)

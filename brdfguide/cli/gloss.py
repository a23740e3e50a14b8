"""`brdfguide gloss`: glossmeter readings to roughness and index, and back."""

from typing import Annotated

from typer import Exit, Option

from ..errors import InputError
from ._options import JsonOption, QuietOption, note, print_json

EXAMPLES = "Examples: brdfguide gloss --at-60 85 --at-20 55 | brdfguide gloss --alpha 0.1 --lobe ggx"


def gloss(
    at_20: Annotated[float | None, Option("--at-20", min=0, help="Reading at 20 degrees [GU].")] = None,
    at_60: Annotated[float | None, Option("--at-60", min=0, help="Reading at 60 degrees [GU].")] = None,
    at_85: Annotated[float | None, Option("--at-85", min=0, help="Reading at 85 degrees [GU].")] = None,
    alpha: Annotated[float | None, Option("--alpha", min=0.002, max=1, help="The other way: a lobe's width to readings.")] = None,
    n: Annotated[float | None, Option("--n", min=1.01, max=3, help="Index, if known; else 1.5 or fitted.")] = None,
    albedo: Annotated[float, Option("--albedo", min=0, max=1, help="Of the body below, which adds to readings.")] = 0.0,
    lobe: Annotated[str | None, Option("--lobe", help="beckmann, ggx; left out: both.")] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Roughness and index from one to three gloss readings of a dielectric, or the readings of a lobe."""
    from .. import gloss as meter
    from ..errors import choices
    from ..report import table

    if lobe is not None and lobe not in meter.LOBES:
        raise choices("lobe", lobe, meter.LOBES)
    lobes = (lobe,) if lobe else meter.LOBES
    readings = {angle: value for angle, value in zip(meter.ANGLES, (at_20, at_60, at_85)) if value is not None}
    if (alpha is None) == (not readings):
        raise InputError("give readings (--at-20, --at-60, --at-85), or --alpha for the readings of a lobe")
    if alpha is not None:
        found = {each: {angle: meter.facet_units(angle, alpha, n or 1.5, each) + albedo * meter.DIFFUSE[angle] for angle in meter.ANGLES} for each in lobes}
        document = {"schema": "brdfguide/gloss/1", "alpha": alpha, "n": n or 1.5, "albedo": albedo, "gloss_gu": {name: {str(a): v for a, v in units.items()} for name, units in found.items()}}
        rows = [(name, *(f"{value:.1f}" for value in units.values())) for name, units in found.items()]
        print_json(document) if json else print(table.columns(("lobe", "20 deg", "60 deg", "85 deg"), rows, right=(1, 2, 3)))
        return
    if max(readings.values()) > 130:
        raise InputError(f"a reading of {max(readings.values()):g}: above 130 it is a metal or a mirror, outside ISO 2813 and ASTM D523")
    fits = [meter.roughness_from(readings, n, each, albedo) for each in lobes]
    best = min(fits, key=lambda each: each.worst)
    document = {
        "schema": "brdfguide/gloss/1", "readings_gu": {str(a): v for a, v in readings.items()}, "agrees": best.agrees,
        "fits": [
            {"lobe": f.lobe, "alpha": f.alpha, "n": f.n, "sigma_over_tau": f.alpha / 2, "phong_exponent": max(0.0, (2 / f.alpha**2 - 2) / 4), "agrees": f.agrees,
             "worst_in_tolerances": f.worst, "predicted_gu": {str(a): v for a, v in f.predicted.items()}, "alpha_of_each": {str(a): v for a, v in f.each.items()}}
            for f in fits
        ],
    }  # fmt: skip
    if json:
        print_json(document)
    else:
        shown = lambda values: "/".join("none" if v is None else f"{v:.3g}" for v in values)  # noqa: E731
        rows = [(f.lobe, f"{f.alpha:.4g}", f"{f.n:.2f}", shown(f.predicted.values()), shown(f.each.values()), "yes" if f.agrees else "no") for f in fits]
        print(table.columns(("lobe", "alpha", "n", "predicted GU", "alpha of each reading", "agrees"), rows, right=(1, 2)))
    if len(readings) == 1 and n is None:
        note("note: one reading cannot tell n; 1.5 was taken", quiet)
    if not best.agrees:
        note("brdfguide: no single lobe gives these readings; they are not averaged (a coat, a second lobe, or a wrong angle)", False)
        raise Exit(1)

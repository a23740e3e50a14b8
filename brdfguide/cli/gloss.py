"""`brdfguide gloss`: glossmeter readings to roughness and index, and back."""

from typing import Annotated

from typer import Exit, Option

from ..errors import InputError
from ._options import JsonOption, QuietOption, answer, remark

EXAMPLES = "Examples: brdfguide gloss --at-60 85 --at-20 55 | brdfguide gloss --alpha 0.1 --lobe ggx"
BRIGHTEST = 130  # [GU]; a smooth dielectric stays below


def gloss(
    at_20: Annotated[float | None, Option("--at-20", min=0, help="Reading at 20 degrees [GU].")] = None,
    at_60: Annotated[float | None, Option("--at-60", min=0, help="Reading at 60 degrees [GU].")] = None,
    at_85: Annotated[float | None, Option("--at-85", min=0, help="Reading at 85 degrees [GU].")] = None,
    alpha: Annotated[
        float | None, Option("--alpha", min=0.002, max=1, help="The other way: a lobe's width to readings.")
    ] = None,
    n: Annotated[float | None, Option("--n", min=1.01, max=3, help="Index, if known; else 1.5 or fitted.")] = None,
    albedo: Annotated[float, Option("--albedo", min=0, max=1, help="Of the body below, which adds to readings.")] = 0.0,
    lobe: Annotated[str | None, Option("--lobe", help="beckmann, ggx; left out: both.")] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Roughness and index from one to three gloss readings of a dielectric, or the readings of a lobe."""
    from ..errors import choices
    from ..physics import gloss as meter
    from ..report.documents import glossmeter
    from ..report.text.glossmeter import lobes_text, readings_text

    if lobe is not None and lobe not in meter.LOBES:
        raise choices("lobe", lobe, meter.LOBES)
    lobes = (lobe,) if lobe else meter.LOBES
    given = zip(meter.ANGLES, (at_20, at_60, at_85), strict=True)
    readings = {angle: value for angle, value in given if value is not None}
    if (alpha is None) == (not readings):
        raise InputError("give readings (--at-20, --at-60, --at-85), or --alpha for the readings of a lobe")
    if alpha is not None:
        document = glossmeter.of_lobes(alpha, n, albedo, lobes)
        answer(document, json, lobes_text)
        return
    if max(readings.values()) > BRIGHTEST:
        raise InputError(
            f"a reading of {max(readings.values()):g}: above {BRIGHTEST} it is a metal or a mirror, outside ISO 2813 "
            f"and ASTM D523"
        )
    document = glossmeter.of_readings(readings, n, albedo, lobes)
    answer(document, json, readings_text)
    if len(readings) == 1 and n is None:
        remark("note: one reading cannot tell n; 1.5 was taken", quiet)
    if not document["agrees"]:
        remark(
            "brdfguide: no single lobe gives these readings; they are not averaged (a coat, a second lobe, or a "
            "wrong angle)"
        )
        raise Exit(1)

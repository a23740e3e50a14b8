"""`brdfguide roughness`: sigma and tau from the angle at which a mirror image emerges."""

import sys
from pathlib import Path
from typing import Annotated

from typer import Option

from ..report import emergence
from ..roughness import DISTANCE_MM, PUPIL_MM, WAVELENGTH
from ._options import JsonOption, QuietOption, note, picture_file

EXAMPLES = "Examples: brdfguide roughness --angle 80 --slope 0.1 | brdfguide roughness --angle 75 --tau-um 5 --plot figure14.png"


def roughness(
    angle: Annotated[float | None, Option("--angle", metavar="DEG", help="Angle of emergence, from the normal.")] = None,
    slope: Annotated[float | None, Option("--slope", help="sigma/tau; 0.1 if nothing is known.")] = None,
    sigma_um: Annotated[float | None, Option("--sigma-um", help="Known rms height; asks for tau.")] = None,
    tau_um: Annotated[float | None, Option("--tau-um", help="Known correlation length; asks for sigma. Both: for the angle.")] = None,
    wavelength_nm: Annotated[float, Option("--wavelength-nm", help="Where it was seen.")] = 1000 * WAVELENGTH,
    pupil_mm: Annotated[float, Option("--pupil-mm", help="Diameter of the pupil that saw it.")] = PUPIL_MM,
    distance_mm: Annotated[float, Option("--distance-mm", help="From surface to pupil.")] = DISTANCE_MM,
    never: Annotated[bool, Option("--never", help="No emergence was seen, up to --angle (85): a lower bound.")] = False,
    contour: Annotated[bool, Option("--contour", help="The whole contour as well.")] = False,
    batch: Annotated[str | None, Option("--batch", metavar="FILE", help="One request a line, `80` or `angle=80 slope=0.2`; - reads stdin.")] = None,
    plot: Annotated[Path | None, Option("--plot", metavar="FILE", callback=picture_file, help="The report's Figure 14 with the answer on it, as .png, .svg or .pdf.")] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Roughness from the angle of specular emergence: Eq. 3 and the He-Torrance criterion side by side."""
    question = dict(angle=angle, slope=slope, sigma_um=sigma_um, tau_um=tau_um, wavelength_nm=wavelength_nm, pupil_mm=pupil_mm, distance_mm=distance_mm)
    question |= dict(contour=contour, never=never)
    if batch is not None:
        sys.exit(_answer_all(batch, json, question))
    text, notes = emergence.answer(json=json, **question)
    if plot is not None:
        from ..report import emergence_plot

        emergence_plot.draw(emergence.document(**question), plot)
        notes = [*notes, f"wrote {plot}"]
    sys.stdout.write(text)
    sys.stdout.flush()
    for each in notes:
        note(f"note: {each}", quiet)


def _answer_all(source: str, json: bool, common: dict) -> int:
    """Answers line by line as they come; the largest exit status of them."""
    from ..errors import InputError

    try:
        lines = sys.stdin if source == "-" else open(source, encoding="utf-8")
    except OSError as error:
        raise InputError(f"cannot read {source}: {error.strerror}") from None
    worst = 0
    with lines:
        for text, status in emergence.batch(lines, json, **common):
            sys.stdout.write(text)
            sys.stdout.flush()
            worst = max(worst, status)
    return worst

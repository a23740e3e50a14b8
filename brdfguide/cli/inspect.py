"""`brdfguide inspect DATA`: what a data file is, what is wrong with it, and what each finding changes."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ._data import AveragePhiOption, ColumnsOption, InPlaneOption, MirrorSideOption, QuantityOption, ThetaMaxOption, UnitOption, WavelengthOption, read
from ._options import JsonOption, picture_file, print_json

EXAMPLES = "Examples: brdfguide inspect run.csv --plot run.png | brdfguide inspect gold-paint.binary --json"


def inspect(
    data: Annotated[Path, Argument(help="Measured data: tables of many kinds, MERL, RGL, Cornell, Zemax, FRED, LightTools, ALTA, ASTM E1392, OpenMATERIAL; - for standard input.")],
    columns: ColumnsOption = None,
    unit: UnitOption = None,
    quantity: QuantityOption = None,
    mirror_side: MirrorSideOption = None,
    average_phi_i: AveragePhiOption = False,
    wavelength: WavelengthOption = None,
    in_plane: InPlaneOption = False,
    theta_max: ThetaMaxOption = None,
    plot: Annotated[Path | None, Option("--plot", callback=picture_file, help="Draw coverage, values, reciprocity and energy (png, svg or pdf).")] = None,
    json: JsonOption = False,
) -> None:
    """Say what a data file is: format, coverage, quantity, conventions, reciprocity, energy, gaps, spikes, noise."""
    from .. import examine
    from ..report import inspection

    measurement = read(data, columns, unit, quantity, mirror_side, wavelength, in_plane, theta_max, average_phi_i=average_phi_i)
    found = examine.examine(measurement)
    settled = examine.corrected(measurement, anyway=True)
    changes = (*settled.findings[len(measurement.findings) :], *(each for each in found if each.code in ("spikes", "dark-edge")))
    result = inspection.document(measurement, found, changes)
    if plot:
        from ..report import survey

        survey.draw(*examine.drawn(measurement), plot, str(data))
    print_json(result) if json else print(inspection.text(result))

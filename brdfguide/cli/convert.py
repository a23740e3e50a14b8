"""`brdfguide convert DATA OUT`: any readable file to plain CSV, a dense table or a fitted model to MERL `.binary`."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._data import AveragePhiOption, ColumnsOption, InPlaneOption, MirrorSideOption, QuantityOption, ThetaMaxOption, UnitOption, WavelengthOption, read
from ._options import ForceOption, QuietOption, note

EXAMPLES = "Examples: brdfguide convert paint.brdf paint.csv | brdfguide convert fit.json paint.binary"


def convert(
    data: Annotated[Path, Argument(help="Measured data, or the JSON of a fit; - for standard input.")],
    out: Annotated[Path, Argument(help="A .csv or a .binary file.")],
    model: Annotated[str | None, Option("--model", "-m", help="Which model of a fit; the recommended one if not said.")] = None,
    columns: ColumnsOption = None,
    unit: UnitOption = None,
    quantity: QuantityOption = None,
    mirror_side: MirrorSideOption = None,
    average_phi_i: AveragePhiOption = False,
    wavelength: WavelengthOption = None,
    in_plane: InPlaneOption = False,
    theta_max: ThetaMaxOption = None,
    force: ForceOption = False,
    quiet: QuietOption = False,
) -> None:
    """Convert DATA to plain CSV with its conventions in the header, or a table or a fitted model to MERL .binary."""
    from .. import outputs, tabulated

    kind = out.suffix.lower()
    if kind not in (".csv", ".binary"):
        raise InputError(f"{out}: wanted a .csv or a .binary file to write")
    if outputs.writable(out).exists() and not force:
        raise InputError(f"{out} exists; --force replaces it")
    if kind == ".binary":
        content, notes = tabulated.merl(data, model, average_phi_i=average_phi_i)
    else:
        from ..formats import table

        measurement = read(data, columns, unit, quantity, mirror_side, wavelength, in_plane, theta_max, average_phi_i=average_phi_i)
        content, notes = "\n".join(table.written(measurement)) + "\n", [finding.text for finding in measurement.findings]
    outputs.write_whole(out, content, force=force)
    for text in notes:
        note(text, quiet)

"""`brdfguide convert DATA OUT`: any readable file as another format, a dense table or a fitted model as MERL's."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError, choices
from ..records import dataclass
from ._data import Reading
from ._options import ForceOption, JsonOption, QuietOption, answer, remark
from ._request import refuse

EXAMPLES = (
    "Examples: brdfguide convert paint.brdf paint.csv | brdfguide convert scan.csv scan.bsdf --to zemax | brdfguide "
    "convert fit.json paint.binary | brdfguide convert --from gltf --to openpbr base_color=0.8,0.1,0.1 roughness=0.4"
)

BY_SUFFIX = {
    ".csv": "csv",
    ".binary": "merl",
    ".astm": "astm",
    ".brdf": "speos",
    ".anisotropicbsdf": "speos-anisotropic",
}
OF_SAMPLES = (
    "columns", "unit", "quantity", "mirror_side", "wavelength", "wavelength_nm", "select", "in_plane", "theta_max",
    "rotation_sense", "scale",
)  # fmt: skip


@dataclass(frozen=True, eq=False, kw_only=True)
class ConvertRequest:
    """Everything that `convert` is asked."""

    context: Context
    words: Annotated[
        list[str],
        Argument(
            metavar="DATA OUT | NAME=VALUE...",
            help=(
                "Measured data or the JSON of a fit, - for standard input, and the file to write; with --from a "
                "shader's numbers, R,G,B for colours."
            ),
        ),
    ]
    from_: Annotated[
        str | None,
        Option("--from", help="A shader, program or law whose numbers are given: gltf, unreal, pbrt, blinn, ward ..."),
    ] = None
    to: Annotated[
        str | None,
        Option(
            "--to",
            help=(
                "zemax, fred, lighttools, astm, speos, speos-anisotropic, tracepro, csv or merl; left out: by OUT's "
                "suffix. With --from another shader, program or law."
            ),
        ),
    ] = None
    model: Annotated[
        str | None, Option("--model", "-m", help="Which model of a fit; the recommended one if not said.")
    ] = None
    reading: Reading
    force: ForceOption = False
    json: JsonOption = False
    quiet: QuietOption = False

    @property
    def data(self) -> Path:
        return Path(self.words[0])

    @property
    def out(self) -> Path:
        return Path(self.words[1])


def convert(request: ConvertRequest) -> None:
    """Convert DATA to another format with its conventions stated, a table or a fitted model to MERL .binary, or one
    shader's numbers to another's."""
    from .. import files
    from ..data import formats

    if request.from_ is not None:
        _shader(request, request.from_)
        return
    refuse(request.context, "json", because="a file is written, and nothing printed; it goes with --from")
    if len(request.words) != 2:
        raise InputError(f"wanted DATA and OUT, two files; found {len(request.words)}")
    out, context = request.out, request.context
    target = _target(request, formats.writers())
    if files.writable(out).exists() and not request.force:
        raise InputError(f"{out} exists; --force replaces it")
    content: str | bytes
    if target == "merl":
        refuse(context, *OF_SAMPLES, because="a .binary is made of a whole table; convert to .csv to take a part of it")
        content, notes = _table(request)
    else:
        why = f"a .{target} holds measured values" if target == "csv" else f"a file for {target} holds measured values"
        refuse(context, "model", because=f"{why}; `evaluate --fit` gives a model's, `export --to` a table of it")
        content, notes = _samples(request, target)
    files.write_whole(out, content, force=request.force)
    for text in notes:
        remark(text, request.quiet)


def _shader(request: ConvertRequest, source: str) -> None:
    """Prints a shader's numbers as another's, with the error."""
    from ..exporters import conversions
    from ..face.surfaces import numbers_from
    from ..report.documents.conversion import conversion_document
    from ..report.text.conversion import conversion_text

    because = "with --from no file is read or written"
    refuse(request.context, *OF_SAMPLES, "model", "average_phi_i", "force", "quiet", because=because)
    if request.to is None:
        raise InputError(f"--to is missing: the shader, program or law that gets the numbers of {source}")
    conversions.spelling(request.to)
    given = numbers_from(request.words)
    found = conversions.convert(conversions.read(source, given), request.to)
    shown = {name: list(value) if len(value) > 1 else value[0] for name, value in given.items()}
    answer(conversion_document(source, request.to, shown, found), request.json, conversion_text)


def _target(request: ConvertRequest, known: tuple[str, ...]) -> str:
    """The format to write. Raises InputError where neither --to nor the suffix names one."""
    if request.to is None:
        suffix = request.out.suffix.lower()
        if suffix not in BY_SUFFIX:
            listed = ", ".join(f"{target} ({suffix})" for suffix, target in BY_SUFFIX.items())
            names = ", ".join((*known, "merl"))
            text = f"its suffix names no format to write; say which with --to ({names}), or end it as in {listed}"
            raise InputError(f"{request.out}: {text}")
        return BY_SUFFIX[suffix]
    target = request.to.strip().lower().replace("_", "-")
    if target not in (*known, "merl"):
        raise choices("format to write", request.to, (*known, "merl"))
    return target


def _samples(request: ConvertRequest, target: str) -> tuple[str, list[str]]:
    """The samples, or a dense table at the angles of a goniometer, in a format; and what was assumed of them."""
    from ..data import formats
    from ..exporters.tables import goniometric

    if target != "csv" and (dense := goniometric.of_dense_table(request.data, target, request.reading.options())):
        measurement, said = dense
    else:
        measurement, said = formats.read(request.data, **request.reading.options()), []
    text, notes = formats.write(target, measurement)
    return text, [*(finding.text for finding in measurement.findings), *said, *notes]


def _table(request: ConvertRequest) -> tuple[str | bytes, list[str]]:
    """A dense table or a fitted model in MERL's layout, and what was taken for granted."""
    from ..exporters.tables import tabulated

    return tabulated.merl(request.data, request.model, average_phi_i=request.reading.average_phi_i)

"""`brdfguide index`: n from F0, F0 from n + ik, or both by the name of a substance."""

from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError
from ._options import JsonOption, QuietOption, answer, remark
from ._request import refuse

EXAMPLES = "Examples: brdfguide index gold | brdfguide index --f0 0.04"

MOST_K = 1000.0  # metals in the far infrared have some 500


def index(
    context: Context,
    material: Annotated[
        str | None,
        Argument(
            help=(
                "A substance (brass), or with the extra `optics` an entry such as SiO2 or Au/Johnson; none and no "
                "option: the table."
            )
        ),
    ] = None,
    f0: Annotated[float | None, Option("--f0", help="Normal reflectance of a smooth sample.")] = None,
    n: Annotated[float | None, Option("--n", help="Refractive index.")] = None,
    k: Annotated[float, Option("--k", min=0, help="Absorption index.")] = 0.0,
    wavelength_nm: Annotated[
        float | None,
        Option(
            "--wavelength-nm", min=100, max=20000, help="At this wavelength; of refractiveindex.info at 550 otherwise."
        ),
    ] = None,
    json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Refractive index and normal reflectance, with what the usual simplifications cost."""
    from ..report.documents import indices
    from ..report.text.indices import text

    if sum(each is not None for each in (material, f0, n)) > 1:
        raise InputError("give one of: a substance, --f0, --n")
    if n is None:
        refuse(context, "k", because="it goes with --n")
    if material is None:
        refuse(context, "wavelength_nm", because="it goes with a substance, and none is asked for")
    if f0 is not None:
        document = indices.from_f0(f0)
    elif n is not None:
        if not 0 < n <= 100:
            raise InputError(f"n = {n:g}: a refractive index lies above 0, at most 100")
        if k > MOST_K:
            raise InputError(f"k = {k:g}: an absorption index is at most {MOST_K:g}")
        document = indices.from_index(n, k)
    elif material is not None:
        document = indices.named_index(material, None if wavelength_nm is None else wavelength_nm / 1000)
    else:
        document = indices.everything()
    answer(document, json, text)
    for each in document["warnings"] if not json else ():
        remark(f"note: {each['text']}", quiet)

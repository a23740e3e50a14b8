"""`brdfguide scatter`: what polished surfaces scatter, in every language in which people tell it."""

from pathlib import Path
from re import fullmatch
from typing import Annotated

from typer import Argument, Context, Option

from ..errors import InputError, choices
from ..records import dataclass
from ._fitting import assignments
from ._options import JsonOption, QuietOption, ThemeOption, answer, picture_file, remark
from ._request import refuse, refuse_theme

EXAMPLES = (
    "Examples: brdfguide scatter --ra 12nm --wavelength-nm 633 | brdfguide scatter abg a=1e-4 b=1e-5 g=1.8 --plot "
    "abg.png"
)
LAWS = ("abg", "harvey-shack", "abc")
UNITS_UM = {"nm": 1e-3, "um": 1.0, "µm": 1.0, "mm": 1e3, "A": 1e-4}
WAVELENGTH_NM = 550.0
NUMBERS, LIGHT = "A number", "Light"
BESIDE_SCAN = "it goes alone, or beside a scan"
NO_CURVE = "a number has no curve; give a law, a spectrum or a scan"


@dataclass(frozen=True, eq=False, kw_only=True)
class Number:
    """A height or a share of light that is known."""

    tis: Annotated[
        float | None, Option("--tis", help="Scattered share of what is reflected: 0.04.", rich_help_panel=NUMBERS)
    ] = None
    haze: Annotated[
        float | None,
        Option("--haze", help="Share beyond 2.5 degrees from the mirror direction.", rich_help_panel=NUMBERS),
    ] = None
    sigma: Annotated[
        str | None, Option("--sigma", "--rq", help="Rms height with its unit: 2nm.", rich_help_panel=NUMBERS)
    ] = None
    ra: Annotated[str | None, Option("--ra", help="Mean absolute height: 12nm, 0.8um.", rich_help_panel=NUMBERS)] = None
    rsm: Annotated[str | None, Option("--rsm", help="Mean spacing of the profile: 80um.", rich_help_panel=NUMBERS)] = (
        None
    )
    rdq: Annotated[
        float | None, Option("--rdq", min=1e-9, help="Rms slope of the profile.", rich_help_panel=NUMBERS)
    ] = None
    stop_deg: Annotated[
        float,
        Option("--stop-deg", min=0.01, max=45, help="From where on --tis was gathered.", rich_help_panel=NUMBERS),
    ] = 2.0
    band: Annotated[
        str | None,
        Option("--band", metavar="LOW:HIGH", help="Cut-offs as waves: 2.5um:0.8mm.", rich_help_panel=NUMBERS),
    ] = None


@dataclass(frozen=True, eq=False, kw_only=True)
class Lit:
    """The light, and what the smooth surface would send back."""

    wavelength_nm: Annotated[
        float | None, Option("--wavelength-nm", min=10, max=1e6, help="550 if left out.", rich_help_panel=LIGHT)
    ] = None
    theta_i: Annotated[float, Option("--theta-i", min=0, max=89, help="Incidence [deg].", rich_help_panel=LIGHT)] = 0.0
    f0: Annotated[
        float | None,
        Option(
            "--f0", min=1e-6, max=1, help="Reflectance of the smooth surface; 1 if left out.", rich_help_panel=LIGHT
        ),
    ] = None
    n: Annotated[float | None, Option("--n", min=0.01, max=100, help="Its index.", rich_help_panel=LIGHT)] = None
    k: Annotated[float | None, Option("--k", min=0, max=200, help="Its absorption.", rich_help_panel=LIGHT)] = None
    to_nm: Annotated[
        float | None,
        Option("--to-nm", min=10, max=1e6, help="Scale to this wavelength as well.", rich_help_panel=LIGHT),
    ] = None
    beta: Annotated[
        str | None,
        Option("--beta", metavar="LOW:HIGH", help="Which |beta - beta0| count.", rich_help_panel=LIGHT),
    ] = None


@dataclass(frozen=True, eq=False, kw_only=True)
class ScatterRequest:
    """Everything that `scatter` is asked."""

    context: Context
    words: Annotated[
        list[str] | None,
        Argument(help="A law with values (abg a=1e-4 b=1e-5 g=1.8), a spectrum's file (f, S) or a scan."),
    ] = None
    number: Number
    light: Lit
    plot: Annotated[
        Path | None, Option("--plot", callback=picture_file, help="Draw it, log-log (png, svg or pdf).")
    ] = None
    theme: ThemeOption = "light"
    json: JsonOption = False
    quiet: QuietOption = False


def scatter(request: ScatterRequest) -> None:
    """What a polished surface scatters: TIS, Ra and rms height, spectra, ABg, Harvey-Shack and K-correlation."""
    from ..report.text.scatter import text

    if request.plot is None:
        refuse_theme(request.context)
    document = _document(request)
    answer(document, request.json, text)
    if request.plot is not None:
        from ..report.figures.scatter import plot_scatter

        plot_scatter(document, request.plot, request.theme)
        remark(f"note: wrote {request.plot}", request.quiet)


def _document(request: ScatterRequest) -> dict:
    given = request.number
    heights = [name for name in ("tis", "haze", "sigma", "ra") if getattr(given, name) is not None]
    if not request.words and len(heights) != 1:
        raise InputError("wanted one of: a law with values, a file, --tis, --haze, --sigma (--rq), --ra")
    _check_light(request)
    if not request.words:
        refuse(request.context, "plot", "beta", because=NO_CURVE)
        refuse(request.context, "stop_deg", because="it goes with a scan and --tis")
        return _of_number(heights[0], request)
    refuse(request.context, "rsm", "rdq", because="they go with --ra or --sigma")
    first, *rest = request.words
    if first.endswith((".yaml", ".yml")):
        return _of_description(first, rest, request)
    if first in LAWS or not _is_scan(first):
        refuse(request.context, "tis", "haze", "sigma", "ra", "stop_deg", because=BESIDE_SCAN)
    if first in LAWS:
        return _of_law(first, rest, request)
    if not exists_as_file(first):
        raise choices("law or file", first, LAWS)
    if not _is_scan(first):
        if rest:
            raise InputError(f"{rest[0]}: one spectrum at a time; a scan goes first, its spectrum second")
        return _of_spectrum(first, request)
    return _of_scan(first, rest, request)


def _is_scan(word: str) -> bool:
    from ..data.spectrum_file import is_spectrum

    return exists_as_file(word) and not is_spectrum(word)


def exists_as_file(word: str) -> bool:
    """Whether a word means a file rather than a law."""
    return word == "-" or "." in word or "/" in word or Path(word).exists()


def _check_light(request: ScatterRequest) -> None:
    if request.light.n is None:
        refuse(request.context, "k", because="it goes with --n")
    else:
        refuse(request.context, "f0", because="--n says what is reflected")


def _light(request: ScatterRequest, wavelength_um: float | None = None):
    from ..report.documents.scatter import Incident

    lit = request.light
    return Incident(
        wavelength=wavelength_um or (lit.wavelength_nm or WAVELENGTH_NM) * 1e-3,
        theta_i_deg=lit.theta_i,
        reflectance=1.0 if lit.f0 is None else lit.f0,
        n=lit.n,
        k=lit.k or 0.0,
        elsewhere=None if lit.to_nm is None else lit.to_nm * 1e-3,
    )


def _of_number(name: str, request: ScatterRequest) -> dict:
    from ..physics import profile_numbers
    from ..report.documents import scatter as documents

    given, light = request.number, _light(request)
    if request.light.f0 is not None or request.light.n is not None:
        refuse(request.context, "f0", "n", "k", because="a share of what is reflected asks for no reflectance")
    if name in ("tis", "haze"):
        refuse(request.context, "rsm", "rdq", "band", because="they are of a profile; give --ra or --sigma")
        known = documents.of_total if name == "tis" else documents.of_haze
        return known(getattr(given, name), light)
    if given.rsm is not None:
        refuse(request.context, "rdq", because="--rsm says the slope already")
    height = length_um(getattr(given, name), f"--{name}")
    assumes = []
    if name == "ra":
        height, assumes = profile_numbers.rq_from_ra(height), [profile_numbers.GAUSSIAN + ": Rq = 1.2533 Ra"]
    if given.band is None:
        assumes.append("the instrument saw every wave that the light sees [--band]")
    return documents.of_height(
        height,
        light,
        said={"ra": "Ra", "sigma": "sigma"}[name],
        band=None if given.band is None else _band(given.band),
        spacing=None if given.rsm is None else length_um(given.rsm, "--rsm"),
        slope=given.rdq,
        assumes=assumes,
    )


def _of_law(law: str, words: list[str], request: ScatterRequest) -> dict:
    from dataclasses import replace

    from ..models.surface import Surface
    from ..report.documents import scatter as documents

    surface = Surface.named(law, assignments(words, law))
    light, band = _light(request), None
    if law == "abc":
        refuse(request.context, "n", "k", because="`abc` has the reflectance f0")
        refuse(request.context, "f0", because="it is a value of the law: f0=0.9")
        light = replace(light, reflectance=float(surface.values["abc.f0"]))
        band = None if request.number.band is None else _band(request.number.band)
    else:
        refuse(request.context, "band", because=f"{law} has no spectrum; `abc` and files of spectra have")
    return documents.of_law(surface, law, light, _reach(request), band)


def _of_spectrum(path: str, request: ScatterRequest) -> dict:
    from ..data.spectrum_file import read_spectrum
    from ..report.documents import scatter as documents

    band = None if request.number.band is None else _band(request.number.band)
    return documents.of_spectrum(read_spectrum(path), _light(request), _reach(request), band)


def _of_scan(path: str, rest: list[str], request: ScatterRequest) -> dict:
    """A scan, with a profile's spectrum or height and a TIS beside it where they are given."""
    from dataclasses import replace

    from ..data import formats
    from ..report.documents import scatter as documents

    refuse(request.context, "haze", because="beside a scan, give what was gathered as --tis with --stop-deg")
    if request.number.tis is None:
        refuse(request.context, "theta_i", because="the scan has its own incidence")
        refuse(request.context, "stop_deg", because="it goes with --tis")
    profile = _profile(rest, request)
    measurement = _one_channel(formats.read(path, wavelength_nm=request.light.wavelength_nm))
    wavelength = float(measurement.geom.wavelength.ravel()[0])
    total = _total(request, wavelength)
    light = replace(_light(request, wavelength), theta_i_deg=float(measurement.geom.theta_i_deg[0, 0]))
    return documents.of_scan(measurement, light, _reach(request, widest=2.0), profile, total)


def _of_description(path: str, rest: list[str], request: ScatterRequest) -> dict:
    """A description that names a scan, with its profile and its TIS."""
    from dataclasses import replace

    from ..advice.material import read_material
    from ..advice.profile import HEIGHTS, band_of, height_of
    from ..data import formats
    from ..fitting.three_ways import Profile, Total
    from ..report.documents import scatter as documents

    refuse(
        request.context, "tis", "haze", "sigma", "ra", "band", "stop_deg", "theta_i", because="the description says it"
    )
    given = read_material(path).given
    if rest or len(given.get("measurements", ())) != 1:
        raise InputError(f"{path}: wanted one scan under 'measurements', and nothing beside the description")
    stylus, tis = given.get("stylus", {}), given.get("tis")
    measurement = _one_channel(
        formats.read(Path(path).parent / given["measurements"][0], wavelength_nm=request.light.wavelength_nm)
    )
    wavelength = float(measurement.geom.wavelength.ravel()[0])
    profile = total = None
    if told := stylus.get("spectrum"):
        spectrum = told["points"]
        low, high = band_of(stylus)
        profile = Profile((low, high or spectrum.ends[1]), spectrum=spectrum)
    elif stylus.keys() & HEIGHTS.keys():
        if not {"shortest_um", "cutoff_um"} <= stylus.keys():
            raise InputError(f"{path}: 'stylus' needs 'shortest_um' and 'cutoff_um': a height is compared in its band")
        height = height_of(given)
        profile = Profile((1 / stylus["cutoff_um"], 1 / stylus["shortest_um"]), rq=height.value if height else None)
    if tis:
        at = tis.get("wavelength_nm", 1000 * wavelength) / 1000
        total = Total(tis["share"], at, tis.get("theta_i_deg", 0.0), tis.get("stop_deg", 2.0))
    light = replace(_light(request, wavelength), theta_i_deg=float(measurement.geom.theta_i_deg[0, 0]))
    if "f0" in given and request.light.f0 is None and request.light.n is None:
        light = replace(light, reflectance=float(given["f0"][0]))
    return documents.of_scan(measurement, light, _reach(request, widest=2.0), profile, total)


def _profile(rest: list[str], request: ScatterRequest):
    """The profile beside a scan: a spectrum's file, or a height in a band. Raises InputError for both, and half."""
    from ..data.spectrum_file import read_spectrum
    from ..fitting.three_ways import Profile
    from ..physics.profile_numbers import rq_from_ra

    given = request.number
    heights = [name for name in ("sigma", "ra") if getattr(given, name) is not None]
    if len(rest) + len(heights) > 1:
        raise InputError("one profile at a time: a spectrum's file, --rq or --ra")
    if not rest and not heights:
        refuse(request.context, "band", because="a scan sees the waves of its own angles [--beta]")
        return None
    band = None if given.band is None else _band(given.band)
    if rest:
        spectrum = read_spectrum(rest[0])
        return Profile(band or spectrum.ends, spectrum=spectrum)
    if band is None:
        raise InputError(f"--{heights[0]} beside a scan needs its cut-offs: --band 2.5um:0.8mm")
    height = length_um(getattr(given, heights[0]), f"--{heights[0]}")
    return Profile(band, rq=rq_from_ra(height) if heights[0] == "ra" else height)


def _total(request: ScatterRequest, wavelength: float):
    from ..fitting.three_ways import Total

    tis = request.number.tis
    if tis is None:
        return None
    if not 0 < tis < 1:
        raise InputError(f"--tis {tis:g}: wanted a share between 0 and 1 (4 % is 0.04)")
    return Total(tis, wavelength, request.light.theta_i, request.number.stop_deg)


def _one_channel(measurement):
    """The measurement. Raises InputError for more than one channel."""
    if len(measurement.channels) > 1:
        raise InputError(
            f"{measurement.name}: {len(measurement.channels)} channels; wanted one [--wavelength of fit], "
            "or `fit -m abc`, in which wavelengths share the spectrum"
        )
    return measurement


def _reach(request: ScatterRequest, widest: float | None = None) -> tuple[float, float]:
    """The least and the greatest |β - β0| that count."""
    from ..fitting.scatter_laws import widest as farthest
    from ..report.documents.scatter import LOW_BETA

    most = widest or farthest(request.light.theta_i)
    text = request.light.beta
    if text is None:
        return LOW_BETA, most
    try:
        low, high = map(float, text.split(":"))
    except ValueError:
        low = high = 0.0
    if not 0 < low < high <= most:
        raise InputError(f"--beta {text}: wanted LOW:HIGH between 0 and {most:.3g}, such as 0.001:0.5")
    return low, high


def length_um(text: str, option: str) -> float:
    """`12nm` or `0.8um` in µm. Raises InputError for anything else."""
    found = fullmatch(r"\s*([0-9.]+(?:[eE][-+]?[0-9]+)?)\s*([A-Za-zµ]+)\s*", text)
    try:
        value = float(found[1]) * UNITS_UM[found[2]] if found else 0.0
    except (ValueError, KeyError):
        value = 0.0
    if not 0 < value < 1e6:
        raise InputError(f"{option} {text}: wanted a length with its unit, such as 12nm or 0.8um")
    return value


def _band(text: str) -> tuple[float, float]:
    """`2.5um:0.8mm`, the shortest and the longest wave, as spatial frequencies [1/µm], low first."""
    short, colon, long = text.partition(":")
    if not colon:
        raise InputError(f"--band {text}: wanted the shortest and the longest wave, such as 2.5um:0.8mm")
    shortest, longest = length_um(short, "--band"), length_um(long, "--band")
    if not shortest < longest:
        raise InputError(f"--band {text}: the first wave has to be the shorter one")
    return 1 / longest, 1 / shortest

"""What a person knows or saw of one surface: observations, blank unless made.

`read_material(path)` checks a YAML file against `FIELDS`, which is the schema (docs/materials.md), and gives a
`Material`. Angles become radians here, lengths stay in µm; nothing is guessed. Guidelines fill blanks with `filled`,
which cannot overwrite.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from math import pi, radians

from .yaml_schema import Document, Field, parse, read

KINDS = ("metal", "dielectric", "semiconductor")
APPEARANCES = ("solid colour", "metallic flake", "black", "metal", "clear", "pearlescent", "fluorescent")
FINISHES = ("mirror", "high gloss", "satin", "low gloss", "matt")  # smoothest first
PATCHES = ("white", "neutral 8", "neutral 6.5", "neutral 5", "neutral 3.5", "black")

OBSERVATIONS = (
    Field("kind", "word", choices=KINDS, meaning="what the surface is made of, if you know it"),
    Field("composition", "text", meaning="the substance by name, such as brass or acrylic"),
    Field("appearance", "word", choices=APPEARANCES, meaning="what the body looks like below the highlight"),
    Field("finish", "word", choices=FINISHES, meaning="how sharp its reflections look"),
    Field("highlight_colour", "word", choices=("white", "tinted"), meaning="white: the highlight has the lamp's colour; tinted: the surface's"),
    Field("coat", "word", choices=("clear", "none"), meaning="a transparent layer over what is seen"),
    Field("f0", "numbers", low=0, high=0.9999, counts=(1, 3), meaning="mirror reflectance of a smooth sample near normal incidence; one, or red green blue"),
    Field("index", "group", meaning="index of refraction n + ik", fields=(
        Field("n", "numbers", above=0, high=20, counts=(1, 3), required=True, meaning="real part; one, or red green blue"),
        Field("k", "numbers", low=0, high=20, counts=(1, 3), meaning="imaginary part; left out: 0"),
        Field("wavelength_nm", "numbers", unit="nm", low=100, high=20000, counts=(1, 3), meaning="where it was measured"),
    )),
    Field("diffuse_reflectance", "numbers", low=0, high=1, counts=(1, 3), meaning="from a reflectometer; one, or red green blue"),
    Field("colorchecker", "group", meaning="comparison by eye with the neutral patches", fields=(
        Field("patch", "word", choices=PATCHES, meaning="the patch that looks as light"),
        Field("between", "texts", meaning="the two patches that it lies between"),
        Field("position", "number", low=0, high=1, meaning="0 at the first of the two, 1 at the second"),
        Field("data_set", "word", choices=("average", "iso17321"), meaning="whose reflectances of the chart; left out: average"),
    )),
    Field("photometer", "group", meaning="signal on the surface against a reference in the same light", fields=(
        Field("ratio", "number", low=0, high=10, required=True, meaning="surface over reference"),
        Field("reference", "number", above=0, high=1, required=True, meaning="reflectance of the reference"),
        Field("of", "word", choices=("diffuse", "mirror"), meaning="what was compared; left out: diffuse"),
    )),
    Field("gloss", "group", meaning="glossmeter readings", fields=tuple(
        Field(angle, "number", unit="GU", low=0, high=2000, meaning=f"gloss units at {angle}°") for angle in ("20", "60", "85")
    )),
    Field("highlight_width_deg", "number", unit="°", above=0, high=180, meaning="full width at half height of a small lamp's highlight, near normal"),
    Field("emergence_angle_deg", "number", unit="°", low=0, high=89.9, choices=("never",), meaning="where a mirror image first appears, from the normal"),
    Field("stylus", "group", meaning="roughness from a stylus or profilometer", fields=(
        Field("sigma_um", "number", unit="µm", above=0, high=1000, meaning="rms height"),
        Field("tau_um", "number", unit="µm", above=0, high=10000, meaning="correlation length"),
        Field("cutoff_um", "number", unit="µm", above=0, high=100000, meaning="longest wavelength kept"),
    )),
    Field("changes_when_turned", "flag", meaning="the highlight changes as the sample turns in its plane"),
    Field("light_bleed_mm", "number", unit="mm", low=0, high=1000, meaning="how far light spreads sideways below the surface"),
    Field("pixel_mm", "number", unit="mm", above=0, high=1e6, meaning="what one pixel covers on the surface"),
    Field("retroreflective", "flag", meaning="brightest when lit from behind the viewer's head"),
    Field("structure", "word", choices=("surface", "hair", "fur", "velvet", "cloth", "foam", "foliage", "granular"), meaning="whether there is one well-defined surface"),
    Field("texture", "word", choices=("random", "brushed", "machined", "grating", "woven", "printed"), meaning="order in the roughness"),
    Field("steep", "flag", meaning="slopes like sandpaper, unglazed ceramic or flat house paint"),
    Field("off_plane", "flag", meaning="it will be seen out of the plane of incidence"),
    Field("wavelength_nm", "number", unit="nm", low=300, high=20000, meaning="the light that matters; left out: 550"),
    Field("viewing", "group", meaning="the eye that looked for the mirror image", fields=(
        Field("pupil_mm", "number", unit="mm", low=0.1, high=100, meaning="left out: 3"),
        Field("distance_mm", "number", unit="mm", low=1, high=1e6, meaning="left out: 600"),
    )),
)  # fmt: skip
FIELDS = (
    Field("name", "text", meaning="what to call it"),
    Field("about", "text", meaning="a sentence for people; never read for meaning"),
    *OBSERVATIONS,
    Field("measurements", "texts", meaning="files of measured data, relative to this one"),
    Field("sources", "group", meaning="where each observation comes from", fields=tuple(Field(f.name, "text", meaning=f.meaning) for f in OBSERVATIONS)),
)


@dataclass(frozen=True)
class Material:
    """Observations, and what guidelines filled in; `given` is the file as read, `filled_by` says which rule set what."""

    name: str = ""
    kind: str | None = None
    composition: str | None = None
    appearance: str | None = None
    finish: str | None = None
    highlight_colour: str | None = None
    coat: str | None = None
    f0: tuple[float, ...] | None = None
    n: tuple[float, ...] | None = None
    k: tuple[float, ...] | None = None
    index_wavelength: tuple[float, ...] | None = None  # µm
    albedo: tuple[float, ...] | None = None
    colorchecker: Mapping | None = None
    photometer: Mapping | None = None
    gloss: Mapping[int, float] | None = None
    highlight_width: float | None = None  # rad
    emerges: bool | None = None
    emergence: float | None = None  # rad
    sigma: float | None = None  # µm
    tau: float | None = None  # µm
    cutoff: float | None = None  # µm
    changes_when_turned: bool | None = None
    light_bleed_mm: float | None = None
    pixel_mm: float | None = None
    retroreflective: bool | None = None
    structure: str | None = None
    texture: str | None = None
    steep: bool | None = None
    off_plane: bool | None = None
    wavelength: float | None = None  # µm
    viewing: Mapping | None = None
    measurements: tuple[str, ...] = ()
    # filled in by guidelines only
    subsurface: str | None = None  # lambertian, lobe, none
    alpha: float | None = None
    slope: float | None = None
    given: Mapping = field(default_factory=dict)
    filled_by: Mapping[str, str] = field(default_factory=dict)

    def filled(self, values: Mapping, rule: str) -> "Material":
        """With the blanks among `values` filled; what was observed or filled before stays."""
        new = {name: value for name, value in values.items() if getattr(self, name) is None}
        if not new:
            return self
        return replace(self, **new, filled_by={**self.filled_by, **dict.fromkeys(new, rule)})

    @property
    def solid_angle(self) -> float:
        """Of the eye that looks for the mirror image [sr]: a 3 mm pupil at 0.6 m unless given."""
        viewing = self.viewing or {}
        return pi * (viewing.get("pupil_mm", 3.0) / 2 / viewing.get("distance_mm", 600.0)) ** 2


def read_material(path) -> Material:
    """The material at `path` (`-`: standard input). Raises InputError with every error, a line each."""
    return from_document(read(path, FIELDS, RULES))


def parse_material(text: str, name: str = "<text>") -> Material:
    return from_document(parse(text, FIELDS, RULES, name))


def from_document(document: Document) -> Material:
    return from_values(document.values, document.name)


def from_values(given: Mapping, name: str = "") -> Material:
    """A Material from values as they stand in a file, checked."""
    own = {f.name for f in fields(Material)}
    values = {key: value for key, value in given.items() if key in own and key not in ("gloss", "f0", "measurements", "name")}
    values |= {key: tuple(given[key]) for key in ("f0", "measurements") if key in given}
    values["name"] = given.get("name") or str(name).rpartition("/")[2].removesuffix(".yaml").removesuffix(".yml").replace("_", " ").replace("-", " ")
    if index := given.get("index"):
        values["n"] = tuple(index["n"])
        values["k"] = tuple(index.get("k", [0.0]))
        values["index_wavelength"] = tuple(nm / 1000 for nm in index["wavelength_nm"]) if "wavelength_nm" in index else None
    if "diffuse_reflectance" in given:
        values["albedo"] = tuple(given["diffuse_reflectance"])
    if given.get("gloss"):
        values["gloss"] = {int(angle): reading for angle, reading in given["gloss"].items()}
    if "highlight_width_deg" in given:
        values["highlight_width"] = radians(given["highlight_width_deg"])
    if "emergence_angle_deg" in given:
        values["emerges"] = given["emergence_angle_deg"] != "never"
        values["emergence"] = radians(given["emergence_angle_deg"]) if values["emerges"] else None
    stylus = given.get("stylus", {})
    values |= {inside: stylus[outside] for inside, outside in (("sigma", "sigma_um"), ("tau", "tau_um"), ("cutoff", "cutoff_um")) if outside in stylus}
    if "wavelength_nm" in given:
        values["wavelength"] = given["wavelength_nm"] / 1000
    return Material(**values, given=given)


def _chart(document: Document):
    """A comparison names one patch, or two and a position."""
    chart = document.values.get("colorchecker")
    if chart is None:
        return
    if ("patch" in chart) == ("between" in chart):
        yield "colorchecker", "'colorchecker' needs either 'patch', or 'between' two patches with a 'position'"
    if "between" in chart:
        if len(chart["between"]) != 2 or len(set(chart["between"])) != 2 or not set(chart["between"]) <= set(PATCHES):
            yield "colorchecker.between", f"'colorchecker.between' wants two different patches of: {', '.join(PATCHES)}"
        if "position" not in chart:
            yield "colorchecker.between", "'colorchecker.between' needs a 'position', from 0 at the first patch to 1 at the second"


def _index(document: Document):
    """n, k and their wavelengths go together."""
    index = document.values.get("index", {})
    counts = {len(index[key]) for key in ("n", "k", "wavelength_nm") if key in index} - {1}
    if len(counts) > 1:
        yield "index", "'index' has lists of different lengths; n, k and wavelength_nm want one value each or three"
    if "n" in index and "k" not in index and min(index["n"]) < 1:
        yield "index.n", f"'index.n' is {min(index['n']):g} without 'k'; below 1 it belongs to a metal, which needs its k"


def _ratio(document: Document):
    meter = document.values.get("photometer", {})
    if {"ratio", "reference"} <= meter.keys() and meter["ratio"] * meter["reference"] > 1:
        yield "photometer.ratio", f"'photometer' gives a reflectance of {meter['ratio'] * meter['reference']:.3g}; a surface reflects at most 1"


def _stylus(document: Document):
    stylus = document.values.get("stylus")
    if stylus is not None and not stylus.keys() & {"sigma_um", "tau_um"}:
        yield "stylus", "'stylus' needs sigma_um, tau_um or both"


def _something(document: Document):
    """A file with nothing but a name says nothing."""
    if not document.values.keys() - {"name", "about", "sources"}:
        yield "", f"no observation; give at least one of: {', '.join(f.name for f in OBSERVATIONS)}"


RULES = (_chart, _index, _ratio, _stylus, _something)

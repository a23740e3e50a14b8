"""What a person knows or saw of one surface: observations, blank unless made.

`read_material(path)` checks a YAML file against `FIELDS`, which is the schema (docs/materials.md), and gives a
`Material`. Angles become radians here, lengths stay in µm; nothing is guessed. Guidelines fill blanks with `filled`,
which cannot overwrite.
"""

from collections.abc import Mapping
from dataclasses import field, fields, replace
from math import pi, radians
from pathlib import Path
from typing import Any

from ..physics.picked_colour import of_hex
from ..physics.roughness_senses import SENSES, USUAL, alpha_of
from ..records import dataclass
from ..yaml_schema import Document, parse, read, written
from .observed_fields import FIELDS, OBSERVATIONS, PATCHES
from .profile import HEIGHTS, band_of, height_of, length_of, spectrum_at, with_spectrum

ROUND_ASPECT = 1.1  # of a highlight, up to which a mounting or the lamp's own shape explains it (ours)
CONVERTED = ("gloss", "f0", "measurements", "name", "base_color")  # keys whose field holds another form of them


@dataclass(frozen=True)
class Material:
    """Observations, and what guidelines filled in; `given` is the file as read, `filled_by` which rule set what."""

    name: str = ""
    kind: str | None = None
    composition: str | None = None
    appearance: str | None = None
    finish: str | None = None
    highlight_colour: str | None = None
    coat: str | None = None
    wet: bool | None = None
    f0: tuple[float, ...] | None = None
    n: tuple[float, ...] | None = None
    k: tuple[float, ...] | None = None
    index_wavelength: tuple[float, ...] | None = None  # µm
    albedo: tuple[float, ...] | None = None
    base_color: tuple[float, ...] | None = None  # linear
    metallic: float | None = None
    typed_alpha: float | None = None  # of a shader's roughness
    colorchecker: Mapping | None = None
    photometer: Mapping | None = None
    gloss: Mapping[int, float] | None = None
    highlight_width: float | None = None  # rad
    flake_highlight_width: float | None = None  # rad, as seen through the coat
    haze: float | None = None
    emerges: bool | None = None
    emergence: float | None = None  # rad
    dimming: Mapping | None = None
    sigma: float | None = None  # µm
    tau: float | None = None  # µm
    cutoff: float | None = None  # µm
    changes_when_turned: bool | None = None
    turned_90_brighter: bool | None = None
    grain_deg: float | None = None
    highlight_aspect: float | None = None
    streak: str | None = None
    light_bleed_mm: float | None = None
    pixel_mm: float | None = None
    retroreflective: bool | None = None
    structure: str | None = None
    texture: str | None = None
    steep: bool | None = None
    off_plane: bool | None = None
    wavelength: float | None = None  # µm
    viewing: Mapping | None = None
    doubts: Mapping | None = None
    measurements: tuple[str, ...] = ()
    # filled in by guidelines only
    subsurface: str | None = None  # lambertian, lobe, none
    alpha: float | None = None
    slope: float | None = None
    inference: Any = None  # what all readings say together, an `inference.Inference`
    given: Mapping = field(default_factory=dict)
    filled_by: Mapping[str, str] = field(default_factory=dict)

    def filled(self, values: Mapping, rule: str) -> "Material":
        """With the blanks among `values` filled; what was observed or filled before stays."""
        new = {name: value for name, value in values.items() if getattr(self, name) is None}
        if not new:
            return self
        return replace(self, **new, filled_by={**self.filled_by, **dict.fromkeys(new, rule)})

    @property
    def under_a_coat(self) -> bool:
        """Whether a clear coat lies over a metal or over flakes, so that finish and gloss are above all the coat's."""
        return self.subsurface == "lobe" or (self.kind == "metal" and self.coat == "clear")

    @property
    def solid_angle(self) -> float:
        """Of the eye that looks for the mirror image [sr]: a 3 mm pupil at 0.6 m unless given."""
        viewing = self.viewing or {}
        return pi * (viewing.get("pupil_mm", 3.0) / 2 / viewing.get("distance_mm", 600.0)) ** 2


def read_material(path) -> Material:
    """The material at `path` (`-`: standard input). Raises InputError with every error, a line each."""
    return from_document(read(path, FIELDS, RULES))


def read_beside(path) -> list[Path]:
    """Files whose names or bytes the material at `path` follows from: the spectrum that it names; itself, where its
    name is the file's. Raises InputError as `read_material` does."""
    document = read(path, FIELDS, RULES)
    spectrum = document.values.get("stylus", {}).get("spectrum")
    found = [] if "name" in document.values else [Path(str(path))]
    return [*found, spectrum_at(spectrum, document)] if isinstance(spectrum, str) else found


def parse_material(text: str, name: str = "<text>") -> Material:
    return from_document(parse(text, FIELDS, RULES, name))


def said_to_be_grained(material: Material) -> bool:
    """Whether it is said to be brushed, or its highlight was seen to be a streak or to change as the sample turns."""
    drawn_out = material.streak not in (None, "none") or (material.highlight_aspect or 1.0) > ROUND_ASPECT
    turned = material.changes_when_turned or material.turned_90_brighter
    return bool(turned or material.texture == "brushed" or drawn_out)


def observed(observations: Mapping) -> Material:
    """The material of observations by the keys of a file. Raises InputError with every mistake, a line each."""
    return parse_material(written(dict(observations)), "observations")


def from_document(document: Document) -> Material:
    """A Material from what was read, with the spectrum of heights that it names. Raises InputError where it is none."""
    return from_values(with_spectrum(document), document.name)


def from_values(given: Mapping, name: str = "") -> Material:
    """A Material from values as they stand in a file, checked."""
    own = {f.name for f in fields(Material)}
    values = {key: value for key, value in given.items() if key in own and key not in CONVERTED}
    values |= {key: tuple(given[key]) for key in ("f0", "measurements") if key in given}
    values["name"] = given.get("name") or str(name).rpartition("/")[2].removesuffix(".yaml").removesuffix(
        ".yml"
    ).replace("_", " ").replace("-", " ")
    if index := given.get("index"):
        values["n"] = tuple(index["n"])
        values["k"] = tuple(index.get("k", [0.0]))
        values["index_wavelength"] = (
            tuple(nm / 1000 for nm in index["wavelength_nm"]) if "wavelength_nm" in index else None
        )
    if "diffuse_reflectance" in given:
        values["albedo"] = tuple(given["diffuse_reflectance"])
    values |= _of_a_shader(given)
    if given.get("gloss"):
        values["gloss"] = {int(angle): reading for angle, reading in given["gloss"].items()}
    if "highlight_width_deg" in given:
        values["highlight_width"] = radians(given["highlight_width_deg"])
    if "flake_highlight_width_deg" in given:
        values["flake_highlight_width"] = radians(given["flake_highlight_width_deg"])
    if "emergence_angle_deg" in given:
        values["emerges"] = given["emergence_angle_deg"] != "never"
        values["emergence"] = radians(given["emergence_angle_deg"]) if values["emerges"] else None
    if known := height_of(given):
        values["sigma"] = known.value
    if known := length_of(given):
        values["tau"] = known.value
    if low := band_of(given.get("stylus", {}))[0]:
        values["cutoff"] = 1 / low
    if "wavelength_nm" in given:
        values["wavelength"] = given["wavelength_nm"] / 1000
    return Material(**values, given=given)


def _of_a_shader(given: Mapping) -> dict:
    """Fields from what is typed into a shader."""
    values: dict[str, Any] = {}
    if "base_color" in given:
        typed = given["base_color"]
        values["base_color"] = of_hex(typed) if isinstance(typed, str) else tuple(typed)
    if "roughness" in given:
        values["typed_alpha"] = alpha_of(given["roughness"], given.get("in", USUAL))
    if "ior" in given and given.get("metallic") != 1:
        values |= {"n": (given["ior"],), "k": (0.0,)}
    return values


def _shader_words(document: Document):
    """A shader's words among each other."""
    values = document.values
    if "in" in values and "roughness" not in values:
        yield "in", "'in' says how 'roughness' is meant, and there is none"
    most = SENSES[values.get("in", USUAL)].most
    if "roughness" in values and values["roughness"] > most:
        yield (
            "roughness",
            f"'roughness' is {values['roughness']:g}; in {values.get('in', USUAL)} it is at most {most:g}",
        )
    if values.get("metallic", 0) not in (0, 1):
        yield "metallic", f"'metallic' is {values['metallic']:g}; a surface is a metal, 1, or none, 0"
    if "ior" in values and "index" in values:
        yield "ior", "'ior' and 'index' are one number twice; give one of them"


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
            yield (
                "colorchecker.between",
                "'colorchecker.between' needs a 'position', from 0 at the first patch to 1 at the second",
            )


def _index(document: Document):
    """n, k and their wavelengths go together."""
    index = document.values.get("index", {})
    counts = {len(index[key]) for key in ("n", "k", "wavelength_nm") if key in index} - {1}
    if len(counts) > 1:
        yield "index", "'index' has lists of different lengths; n, k and wavelength_nm want one value each or three"
    if "n" in index and "k" not in index and min(index["n"]) < 1:
        yield (
            "index.n",
            f"'index.n' is {min(index['n']):g} without 'k'; below 1 it belongs to a metal, which needs its k",
        )


def _ratio(document: Document):
    meter = document.values.get("photometer", {})
    if {"ratio", "reference"} <= meter.keys() and meter["ratio"] * meter["reference"] > 1:
        yield (
            "photometer.ratio",
            (
                f"'photometer' gives a reflectance of {meter['ratio'] * meter['reference']:.3g}; a surface reflects "
                f"at most 1"
            ),
        )


def _stylus(document: Document):
    stylus = document.values.get("stylus")
    if stylus is not None and not stylus.keys() & {*HEIGHTS, "tau_um", "rsm_um", "spectrum"}:
        yield "stylus", f"'stylus' needs a height ({', '.join(HEIGHTS)}), tau_um, rsm_um or a spectrum"
    if stylus is not None and stylus.keys() & {"rdq", "sdq"} and not stylus.keys() & HEIGHTS.keys():
        yield "stylus", f"'stylus' has a slope without a height; give one of: {', '.join(HEIGHTS)}"
    short, long = (stylus or {}).get("shortest_um"), (stylus or {}).get("cutoff_um")
    if short is not None and long is not None and not short < long:
        yield "stylus.shortest_um", f"'stylus.shortest_um' is {short:g}, not below 'cutoff_um', {long:g}"


def _dimming(document: Document):
    seen = document.values.get("dimming", {})
    if {"angles_deg", "ratio"} <= seen.keys() and len(seen["angles_deg"]) != len(seen["ratio"]):
        yield (
            "dimming.ratio",
            f"'dimming' has {len(seen['angles_deg'])} angles and {len(seen['ratio'])} ratios; wanted as many",
        )


def _doubted(document: Document):
    """A doubt belongs to something that was observed."""
    values = document.values
    stylus = values.get("stylus", {})
    there = {**values, **stylus} | ({"gloss_gu": values["gloss"]} if "gloss" in values else {})
    for name in values.get("doubts", {}):
        if name not in there:
            yield f"doubts.{name}", f"'doubts.{name}' is the doubt of an observation that is not there"


def _something(document: Document):
    """A file with nothing but a name says nothing."""
    if not document.values.keys() - {"name", "about", "sources", "doubts"}:
        yield "", f"no observation; give at least one of: {', '.join(f.name for f in OBSERVATIONS)}"


RULES = (_chart, _shader_words, _index, _ratio, _stylus, _dimming, _doubted, _something)

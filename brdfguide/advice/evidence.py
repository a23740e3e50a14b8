"""What a description says about roughness, index and albedo, each observation with its own doubt.

`evidence_of(material)` turns observations into numbers that a law can predict. A doubt is one standard deviation: as
stated under `doubts`, else the usual one of such a reading (`USUAL`).
"""

from dataclasses import replace
from math import atan, cos, degrees, hypot, log, radians, sqrt

from ..physics import emergence, gloss
from ..physics.fresnel import fresnel
from ..records import dataclass
from .material import Material
from .profile import height_of, length_of

# One standard deviation of a reading of which nothing is stated: how people and shop instruments read (ours, except
# that glossmeters repeat within max(1 unit, 1.5 %), see gloss.REPEATS).
USUAL = {
    "emergence_angle_deg": 2.0,  # °
    "highlight_width_deg": 0.1,  # of the width
    "roughness": 0.01,  # of the alpha that a typed number means: it is meant as it is typed
    "sigma_um": 0.1,  # of a stylus' rms height
    "tau_um": 0.2,  # of its correlation length, which depends on how the profile was cut and levelled
    "haze": 0.02,  # of the reflected light
    "dimming": 0.03,  # of the strength of the mirror image, and DARK besides
    "f0": 0.03,  # of the reflectance
    "diffuse_reflectance": 0.01,
}
DARK = 0.003  # of a photograph of a mirror image: what its dark level leaves of the ratio
USUAL_N, USUAL_N_DOUBT = 1.5, 0.06  # dielectrics: most plastics, glasses and paints lie in 1.38 to 1.62 (ours)
KNOWN_N_DOUBT, NAMED_N_DOUBT = 0.005, 0.02  # of an index that was observed, and of a substance's (ours)
METAL_DOUBT = {"observed": 0.03, "named": 0.05, "unknown": 0.2}  # of the reflectance of a metal, as a share (ours)
CHROMIUM = (3.18, 4.41)  # n, k in the middle of the metals (Westin et al. 2004, Table 1)
USUAL_ALBEDO, USUAL_ALBEDO_DOUBT = 0.3, 0.25  # of a body of unknown lightness (ours): all that dielectrics have
FLAKES = (0.6, 0.2)  # reflectance of metallic flakes and its doubt (ours): between chromium's and half of aluminium's
# How much of a smooth surface's light at 60° still reaches a glossmeter, as the trade uses the words: 70 units and more
# are high gloss; 27, 9 and 2 are the middles of satin, low gloss and matt, and neighbours lie a factor 3 apart.
SHARPNESS = {"mirror": 0.97, "high gloss": 0.76, "satin": 0.29, "low gloss": 0.098, "matt": 0.04}
BOUNDS = {"mirror": "at least", "high gloss": "at least", "matt": "at most"}
HALF_A_CLASS = log(3) / 2
LOOKED_UP_TO_DEG = 85.0  # as far as people usually look for a mirror image


@dataclass(frozen=True)
class Observation:
    """One reading as a number to be predicted: `value` and `doubt` in its own unit, of lengths and widths as ln."""

    key: str  # in a description, such as gloss.60
    quantity: str  # gloss, width, haze, emergence, dimming, sigma, tau, sharpness
    value: float
    doubt: float
    angle: float = 0.0  # of incidence [°], where the quantity has one
    side: str = ""  # "at least", "at most": a bound; "": a value
    wavelength: float = emergence.WAVELENGTH  # µm, of a mirror image's strength


@dataclass(frozen=True)
class Evidence:
    """All that bears on the surface's roughness, and what is known before of its index and of the body below."""

    observations: tuple[Observation, ...]
    n: float = USUAL_N  # of a dielectric, or of a coat
    n_doubt: float = USUAL_N_DOUBT
    # of a metal, or of what lies under a coat: reflectance at gloss.ANGLES, and its doubt as a share; empty: none
    base: tuple[float, ...] = ()
    base_doubt: float = 0.0
    coated: bool = False  # whether a clear coat lies over the base
    albedo: float = 0.0
    albedo_doubt: float = 0.0
    wavelength: float = emergence.WAVELENGTH  # µm, of the eye that looked for the mirror image
    solid_angle: float = emergence.OMEGA  # sr, of the same

    def without(self, key: str) -> "Evidence":
        """The same but for one observation."""
        return replace(self, observations=tuple(each for each in self.observations if each.key != key))


def evidence_of(material: Material) -> Evidence | None:
    """What a material says; None where nothing but a look says anything of its roughness."""
    found = (*_gloss(material), *_lobe(material), *_mirror_image(material), *_stylus(material))
    if not found:
        return None
    n, n_doubt = _index(material)
    base, base_doubt = _base(material)
    albedo, albedo_doubt = _body(material)
    return Evidence(
        (*found, *_look(material)),
        n=n,
        n_doubt=n_doubt,
        base=base,
        base_doubt=base_doubt,
        coated=bool(base) and material.under_a_coat,
        albedo=albedo,
        albedo_doubt=albedo_doubt,
        wavelength=material.wavelength or emergence.WAVELENGTH,
        solid_angle=material.solid_angle,
    )


def shows_highlight(material: Material) -> bool:
    """Whether a highlight was seen, or read beyond what a white body alone gives a glossmeter."""
    readings = (material.gloss or {}).items()
    read = any(units > gloss.DIFFUSE[angle] + gloss.tolerance(units) for angle, units in readings)
    return read or material.highlight_width is not None or material.finish not in (None, "matt")


def _doubt(material: Material, key: str, value: float = 1.0) -> float:
    """The stated doubt as a share of `value`, or the usual one as it stands."""
    stated = (material.doubts or {}).get(key)
    return stated / value if stated else USUAL[key]


def _gloss(material: Material) -> tuple[Observation, ...]:
    stated = (material.doubts or {}).get("gloss_gu")
    return tuple(
        Observation(f"gloss.{angle}", "gloss", reading, stated or gloss.tolerance(reading), angle)
        for angle, reading in sorted((material.gloss or {}).items())
    )


def _lobe(material: Material) -> tuple[Observation, ...]:
    """The highlight's width, as seen or as typed into a shader, and the haze about it."""
    found = []
    if material.highlight_width:
        share = _doubt(material, "highlight_width_deg", degrees(material.highlight_width))
        found.append(Observation("highlight_width_deg", "width", log(material.highlight_width), share))
    if material.typed_alpha is not None and material.typed_alpha >= gloss.LOW:
        width = 4 * atan(sqrt(sqrt(2) - 1) * material.typed_alpha)  # of GGX, at half its height
        found.append(Observation("roughness", "width", log(width), _doubt(material, "roughness")))
    if material.haze is not None:
        found.append(Observation("haze", "haze", material.haze, _doubt(material, "haze")))
    return tuple(found)


def _mirror_image(material: Material) -> tuple[Observation, ...]:
    """Where a mirror image appears, and how strong it is beside that in black glass."""
    found, key = [], "emergence_angle_deg"
    doubt = _doubt(material, key)
    if material.emergence is not None:
        angle = degrees(material.emergence)
        found.append(Observation(key, "emergence", angle, doubt, side="" if angle else "at most"))
    elif material.emerges is False:
        found.append(Observation(key, "emergence", LOOKED_UP_TO_DEG, doubt, side="at least"))
    seen = material.dimming or {}
    pairs = zip(seen.get("angles_deg", ()), seen.get("ratio", ()), strict=True)
    stated = (material.doubts or {}).get("dimming")
    found += [Observation("dimming", "dimming", ratio, stated or dimming_doubt(ratio), angle) for angle, ratio in pairs]
    return tuple(found)


def dimming_doubt(ratio: float) -> float:
    """The usual doubt of the strength of a mirror image beside that in black glass."""
    return hypot(USUAL["dimming"] * ratio, DARK)


def _stylus(material: Material) -> tuple[Observation, ...]:
    given = {"sigma": height_of(material.given), "tau": length_of(material.given)}
    return tuple(
        Observation(known.key, name, log(known.value), _doubt(material, f"{name}_um", known.value))
        for name, known in given.items()
        if known and name not in material.filled_by
    )


def _look(material: Material) -> tuple[Observation, ...]:
    """The finish, as a soft reading of how much light stays sharp; of what is coated it tells of the coat alone."""
    if material.finish not in SHARPNESS or material.under_a_coat:
        return ()
    doubt = 0.05 if material.finish == "mirror" else HALF_A_CLASS
    aim = log(SHARPNESS[material.finish])
    return (Observation("finish", "sharpness", aim, doubt, 60.0, BOUNDS.get(material.finish, "")),)


def _index(material: Material) -> tuple[float, float]:
    """n and its doubt, of a dielectric before any reading of its roughness."""
    if material.kind == "metal" or material.subsurface == "lobe" or material.n is None:
        return USUAL_N, USUAL_N_DOUBT
    n = max(material.n[len(material.n) // 2], 1.05)
    by = material.filled_by.get("n")
    if by in ("index_from_f0", "index_from_mirror_ratio"):
        share = _doubt(material, "f0", ((n - 1) / (n + 1)) ** 2)
        return n, share * (n * n - 1) / 4  # dF/F = 4 dn/(n² - 1)
    return n, NAMED_N_DOUBT if by else KNOWN_N_DOUBT


def _base(material: Material) -> tuple[tuple[float, ...], float]:
    """What a smooth metal, or the flakes below a coat, reflect at the instruments' angles, in the middle channel."""
    if material.subsurface == "lobe":
        return (FLAKES[0],) * len(gloss.ANGLES), FLAKES[1] / FLAKES[0]
    if material.kind != "metal":
        return (), 0.0
    n, k = (each[len(each) // 2] for each in (material.n or CHROMIUM[:1], material.k or CHROMIUM[1:]))
    by = material.filled_by.get("n")
    sure = "named" if by else "observed"
    if material.n is None or by == "index_of_alloy":
        sure = "unknown"
    return tuple(float(fresnel(cos(radians(angle)), n, k)) for angle in gloss.ANGLES), METAL_DOUBT[sure]


def _body(material: Material) -> tuple[float, float]:
    """The body's albedo and its doubt, on the average of the channels."""
    if material.kind == "metal" or material.subsurface in ("none", "lobe"):
        return 0.0, 0.0
    if material.albedo is None:
        return USUAL_ALBEDO, USUAL_ALBEDO_DOUBT
    return sum(material.albedo) / len(material.albedo), _doubt(material, "diffuse_reflectance")

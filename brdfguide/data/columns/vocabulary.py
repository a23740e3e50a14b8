"""The words that name a column, what each may mean, and which of them together say what: the one table of it all.

`grammar.py` reads a name by these tables, and docs/columns.md is written from them.
"""

from math import pi

from ...records import dataclass
from .inverse_units import BY_WORD


def word_set(text: str) -> frozenset[str]:
    return frozenset(text.split())


# sense -> the words that may have it; a word may stand in several rows
SENSES = {
    "light": (
        "i in inc incid incident incidence incoming ill illum illumination illuminant illuminating illuminated l light "
        "source lamp laser wi input sun solar irradiation"
    ),
    "detector": (
        "r o s v e out outgoing output sca scat scatter scattered scattering ref refl reflect reflected reflection "
        "view viewing viewer sat satellite det detector detection obs observer observation observing receiver camera "
        "cam sensor exit exiting exitance exitant exitent em emission emergence emergent emerging meas measure "
        "measured measurement wo"
    ),
    "incidence": "incidence",  # these two name the angle by themselves
    "emission": "emission emergence",
    "polar": "theta th thet polar zenith zen inclination colatitude",
    "azimuth": "phi ph azimuth azimuthal azim azi az azm",
    "angle": "angle angles ang position arm",
    "elevation": "elevation elev altitude grazing glancing",
    "relative": "relative rel delta d difference differential diff between",
    "half": "h half halfway",
    "difference": "d diff difference",
    "phase": "phase",
    "mirror": "specular mirror spec",
    "from": "from off about to relative",
    "turn": "rotation rotate rotated rot psi turn turned orientation",
    "sample": "sample specimen target surface stage turntable",
    "alpha": "alpha",
    "beta": "beta",
    "mu": "mu μ",
    "cosine": "cos cosine",
    "sine": "sin sine",
    "x": "x",
    "y": "y",
    "z": "z",
    "wavelength": "wavelength wavelengths wavelen wvl wl wave lambda lam",
    "wavenumber": "wavenumber wavenumbers",
    "frequency": "frequency freq photon energy",
    "doubt": (
        "u unc uncertainty uncertainties uncert stderr stderror se std stdev stddev sd sigma error err sem delta d"
    ),
    "expanded": "expanded",
    "proportional": "relative rel fractional",
    "value": "value values val vals",
    "filler": (
        "of the a an by at for in is mean average avg ave measured measurement meas spectral absolute abs calibrated "
        "corrected data center centre central peak vacuum laser source light total combined standard deviation dev "
        "channel ch band re"
    ),
}

# in which sense azimuths and rotations are counted, seen from above -> how it is written
TURNING = {"cw": "cw clockwise", "ccw": "ccw acw counterclockwise anticlockwise"}
AGAINST = word_set("counter anti")  # before clockwise

# one word of the trade -> the plain ones that it stands for
SPELT = {
    "aoi": "angle of incidence",
    "aos": "angle of scattering",
    "aor": "angle of reflection",
    "aov": "angle of view",
    "poi": "azimuth of incidence",
    "sza": "solar zenith angle",
    "vza": "viewing zenith angle",
    "oza": "observation zenith angle",
    "iza": "incident zenith angle",
    "saa": "solar azimuth angle",
    "vaa": "viewing azimuth angle",
    "oaa": "observation azimuth angle",
    "raa": "relative azimuth angle",
    "sea": "solar elevation angle",
    "vea": "viewing elevation angle",
    "aspecular": "angle from specular",
    "dphi": "delta phi",
    "daz": "delta azimuth",
    "relaz": "relative azimuth",
    "raz": "relative azimuth",
    "costheta": "cos theta",
    "sintheta": "sin theta",
    "fr": "brdf",
    "fs": "brdf",
    "brdfcos": "brdf cos",
    "bsdfcos": "bsdf cos",
    "cosbrdf": "brdf cos",
    "brdfpi": "brdf pi",
    "pibrdf": "pi brdf",
    "ccbrdf": "cosine corrected brdf",
    "ccbsdf": "cosine corrected bsdf",
    "ubrdf": "u brdf",
    "ubsdf": "u bsdf",
}
# a Greek letter, a cosine or a sine with a short mark behind it, written as one word: thetai, phir, thetah, mu0
STEMS = ("theta", "phi", "alpha", "beta", "mu", "costheta", "sintheta")
MARKS = ("i", "in", "inc", "l", "wi", "r", "o", "s", "v", "e", "out", "sca", "ref", "det", "obs", "wo", "h", "d")
SPELT |= {stem + mark: f"{SPELT.get(stem, stem)} {mark}" for stem in STEMS for mark in MARKS}
SPELT |= {"th" + mark: f"theta {mark}" for mark in "irosvhd"}
SPELT |= {side + axis: f"{side} {axis}" for side in ("wi", "wo", "i", "o") for axis in "xyz"}
# the same for names of nothing but two letters
SPELT_ALONE = {
    "ti": "theta i",
    "to": "theta o",
    "tr": "theta r",
    "tv": "theta v",
    "tl": "theta l",
    "pr": "phi r",
    "po": "phi o",
}


# what a column can be
ROLES = {
    "theta_i": "zenith angle of the light",
    "phi_i": "azimuth of the light",
    "theta_r": "zenith angle of the detector",
    "phi_r": "azimuth of the detector",
    "dphi": "azimuth from light to detector; beside theta_h and theta_d that of the difference",
    "theta_h": "zenith angle of the half vector",
    "phi_h": "azimuth of the half vector",
    "theta_d": "angle from the half vector to the light",
    "phase": "angle between light and detector",
    "from_mirror": "angle from the mirror direction, positive toward grazing",
    "beta_from_mirror": "the same as a difference of sines",
    "beta_i": "sine of theta_i",
    "beta_r": "direction cosine of the detector along the plane of incidence",
    "alpha_r": "direction cosine of the detector across it",
    "x_i": "component of the direction to the light",
    "y_i": "component of the direction to the light",
    "z_i": "component of the direction to the light, along the normal",
    "x_r": "component of the direction to the detector",
    "y_r": "component of the direction to the detector",
    "z_r": "component of the direction to the detector, along the normal",
    "rotation": "rotation of the sample about its normal",
    "wavelength": "wavelength of a row",
    "wavenumber": "inverse wavelength of a row, or its frequency or photon energy",
    "value": "what was measured, of all light or of a channel",
    "stderr": "its doubt",
}


@dataclass(frozen=True)
class NameRule:
    """A role, the senses that its name needs, each by a word of its own (`a/b`: either), and those that it may hold."""

    role: str
    needs: tuple[str, ...]
    may: tuple[str, ...] = ()
    form: str = ""  # how the column gives the angle: elevation, cos, sin; or that it counts in its unit alone


# In this order: the first rule that accounts for every word of a name is its reading.
RULES = (
    NameRule("from_mirror", ("mirror", "from"), ("angle", "polar", "detector", "relative", "from", "filler")),
    NameRule("theta_h", ("half", "polar/angle"), ("filler",)),
    NameRule("phi_h", ("half", "azimuth"), ("angle", "filler")),
    NameRule("rotation", ("turn",), ("sample", "angle", "azimuth", "filler")),
    NameRule("rotation", ("sample", "azimuth/angle"), ("angle", "filler")),
    NameRule("phase", ("phase",), ("angle", "filler")),
    NameRule("theta_i", ("light", "elevation"), ("angle", "filler"), form="elevation"),
    NameRule("theta_r", ("detector", "elevation"), ("angle", "filler"), form="elevation"),
    NameRule("phi_i", ("azimuth", "light"), ("angle", "filler")),
    NameRule("phi_r", ("azimuth", "detector"), ("angle", "filler")),
    NameRule("theta_i", ("polar/angle", "light"), ("polar", "angle", "light", "filler")),
    NameRule("theta_r", ("polar/angle", "detector"), ("polar", "angle", "detector", "filler")),
    NameRule("theta_i", ("incidence",), ("filler",)),
    NameRule("theta_r", ("emission",), ("filler",)),
    NameRule("theta_i", ("mu", "light"), form="cos"),
    NameRule("theta_r", ("mu", "detector"), form="cos"),
    NameRule("beta_i", ("beta", "light"), ("filler",)),
    NameRule("beta_r", ("beta", "detector"), ("filler",)),
    NameRule("alpha_r", ("alpha", "detector"), ("filler",)),
    NameRule("dphi", ("azimuth",), ("relative", "difference", "angle", "filler")),
    NameRule("theta_d", ("polar/angle", "difference"), ("filler",)),
    NameRule("x_i", ("light", "x")),
    NameRule("y_i", ("light", "y")),
    NameRule("z_i", ("light", "z")),
    NameRule("x_r", ("detector", "x")),
    NameRule("y_r", ("detector", "y")),
    NameRule("z_r", ("detector", "z")),
    NameRule("wavelength", ("wavelength",), ("filler", "value")),
    NameRule("wavenumber", ("wavenumber",), ("filler", "value")),
    NameRule("wavenumber", ("frequency",), ("frequency", "filler", "value"), form="in its unit"),
    NameRule("stderr", ("doubt",), ("doubt", "expanded", "proportional", "value", "filler")),
    NameRule("stderr", ("expanded/proportional", "doubt"), ("doubt", "value", "filler")),
)
# Names that say too little to be taken for these while another column has the role,
WEAK_RULES = (
    NameRule("theta_r", ("polar/angle",), ("polar", "angle")),
    NameRule("theta_i", ("light",)),
    NameRule("theta_r", ("detector",)),
)
# and words that are no name by themselves.
NEVER_ALONE = word_set(
    "i l in input wi r o s v e em ref refl reflect reflection measured measurement meas measure output sensor wo a d "
    "delta"
)


@dataclass(frozen=True)
class Quantity:
    """What values may be, in terms of the BRDF f; `phrases` are the words by which a column's name says so."""

    meaning: str
    phrases: tuple[str, ...]
    spoken: tuple[str, ...] = ()  # those that say so in a title or a comment as well


QUANTITIES = {
    "brdf": Quantity(
        "the BRDF f [1/sr]",
        (
            "brdf",
            "bsdf",
            "f",
            "f r",
            "f s",
            "brdf r",
            "bidirectional reflectance distribution function",
            "bidirectional scattering distribution function",
            "bidirectional scatter distribution function",
        ),
        ("brdf", "bsdf"),
    ),
    "brdf-cos": Quantity(
        "f cos theta_r [1/sr]: scattered power for each steradian",
        (
            "cosine corrected brdf",
            "cosine corrected bsdf",
            "cosine weighted brdf",
            "cosine weighted bsdf",
            "ars",
            "angle resolved scatter",
            "angle resolved scattering",
            "dsf",
        ),
        ("cosine corrected brdf", "cosine corrected bsdf", "angle resolved scatter", "angle resolved scattering"),
    ),
    "brdf-cos-i": Quantity("f cos theta_i [1/sr]: not divided by the irradiance", ()),
    "reflectance-factor": Quantity(
        "pi f: against a perfect white diffuser under the same light (BRF, REFF)",
        (
            "reflectance factor",
            "reflectance factors",
            "refl factor",
            "bidirectional reflectance factor",
            "biconical reflectance factor",
            "brf",
            "rf",
            "reff",
            "bicrf",
        ),
        ("reflectance factor", "reflectance factors", "refl factor", "brf", "bicrf", "reff"),
    ),
    "radiance-factor": Quantity(
        "pi f in colorimetry; pi f cos theta_i beside incidence, emission and phase",
        ("radiance factor",),
        ("radiance factor",),
    ),
    "radf": Quantity(
        "pi f cos theta_i: I/F, the radiance factor of planetary work",
        ("radf", "iof", "i / f", "i over f", "bidirectional radiance factor"),
        ("radf", "i / f"),
    ),
    "hdrf": Quantity(
        "pi f, measured under the sun and the whole sky (HDRF, HCRF)",
        (
            "hdrf",
            "hcrf",
            "hemispherical directional reflectance factor",
            "hemispherical conical reflectance factor",
        ),
        ("hdrf", "hcrf", "hemispherical directional reflectance factor", "hemispherical conical reflectance factor"),
    ),
}
VAGUE = ("reflectance", "intensity")  # may hold a BRDF, as `value` does; taken for one, and noted
SCATTERED = word_set("scatter scattering scattered reflected")  # so do these, where the unit is 1/sr

COLOURS = {"r": "R", "red": "R", "g": "G", "green": "G", "b": "B", "blue": "B", "x": "X", "y": "Y", "z": "Z"}

# unit of angles -> (degrees in one, how it is written)
ANGLE_UNITS = {
    "deg": (1.0, "° deg degs degree degrees"),
    "rad": (180 / pi, "rad rads radian radians"),
    "gon": (0.9, "gon gons grad grads gradian gradians"),
    "mrad": (0.18 / pi, "mrad milliradian milliradians"),
    "arcmin": (1 / 60, "arcmin arcminute arcminutes"),
    "arcsec": (1 / 3600, "arcsec arcsecond arcseconds"),
}
# unit of wavelengths -> (micrometres in one, how it is written)
LENGTH_UNITS = {
    "nm": (1e-3, "nm nanometer nanometers nanometre nanometres"),
    "um": (1.0, "um μm micron microns micrometer micrometers micrometre micrometres"),
    "angstrom": (1e-4, "angstrom angstroms a"),
    "mm": (1e3, "mm millimeter millimeters millimetre millimetres"),
    "m": (1e6, "m meter meters metre metres"),
}
ONLY_AS_UNIT = word_set("m mm a")  # read as units behind a number, in brackets or at the end alone
# form of values -> how it is written
SCALES = {
    "%": "% percent pct",
    "dB": "db decibel decibels",
    "log10": "log10 log lg",
    "ln": "ln",
}
# unit of solid angles -> how many of them one steradian has
STERADIAN = {**dict.fromkeys(word_set("sr steradian steradians ster"), 1.0), "msr": 1e3, "μsr": 1e6, "usr": 1e6}
CONFIDENCE = {68.0: 1.0, 95.0: 1.96, 99.0: 2.576}  # percent -> coverage factor of a normal distribution


def _senses_by_word() -> dict[str, frozenset[str]]:
    found: dict[str, set[str]] = {}
    for sense, text in SENSES.items():
        for word in text.split():
            found.setdefault(word, set()).add(sense)
    return {word: frozenset(senses) for word, senses in found.items()}


def _units_by_word(table) -> dict[str, str]:
    return {word: unit for unit, (_, text) in table.items() for word in text.split()}


SENSES_OF = _senses_by_word()
ANGLE_UNIT_OF = _units_by_word(ANGLE_UNITS)
LENGTH_UNIT_OF = _units_by_word(LENGTH_UNITS)
SENSES_OF_TURNING = {word: sense for sense, text in TURNING.items() for word in text.split()}
SCALE_OF = {word: scale for scale, text in SCALES.items() for word in text.split()}
# phrase as a tuple of words -> quantity; None where the words are too vague to be one
QUANTITY_OF: dict[tuple[str, ...], str | None] = {(word,): None for word in VAGUE}
QUANTITY_OF |= {tuple(phrase.split()): name for name, each in QUANTITIES.items() for phrase in each.phrases}
SPOKEN_OF = {tuple(phrase.split()): name for name, each in QUANTITIES.items() for phrase in each.spoken}
QUANTITY_WORDS = frozenset(word for phrase in QUANTITY_OF for word in phrase if len(word) > 1 or len(phrase) == 1)
KNOWN = frozenset(
    {*SENSES_OF, *SPELT, *SPELT_ALONE, *ANGLE_UNIT_OF, *LENGTH_UNIT_OF, *SCALE_OF, *STERADIAN, *COLOURS}
    | {*SENSES_OF_TURNING, *AGAINST, *QUANTITY_WORDS, *BY_WORD, "pi", "per", "coverage", "factor"}
)


def senses_of(word: str) -> frozenset[str]:
    """What a word may mean; nothing for one that is not known."""
    return SENSES_OF.get(word, frozenset())

"""Sheets as laboratories and programs make them: random conventions, known truth.

A sheet is a table of one surface (lambertian+ggx, 1 % noise): names, units and order of columns, decimal comma,
separators, titles, azimuths or signs, half and difference angles, phase, elevation, direction cosines, wide or tidy,
percent, decibels, reflectance factors, I/F, doubts with k = 2, columns about the run; sometimes a second surface under
a column of names, sometimes a name that says nothing.
"""

from dataclasses import dataclass, field

import numpy as np

from benchmarks.sheet_angles import WAYS, Making, signed
from brdfguide import models
from brdfguide.physics.geometry import Geometry

MODEL = "lambertian+ggx"
NOISE = 0.01
CHANNELS = {"450": (0.45, 1.0), "550": (0.55, 0.7), "650": (0.65, 1.4)}  # nm -> um, body against the first


@dataclass
class Sheet:
    """A made table: its text, how it is read, and the truth."""

    text: str
    geom: Geometry  # every direction once, in the order of the rows
    surface: dict[str, float]
    bodies: tuple[float, ...]  # albedo against the first channel's
    um: tuple[float, ...] | None  # wavelengths that the sheet states
    stderr: float | None  # relative standard error that it states
    group: tuple[str, tuple[str, ...]] | None  # a column of two surfaces' names; the second is twice as bright
    said: dict[str, str] = field(default_factory=dict)  # which convention was taken for what


# --- values -------------------------------------------------------------------------------------------------

# quantity -> (what a value is of the BRDF and the cosines, names)
QUANTITIES = {
    "brdf": (
        lambda f, ci, cr: f,
        ("BRDF", "brdf", "BSDF", "f_r", "fr", "BRDF value", "Brdf", "f_r(θi,θr)", "measured BRDF", "mean BRDF"),
    ),
    "reflectance factor": (
        lambda f, ci, cr: np.pi * f,
        ("BRF", "reflectance factor", "Reflectance Factor", "Bidirectional Reflectance Factor", "HDRF", "refl. factor"),
    ),
    "radf": (lambda f, ci, cr: np.pi * f * ci, ("RADF", "I/F", "i/f")),
    "cosine": (lambda f, ci, cr: f * cr, ("CCBRDF", "BRDF*cos(theta_r)", "ARS", "cosine-corrected BSDF", "BRDF x cos")),
}
# scale -> (numbers of values, how a name says so)
SCALES = {
    "": (lambda x: x, ("{}", "{}", "{} (1/sr)", "{} [sr^-1]", "{} / sr⁻¹", "{} (sr-1)")),
    "%": (lambda x: 100 * x, ("{} [%]", "{} (%)", "{} in percent")),
    "dB": (lambda x: 10 * np.log10(x), ("{} (dB)", "{} [dB]")),
    "log10": (np.log10, ("log10({})", "log10 {}", "log({})")),
    "milli": (lambda x: 1000 * x, ("{} [10^-3 1/sr]", "{} (10⁻³ sr⁻¹)", "{} [1e-3/sr]")),
}
STRANGE = ("reading", "x1", "Messwert", "probe", "data 7", "Kopf", "A", "c3", "signal/ref")
PLAIN = {"brdf": "BRDF", "reflectance factor": "BRF", "radf": "RADF", "cosine": "CCBRDF"}  # in the names of doubts
CHANNEL_FORMS = ("{} {} nm", "{}_{}nm", "{} @ {} nm", "{} ({} nm)", "{}_{}", "{1}nm", "{1} nm")
DOUBT_FORMS = ("u({})", "{} uncertainty", "stderr {}", "{} std", "u {}", "{} error")
# how a doubt is given -> (how a name says so, its numbers from share, numbers and values without scale)
DOUBTS = {
    "absolute": ("{}", lambda share, numbers: share * numbers),
    "expanded": ("{} (k=2)", lambda share, numbers: 2 * share * numbers),
    "percent": ("relative {} [%]", lambda share, numbers: 100 * share + 0 * numbers),
    "expanded percent": ("relative {} (k=2) %", lambda share, numbers: 200 * share + 0 * numbers),
    "relative": ("relative {}", lambda share, numbers: share + 0 * numbers),
    "two sigma": ("{} (2 sigma)", lambda share, numbers: 2 * share * numbers),
}


def value_names(making: Making, quantity: str, scale: str, nm: tuple[str, ...]) -> list[str]:
    """`log10(BRDF) 550 nm`, `reflectance factor [%]`, `BSDF 405 nm (1/sr)`: one for each channel."""
    name = making.one_of("value", QUANTITIES[quantity][1])
    forms = SCALES[scale][1]
    form = making.one_of("scale form", forms if scale or quantity in ("brdf", "cosine") else forms[:2])
    bare = quantity == "brdf" and not scale
    channel = making.one_of("channel form", CHANNEL_FORMS if bare else CHANNEL_FORMS[:4])
    return [form.format(channel.format(name, each)) for each in nm] if nm else [form.format(name)]


def doubts(making: Making, quantity: str, scale: str, nm, numbers: np.ndarray):
    """Columns of doubts, a name and numbers for each channel, and the relative standard error that they mean."""
    share = float(np.round(making.draw.uniform(0.01, 0.05), 3))
    ways = list(DOUBTS) if scale in ("", "%", "milli") else ["percent", "expanded percent", "relative"]
    form, numbers_of = DOUBTS[making.one_of("doubt", ways)]
    word = making.one_of("doubt form", DOUBT_FORMS)
    plain = PLAIN[quantity]
    said = [form.format(word.format(f"{plain} {each} nm" if each else plain)) for each in nm or ("",)]
    return list(zip(said, numbers_of(share, numbers).T, strict=True)), share


# --- the sheet ----------------------------------------------------------------------------------------------


def made(seed: int) -> Sheet:
    """The sheet of a seed."""
    making = Making(np.random.default_rng([2027, seed]))
    surface = {
        "ggx.alpha": float(making.draw.uniform(0.15, 0.45)),
        "ggx.n": float(making.draw.uniform(1.4, 1.7)),
        "lambertian.albedo": float(making.draw.uniform(0.1, 0.5)),
    }
    way = WAYS[int(making.draw.integers(len(WAYS)))]
    making.said["way"] = way.__name__
    unit = making.one_of("unit", ("deg", "deg", "deg", "rad", "gon", "mrad"))
    geom = way(making, unit, unit == "deg" and making.chance(0.5))
    quantity = making.one_of("quantity", ("brdf", "brdf", "brdf", "reflectance factor", "radf", "cosine"))
    scale = making.one_of("scale", ("", "", "", "%", "dB", "log10", "milli"))
    if scale == "%" and quantity != "reflectance factor" or scale == "milli" and quantity not in ("brdf", "cosine"):
        scale = making.said["scale"] = ""
    layout = making.one_of("layout", ("one", "one", "wide", "wide", "long", "bands"))
    nm = () if layout == "one" else tuple(CHANNELS)
    factors = [CHANNELS[each][1] for each in nm] or [1.0]
    truth = np.stack([brdf_of(geom, surface, factor) for factor in factors], axis=1)
    noisy = truth * np.exp(NOISE * making.draw.standard_normal(truth.shape))
    convert = QUANTITIES[quantity][0]
    values = np.stack([convert(f, geom.cos_i[:, 0], geom.cos_r[:, 0]) for f in noisy.T], axis=1)
    numbers = SCALES[scale][0](values)
    names = value_names(making, quantity, scale, nm if layout == "wide" else ())
    wide = [(name, column) for name, column in zip(names, numbers.T, strict=False)] if layout in ("one", "wide") else []
    more, stderr = doubts(making, quantity, scale, nm, numbers) if wide and making.chance(0.4) else ([], None)
    cells: dict[str, list[str]] = {}
    columns = [*making.columns, *wide, *more]
    if way is signed and layout == "one" and not more and making.chance(0.3):
        columns = by_incidence(making, names[0], *(column for _, column in columns))
    if not wide:
        columns = [(name, np.repeat(column, len(nm))) for name, column in making.columns]
        columns += [(names[0], numbers.ravel())]
        wave = waves(making, layout, nm, len(geom))
        cells, columns = (dict([wave]), columns) if layout == "bands" else ({}, [*columns, wave])
    if making.said["way"] != "by_incidence" and making.chance(0.02):  # one column has a name that says nothing
        place = int(making.draw.integers(len(columns) - len(more) - (len(wide) if len(wide) > 1 else 0)))
        columns[place] = making.one_of("strange", STRANGE), columns[place][1]
    sheet = Sheet("", geom, surface, tuple(factors), None, stderr, None, making.said)
    sheet.um = tuple(CHANNELS[each][0] for each in nm) or None
    sheet.text = text_of(making, sheet, columns, cells)
    return sheet


def by_incidence(making: Making, name: str, theta_i, theta_r, numbers):
    """A column of reflected angles, and one of values for each incidence."""
    making.said["way"] = "by_incidence"
    angles = np.unique(theta_i)
    degrees = making.said["incidences"].strip("()").split(", ")
    plain = name in ("BRDF", "brdf", "BSDF", "f_r", "fr")
    forms = ("{0} @ {1:g} deg", "{0} {1:g}°", "{0} theta_i={1:g}", "{0} AOI {1:g} deg")
    form = making.one_of(
        "incidence form", (*forms, "{1:g} deg", "{1:g}", "theta_i={1:g}", "AOI {1:g}") if plain else forms
    )
    columns = [(making.columns[1][0], theta_r[theta_i == angles[0]])]
    for angle, value in zip(angles, degrees, strict=True):
        columns.append((form.format(name, float(value)), numbers[theta_i == angle]))
    return columns


def brdf_of(geom: Geometry, values: dict[str, float], factor: float = 1.0) -> np.ndarray:
    """The BRDF (rows,) with the body as many times as bright."""
    values = {**values, "lambertian.albedo": values["lambertian.albedo"] * factor}
    return np.broadcast_to(models.get(MODEL)(geom, values), (len(geom), 1))[:, 0]


def waves(making: Making, layout: str, nm, count: int):
    """A column of wavelengths for a tidy table, as numbers or as words."""
    if layout == "bands":
        return making.one_of("band", ("band", "Wavelength", "channel", "filter")), [
            f"{each} nm" for _ in range(count) for each in nm
        ]
    unit = making.one_of("wave unit", ("nm", "um", "µm"))
    word = making.one_of("wave", ("wavelength", "lambda", "Wavelength", "λ", "wl"))
    name = making.one_of("wave form", ("{}_{}", "{} ({})", "{} [{}]", "{} / {}")).format(word, unit)
    return name, np.tile([float(each) * (1 if unit == "nm" else 1e-3) for each in nm], count)


# --- lines --------------------------------------------------------------------------------------------------

TITLES = (
    "",
    "",
    "Sample 12, paint shop",
    "Goniometer run of Tuesday",
    "measured by hand, lamp A",
    "Data file version 2",
)
ABOUT_THE_RUN = (  # columns that say nothing of the surface
    ("time", lambda draw, count: [f"{9 + k // 60:02d}:{k % 60:02d}" for k in range(count)]),
    ("No", lambda draw, count: [str(k + 1) for k in range(count)]),
    ("temperature (C)", lambda draw, count: [f"{each:.2f}" for each in 21 + 0.1 * draw.standard_normal(count)]),
    ("detector gain", lambda draw, count: ["2"] * count),
    ("remark", lambda draw, count: ["" if draw.uniform() < 0.9 else "check" for _ in range(count)]),
)
SAMPLES = (
    ("sample", ("white", "black")),
    ("Sample ID", ("7", "8")),
    ("material", ("A", "B")),
    ("polarisation", ("s", "p")),
)


def text_of(making: Making, sheet: Sheet, columns, cells: dict[str, list[str]]) -> str:
    """The sheet as text: columns in any order, decimal comma, separators, quotes, titles, comments."""
    draw, count = making.draw, len(columns[0][1])
    digits = int(making.one_of("digits", (6, 8)))
    form = making.one_of("numbers", ("g", "g", "e"))
    table = {name: [f"{each:.{digits}{form}}" for each in values] for name, values in columns} | cells
    for place in draw.permutation(len(ABOUT_THE_RUN))[: int(draw.integers(0, 3))]:
        name, words = ABOUT_THE_RUN[place]
        table[name] = words(draw, count)
    if making.chance(0.12):  # a second surface, twice as bright
        sheet.group = making.one_of("samples", SAMPLES)  # type: ignore[assignment]
        table = doubled(table, sheet, columns)
    names = list(table)
    if making.chance(0.3):
        names = [names[place] for place in draw.permutation(len(names))]
    style = making.one_of("separator", (",", ",", ";", "\t", "|", " "))
    comma = style in (";", "\t") and making.chance(0.5)
    making.said["decimal"] = "comma" if comma else "point"
    return "".join(lines_of(making, sheet, table, names, style, comma))


def with_units_below(names: list[str]) -> tuple[list[str], list[str]]:
    """Names, and their units in a row of its own; no units where a name would be another's without."""
    heads, units = [], []
    for name in names:
        head, opened, unit = name.rpartition(" [")
        heads.append(head if opened else name)
        units.append(unit.rstrip("]") if opened else "")
    return (heads, units) if any(units) and len(set(heads)) == len(heads) else (names, [])


def doubled(table: dict[str, list[str]], sheet: Sheet, columns) -> dict[str, list[str]]:
    """The same rows again for the second surface, under a column of names; only plain scales, where twice is twice."""
    name, groups = sheet.group or ("", ())
    count = len(next(iter(table.values())))
    found = {name: [each for each in groups for _ in range(count)]}
    return found | {key: values * 2 for key, values in table.items()}


def lines_of(making: Making, sheet: Sheet, table, names: list[str], style: str, comma: bool):
    """The lines one after the other."""
    quoted = style != "|" and making.chance(0.2) or style == " "
    end = making.one_of("line end", ("\n", "\n", "\r\n"))
    if making.chance(0.15):
        yield "\ufeff"
    if title := making.one_of("title", TITLES):
        yield f"{title}{end}"
    if making.chance(0.3):
        yield f"# instrument: goniometer, 3 mm spot{end}"
    if sheet.um is None and making.chance(0.4):
        sheet.um = (0.633,)
        yield making.one_of("comment", ("# wavelength_nm: 633", "# lambda = 633 nm", "# Wavelength: 0.633 um")) + end
    heads, units = with_units_below(names) if making.chance(0.15) else (names, [])
    for row in (heads, units) if units else (heads,):
        yield style.join(f'"{name}"' if quoted or style in name else name for name in row) + end
    for cells in zip(*(table[name] for name in names), strict=True):
        line = [(each.replace(".", ",") if comma else each) for each in cells]
        yield style.join(f'"{each}"' if style == " " and (not each or " " in each) else each for each in line) + end

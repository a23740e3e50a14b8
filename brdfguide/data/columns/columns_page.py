"""`docs/columns.md`: every name, unit, quantity and format that is read, from the tables that read them."""

from importlib import import_module

from .. import conventions, formats
from .inverse_units import INVERSE_UNITS
from .languages import SIGNS, WORDS
from .vocabulary import (
    ANGLE_UNITS,
    CONFIDENCE,
    LENGTH_UNITS,
    QUANTITIES,
    ROLES,
    RULES,
    SCALES,
    SENSES,
    SPELT,
    SPELT_ALONE,
    STERADIAN,
    TURNING,
    VAGUE,
    WEAK_RULES,
)

EXAMPLES = {
    "theta_i": ("theta_i_deg", "AOI [°]", "SZA", "Incident_angle", "θ_i / rad"),
    "theta_r": ("theta_r", "Scatter angle (deg)", "VZA", "emission", "cos(theta_r)"),
    "phi_i": ("phi_i", "SAA", "source azimuth"),
    "phi_r": ("phi_r", "VAA", "azimuth_out"),
    "dphi": ("dphi", "RAA", "relative azimuth", "Δφ"),
    "theta_h": ("theta_h", "half angle"),
    "phi_h": ("phi_h",),
    "theta_d": ("theta_d", "difference angle"),
    "phase": ("phase angle",),
    "from_mirror": ("angle from specular", "theta_s - theta_i", "aspecular angle"),
    "beta_from_mirror": ("beta - beta0",),
    "beta_i": ("beta_0",),
    "beta_r": ("beta_s",),
    "alpha_r": ("alpha_s",),
    "x_i": ("wi_x", "ix"),
    "y_i": ("wi_y",),
    "z_i": ("wi_z",),
    "x_r": ("wo_x", "ox"),
    "y_r": ("wo_y",),
    "z_r": ("wo_z",),
    "rotation": ("sample rotation", "psi"),
    "wavelength": ("lambda_nm", "wavelength [um]", "λ / nm"),
    "wavenumber": ("wavenumber (cm-1)", "frequency [THz]", "photon energy (eV)"),
    "value": ("BRDF [1/sr]", "f_r", "BSDF 405 nm (1/sr)", "reflectance factor [%]", "BRDF (dB)", "550nm", "red"),
    "stderr": ("stderr_450nm", "u(BSDF) 405 nm", "uncertainty (k=2) %", "relative uncertainty [%]"),
}
HEAD = """# What is read

A table's columns are known by their names, whatever their case, order and punctuation: `theta_i_deg`, `Theta I [°]` and
`θᵢ (deg)` are one name. A name is read word by word. Units, wavelengths, quantities and scales are taken out of it;
what is left must be accounted for to the last word, or the column is left out. `inspect` prints what each column was
taken for, in which unit, and what was left out and why.

This page is written from the program's own tables by `python -m brdfguide.data.columns.columns_page`.
"""
OPTIONS = (  # what is typed, and what it does
    (
        "`--columns theta_i=AOI,brdf=Panel BRF`",
        "which column is what; what its name says of unit, quantity, wavelength and doubt is kept",
    ),
    ("`--columns brdf=A,brdf=B`", "a channel for each, by the wavelengths or colours in their names"),
    ("`--columns theta_i=30`, `wavelength=633nm`", "one angle [deg] or wavelength [nm] for all rows"),
    ("`--columns theta_i,theta_r,brdf`", "the names of a table without a header, in order"),
    ("`--columns ignore=NAME`", "leaves a column out that names groups"),
    ("`--unit`", f"the unit of all angles: {', '.join(f'`{unit}`' for unit in ANGLE_UNITS)}"),
    ("`--quantity`", f"what the values are: {', '.join(f'`{name}`' for name in conventions.QUANTITIES)}"),
    ("`--scale 0.001`", "what all values are multiplied by; a comment's scale gives way to it"),
    ("`--rotation-sense cw`", "the sample was turned clockwise, seen from above; `ccw`, counter-clockwise, is taken"),
    ("`--wavelength-nm 633`", "the wavelength of a file of any format that does not state it"),
    ("`--select sample=white`", "only the rows that have it; may be given several times"),
    ("`--group sample`", "with `fit`: each value of the column is a surface of its own"),
)
AFTER_OPTIONS = """
Rows of several samples, bands or polarisations are never mixed: a column that names them, or that tells directions
apart which are repeated with other values, is named, and one of the last two options asked for. An option that could
have no effect on a file is refused.

Titles and comments count too: `theta_i: 45`, `AOI = 45 deg`, `wavelength_nm: 633`, `lambda = 532 nm`,
`wavenumber = 1000 cm-1`, `2-5.7 um band`, `azimuth: 90 deg`, `quantity: brf`, `scale: 0.001`, `BRDF in 1e-3 sr^-1`,
`angles in radians`, `sample rotated clockwise`, and a quantity by its words where the values' name has none (`BRF
values of ...`). Lines between the rows that state such a thing again, or a sample, hold for the rows below them:
`# theta_i = 30`, `wavelength: 650 nm`, `# sample: white`. So does an angle or wavelength that most rows leave empty.

A column that marks rows (`mask`, `valid`, `flag`, `quality`) is asked about. `999` and the like, or all bits of a
counter, several times and far above all other values, are marks for missing, as `-999`, `n.a.` and empty cells are. A
function or a factor in a name (`sqrt(BRDF)`, `BRDF x 10^3`) is not undone: such a column is refused, the factor with
`--scale` taken. One negative number that stands four times or more, where no other is negative, is a mark too.

## Cells

| in a cell | what is made of it |
|---|---|
| `0.10 ± 0.01`, `0.10 +/- 0.01`, `0.10 ± 5 %`, `0.10(1)` | the value and its standard error; of angles it is left out |
| `10 deg`, `10°`, `10°30'`, `550 nm`, `45 %`, `-3 dB`, `0.1 1/sr` | the column's unit: one for all its cells |
| `9.8×10⁻³`, `9.8 x 10^-3`, `9.8D-3` | a power of ten |
| `1,234.5`, `1 234,5`, `1'234.5`, `1.234,5` | thousands; commas that may be decimal as well are refused |
| `<0.1` | a limit: missing |
| `OVER`, `saturated`, `no data`, `bad`, `####` | missing |

Zeniths of an arm that counts 0 to 360 are brought to -90 to 90. Rows may stand in brackets (`[10, -75, 0.1],`), have
their names in the cells (`theta_i=10 theta_r=-75 brdf=0.1`), or be columns, each number behind its name in one line.
Row numbers that have no name, and statistics or words below the rows, are left out.
"""
ANGLES = (  # columns, and what they mean
    (
        "theta_i, theta_r",
        "a scan in the plane of incidence; theta_r positive on the mirror side, or as the values show",
    ),
    ("theta_i, theta_r and dphi, or phi_i and phi_r", "anywhere; zeniths may be given as elevation, cosine or sine"),
    ("theta_i, theta_r, phase", "anywhere: cos g = cos i cos e + sin i sin e cos azimuth"),
    ("theta_h, theta_d, dphi (phi_d), perhaps phi_h", "half vector and difference"),
    (
        "theta_i and from_mirror or beta_from_mirror",
        "in the plane of incidence, counted from the mirror direction",
    ),
    ("theta_i or beta_i, beta_r, perhaps alpha_r", "direction cosines along and across the plane of incidence"),
    ("x_i, y_i, x_r, y_r, perhaps z_i, z_r", "components of both directions"),
    (
        "theta_i, theta_r with a sign and phi_i",
        "scans in the plane of incidence, the light at that azimuth of the sample",
    ),
    (
        "theta_i, theta_r with a sign and a lone `azimuth` or `phi`",
        "the same; azimuth from light to detector where the mirror direction is not as bright under each, and where "
        "its name is `relative`",
    ),
    ("rotation, beside any of them", "the sample turned by +psi: light at -psi of the sample; clockwise, at +psi"),
    (
        "theta_r and a column for each theta_i, or the reverse",
        "`30 deg`, `theta_i=30`, `BRDF @ 30 deg 550 nm`, `15`, `-15`; a corner `theta_r \\ theta_i` names both",
    ),
)
ABOUT_ANGLES = """
Both directions point away from the surface; the mirror direction is at phi_r - phi_i = 180 degrees. What a table gives
besides one of these ways is left out, or checked where it can be (a phase angle against azimuths). A column without a
unit has that of the others, else of a comment, else degrees or radians as the values tell; where they do not, `--unit`
is asked for. Azimuths and rotations count counter-clockwise, seen from above, unless a name says otherwise:
{clockwise}, as in `rotation (cw)`, or of a rotation a comment. `--rotation-sense` comes before both, and makes a lone
`azimuth` a rotation.
"""
DOUBTS = """## Doubts

A doubt is understood as a standard error: divided by its coverage factor (`k=2`, `2 sigma`, `coverage factor 2`,
{confidence}; `expanded` alone by 2), multiplied by the value
where it is relative or in percent (in percentage points where the values are in percent too), and taken from decibels
or logarithms. It goes with the channel whose wavelength or colour its name has; a relative one without goes with all.
"""


def columns_page() -> str:
    """The page as text."""
    confidence = ", ".join(f"`{percent:g} %` by {k:g}" for percent, k in CONFIDENCE.items())
    parts = [
        HEAD,
        _roles(),
        _table("Angles", ("columns", "meaning"), ANGLES)
        + ABOUT_ANGLES.format(clockwise=" or ".join(f"`{word}`" for word in TURNING["cw"].split())),
        _units(),
        _quantities(),
        DOUBTS.format(confidence=confidence),
        _table("When the names do not say it", ("option", "what it does"), OPTIONS) + AFTER_OPTIONS,
        _words(),
        _formats(),
    ]
    return "\n".join(parts)


def _table(title: str, header: tuple[str, ...], rows) -> str:
    lines = [f"## {title}", "", f"| {' | '.join(header)} |", "|" + "---|" * len(header)]
    return "\n".join([*lines, *(f"| {' | '.join(row)} |" for row in rows)]) + "\n"


def _listed(words) -> str:
    return " ".join(f"`{word}`" for word in words)


def _roles() -> str:
    rows = []
    for role, meaning in ROLES.items():
        rules = [rule for rule in (*RULES, *WEAK_RULES) if rule.role == role]
        made = "; ".join(dict.fromkeys(" + ".join(need.replace("/", " or ") for need in rule.needs) for rule in rules))
        rows.append((f"`{role}`", meaning, _listed(EXAMPLES[role]), made))
    return _table("Columns", ("role", "meaning", "such as", "words of its name"), rows)


def _words() -> str:
    senses = [(sense, _listed(text.split())) for sense, text in SENSES.items()]
    spelt = {
        word: plain for word, plain in (SPELT | SPELT_ALONE).items() if word.replace(" ", "") != plain.replace(" ", "")
    }
    short = [(f"`{word}`", plain) for word, plain in spelt.items()]
    return "\n".join(
        [
            _table("Words", ("sense", "words"), senses),
            _table("Abbreviations", ("written", "read as"), short),
            _table("Other languages", ("language", "words"), _languages()) + "\n" + OF_LANGUAGES,
        ]
    )


def _languages() -> list[tuple[str, str]]:
    """Each language with its words and the English that they are read as."""
    tables = (WORDS | SIGNS).items()
    return [
        (name, ", ".join(f"`{word}`" + (f" {english}" if english else "") for word, english in table.items()))
        for name, table in tables
    ]


def _units() -> str:
    angles = [
        (f"`{unit}`", f"{degrees:.9g} degrees", _listed(text.split())) for unit, (degrees, text) in ANGLE_UNITS.items()
    ]
    lengths = [(f"`{unit}`", f"{um:g} µm", _listed(text.split())) for unit, (um, text) in LENGTH_UNITS.items()]
    lengths += [
        (f"`{unit}`", f"{um:.7g} µm divided by it", _listed(text.split())) for unit, (um, text) in INVERSE_UNITS.items()
    ]
    scales = [(f"`{scale}`", UNDONE[scale], _listed(text.split())) for scale, text in SCALES.items()]
    scales.append(
        (
            "`1/sr`",
            "as it is",
            _listed([*sorted(STERADIAN)]) + " with `1/`, `per`, `^-1`; a power of ten before it counts",
        )
    )
    return _table("Units and scales", ("unit", "is", "written"), [*angles, *lengths, *scales])


OF_LANGUAGES = (
    "Text that is no UTF-8 is read in the encoding in which its words are these (GB18030, Shift JIS, Windows 1251 and "
    "1250,\nBig5, EUC-KR), else as Latin-1.\n"
)
UNDONE = {"%": "divided by 100", "dB": "10^(x/10)", "log10": "10^x", "ln": "e^x"}


def _quantities() -> str:
    rows = [
        (f"`{name}`", quantity.meaning, _listed_phrases(quantity.phrases), _listed_phrases(quantity.spoken))
        for name, quantity in QUANTITIES.items()
    ]
    vague = f"{_listed(VAGUE)} and `value` do not say what they hold: taken as the BRDF, and examined; `reflectance`\n"
    vague += "in percent is a reflectance factor.\n"
    header = ("quantity", "values are", "in a name", "in a title or comment")
    return _table("Quantities", header, rows) + "\n" + vague


def _listed_phrases(phrases) -> str:
    return ", ".join(f"`{phrase}`" for phrase in phrases)


def _written_by(name: str) -> str:
    targets = [target for target, format in formats.WRITTEN_AS.items() if format == name]
    return ", ".join(f"`--to {target}`" for target in (*targets, *(["merl"] if name == "merl" else [])))


def _formats() -> str:
    rows = []
    for name in formats.names():
        module = import_module(f"brdfguide.data.formats.{name.replace('-', '_')}")
        first = (module.__doc__ or "").partition("\n")[0].rstrip(".")
        suffixes = _listed(module.FORMAT.suffixes)
        rows.append((f"`{name}`", first, suffixes, _written_by(name)))
    text = (
        "What a file contains decides, not its suffix. Any of them may be compressed (gzip, bzip2, xz, of several "
        "members), be the only file of a ZIP, or come from standard input. `convert FILE OUT --to NAME` writes "
        "measured values, `export SURFACE --to NAME -o OUT` a model as a table. Excel needs the extra `excel`, Parquet "
        "`parquet`, HDF5 `hdf5`, zarr `zarr`. Of several sheets or tables in a file one is chosen, `--select "
        "sheet=NAME` or `--select table=2`. A file of another kind is named from its first bytes, with what to export "
        "instead.\n"
    )
    return _table("Formats", ("format", "what it is", "usual suffixes", "written by"), rows) + "\n" + text


if __name__ == "__main__":
    print(columns_page(), end="")

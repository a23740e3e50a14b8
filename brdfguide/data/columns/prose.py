"""What titles and comments say of a table: wavelength, incidence, quantity, unit of the angles, sense of rotations."""

from itertools import pairwise
from math import acos, asin, degrees

from ...records import dataclass
from .facts import bare_wavelength, facts, spelt_out
from .grammar import understood
from .inverse_units import InverseUnit, inverse_unit
from .tokens import Token
from .turning_sense import taken_sense
from .vocabulary import (
    ANGLE_UNIT_OF,
    ANGLE_UNITS,
    LENGTH_UNIT_OF,
    LENGTH_UNITS,
    SPOKEN_OF,
    STERADIAN,
    senses_of,
    word_set,
)

MOST_LINES = 2000  # of titles and comments; data do not begin later
BETWEEN = 5  # tokens that may stand between `wavelength` and its number
LONGEST_SPOKEN = max(len(phrase) for phrase in SPOKEN_OF)
WORDS_OF_AN_ANGLE = 4
ABOUT_VALUES = word_set("unit units value values data")
SMALL_WORDS = word_set("in of is are the all given")


@dataclass(frozen=True)
class Wavelength:
    um: float
    said_as: str  # `wavelength`, or `middle of the band`
    line: int  # which of the lines says it
    told: bool  # by the word wavelength, not merely by a unit


def wavelength_in(lines) -> Wavelength | None:
    """`wavelength_nm: 633`, `Wavelength (nm) = 550`, `lambda = 532 nm`; then `2-5.7 um band`; then a lone `650 nm`."""
    rows = [spelt_out(line) for line in lines[:MOST_LINES]]
    for find, said_as in (
        (_after_the_word, "wavelength"),
        (_after_another, "wavelength"),
        (_band, "middle of the band"),
        (_alone, "wavelength"),
    ):
        for place, row in enumerate(rows):
            um = find(row)
            if um is not None:
                return Wavelength(um, said_as, place, find in (_after_the_word, _after_another))
    return None


def _after_the_word(row: list[Token]) -> float | None:
    for place, token in enumerate(row):
        if "wavelength" not in senses_of(token.text) or token.text == "wave":
            continue
        unit = None
        for at in range(place + 1, min(place + 1 + BETWEEN, len(row))):
            each = row[at]
            if each.text == "0" and at == place + 1:
                continue  # lambda_0
            if each.is_number:
                after = row[at + 1].text if at + 1 < len(row) else ""
                unit = LENGTH_UNIT_OF.get(after, unit)
                if unit:
                    return each.number * LENGTH_UNITS[unit][0]
                if not after and token.text not in ("lambda", "lam"):  # lambda = 3 may be anything
                    return bare_wavelength(each.text)
                break
            unit = LENGTH_UNIT_OF.get(each.text, unit)
            if each.is_word and not (each.text in LENGTH_UNIT_OF or senses_of(each.text) & {"wavelength", "filler"}):
                break
    return None


def _after_another(row: list[Token]) -> float | None:
    """`wavenumber = 1000 cm-1`, `frequency: 474 THz`; a wavenumber without unit is in 1/cm."""
    for place, token in enumerate(row):
        senses = senses_of(token.text)
        if not senses & {"wavenumber", "frequency"}:
            continue
        for at in range(place + 1, min(place + 1 + BETWEEN, len(row))):
            if not row[at].is_number or row[at - 1].text in ("-", "^"):
                continue
            unit = inverse_unit(row, at + 1)
            if unit is None and "wavenumber" in senses and at + 1 == len(row):
                unit = InverseUnit("1/cm", at, at)
            return unit.um(row[at].number) if unit else None
    return None


def _band(row: list[Token]) -> float | None:
    for low, sign, high, unit in (row[place : place + 4] for place in range(len(row) - 3)):
        if low.is_number and high.is_number and sign.text in ("-", "to") and unit.text in LENGTH_UNIT_OF:
            return 0.5 * (low.number + high.number) * LENGTH_UNITS[LENGTH_UNIT_OF[unit.text]][0]
    return None


def _alone(row: list[Token]) -> float | None:
    for token, unit in pairwise(row):
        if token.is_number and LENGTH_UNIT_OF.get(unit.text) == "nm" and 100 <= token.number < 100_000:
            return token.number / 1000
    return None


def incidence_in(lines, unit: str = "deg") -> float | None:
    """`theta_i: 45`, `AOI = 45 deg`, `theta_i [rad]: 0.5`, `elevation of the light: 60°`, `cos(theta_i) = 0.87` [deg].

    `unit` is that of a number without one.
    """
    for line in lines[:MOST_LINES]:
        row = spelt_out(line)
        for place, token in enumerate(row):
            if token.text not in (":", "=") or place + 1 >= len(row):
                continue
            sign = -1.0 if row[place + 1].text == "-" else 1.0
            at = place + 1 + (row[place + 1].text in ("-", "+"))
            if at >= len(row) or not row[at].is_number:
                continue
            after = row[at + 1].text if at + 1 < len(row) else ""
            several = after in (",", ";") and at + 2 < len(row) and row[at + 2].is_number
            if several or after not in ("", ",", ";") and after not in ANGLE_UNIT_OF:
                continue
            before = [each.text for each in row[:place] if each.text in ANGLE_UNIT_OF]
            stated = ANGLE_UNIT_OF.get(after) or (ANGLE_UNIT_OF[before[-1]] if before else unit)
            form = _form_of_incidence(row[:place])
            if form is not None:
                return _in_degrees(sign * row[at].number, form, stated)
    return None


def _in_degrees(number: float, form: str, unit: str) -> float | None:
    """An angle [deg] given as itself, as an elevation, or by a function of it; None beyond what that can be."""
    if form in ("cos", "sin"):
        inverse = acos if form == "cos" else asin
        return round(degrees(inverse(number)), 9) if abs(number) <= 1 else None
    angle = round(number * ANGLE_UNITS[unit][0], 9)
    return 90.0 - angle if form == "elevation" else angle


def angles_of_detector_in(lines) -> dict[str, float]:
    """`phi: 90 deg`, `azimuth = 45`, `theta_r: 30` and nothing more -> the one angle [deg] that each role has."""
    found: dict[str, set[float]] = {}
    for line in lines[:MOST_LINES]:
        row = spelt_out(line)
        place = next((place for place, token in enumerate(row) if token.text in (":", "=")), len(row))
        said = row[place + 1 :]
        sign = -1.0 if said and said[0].text == "-" else 1.0
        said = said[1:] if said and said[0].text in ("-", "+") else said
        plain = len(said) == 1 or len(said) == 2 and ANGLE_UNIT_OF.get(said[1].text) == "deg"
        if plain and said[0].is_number:
            whole = understood(" ".join(token.text for token in row[:place] if token.text not in ANGLE_UNIT_OF))
            if whole.role in ("theta_r", "dphi", "phi_r") and not whole.form:
                found.setdefault(whole.role, set()).add(sign * said[0].number)
    return {role: angles.pop() for role, angles in found.items() if len(angles) == 1}


def _form_of_incidence(before: list[Token]) -> str | None:
    """How the words name the angle of incidence, the most of them that do: "" as itself; None where they do not."""
    words = [token.text for token in before if token.is_word and token.text not in ANGLE_UNIT_OF][-WORDS_OF_AN_ANGLE:]
    tails = (understood(" ".join(words[start:])) for start in range(len(words)))
    return next((column.form for column in tails if column.role == "theta_i"), None)


def quantity_stated(lines) -> str | None:
    """What a line `quantity: NAME` says outright."""
    for line in lines[:MOST_LINES]:
        row = line[:80].replace("=", ":").partition(":")
        if row[0].strip().lower() == "quantity" and row[2].split():
            return row[2].split()[0].strip(",;.").lower()
    return None


def quantities_in(lines) -> dict[str, str]:
    """Every quantity that titles and comments name -> the words that do."""
    found: dict[str, str] = {}
    for line in lines[:MOST_LINES]:
        row = [token.text for token in spelt_out(line) if token.text != "-"]
        place = 0
        while place < len(row):
            phrases = (tuple(row[place : place + length]) for length in range(LONGEST_SPOKEN, 0, -1))
            phrase = next((each for each in phrases if each in SPOKEN_OF), None)
            if phrase:
                found.setdefault(SPOKEN_OF[phrase], " ".join(phrase))
            place += len(phrase or (0,))
    return found


def angle_unit_in(lines) -> str | None:
    """`angles in radians`, `Angles: deg`: the one unit that comments give for angles as such."""
    found = set()
    for line in lines[:MOST_LINES]:
        row = spelt_out(line)
        if any(token.is_number for token in row) or not any(token.text in ("angle", "angles") for token in row):
            continue
        found |= {ANGLE_UNIT_OF[token.text] for token in row if token.text in ANGLE_UNIT_OF}
    return found.pop() if len(found) == 1 else None


def sense_in(lines) -> str | None:
    """`psi: rotation of the sample, clockwise`: the one sense, cw or ccw, that comments give for its rotation."""
    rows = [spelt_out(line) for line in lines[:MOST_LINES]]
    found = {taken_sense(row)[0] for row in rows if any("turn" in senses_of(token.text) for token in row)}
    return next(iter(found - {None})) if len(found - {None}) == 1 else None


def scale_in(lines) -> float | None:
    """`scale: 0.001`, `scale factor = 1e-3`: what values are to be multiplied by; a number with a unit is none."""
    for line in lines[:MOST_LINES]:
        words = [token.text for token in spelt_out(line)]
        row = [token for token in spelt_out(line) if token.text != "factor"]
        said = len(row) == 3 and words[0] in ("scale", "multiplier") and row[1].text in (":", "=")
        if said and row[2].is_number and row[2].number > 0:
            return row[2].number
    return None


def unit_of_values_in(lines) -> float | None:
    """`BRDF in 10^-3 sr^-1`, `units: 1e-3/sr`, `all values in percent`: what values whose names have no unit are in."""
    found = set()
    for line in lines[:MOST_LINES]:
        column, left = facts(f"({line})", colours=False)
        words = {token.text for token in left if token.is_word}
        about = column.quantity is not None or column.vague or words & ABOUT_VALUES
        if not about or not words <= ABOUT_VALUES | SMALL_WORDS or any(token.is_number for token in left):
            continue
        if column.per_sr and column.factor != 1 and _is_inverse(line):
            found.add(column.factor)
        elif column.scale == "%" and not column.per_sr and not any(token.is_number for token in spelt_out(line)):
            found.add(0.01)
    return found.pop() if len(found) == 1 else None


def _is_inverse(line: str) -> bool:
    """Whether a unit is one over steradians, and not a solid angle."""
    texts = [token.text for token in spelt_out(line)]
    places = [place for place, text in enumerate(texts) if text in STERADIAN]
    return any(texts[place - 1] in ("/", "per") or texts[place + 1 : place + 2] in (["-"], ["^"]) for place in places)

"""What a name states outright: units, wavelength, angle, colour, quantity, scale, coverage factor; and what is left."""

from functools import lru_cache

from ...records import dataclass
from .inverse_units import inverse_unit
from .languages import PLAIN, PLAIN_ALONE, with_blanks, without_articles
from .tokens import Token, tokens
from .turning_sense import taken_sense
from .vocabulary import (
    ANGLE_UNIT_OF,
    COLOURS,
    CONFIDENCE,
    KNOWN,
    LENGTH_UNIT_OF,
    LENGTH_UNITS,
    ONLY_AS_UNIT,
    QUANTITY_OF,
    QUANTITY_WORDS,
    SCALE_OF,
    STERADIAN,
    senses_of,
)

SAYS_IT_IS = frozenset(":=@")  # between a word and its number
TIMES = frozenset(["*", "x", "times", "by"])
OF_VALUES = frozenset(["value", "doubt", "filler", "proportional", "expanded"])
WAVES = {"wavelength", "wavenumber", "frequency"}
ARGUMENTS = frozenset(["polar", "azimuth", "light", "detector", "wavelength"])
LONGEST_PHRASE = max(len(phrase) for phrase in QUANTITY_OF)
FIRST_OF_QUANTITY = frozenset(phrase[0] for phrase in QUANTITY_OF)
POWERS_OF_TEN = (["10", "^", "-", "n"], ["10", "-", "n"], ["10", "^", "n"])  # and 1e-3, which is one token


@dataclass(frozen=True, kw_only=True)
class Column:
    """One column as its name says. `role` is None where the name does not tell, and `why` says what was in the way."""

    name: str
    place: int = 0
    role: str | None = None
    why: str = ""
    weak: bool = False  # the role is only taken where no other column has it
    form: str = ""  # of an angle: as it is, elevation, cos, sin
    unit: str | None = None  # of an angle or a wavelength
    sense: str | None = None  # in which an azimuth or a rotation is counted: cw, ccw
    quantity: str | None = None
    vague: bool = False  # a value whose name hardly says that it is a BRDF
    scale: str = ""  # of a value or a doubt: as it is, %, dB, log10, ln
    factor: float = 1.0  # the power of ten that stands with the unit
    per_sr: bool = False  # whether the unit is 1/sr
    colour: str | None = None
    um: float | None = None  # wavelength that the name states
    at: float | None = None  # angle [deg] that the name states, of a sheet with a column for each
    at_role: str | None = None  # which angle that is, where the name says so
    bare: str = ""  # a number without unit beside a value: a wavelength or an angle, as the table needs
    k: float | None = None  # coverage factor of a doubt
    proportional: bool = False  # a doubt relative to the value
    expanded: bool = False  # a doubt said to be expanded

    @property
    def channel(self) -> str | None:
        """The name of the channel that the column holds; None where it names none."""
        return f"{self.um * 1000:g}nm" if self.um is not None else self.colour


def facts(name: str, colours: bool = True) -> tuple[Column, list[Token]]:
    """The column as far as single facts go, and the tokens that no fact accounts for."""
    reading = _Name(spelt_out(name))
    found = reading.facts(colours)
    return Column(name=name, **found), reading.left


def spelt_out(text: str) -> list[Token]:
    """The tokens of a name or a line, with abbreviations and words of other languages as the English that they stand
    for."""
    return list(_spelt_out(text))


@lru_cache(maxsize=1024)  # comments are asked about each thing in turn, and the next file mostly has the same
def _spelt_out(text: str) -> tuple[Token, ...]:
    found = without_articles(tokens(with_blanks(text.strip().strip("\"'")), KNOWN))
    words = [token for token in found if token.is_word]
    alone = len(words) == 1 or len(words) == 2 and words[1].text in ANGLE_UNIT_OF
    table = PLAIN_ALONE if alone else PLAIN
    return tuple(Token(word, token.depth) for token in found for word in table.get(token.text, token.text).split())


def _of_a_value(word: str) -> bool:
    """Whether a word speaks of values or doubts, and not of light or detector."""
    senses = senses_of(word)
    return bool(senses & OF_VALUES) and not senses & {"light", "detector"}


def bare_wavelength(text: str) -> float | None:
    """Micrometres of a number without unit: hundreds and thousands are nm, a few with decimals um."""
    number = float(text.replace(",", "."))
    if "e" in text.lower():
        return None
    if 100 <= number <= 20_000:
        return number / 1000
    return number if 0.1 <= number <= 30 and not text.isdigit() else None


class _Name:
    """A name while it is read: `left` are the tokens that nothing has accounted for yet."""

    def __init__(self, found: list[Token]):
        self.left = found

    def facts(self, colours: bool) -> dict:
        self._naught()
        sense, self.left = taken_sense(self.left)
        found = {} if sense is None else {"sense": sense}
        found |= self._coverage() | self._steradian() | self._mueller() | self._numbers()
        found |= self._unit() | self._scale()
        if colours:
            found |= self._colour()
        if "quantity" not in found:
            found |= self._quantity()
        return found | self._bare_number()

    def text(self, place: int) -> str:
        return self.left[place].text if 0 <= place < len(self.left) else ""

    def texts(self, first: int, end: int) -> list[str]:
        return [token.text for token in self.left[first:end]]

    def senses(self, place: int) -> frozenset[str]:
        return senses_of(self.text(place))

    def take(self, first: int, count: int = 1) -> None:
        del self.left[first : first + count]

    def drop(self, words: set[str]) -> None:
        self.left = [token for token in self.left if token.text not in words]

    # --- numbers ------------------------------------------------------------------------------------------

    def _naught(self) -> None:
        """The 0 of theta_0, phi0 or beta_0 is the incident light's, that of lambda_0 no number at all."""
        for place in range(len(self.left) - 1, 0, -1):
            before = self.senses(place - 1)
            if self.text(place) == "0" and before & {"polar", "azimuth", "alpha", "beta", "mu"}:
                self.left[place] = Token("i", self.left[place].depth)
            elif self.text(place) == "0" and "wavelength" in before:
                self.take(place)

    def _coverage(self) -> dict:
        """`k=2`, `coverage factor 2`, `2 sigma`, `95 %` of a doubt."""
        if not any("doubt" in senses_of(token.text) for token in self.left):
            return {}
        for place, token in enumerate(self.left):
            if not token.is_number:
                continue
            start = place - 1 if self.text(place - 1) in SAYS_IT_IS else place
            if self.text(start - 1) == "k":
                self.take(start - 1, place - start + 2)
                return {"k": token.number}
            if self.texts(max(start - 2, 0), start) == ["coverage", "factor"]:
                self.take(start - 2, place - start + 3)
                return {"k": token.number}
            if self.text(place + 1) == "sigma":
                self.take(place)
                return {"k": token.number}
            if token.number in CONFIDENCE and self.text(place + 1) in ("%", "percent"):
                self.take(place, 2)
                return {"k": CONFIDENCE[token.number]}
        return {}

    def _steradian(self) -> dict:
        """`1/sr`, `sr^-1`, `per sr`, and a power of ten before it, as in `[10⁻³ sr⁻¹]`."""
        place = next((place for place, token in enumerate(self.left) if token.text in STERADIAN), None)
        if place is None:
            return {}
        small = {"factor": STERADIAN[self.text(place)]} if STERADIAN[self.text(place)] != 1 else {}
        depth, start, end = self.left[place].depth, place, place + 1
        for sign in ("^", "-", "1"):
            end += self.text(end) == sign
        while start and self.text(start - 1) in ("/", "per", "1", "inverse", "inv", "in"):
            start -= 1
        self.take(start, end - start)
        if start and depth == self.left[start - 1].depth > 0 and self.left[start - 1].is_power_of_ten:
            factor = self.left[start - 1].number
            self.take(start - 1)
            return {"per_sr": True} | ({"factor": factor} if 0 < factor < float("inf") else {})
        for form in POWERS_OF_TEN if depth else ():
            before = self.left[max(start - len(form), 0) : start]
            texts = [token.text for token in before if token.depth == depth]
            if len(texts) == len(form) and texts[:-1] == form[:-1] and texts[-1].isdigit() and len(texts[-1]) < 3:
                self.take(start - len(form), len(form))
                return {"per_sr": True, "factor": 10.0 ** (-int(texts[-1]) if "-" in form else int(texts[-1]))}
        return {"per_sr": True} | small

    def _mueller(self) -> dict:
        """`f_r11`, the first element of a Mueller matrix, is the BRDF; the others are not."""
        for place in range(len(self.left)):
            for phrase in (["f", "r", "11"], ["brdf", "11"]):
                if self.texts(place, place + len(phrase)) == phrase:
                    self.take(place, len(phrase))
                    return {"quantity": "brdf"}
        return {}

    def _numbers(self) -> dict:
        """The wavelength and the angle that the name states."""
        found: dict = {}
        place = 0
        while place < len(self.left):
            if self.left[place].is_number and self.text(place - 1) not in ("*", "^", "+"):
                start = self._wavelength(place, found)
                start = self._angle(place, found) if start is None else start
                place = place if start is None else start - 1
            place += 1
        return found

    def _wavelength(self, place: int, found: dict) -> int | None:
        """Takes out a wavelength whose number stands at `place`; gives where reading goes on."""
        if "um" in found:
            return None
        number, end = self.left[place].number, place + 1
        ranges = self.text(end) in ("-", "to") and end + 1 < len(self.left) and self.left[end + 1].is_number
        if ranges and self.text(end + 2) in LENGTH_UNIT_OF:  # a band: its middle
            number, end = 0.5 * (number + self.left[end + 1].number), end + 2
        unit, inverse = LENGTH_UNIT_OF.get(self.text(end)), inverse_unit(self.left, end)
        start = self._words_before(place, WAVES if inverse else {"wavelength"})
        if inverse is not None and (um := inverse.um(number)):
            found["um"], end = um, inverse.end
        elif unit is not None:
            found["um"], end = number * LENGTH_UNITS[unit][0], end + 1
        elif start == place or self.text(end) in ANGLE_UNIT_OF:
            return None
        else:
            inside = next((LENGTH_UNIT_OF[token.text] for token in self.left if token.text in LENGTH_UNIT_OF), None)
            um = number * LENGTH_UNITS[inside][0] if inside else bare_wavelength(self.left[place].text)
            if um is None:
                return None
            found["um"] = um
        self.take(start, end - start)
        return start

    def _angle(self, place: int, found: dict) -> int | None:
        """Takes out an angle whose number stands at `place`: `30 deg`, `theta_i=30`, `AOI 30`, `@ 30`."""
        unit, number = ANGLE_UNIT_OF.get(self.text(place + 1)), self.left[place].number
        if "at" in found or unit not in ("deg", None) or number >= 90:
            return None
        below = self.text(place - 1) == "-" and self.text(place - 2) in SAYS_IT_IS
        start = self._words_before(place - below, {"light", "detector", "polar", "angle"})
        senses = frozenset().union(*(self.senses(each) for each in range(start, place)))
        letters = max((len(text) for text in self.texts(start, place)), default=0)
        if unit is None and self.text(place - 1 - below) != "@" and (start == place or letters == 1):
            return None
        if self.text(place - 1) == "-" and not below and start == place:
            return None
        found["at"] = -number if below else number
        if ("light" in senses) != ("detector" in senses):
            found["at_role"] = "theta_i" if "light" in senses else "theta_r"
        self.take(start, place - start + (2 if unit else 1))
        return start

    def _words_before(self, place: int, wanted: set[str]) -> int:
        """Where the words of these senses begin that stand before a number, or the sign between; `place` if none do."""
        sign = place - 1 if self.text(place - 1) in SAYS_IT_IS else place
        first, depth, known = sign, self.left[place].depth, wanted | {"filler"}
        quantity = self._places_of_quantity() if first and self.senses(first - 1) & known else range(0)
        while first and self.senses(first - 1) & known and first - 1 not in quantity:
            if self.left[first - 1].depth > depth:
                break
            first -= 1
        while first < sign and not self.senses(first) & wanted and self.text(first) != "at":
            first += 1
        return first if first < sign or self.text(sign) == "@" else place

    def _bare_number(self) -> dict:
        """One number that is left beside a value, such as 400 or `BRF_865`."""
        numbers = [place for place, token in enumerate(self.left) if token.is_number]
        if [token.text for token in self.left[:-1]] == ["-"] and numbers == [1]:  # -30 and nothing else
            return {"bare": f"-{self.left.pop().text}"}
        if len(numbers) != 1 or self.text(numbers[0] - 1) in ("*", "^", "+", "-"):
            return {}
        bare = self.text(numbers[0])
        if self.text(numbers[0] - 1) == "/" and self.left[numbers[0]].is_power_of_ten:
            return {}
        depth = self.left[numbers[0]].depth
        self.take(numbers[0])
        return {} if bare == "1" and depth else {"bare": bare}  # the unit of what has none

    # --- units, scales and colours ------------------------------------------------------------------------

    def _unit(self) -> dict:
        """The unit of an angle or a wavelength, with the `in` or `/` before it."""
        for place in range(len(self.left) - 1, -1, -1):
            token = self.left[place]
            if inverse := inverse_unit(self.left, place):
                self.take(place, inverse.end - place)
                return {"unit": inverse.unit}
            unit = ANGLE_UNIT_OF.get(token.text) or LENGTH_UNIT_OF.get(token.text)
            as_unit = place and (token.depth or place == len(self.left) - 1)
            if unit is None or token.text in ONLY_AS_UNIT and not as_unit:
                continue
            first = place - 1 if self._says_unit(place) else place
            self.take(first, place - first + 1)
            self._same_unit_again(unit)
            return {"unit": unit}
        return {}

    def _says_unit(self, place: int) -> bool:
        """Whether the word before a unit is the `in` or `/` that leads to it; in `theta_in deg` it names the light."""
        if place < 2 or self.left[place].depth or self.text(place - 1) not in ("in", "/"):
            return False
        return self.text(place - 1) == "/" or any(
            self.senses(each) & {"light", "detector", "wavelength", "doubt"} for each in range(place - 1)
        )

    def _same_unit_again(self, unit: str) -> None:
        """`theta_i_deg (°)` says its unit twice."""
        again = [t for t in self.left if unit in (ANGLE_UNIT_OF.get(t.text), LENGTH_UNIT_OF.get(t.text))]
        self.left = [token for token in self.left if token not in again]

    def _scale(self) -> dict:
        """`%`, `dB`, `log10(...)`, `10 log10(...)`, `ln(...)`."""
        for place, token in enumerate(self.left):
            scale = SCALE_OF.get(token.text)
            if scale is None:
                continue
            first, end = place, place + 1
            if scale == "log10" and self.text(end) == "10":
                end += 1
            before = place - 2 if self.text(place - 1) == "*" else place - 1
            if scale == "log10" and before >= 0 and self.text(before) == "10":
                scale, first = "dB", before
            if self.text(0) == "-" and first == 1:
                return {}  # a negative one is not undone
            self.take(first, end - first)
            return {"scale": scale}
        return {}

    def _colour(self) -> dict:
        """A colour at the end or the beginning, beside nothing but words of values and doubts."""
        places = [place for place, token in enumerate(self.left) if token.is_word]
        for place in (*places[-1:], *places[:1]):
            rest = [self.text(each) for each in places if each != place]
            plain = all(word in QUANTITY_WORDS or _of_a_value(word) for word in rest)
            if self.text(place) in COLOURS and plain:
                colour = COLOURS[self.text(place)]
                self.take(place)
                return {"colour": colour}
        return {}

    # --- quantities ---------------------------------------------------------------------------------------

    def _quantity(self) -> dict:
        """The quantity, with a cosine or pi that multiplies it; the longest phrase counts."""
        places = self._places_of_quantity()
        if not places:
            return {}
        depth, quantity = self.left[places[0]].depth, QUANTITY_OF[tuple(self.texts(places[0], places[-1] + 1))]
        self.take(places[0], len(places))
        if quantity is None:
            return {"vague": True}
        quantity = self._with_cosine(self._with_pi(quantity))
        self._arguments(places[0], depth)
        return {"quantity": quantity}

    def _places_of_quantity(self) -> range:
        """Where the longest phrase stands that names a quantity."""
        words = self.texts(0, len(self.left))
        begins = [place for place, word in enumerate(words) if word in FIRST_OF_QUANTITY]
        for length in range(LONGEST_PHRASE, 0, -1):
            for place in begins:
                if tuple(words[place : place + length]) in QUANTITY_OF and place + length <= len(words):
                    return range(place, place + length)
        return range(0)

    def _with_pi(self, quantity: str) -> str:
        """A BRDF times pi is a reflectance factor, which divided by pi is a BRDF."""
        words = self.texts(0, len(self.left))
        if "pi" not in words:
            return quantity
        divided = self.text(words.index("pi") - 1) == "/"
        other = {"reflectance-factor": "brdf", "hdrf": "brdf"} if divided else {"brdf": "reflectance-factor"}
        if quantity in other:
            self.drop({"pi", "/", *TIMES})
        return other.get(quantity, quantity)

    def _with_cosine(self, quantity: str) -> str:
        """A BRDF times the cosine of an angle, the reflected one where the name does not say which."""
        places = [place for place in range(len(self.left)) if "cosine" in self.senses(place)]
        if quantity != "brdf" or not places or self.text(places[0] - 1) == "/":
            return quantity
        after = [self.senses(place) for place in range(places[0] + 1, len(self.left))]
        of_light = any("light" in each for each in after) and not any("detector" in each for each in after)
        self.drop({*TIMES, self.text(places[0])})
        self.left = [token for token in self.left if not senses_of(token.text) & ARGUMENTS]
        return "brdf-cos-i" if of_light else "brdf-cos"

    def _arguments(self, place: int, depth: int) -> None:
        """`f_r(theta_i, phi_i; theta_r, phi_r)` names what the BRDF depends on."""
        inside = [token for token in self.left[place:] if token.depth > depth and token.is_word]
        if inside and all(senses_of(token.text) & ARGUMENTS for token in inside):
            self.left = [token for token in self.left if token not in inside]

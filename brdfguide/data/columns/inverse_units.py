"""What stands in place of a wavelength and falls where it grows: wavenumber, frequency, energy of a photon."""

from ...records import dataclass
from .tokens import Token

# unit -> (micrometres times it, how it is written)
INVERSE_UNITS = {
    "1/cm": (1e4, "cm-1 cm^-1 1/cm"),
    "THz": (299.792458, "THz"),
    "eV": (1.239841984, "eV"),  # h c / e, CODATA 2018
}
BY_WORD = {"cm": "1/cm", "thz": "THz", "ev": "eV"}
INVERSE_OF_CM = (("/", "1"), ("per",)), (("-", "1"), ("^", "-", "1"))  # before it, the nearest first, and behind it


@dataclass(frozen=True)
class InverseUnit:
    unit: str
    first: int  # of the tokens that write it
    end: int

    def um(self, value: float) -> float | None:
        """Micrometres; None of what is no such quantity."""
        return INVERSE_UNITS[self.unit][0] / value if value > 0 else None


def inverse_unit(row: list[Token], place: int) -> InverseUnit | None:
    """The unit that is written at a place, or from there on: `cm-1`, `cm^-1`, `1/cm`, `THz`, `eV`."""
    texts = [token.text for token in row]
    for at in (place, place + 1, place + 2):
        unit = BY_WORD.get(texts[at]) if at < len(texts) else None
        if unit is None:
            continue
        if unit != "1/cm":
            return InverseUnit(unit, at, at + 1) if at == place else None
        before, behind = INVERSE_OF_CM
        first = next((at - len(each) for each in before if tuple(texts[place:at]) == each[::-1]), None)
        if first is not None and at > place:
            return InverseUnit(unit, first, at + 1)
        end = next((at + 1 + len(each) for each in behind if tuple(texts[at + 1 : at + 1 + len(each)]) == each), None)
        return InverseUnit(unit, at, end) if end is not None and at == place else None
    return None

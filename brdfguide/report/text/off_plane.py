"""What data in the plane of incidence cost, and which term the law lacks, in words."""

from ...printable import off_words
from .folding import folded

SHOWN = 2  # laws that part outside the plane
MORE_OFF = 3  # as measured surfaces were toward grazing (docs/out_of_plane.md)


def off_plane_text(document: dict) -> str:
    """A sentence on each, and where laws that tie in the plane part outside it; nothing where nothing is known."""
    return "\n".join(folded(each, "", "  ") for each in off_plane_sentences(document))


def off_plane_sentences(document: dict) -> list[str]:
    """The same, sentence by sentence."""
    return [*_price(document.get("off_plane")), *_missing(document.get("missing"))]


def _price(price: dict | None):
    if not price:
        return
    expected = off_words(price["expected_percent"])
    said = f"outside the plane of incidence, where nothing was measured, expect it {expected} off"
    yield f"{said}{_grazing(price['toward_grazing'])}; `brdfguide plan --after` says which directions tell"
    for each in price["apart"][:SHOWN]:
        at = each["at"][0]
        place = f"theta_i {at['theta_i_deg']:g}, theta_r {at['theta_r_deg']:g}, phi {at['phi_deg']:g} deg"
        how = "ties with it in the plane" if each["ties"] else "may as well be right"
        said = f"{each['candidate']} {how} and parts from it outside, most at {place}"
        yield f"{said}: {off_words(each['then_percent'])} off if that one is right"


def _grazing(steep: dict | None) -> str:
    if steep is None:
        return ""
    where = f"where both angles add up to more than {steep['beyond_deg']:g} deg"
    return f", {where} {off_words(steep['expected_percent'])} and up to {MORE_OFF} times that"


def _missing(term: dict | None):
    if not term:
        return
    said = f"what it lacks looks like {term['words']}: {100 * term['share']:.0f} % of what is left would go"
    others = ", ".join(f"{each['words']} {100 * each['share']:.0f} %" for each in term["beside"])
    tried = f"; `-m {term['with_it']}` tries it" if term["with_it"] else ""
    yield f"{said} (confidence {term['confidence']:.2f}{f'; {others}' if others else ''}){tried}"

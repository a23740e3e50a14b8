"""Surfaces side by side, in words."""

from .folding import folded
from .table import columns

PLACES = {
    "from_mirror_direction": "highlight and body",
    "on_the_sphere": "on the sphere",
    "lamp_from_eye": "where the lamp stands",
}

KEY = (
    "seen, S: rms difference in lightness L* of two spheres, here of those directions alone; share of S²: how much of "
    "the whole comes from them"
)
FARTHER = {  # what is said of the one that comes after
    None: "",
    "alike to the eye": "alike to the eye",
    "probably closer": "probably farther",
    "closer": "farther",
    "clearly closer": "clearly farther",
}


def pair_text(document: dict) -> str:
    """How different two surfaces look, what changes, and where."""
    one, other = document["surfaces"]
    lines = [
        f"seen {figure_text(document['seen'])} L*: {document['seen_words']}, weights: {document['seen_weights']} "
        f"({document['directions']} directions); rms ln {log_of(document)}",
        f"  A: {one}",
        f"  B: {other}",
    ]
    if document["greatest"] is None:
        return "\n".join([*lines, "  they do not differ anywhere"])
    lines += [
        f"  B is {than(document['brighter'])} on average; {half(document['half'])}",
        f"  most of all at {most(document['greatest'])}",
    ]
    for name, parts in document["where"].items():
        rows = [
            (
                each["where"],
                f"{100 * each['share']:.0f} %",
                figure_text(each["seen"]),
                f"{each['brighter']:+.1f}",
            )
            for each in parts
        ]
        lines += ["", columns((PLACES[name], "share of S²", "S", "B lighter by"), rows, right=(1, 2, 3))]
    lines += ["", folded(KEY, "", "  ")]
    return "\n".join(lines)


def many_text(document: dict) -> str:
    """The nearest first, and how surely each is nearer than the next."""
    rows = [
        (each["surface"], figure_text(each["seen"]), log_of(each), each["seen_words"], FARTHER[each["before_it"]])
        for each in document["ranking"]
    ]
    header = ("surface", "seen L*", "rms ln", "beside it", "than the one above")
    return f"{document['surfaces'][0]} against, nearest first; weights: {document['seen_weights']}\n\n" + columns(
        header, rows, right=(1, 2)
    )


def figure_text(value) -> str:
    return "-" if value is None else f"{value:.1f}"


def log_of(entry: dict) -> str:
    return "-" if entry["rms_ln"] is None else f"{entry['rms_ln']:.2g}"


def than(brighter: float) -> str:
    """How much lighter or darker."""
    return f"{abs(brighter):.1f} L* {'lighter' if brighter >= 0 else 'darker'}"


def half(lies: dict) -> str:
    """Where half of the difference comes from."""
    low, high = lies["theta_i_deg"]
    return (
        f"half of the difference lies within {lies['within_deg']:.0f} deg of the mirror direction, mostly at theta_i "
        f"{low:.0f} to {high:.0f} deg"
    )


def most(place: dict) -> str:
    return (
        f"theta_i {place['theta_i_deg']:.0f}, theta_r {place['theta_r_deg']:.0f}, phi {place['phi_deg']:.0f} deg: "
        f"{than(place['brighter'])}"
    )

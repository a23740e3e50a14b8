"""The answer of `roughness` in words, for one question or for many. Loads nothing but `math`: shell loops call it."""

import sys

from ...errors import BrdfguideError, InputError
from ..documents.emergence import SCHEMA, SLOPE, document


def text(result: dict, full: bool = False) -> str:
    """The document for people: the answer, then Eq. 3 and the criterion side by side; in full what else follows."""
    lines = [*_answer(result), "", *_both(result), ""]
    if "difference" in result:
        percent, of = result["difference"]["eq3_over_criterion_percent"], result["difference"]["of"].removesuffix("_um")
        more = f"{abs(percent):.1f} % {'larger' if percent > 0 else 'smaller'}"
        lines.append(f"the guide's short formula, Eq. 3, gives a {of} {more} than the full criterion behind it")
    lines += _report_example(result)
    if "slopes" in result:
        shows = ", ".join(f"{100 * share:.2g} % on a {body}" for body, share in result["slopes"]["shows_from"].items())
        lines.append(f"for the eye: a change of sigma/tau shows from {shows}")
        lines += _in_other_words(result) if full else []
    for tau, sigma in result.get("contour", ()):
        if (tau, sigma) == tuple(result["contour"][0]):
            lines += ["", f"{'tau [um]':>10}  {'sigma [um]':>10}"]
        lines.append(f"{tau:10.4g}  {sigma:10.4g}")
    return "\n".join(lines).rstrip("\n") + "\n"


def _answer(result) -> list[str]:
    """The numbers to type, how sure they are, and what was asked."""
    criterion, never = result["criterion"], result["emergence"] == "never"
    sigma, tau = criterion["sigma_um"], criterion["tau_um"]
    lines = []
    if never:
        lines.append(f"no mirror image seen: rougher than sigma {sigma:.3g} um at sigma/tau = {criterion['slope']:.3g}")
    elif sigma:
        lines.append(
            f"sigma {sigma:.3g} um, tau {tau:.3g} um: rms height and distance of the surface's bumps, at sigma/tau = "
            f"{criterion['slope']:.3g}{' [--slope]' if _is_usual(criterion) else ''}"
        )
    if "doubt" in result:
        lines.append(_doubt(result["doubt"], criterion))
    head = "without a mirror image up to" if never else "for a mirror image that appears at"
    return [
        *lines,
        f"{head} {result['angle_deg']:.4g} deg from the normal, {result['wavelength_nm']:g} nm, a pupil of "
        f"{result['pupil_mm']:g} mm at {result['distance_mm']:g} mm ({result['solid_angle_sr']:.4g} sr)",
    ]


def _is_usual(point) -> bool:
    """Whether sigma/tau is what is taken where none is given."""
    return round(point["slope"], 9) == SLOPE


def _both(result) -> list[str]:
    """Eq. 3 and the criterion, a line each."""
    eq3, criterion = result["eq3"], result["criterion"]
    sign = "> " if result["emergence"] == "never" else ""
    lines = [f"{'':24}  {'sigma [um]':>10}  {'tau [um]':>10}  {'angle [deg]':>11}"]
    for name, part in (
        (f"Eq. 3 with C = {eq3['c']:.3g}" if eq3["sigma_um"] else "Eq. 3", eq3),
        ("He-Torrance criterion", criterion),
    ):
        cells = [sign + f"{part[key]:.3g}" if part["sigma_um"] else "-" for key in ("sigma_um", "tau_um")]
        angle = f"{part['angle_deg']:.4g}" if part["sigma_um"] else "-"
        lines.append(f"{name:24}  {cells[0]:>10}  {cells[1]:>10}  {angle:>11}")
    return lines


def _in_other_words(result) -> list[str]:
    """The slope as others name it, and the same surface in other light."""
    slopes = result["slopes"]
    others = [f"{emerges(each['angle_deg'])} at {each['wavelength_nm']:g} nm" for each in result["other_wavelengths"]]
    return [
        f"sigma/tau {slopes['sigma_over_tau']:.3g} by its other names: rms slope along a line "
        f"{slopes['rms_along_a_line']:.3g}, mean gradient {slopes['mean_gradient']:.3g}, Beckmann's alpha "
        f"{slopes['beckmann_alpha']:.3g}",
        f"in other light the same surface's mirror image appears {' and '.join(others)}",
    ]


def _doubt(doubt, criterion):
    """What the reading's error does to the answer."""
    name, value = doubt["of"].removesuffix("_um"), criterion[doubt["of"]]
    low, high = doubt["low"], doubt["high"]
    if low is None and high is None:
        return f"the angle, read to {doubt['angle_error_deg']:g} deg, leaves {name} open"
    if low is None or high is None:
        said = f"lies above {low:.3g} um" if high is None else f"lies below {high:.3g} um"
    else:
        said = (
            f"lies in {low:.3g} to {high:.3g} um ({100 * (low / value - 1):+.0f} to {100 * (high / value - 1):+.0f} %)"
        )
    return f"the angle read to {doubt['angle_error_deg']:g} deg, {name} {said}, 19 times in 20"


def emerges(degrees):
    """From where on a mirror image stands out."""
    if degrees is None:
        return "nowhere below 89.9 deg"
    return f"at {degrees:.3g} deg" if degrees else "at every angle"


def _report_example(result):
    """The report's worked example, said beside the answers that it belongs to and that it does not."""
    point = result["criterion"]
    if point["sigma_um"] is None or not _is_usual(point):
        return []
    if f"{point['sigma_um']:.2f}, {point['tau_um']:.1f}" == "0.50, 5.0":
        return ["the guide's worked example (sigma 0.50, tau 5.0) belongs here, though it names 80 deg"]
    return (
        ["the guide's worked example (sigma 0.50, tau 5.0) belongs to 75 deg, not to 80"]
        if result["angle_deg"] == 80
        else []
    )


def notes(result: dict) -> list[str]:
    """The doubts, for stderr."""
    return [flag["text"] for part in ("eq3", "criterion") for flag in result[part]["flags"]]


def answer_text(json: bool = False, full: bool = False, **question) -> tuple[str, list[str]]:
    """stdout and the notes for stderr. Both ways to run the command end here."""
    result = document(**question, brief=not (json or full))
    return (_json(result) + "\n", []) if json else (_on_screen(text(result, full)), notes(result))


def _on_screen(words: str) -> str:
    """Folded where a screen is narrower; in a pipe nothing is."""
    if not sys.stdout.isatty():
        return words
    from .folding import page

    return page(words)


def _json(value, margin="\n") -> str:
    """As `json.dumps(value, indent=2)` writes it; importing that costs half of a bare Python again."""
    inside = margin + "  "
    if value is None or value == [] or value == {}:
        return "null" if value is None else str(value)
    if isinstance(value, dict):
        return "{" + ",".join(f'{inside}"{key}": {_json(item, inside)}' for key, item in value.items()) + margin + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(inside + _json(item, inside) for item in value) + margin + "]"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str) and value.isascii() and value.isprintable() and '"' not in value and "\\" not in value:
        return f'"{value}"'
    from json import dumps

    return dumps(value)


# --- many questions in one process -------------------------------------------------------------------

COLUMNS = (
    "angle_deg",
    "wavelength_nm",
    "eq3_sigma_um",
    "eq3_tau_um",
    "sigma_um",
    "tau_um",
    "note",
    "low_um",
    "high_um",
)


def batch(lines, json: bool = False, **common):
    """One answer for each line such as `80`, `80 slope=0.2` or `tau-um=5 angle=75`: (text, exit status).

    Blank lines and those that begin with # are passed over.
    """
    if not json:
        yield "\t".join(COLUMNS) + "\n", 0
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        try:
            result, status = document(**common | _question(line)), 0
        except BrdfguideError as error:
            result, status = {"schema": SCHEMA, "line": number, "error": str(error)}, error.exit_status
        if json:
            from json import dumps

            yield dumps(result, allow_nan=False) + "\n", status
        elif status:
            before, after = COLUMNS.index("note"), len(COLUMNS) - COLUMNS.index("note") - 1
            yield "\t" * before + f"line {number}: {result['error']}" + "\t" * after + "\n", status
        else:
            values = [
                result["angle_deg"],
                result["wavelength_nm"],
                *(result[part][key] for part in ("eq3", "criterion") for key in ("sigma_um", "tau_um")),
            ]
            ends = [result.get("doubt", {}).get(end) for end in ("low", "high")]
            cells = [*map(_cell, values), "; ".join(notes(result)), *map(_cell, ends)]
            yield "\t".join(cells) + "\n", status


def _cell(value) -> str:
    return "" if value is None else f"{value:.6g}"


def _question(line):
    known = ("angle", "slope", "sigma-um", "tau-um", "wavelength-nm", "pupil-mm", "distance-mm", "angle-error")
    question = {}
    for word in line.split():
        name, _, value = word.rpartition("=")
        name = name or "angle"
        if name not in known:
            raise InputError(f"'{word}': a request is an angle or name=value with {', '.join(known)}")
        try:
            question[name.replace("-", "_")] = float(value)
        except ValueError:
            raise InputError(f"'{word}': '{value}' is no number") from None
    return question

"""What the guidelines make of a description, and what a measurement says to it, in words."""

from .folding import folded
from .table import columns
from .values import percent_words


def text(document: dict, explain: bool = False, full: bool = False, *, measured: bool = False) -> str:
    """For people: the pick with its numbers, why, what was guessed, what is doubtful, what it cannot do. Where the
    surface was `measured` too, what was measured is the answer, and this stands below it."""
    answered = bool(document["candidates"]) or explain
    blocks = [_pick(document, measured), _candidates(document["candidates"], full), _domain(document)]
    for title, rules in _rules(document, answered).items():
        if rules and (full or explain or title != INFERRED):
            said = [_item(f"{a['says']}  <- {a['because']}  [{a['section']}, {a['rule']}]") for a in rules]
            blocks.append("\n".join([f"{title}:", *said]))
    if answered and (full or explain):
        blocks += [_left_out(document["left_out"]), _without(document["observations"])]
    elif answered:
        blocks.append(folded(MORE, "", "  "))
    if explain:
        silent = [_item(f"{each['rule']}: {each['about']}  [{each['section']}]") for each in document["silent"]]
        blocks.append("\n".join(["silent rules:", *silent]))
    return "\n\n".join(filter(None, blocks))


INFERRED = "observed or inferred"
MORE = (
    "[section of the guide, rule]: `brdfguide --explain RULE` says what it is; --full: what was inferred and left out"
)


KEY = (
    "75 over 10 deg: how much brighter the highlight, and the mirror image, is with the lamp at 75 degrees than at 10; "
    "gloss: what a glossmeter would read at 20, 60 and 85 degrees"
)
REACH = {  # what the guide's domain is to this surface
    "inside": "the guide's rules are made for such surfaces",
    "flagged": "the guide's rules reach it in part",
    "outside": "outside what the guide's rules are made for",
}


def _item(said: str) -> str:
    return folded(said, "  ", "    ")


def _domain(document: dict) -> str:
    """What the surface is, and whether the guide speaks of such ones."""
    domain, verdict = document["domain"], document["verdict"]
    head = f"{document['name'] or 'material'}: {verdict['kind']} ({verdict['evidence']}); {REACH[domain['status']]}"
    lines = [folded(head, "", "  ")]
    for each in domain["reasons"]:
        needs = f"; needs {each['needs']}" if each["needs"] else ""
        lines.append(_item(f"{each['status']}: {each['text']}{needs}  [{each['section']}]"))
    return "\n".join(lines)


def _pick(document: dict, measured: bool) -> str:
    """The model to use, what to type, why, and how far to trust it; or why there is none."""
    if not document["candidates"]:
        reasons = document["domain"]["reasons"]
        alone = "by the description alone " if measured else ""
        why = reasons[0]["text"] if reasons else "nothing fits"
        return folded(f"{alone}no model is recommended: {why}", "", "  ")
    pick, head = document["candidates"][0], "by the description alone" if measured else "recommended"
    lines = [
        folded(f"{head}: {pick['model']}, for {document['name'] or 'this material'}", "", "  "),
        _item(f"to type: {_values(pick)}"),
        _item(f"because {pick['why']}"),
        _item(f"trust: {_trust(document, measured)}"),
    ]
    lines += [_item(f"cannot: {each}") for each in pick["cannot"]]
    return "\n".join([*lines, *map(_item, _shows(pick["shows_from"]))])


def _trust(document: dict, measured: bool) -> str:
    """How far to trust what no instrument has seen, in one sentence."""
    guesses = sum(each["guess"] for each in document["advice"])
    decides = "; what was measured decides" if measured else ", which a measurement would settle"
    said = [f"start values from a description alone{decides}"]
    if guesses:
        said.append(f"{guesses} guess{'es' * (guesses > 1)} below")
    if document["conflicts"]:
        said.append("the description contradicts itself")
    if document["domain"]["status"] != "inside":
        said.append(REACH[document["domain"]["status"]])
    return "; ".join(said)


def _candidates(found: list[dict], full: bool) -> str:
    """Every candidate in a table; with its start values where it is to be `full`."""
    if not found:
        return ""
    timed = "time_per_sample_ns" in found[0]
    last = ("start values",) if full else ()
    header = ("candidate", "75 over 10 deg", "gloss 20/60/85", *(("ns",) if timed else ()), *last)
    rows = []
    for each in found:
        time = (f"{each['time_per_sample_ns']:.0f}",) if timed else ()
        rows.append((each["model"], _growth(each), _gloss(each), *time, *((_values(each),) if full else ())))
    return columns(header, rows, right=(3,) if timed else ()) + "\n" + folded(KEY, "", "  ")


def _shows(shows: dict) -> list[str]:
    """From which change on the eye would notice each number."""
    said = [f"{percent_words(share)} of {key}" for key, share in shows.items() if share is not None]
    return [f"for the eye: a change shows from {', '.join(said)} on"] if said else []


def _rules(document: dict, answered: bool) -> dict[str, list[dict]]:
    """What the rules said, by how sure it is; of the domain is spoken above."""
    domain = {each["rule"] for each in document["domain"]["reasons"]}
    advice = document["advice"]
    plain = [a for a in advice if not (a["guess"] or a["conflict"] or a["rule"] in domain)]
    return {
        INFERRED: plain if answered else [],
        "guessed": [a for a in advice if a["guess"] and answered],
        "contradictory": [a for a in advice if a["conflict"]],
    }


def measured_text(document: dict) -> str:
    """The verdict on the data, and what it denies of the description."""
    judged = document["measured_verdict"]
    evidence = f" ({'; '.join(judged['evidence'])})" if judged["evidence"] else ""
    lines = [folded(f"from the measurement: {judged['kind']}{evidence}", "", "  ")]
    for each in document["disagreements"]:
        lines.append(_item(f"eye against instrument: {each['text']}; {each.get('consequence', '')}"))
    return "\n".join(lines)


def _without(observations: list[dict]) -> str:
    """What leaving out an observation would change, where that is not the answer itself."""
    told = [(each["observation"], each["text"]) for each in observations if each["effect"] != "decides"]
    return folded("leaving out one observation: " + _grouped(told), "", "  ") if told else ""


def _left_out(left_out: list[dict]) -> str:
    """Models that do not come into question, and why."""
    if not left_out:
        return ""
    return folded("left out: " + _grouped((each["term"], each["why"]) for each in left_out), "", "  ")


def _grouped(pairs) -> str:
    """`a, b (why); c (why)`."""
    by_reason: dict[str, list[str]] = {}
    for name, why in pairs:
        by_reason.setdefault(why, []).append(name)
    return "; ".join(f"{', '.join(names)} ({why})" for why, names in by_reason.items())


def _values(candidate: dict) -> str:
    """name=value, ready to type."""

    def word(value):
        return ",".join(f"{each:g}" for each in value) if isinstance(value, list) else f"{value:g}"

    return " ".join(f"{key}={word(value)}" for key, value in candidate["start"].items())


def _growth(candidate: dict) -> str:
    rise = candidate["growth_10_to_75_deg"]
    parts = [f"x{rise['at_mirror']:.3g}"] if rise["at_mirror"] else []
    return ", ".join(parts + ([f"image x{rise['mirror_term']:.3g}"] if rise["mirror_term"] else [])) or "-"


def _gloss(candidate: dict) -> str:
    return "/".join(f"{value:.0f}" for value in candidate["gloss_gu"].values()) if candidate["gloss_gu"] else "-"

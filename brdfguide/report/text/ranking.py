"""A fit's document as text: which model, how sure, what it costs, what was doubtful."""

from collections.abc import Iterator
from typing import NamedTuple

from ...printable import LEAST_NOISE, off_words, off_words_of
from .floor import floor_text
from .folding import folded, wrapped_text
from .off_plane import off_plane_text
from .ranked_table import detail_tables, legend, number_text, ranked_lines, told_rows
from .stray_light import stray_light_text
from .values import percent_words

MOST_KNOWN = 1.0  # two standard errors, as a share of a value, from which on it could as well be zero
MOST_TYPED = 4  # channels of which every value is told


class Paragraph(NamedTuple):
    """A paragraph of an answer, and what it is for those who colour it."""

    role: str  # "answer", "no answer", "table", "data", "doubts" or "detail"
    rows: list[list[str]]  # the lines of each row; of prose one row

    @property
    def text(self) -> str:
        return "\n".join("\n".join(row) for row in self.rows)


def ranking_text(document: dict, *, notes: bool = True, full: bool = False) -> str:
    """The answer in plain text: model and numbers, table, data, doubts; all that is known where it is to be `full`."""
    return "\n\n".join(part.text for part in ranking_parts(document, notes=notes, full=full))


def ranking_parts(document: dict, *, notes: bool = True, full: bool = False) -> list[Paragraph]:
    """The same, paragraph by paragraph; the rows of the table apart."""
    rows = told_rows(document, full)
    more = len(document["ranking"]) - len(rows)
    left_out = f"{more} models more than 4 times as far off as the best are left out (--full)" if more else ""
    parts = [
        _part("no answer" if document.get("no_answer") else "answer", pick_text(document, notes)),
        Paragraph("table", ranked_lines(rows)),
        _part("detail", folded("; ".join(filter(None, [left_out, legend(rows)])), "", "  ")),
        _part("data", data_text(document)),
        _part("answer", stray_light_text(document["stray_light"], wrapped_text)),
        _part("doubts", off_plane_text(document)),
    ]
    if full:
        parts += [_part("detail", text) for text in _in_full(document)]
    if notes:
        parts.append(_part("doubts", doubts_text(document)))
        parts.append(_part("detail", data_notes(document["data"], full)))
        if not full:
            parts.append(_part("detail", folded(MORE, "", "  ")))
    return [part for part in parts if part.text.strip()]


MORE = "--full: every number, scale and note; `brdfguide --explain CODE`: what a doubt means, such as discrepancy"


def _part(role: str, text: str) -> Paragraph:
    return Paragraph(role, [text.split("\n")])


def _in_full(document: dict) -> Iterator[str]:
    pick = recommended_row(document)
    yield detail_tables(document["ranking"])
    if pick.get("growth") and _finite(pick["growth"]["r_mirror"]):  # a model that is 0 everywhere has none
        yield wrapped_text(growth_text(pick["growth"]))
    yield from (seen_text(document), floor_text(document), scales(document))


def recommended_row(document: dict) -> dict:
    """The row of the model to use."""
    return next(row for row in document["ranking"] if row["candidate"] == document["recommended"])


def pick_text(document: dict, notes: bool = True) -> str:
    """Which model, how far off, what to type, how well each number is known, how far to trust it, and why this one."""
    row = recommended_row(document)
    lines = [folded(line, "", "  ") for line in verdict_words(document).split("\n")[:-1]]
    verdict = verdict_words(document).split("\n")[-1]
    lines.append(folded(f"{verdict}: {document['recommended']}, {headline(row)}", "", "  "))
    lines.append(wrapped_text(f"to type: {typed_text(row)}"))
    lines += [wrapped_text(said) for said in (shows_text(row["parameters"]), trust_text(document, row, notes)) if said]
    lines.append(wrapped_text(f"why: {document['because']}"))
    return "\n".join(lines)


def typed_text(row: dict) -> str:
    """name=value of all that `evaluate` and `export --model` want; of many channels the range."""
    return " ".join(f"{key}={_typed(value)}" for key, value in row["typed"].items())


def _typed(value) -> str:
    if not hasattr(value, "__len__"):
        return f"{value:.4g}"
    if len(value) > MOST_TYPED:
        return f"{min(value):.3g}..{max(value):.3g}"
    return ",".join(f"{each:.4g}" for each in value)


def trust_text(document: dict, row: dict, notes: bool = True) -> str:
    """How far to trust the answer, in one sentence."""
    if document.get("no_answer"):
        return ""
    said = [against] if (against := against_data(document)) else []
    if (held := row["held_out_rms_ln"]) is not None:
        said.append(f"{off_words_of(held)} off at incidence angles that it was not fitted to")
    causes = {flag["code"] for flag in row["flags"]}
    if "discrepancy" in causes:
        said.append("it errs the same way over neighbouring directions, so its numbers are less sure than their ±")
    elif "instrument" in causes:
        said.append("what it misses looks like the instrument's drift")
    else:
        said.append("what it misses has no pattern")
    doubts = len(row["flags"]) + len(document["warnings"])
    told = " below" if notes else "; --json has them"
    count = "no doubts" if not doubts else f"{doubts} doubt{'s' * (doubts > 1)}{told}"
    return f"trust: {'; '.join([*said, count])}"


def data_text(document: dict) -> str:
    """What the file is, what its values are worth, and whether it is of a metal."""
    text = heading(document["data"]) + noise_line(document) + kind_line(document)
    return "\n".join(folded(line, "", "  ") for line in text.split("\n"))


def heading(data: dict) -> str:
    low, high = data["theta_i_deg"]
    incidence = f"{low:.3g}" if low == high else f"{low:.3g}..{high:.3g}"
    plane = "in the plane of incidence" if data["in_plane"] else "over the hemisphere"
    channels = f"{len(data['channels'])} channels" if len(data["channels"]) > 1 else f"{data['wavelength_nm'][0]:g} nm"
    missing = f", {data['missing']} of {data['values']} values missing" if data["missing"] else ""
    return f"{data['file']}: {data['samples']} directions {plane}, {channels}, theta_i {incidence} deg{missing}"


def noise_line(document: dict) -> str:
    """What single values are worth, and over which of them errors are told."""
    noise, values = document["noise"], document["data"]["values"]
    if noise["relative"] is None:
        return ""
    level = min(noise["relative"], document["noise_rms_ln"])  # what the best law leaves, where that is less
    share = off_words(100 * level) if level > LEAST_NOISE else f"less than {100 * LEAST_NOISE:g} %"
    text = f"\nsingle values scatter by {share}"
    if any(noise.get("absolute_per_sr") or ()):
        text += f", and by {span_text(noise['absolute_per_sr'])}/sr where they are dim"
    if noise.get("told_from_per_sr"):
        limit = span_text(noise["told_from_per_sr"])
        text += f"; errors are told over the {noise['values_told']} of {values} values above {limit}/sr"
    return text


def against_data(document: dict) -> str:
    """That --kind was believed and the data were not, in a few words; nothing where they agree."""
    if not any(note["code"] == "kind-contradicted" for note in document["data"]["findings"]):
        return ""
    told = document["kind"]["verdict"]
    taken = "dielectric" if told == "metal" else "metal"
    return f"taken as a {taken} because --kind says so; these data say {told}"


def span_text(values: list[float]) -> str:
    """From the least to the greatest, two digits; one number where they are alike."""
    low, high = min(values), max(values)
    return f"{high:.2g}" if low > 0.8 * high else f"{low:.2g}..{high:.2g}"


def kind_line(document: dict) -> str:
    """Metal or dielectric, where the data decide it; that it was fitted as the other, where it was."""
    if against := against_data(document):
        return f"\n{against}: {'; '.join(document['kind']['evidence'])}"
    kind = document.get("kind")
    return (
        f"\n{kind['verdict']}: {'; '.join(kind['evidence'])}"
        if kind and kind["verdict"] in ("metal", "dielectric")
        else ""
    )


def verdict_words(document: dict) -> str:
    """What is said of the model that is named: to be used, or only the best of those that are not."""
    if not document.get("no_answer"):
        return "recommended"
    return f"no trustworthy answer: {document['no_answer']}\nnearest"


def headline(row: dict) -> str:
    """How far off a model typically is, in words first."""
    text = f"typically {off_words(row['off_percent'])} off"
    return text if row["seen"] is None else f"{text}; side by side it {row['seen_says'].removesuffix(' side by side')}"


def shows_text(parameters: dict) -> str:
    """How well each parameter is known, and from which change on it would show on this surface; by its full name where
    several terms have one of the same."""
    shown = {key: entry for key, entry in parameters.items() if "shows_from" in entry}
    bare, said = [key.rpartition(".")[2] for key in shown], []
    for key, name in zip(shown, bare, strict=True):
        name = name if bare.count(name) == 1 else key
        said.append(f"{name} {known_and_shows(shown[key]['known_to'], shown[key]['shows_from'])}")
    return f"for the eye: {'; '.join(said)}" if said else ""


def known_and_shows(known: float | None, shows: float | None) -> str:
    """How well a value is known beside the change that begins to show."""
    if known is not None and known >= MOST_KNOWN:
        known = None
    knowledge = "is not determined" if known is None else f"is known to {percent_words(known)}"
    if shows is None:
        return f"{knowledge}, and no change of it shows"
    if known is None or known > shows:
        return f"{knowledge}, but {percent_words(shows)} begins to show"
    return f"{knowledge}, and it takes {percent_words(shows)} to show"


def seen_text(document: dict) -> str:
    """How far the recommended model looks from the data, and the order in which people would put all of them."""
    order = document["seen_order"]
    pick = recommended_row(document)
    if not order or pick["seen"] is None:
        return ""
    first = f"seen {pick['seen']:.1f} L*: {pick['seen_words']}, weights: {document['seen_weights']}"
    bands: dict[str, list[str]] = {}
    for place, each in enumerate(order):
        alike = " (alike)" if each["alike"] and place else ""
        bands.setdefault(each["seen_words"].removesuffix(" side by side"), []).append(
            f"{each['candidate']} {each['seen']:.1f}{alike}"
        )
    text = "seen order: " + "; ".join(f"{words}: {', '.join(names)}" for words, names in bands.items())
    promise = "people order clear cases this way 9 times in 10 under one real light; this is no promise for yours"
    return "\n".join([first, *map(wrapped_text, (text, promise) if len(order) > 1 else ())])


def growth_text(growth: dict) -> str:
    """How fast model and data rise toward grazing: what models differ in most (Westin et al. 2004, section 5.2)."""
    low, high = growth["theta_i_deg"]

    def data(key):
        return f", the data {growth[key]:.3g} times" if _finite(growth[key]) else ""

    greatest = (
        f"; its greatest value {growth['r_max']:.3g} times{data('r_max_data')}" if _finite(growth["r_max"]) else ""
    )
    return (
        f"toward grazing, from {low:g} to {high:g} degrees, it grows {growth['r_mirror']:.3g} times in the mirror "
        f"direction{data('r_mirror_data')}{greatest}"
    )


def next_text(block: dict) -> str:
    """What one more measurement is for, and a line for each direction; of photographs, for each phase."""
    if "phases" in block:
        return _next_picture_text(block)
    if block["purpose"] == "separate":
        lines = [f"to tell {block['of'][0]} from {block['of'][1]}, measure next at"]
    else:
        lines = [f"to pin {block['of'][0]}, measure next at"]
    if block.get("turns_deg"):
        turns = " and then ".join(f"{each:g}" for each in block["turns_deg"])
        lines.insert(0, f"to tell its grain, turn the sample by {turns} degrees and scan again (--turned joins them)")
    for each in block["directions"]:
        where = f"theta_i {each['theta_i_deg']:g}, theta_r {each['theta_r_deg']:g}, phi {each['phi_deg']:g} deg"
        if block["purpose"] == "separate":
            gain = f"they differ by {each['differ_by_noise']:.2g} times the noise of one value"
        else:
            gain = f"one value there leaves {100 * each['standard_error_left']:.3g} % of its standard error"
        lines.append(f"{where}: {gain}")
    if not block["narrows"]:
        lines.append("no single value narrows it much; whole scans of the detector in the plane of incidence do:")
        lines += [_scan_text(each) for each in block["scans"]]
    return "\n  ".join(lines)


def _scan_text(scan: dict) -> str:
    low, high = scan["theta_r_deg"]
    angles = f"theta_i {scan['theta_i_deg']:g}, theta_r {low:g} to {high:g} every {scan['step_deg']:g} deg"
    return f"{angles}: leaves {100 * scan['standard_error_left']:.3g} % of its standard error"


def _next_picture_text(block: dict) -> str:
    separate = block["purpose"] == "separate"
    purpose = f"to tell {block['of'][0]} from {block['of'][1]}" if separate else f"to pin {block['of'][0]}"
    lines = [f"{purpose}, take a picture at phase {block['phases'][0]['phase_deg']:g} (lamp - sample - camera):"]
    for each in block["phases"]:
        if separate:
            gain = f"over the ball they differ by {each['differ_by_noise']:.2g} times the noise of one value"
        else:
            gain = f"it leaves {100 * each['standard_error_left']:.3g} % of its standard error"
        lines.append(f"phase {each['phase_deg']:g} degrees: {gain}")
    return "\n  ".join(lines)


def scales(document: dict) -> str:
    """What each scale counts, and the order on it."""
    paragraphs = ["best three on each scale:"]
    for name, scale in document["scales"].items():
        if name == "seen":  # told in a paragraph of its own
            continue
        best = ", ".join(f"{each['candidate']} {number_text(each['error'], '.3g')}" for each in scale["order"][:3])
        paragraphs += [wrapped_text(f"{name}, {scale['counts']}:"), folded(best, "    ", "      ")]
    return "\n".join(paragraphs)


def doubts_text(document: dict) -> str:
    """Every warning about the recommended model and about the ranking."""
    row = recommended_row(document)
    return notes_text("doubts:", row["flags"] + document["warnings"])


def data_notes(data: dict, full: bool = True) -> str:
    """What was made of the file; where it is not to be `full` the doubts alone."""
    told = [each for each in data["findings"] if full or each["severity"] != "note"]
    return notes_text("about the data:", told)


def notes_text(title: str, findings: list[dict]) -> str:
    lines = [
        wrapped_text(
            f"{each['code']}: {each['text'].removeprefix(each['code'].replace('-', ' ') + ': ')}"
            + (f": {each['consequence']}" if each.get("consequence") else "")
            + _option(each)
        )
        for each in findings
    ]
    return "\n".join([title, *lines]) if lines else ""


def _option(finding: dict) -> str:
    return f" [{finding['option']}]" if finding.get("option") else ""


def _finite(value) -> bool:
    return value is not None and abs(value) < float("inf")

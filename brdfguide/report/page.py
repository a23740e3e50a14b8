"""A result as one self-contained HTML page: the answer first, then figures, ranking, doubts, and how to repeat it.

Reads the documents of `--json` and nothing else, so that page, terminal and JSON cannot disagree.
"""

import json
import platform
from hashlib import sha256
from html import escape
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from .. import __version__, printable
from ..files import write_whole
from ..opening import is_plain
from ..printable import off_words, off_words_of
from . import sheet
from .documents.plain import plain
from .elements import (
    html_definitions,
    html_findings,
    html_number,
    html_sentence,
    html_table,
    name_of,
    quantity,
    typed,
)
from .page_numbers import numbers_table
from .page_ranking import ranking
from .page_words import section_links, words_used
from .text.off_plane import off_plane_sentences

PACKAGES = ("numpy", "matplotlib", "pyyaml")


def write(document: dict, path, figures=(), command: str = "", files=(), explorer: str = "") -> None:
    """Write the page whole or not at all.

    `figures` are as `sheet.picture` takes them; `files` are hashed for the last section; `explorer` is the block of
    `explorer_block`. Raises InputError where it cannot be written.
    """
    write_whole(path, html(document, figures, command, files, explorer))


def html(document: dict, figures=(), command: str = "", files=(), explorer: str = "") -> str:
    """The page as text; `figures` are as `sheet.picture` takes them."""
    whole = plain(document)
    document = printable.document(whole)
    sections = [
        ("figures", "Figures", _figures(figures)),
        ("turn", "Turn the knobs", explorer),
        ("ranking", "Ranking", ranking(document)),
        ("parameters", "Parameters", _parameters(document)),
        ("numbers", "Numbers to type", numbers_table(document)),
        ("candidates", "Models worth trying", _candidates(document)),
        ("doubts", "Doubts", _doubts(document)),
        ("beyond", "What the data do not show", _beyond(document)),
        ("material", "The material as understood", _material(document)),
        ("guidelines", "Guidelines that spoke", _advice(document)),
        ("data", "The data", _data(document)),
        ("scene", "Scene, and what it can do without", _scene(document)),
        ("repeat", "To repeat this", _repeat(printable.comment(command), files)),
    ]
    there = [(key, title, text) for key, title, text in sections if text]
    there.append(("words", "Words", words_used(document, "".join(text for key, _, text in there if key != "turn"))))
    title = _title(document)
    head = f"<header><h1>{escape(title)}</h1>{_answer(document)}</header>"
    links = "<nav>" + " ".join(f'<a href="#{key}">{title}</a>' for key, title, _ in there) + "</nav>"
    body = "\n".join(f'<section id="{key}"><h2>{title}</h2>{text}</section>' for key, title, text in there)
    return sheet.html_page(escape(title), f"{head}{links}<main>{body}</main>", json.dumps(whole, allow_nan=False))


def _title(document) -> str:
    data = document.get("data") or {}
    return f"Reflectance of {document.get('name') or Path(str(data.get('file') or 'a surface')).name}"


def _answer(document) -> str:
    """The first thing read: which model, how far off, how sure; or that there is none to be trusted."""
    rows = document.get("ranking") or []
    domain = document.get("domain") or {}
    outside = "".join(f"<p>{escape(html_sentence(reason))}</p>" for reason in domain.get("reasons", ()))
    if domain.get("status") == "outside":
        return f'<div class="answer"><strong>No trustworthy answer</strong>{outside}</div>'
    if rows:
        pick = next((row for row in rows if name_of(row) == document.get("recommended")), rows[0])
        off = off_words(pick["off_percent"])
        doubt = document.get("no_answer")
        text = f"<strong>No trustworthy answer</strong><p>{escape(html_sentence(doubt))}</p>" if doubt else ""
        text += f"<strong>{escape(name_of(pick))}</strong><p>Typically {off} off (rms ln {pick['rms_ln']:.3g})."
        if pick.get("seen") is not None:
            text += f" On a sphere under lamps all around it {escape(pick['seen_says'])}: {pick['seen']:.1f} L*."
        if pick.get("held_out_rms_ln") is not None:
            text += f" {off_words_of(pick['held_out_rms_ln'])} off at incidence angles that it was not fitted to."
        text += f"</p><p>{escape(document.get('because', ''))}</p>"
        free = {key: entry["value"] for key, entry in pick["parameters"].items() if not entry.get("derived")}
        return f'<div class="answer">{text}<p>{typed(free)}</p>{outside}</div>'
    first = (document.get("candidates") or [{}])[0]
    words = f"<strong>{escape(first.get('model', 'no model'))}</strong><p>{escape(first.get('why', ''))}</p>"
    return (
        f'<div class="answer">{words}<p>{typed(first.get("start") or {})}</p><p>From guidelines alone: no '
        f"measurement was given.</p>{outside}</div>"
    )


def _figures(figures) -> str:
    return "".join(sheet.picture(each, number) for number, each in enumerate(figures, start=1))


def _parameters(document) -> str:
    rows = document.get("ranking") or []
    pick = next((row for row in rows if name_of(row) == document.get("recommended")), None)
    if not pick:
        return ""
    lines = []
    for key, entry in pick["parameters"].items():
        how = "fitted" if entry.get("fitted") else "held"
        how = "follows" if entry.get("derived") else how
        how += f", at its {entry['at_bound']} bound" if entry.get("at_bound") else ""
        lines.append(
            (
                [
                    f"<code>{escape(key)}</code>",
                    quantity(entry["value"]),
                    quantity(entry.get("stderr")),
                    escape(entry.get("unit", "")),
                    how,
                ],
                False,
            )
        )
    return html_table(["parameter", "value", "±", "unit", ""], lines, numbers={1, 2})


def _candidates(document) -> str:
    """Each with the values to start from, why it is there and what it cannot do."""
    out = []
    for each in document.get("candidates") or ():
        cannot = "; ".join(each.get("cannot") or ())
        out.append(
            f"<h3>{escape(each['model'])}</h3><p>{typed(each.get('start') or {})}</p>"
            f"<p>{escape(each.get('why', ''))}</p>"
            + (f'<p class="soft">cannot: {escape(cannot)}</p>' if cannot else "")
        )
    return "".join(out)


def _doubts(document) -> str:
    rows = document.get("ranking") or []
    pick: dict = next((row for row in rows if name_of(row) == document.get("recommended")), {})
    doubts = (
        list(document.get("warnings") or []) + list(document.get("conflicts") or []) + list(pick.get("flags") or [])
    )
    doubts = (
        list(document.get("disagreements") or []) + doubts + list((document.get("scene") or {}).get("findings") or [])
    )
    doubts += [
        {"code": "guess", "text": each["says"], "consequence": each.get("because")}
        for each in document.get("advice") or ()
        if each.get("guess")
    ]
    doubts += [
        each for each in (document.get("data") or {}).get("findings", ()) if each.get("severity", "note") != "note"
    ]
    return html_findings(doubts) or "<p>None was found.</p>"


def _beyond(document) -> str:
    """What is expected where nothing was measured, and what the law lacks."""
    return "".join(f"<p>{escape(each)}</p>" for each in off_plane_sentences(document))


def _material(document) -> str:
    material = document.get("material") or {}
    lines = []
    for key, entry in material.items():
        if isinstance(entry, dict) and "value" in entry:
            source = entry.get("from", "")
            if entry.get("rule"):
                section = f", section {entry['section']}" if entry.get("section") else ""
                source += f" ({entry['rule']}{section})"
            lines.append(([escape(key), quantity(entry["value"]), escape(source)], False))
        elif not isinstance(entry, (dict, list)) and entry is not None:
            lines.append(([escape(key), quantity(entry), ""], False))
    domain = document.get("domain") or {}
    status = (
        f"<p>Inside the guide's domain: {escape(str(domain['status']))}. "
        + escape(" ".join(html_sentence(r) for r in domain.get("reasons", ())))
        + "</p>"
        if domain
        else ""
    )
    unused = "".join(
        f"<li>{escape(each['observation'])}: {escape(each['why'])}</li>" for each in document.get("unused") or ()
    )
    return (
        (html_table(["", "value", "from"], lines) if lines else "")
        + status
        + (f"<h3>Observed but of no use</h3><ul>{unused}</ul>" if unused else "")
    )


def _advice(document) -> str:
    items = [
        f"<li>{escape(each.get('says', ''))} ({escape(each.get('because', ''))}){_section(each)}</li>"
        for each in document.get("advice") or ()
    ]
    return f"<ul>{''.join(items)}</ul>" if items else ""


def _section(advice: dict) -> str:
    """Where the rule comes from, as links to a line on the page."""
    return f" [{section_links(advice['section'])}]" if advice.get("section") else ""


def _data(document) -> str:
    data = document.get("data") or {}
    if not data:
        return ""
    channels, angle = data.get("channels", []), "{0[0]:g}° to {0[1]:g}°".format
    shown = ", ".join(channels) if len(channels) <= 6 else f"{len(channels)}: {channels[0]} to {channels[-1]}"
    values = (
        f"{data.get('values', 0)}, of which {data.get('missing', 0)} missing or not positive: left out, never clipped"
    )
    entries = [
        ("file", data.get("file")),
        ("format", data.get("format")),
        ("directions", data.get("samples")),
        ("channels", shown),
        ("values", values),
        ("incidence", angle(data["theta_i_deg"]) if data.get("theta_i_deg") else None),
        ("reflection", angle(data["theta_r_deg"]) if data.get("theta_r_deg") else None),
        ("plane", "all in the plane of incidence" if data.get("in_plane") else "also outside the plane of incidence"),
    ]
    notes = [each for each in data.get("findings", ()) if each.get("severity", "note") == "note"]
    return html_definitions(entries) + html_findings(notes)


def _scene(document) -> str:
    scene = document.get("scene") or {}
    words = ""
    if scene:
        error = scene.get("error", {}).get("worst_visible")
        words = (
            f"<p>{escape(scene.get('assumptions', ''))}</p><p>Enough for it: "
            f"<strong>{escape(scene.get('pruned', ''))}</strong>"
        )
        words += (
            f", {html_number(error)} {escape(scene.get('unit', ''))} off at worst where it can be seen.</p>"
            if error is not None
            else ".</p>"
        )

    def worst(error):
        return error.get("worst_visible") if isinstance(error, dict) else error

    lines = [
        (
            [
                escape(str(each.get("term", ""))),
                html_number(worst(each.get("error"))),
                html_number(each.get("saving_ns")),
                escape(str(each.get("why", ""))),
            ],
            False,
        )
        for each in document.get("left_out") or ()
        if isinstance(each, dict)
    ]
    return words + (
        html_table(["left out", "costs in error", "saves [ns]", "why"], lines, numbers={1, 2}) if lines else ""
    )


def _repeat(command, files) -> str:
    versions = [
        f"brdfguide {__version__}",
        f"Python {platform.python_version()}",
        *(_version(name) for name in PACKAGES),
        f"{platform.system()} {platform.machine()}",
    ]
    entries = [
        ("command", f"<code>{escape(command)}</code>" if command else None),
        ("with", escape(", ".join(filter(None, versions)))),
    ]
    for file in map(Path, files):
        if is_plain(file):
            entries.append(
                (escape(printable.line(file.name)), f"<code>SHA-256 {sha256(file.read_bytes()).hexdigest()}</code>")
            )
    return (
        html_definitions(entries, escaped=True)
        + '<p class="soft">The whole result stands in this page as JSON, in the element with the id “result”.</p>'
    )


def _version(name: str) -> str:
    try:
        return f"{name} {version(name)}"
    except PackageNotFoundError:
        return ""

"""A result as one self-contained HTML page: the answer first, then figures, ranking, doubts, and how to repeat it.

Reads the documents of `--json` and nothing else, so that page, terminal and JSON cannot disagree.
"""

import json
import platform
from hashlib import sha256
from html import escape
from importlib.metadata import PackageNotFoundError, version
from math import exp
from pathlib import Path

from .. import __version__
from ..outputs import write_whole
from . import sheet
from .plain import plain

PACKAGES = ("numpy", "matplotlib", "pyyaml")


def write(document: dict, path, figures=(), command: str = "", files=()) -> None:
    """Write the page whole or not at all. `figures` are (SVG or PNG file, caption); `files` are hashed for the last section. Raises InputError where it cannot be written."""
    write_whole(path, html(document, figures, command, files))


def html(document: dict, figures=(), command: str = "", files=()) -> str:
    """The page as text; `figures` are (SVG or PNG file, caption)."""
    document = plain(document)
    sections = [
        ("figures", "Figures", _figures(figures)),
        ("ranking", "Ranking", _ranking(document)),
        ("parameters", "Parameters", _parameters(document)),
        ("candidates", "Models worth trying", _candidates(document)),
        ("doubts", "Doubts", _doubts(document)),
        ("material", "The material as understood", _material(document)),
        ("guidelines", "Guidelines that spoke", _advice(document)),
        ("data", "The data", _data(document)),
        ("scene", "Scene, and what it can do without", _scene(document)),
        ("repeat", "To repeat this", _repeat(command, files)),
    ]
    there = [(key, title, text) for key, title, text in sections if text]
    title = _title(document)
    head = f"<header><h1>{escape(title)}</h1>{_answer(document)}</header>"
    links = "<nav>" + " ".join(f'<a href="#{key}">{title}</a>' for key, title, _ in there) + "</nav>"
    body = "\n".join(f'<section id="{key}"><h2>{title}</h2>{text}</section>' for key, title, text in there)
    return sheet.document(escape(title), f"{head}{links}<main>{body}</main>", json.dumps(document, allow_nan=False))


def _title(document) -> str:
    data = document.get("data") or {}
    return f"Reflectance of {document.get('name') or Path(str(data.get('file') or 'a surface')).name}"


def _answer(document) -> str:
    """The first thing read: which model, how far off, how sure; or that there is none to be trusted."""
    rows = document.get("ranking") or []
    domain = document.get("domain") or {}
    outside = "".join(f"<p>{escape(_sentence(reason))}</p>" for reason in domain.get("reasons", ()))
    if domain.get("status") == "outside":
        return f'<div class="answer"><strong>No trustworthy answer</strong>{outside}</div>'
    if rows:
        pick = next((row for row in rows if _name(row) == document.get("recommended")), rows[0])
        off = exp(min(pick["rms_ln"], 50)) - 1
        text = f"<strong>{escape(_name(pick))}</strong><p>rms ln error {pick['rms_ln']:.3g}: typically {_percent(off)} off."
        if pick.get("held_out_rms_ln") is not None:
            text += f" At incidence angles left out of the fit {pick['held_out_rms_ln']:.3g}."
        text += f"</p><p>{escape(document.get('because', ''))}</p>"
        free = {key: entry["value"] for key, entry in pick["parameters"].items() if not entry.get("derived")}
        return f'<div class="answer">{text}<p>{_typed(free)}</p>{outside}</div>'
    first = (document.get("candidates") or [{}])[0]
    words = f"<strong>{escape(first.get('model', 'no model'))}</strong><p>{escape(first.get('why', ''))}</p>"
    return f'<div class="answer">{words}<p>{_typed(first.get("start") or {})}</p><p>From guidelines alone: no measurement was given.</p>{outside}</div>'


def _typed(values) -> str:
    """Parameters as they are typed."""
    return " ".join(f"<code>{escape(key)}={_values(value)}</code>" for key, value in values.items())


def _figures(figures) -> str:
    return "".join(
        f'<figure><div class="wide">{sheet.picture(content, number, escape(caption, quote=True))}</div>'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
        for number, (content, caption) in enumerate(figures, start=1)
    )


def _ranking(document) -> str:
    rows = document.get("ranking") or []
    if not rows:
        return ""
    worst = max(row["rms_ln"] for row in rows)
    timed = any(row.get("time_per_sample_ns") for row in rows)
    held = any(row.get("held_out_rms_ln") is not None for row in rows)
    header = ["rank", "model", "rms ln", "", "behind the best"] + ["held out"] * held + ["ns per sample"] * timed + ["flags"]
    lines = []
    for row in rows:
        cells = [f"{row['rank']}{'=' if row.get('tied') and row['rank'] == 1 else ''}", escape(_name(row)), f"{row['rms_ln']:.3g}",
                 f'<span class="bar" style="width:{7 * row["rms_ln"] / worst:.2f}rem"></span>',
                 "best" if row is rows[0] else f"{_number(row.get('behind'))} ± {_number(row.get('behind_se'), 1)}"]  # fmt: skip
        cells += [_number(row.get("held_out_rms_ln"))] * held
        cells += [_number(row.get("time_per_sample_ns")) + (" ◆" if row.get("on_front") else "")] * timed
        cells += [escape(", ".join(dict.fromkeys(flag["code"].partition(":")[0] for flag in row.get("flags", ()))))]
        lines.append((cells, _name(row) == document.get("recommended")))
    note = '<p class="soft">◆ no other model is better in both error and time. = cannot be told from the best by these data.</p>' if timed else ""
    return _table(header, lines, numbers={0, 2, *range(4, len(header) - 1)}) + note + _by_angle(rows, document) + _by_scale(rows, document)


def _by_angle(rows, document) -> str:
    """Error at each incidence angle: the guide's main difference between models is their growth toward grazing."""
    angles = sorted({key for row in rows for key in row.get("rms_ln_by_theta_i") or {}}, key=float)
    if len(angles) < 2:
        return ""
    risen = next((row["growth"] for row in rows if row.get("growth")), None)
    rise = lambda growth, of="": [_number(growth[f"r_{name}{of}"] if growth else None) for name in ("mirror", "max")] if risen else []  # noqa: E731
    lines = [([escape(_name(row)), *(_number((row.get("rms_ln_by_theta_i") or {}).get(angle)) for angle in angles), *rise(row.get("growth"))],
              _name(row) == document.get("recommended")) for row in rows]  # fmt: skip
    if risen:
        lines.insert(0, (["<i>the data</i>", *[""] * len(angles), *rise(risen, "_data")], False))
    header = ["model", *(f"{float(a):g}°" for a in angles), *(("R-mirror", "R-max") if risen else ())]
    note = f'<p class="soft">R: how many times the value in the mirror direction, and the greatest, grow from {risen["theta_i_deg"][0]:g}° to {risen["theta_i_deg"][1]:g}°.</p>' if risen else ""
    return "<h3>rms ln at each angle of incidence, and growth toward grazing</h3>" + _table(header, lines, numbers=set(range(1, 99))) + note


def _by_scale(rows, document) -> str:
    """The error and the place on every scale, and what each scale counts."""
    scales = document.get("scales") or {}
    if not scales:
        return ""
    cells = {name: {each["candidate"]: (_number(each["error"]), str(place)) for place, each in enumerate(scale["order"], start=1)} for name, scale in scales.items()}
    lines = [([escape(_name(row)), *(cell for name in scales for cell in cells[name][_name(row)])], _name(row) == document.get("recommended")) for row in rows]
    counts = "; ".join(f"<b>{escape(name)}</b> {escape(scale['counts'])}" for name, scale in scales.items())
    return "<h3>error on each scale</h3>" + _table(["model", *(word for name in scales for word in (name, "place"))], lines, numbers=set(range(1, 9))) + f'<p class="soft">{counts}.</p>'


def _parameters(document) -> str:
    rows = document.get("ranking") or []
    pick = next((row for row in rows if _name(row) == document.get("recommended")), None)
    if not pick:
        return ""
    lines = []
    for key, entry in pick["parameters"].items():
        how = "follows" if entry.get("derived") else "fitted" if entry.get("fitted") else "held"
        how += f", at its {entry['at_bound']} bound" if entry.get("at_bound") else ""
        lines.append(([f"<code>{escape(key)}</code>", _values(entry["value"]), _values(entry.get("stderr")), escape(entry.get("unit", "")), how], False))
    return _table(["parameter", "value", "±", "unit", ""], lines, numbers={1, 2})


def _candidates(document) -> str:
    """Each with the values to start from, why it is there and what it cannot do."""
    out = []
    for each in document.get("candidates") or ():
        cannot = "; ".join(each.get("cannot") or ())
        out.append(f"<h3>{escape(each['model'])}</h3><p>{_typed(each.get('start') or {})}</p><p>{escape(each.get('why', ''))}</p>"
                   + (f'<p class="soft">cannot: {escape(cannot)}</p>' if cannot else ""))  # fmt: skip
    return "".join(out)


def _doubts(document) -> str:
    rows = document.get("ranking") or []
    pick = next((row for row in rows if _name(row) == document.get("recommended")), {})
    doubts = list(document.get("warnings") or []) + list(document.get("conflicts") or []) + list(pick.get("flags") or [])
    doubts = list(document.get("disagreements") or []) + doubts + list((document.get("scene") or {}).get("findings") or [])
    doubts += [{"code": "guess", "text": each["says"], "consequence": each.get("because")} for each in document.get("advice") or () if each.get("guess")]
    doubts += [each for each in (document.get("data") or {}).get("findings", ()) if each.get("severity") in ("warning", "error")]
    return _findings(doubts) or "<p>None was found.</p>"


def _material(document) -> str:
    material = document.get("material") or {}
    lines = []
    for key, entry in material.items():
        if isinstance(entry, dict) and "value" in entry:
            source = entry.get("from", "")
            source += f" ({entry['rule']}, section {entry['section']})" if entry.get("rule") and entry.get("section") else f" ({entry['rule']})" if entry.get("rule") else ""
            lines.append(([escape(key), _values(entry["value"]), escape(source)], False))
        elif not isinstance(entry, (dict, list)) and entry is not None:
            lines.append(([escape(key), _values(entry), ""], False))
    domain = document.get("domain") or {}
    status = f"<p>Inside the guide's domain: {escape(str(domain['status']))}. " + escape(" ".join(_sentence(r) for r in domain.get("reasons", ()))) + "</p>" if domain else ""
    unused = "".join(f"<li>{escape(each['observation'])}: {escape(each['why'])}</li>" for each in document.get("unused") or ())
    return (_table(["", "value", "from"], lines) if lines else "") + status + (f"<h3>Observed but of no use</h3><ul>{unused}</ul>" if unused else "")


def _advice(document) -> str:
    items = [f"<li>{escape(each.get('says', ''))} ({escape(each.get('because', ''))})</li>" for each in document.get("advice") or ()]
    return f"<ul>{''.join(items)}</ul>" if items else ""


def _data(document) -> str:
    data = document.get("data") or {}
    if not data:
        return ""
    channels, angle = data.get("channels", []), "{0[0]:g}° to {0[1]:g}°".format
    shown = ", ".join(channels) if len(channels) <= 6 else f"{len(channels)}: {channels[0]} to {channels[-1]}"
    values = f"{data.get('values', 0)}, of which {data.get('missing', 0)} missing or not positive: left out, never clipped"
    entries = [("file", data.get("file")), ("format", data.get("format")), ("directions", data.get("samples")), ("channels", shown), ("values", values),
               ("incidence", angle(data["theta_i_deg"]) if data.get("theta_i_deg") else None),
               ("reflection", angle(data["theta_r_deg"]) if data.get("theta_r_deg") else None),
               ("plane", "all in the plane of incidence" if data.get("in_plane") else "also outside the plane of incidence")]  # fmt: skip
    notes = [each for each in data.get("findings", ()) if each.get("severity") not in ("warning", "error")]
    return _pairs(entries) + _findings(notes)


def _scene(document) -> str:
    scene = document.get("scene") or {}
    words = ""
    if scene:
        error = scene.get("error", {}).get("worst_visible")
        words = f"<p>{escape(scene.get('assumptions', ''))}</p><p>Enough for it: <strong>{escape(scene.get('pruned', ''))}</strong>"
        words += f", {_number(error)} {escape(scene.get('unit', ''))} off at worst where it can be seen.</p>" if error is not None else ".</p>"
    worst = lambda error: error.get("worst_visible") if isinstance(error, dict) else error  # noqa: E731
    lines = [([escape(str(each.get("term", ""))), _number(worst(each.get("error"))), _number(each.get("saving_ns")), escape(str(each.get("why", "")))], False)
             for each in document.get("left_out") or () if isinstance(each, dict)]  # fmt: skip
    return words + (_table(["left out", "costs in error", "saves [ns]", "why"], lines, numbers={1, 2}) if lines else "")


def _repeat(command, files) -> str:
    versions = [f"brdfguide {__version__}", f"Python {platform.python_version()}", *(_version(name) for name in PACKAGES), f"{platform.system()} {platform.machine()}"]
    entries = [("command", f"<code>{escape(command)}</code>" if command else None), ("with", escape(", ".join(filter(None, versions))))]
    for file in map(Path, files):
        if file.is_file():
            entries.append((escape(file.name), f"<code>SHA-256 {sha256(file.read_bytes()).hexdigest()}</code>"))
    return _pairs(entries, escaped=True) + '<p class="soft">The whole result stands in this page as JSON, in the element with the id “result”.</p>'


def _version(name: str) -> str:
    try:
        return f"{name} {version(name)}"
    except PackageNotFoundError:
        return ""


def _findings(found) -> str:
    items = [
        f'<li class="{escape(each.get("severity", "note"))}">{escape(each["text"])}'
        + (f": {escape(each['consequence'])}" if each.get("consequence") else "")
        + (f" (<code>{escape(each['option'])}</code> overrides it)" if each.get("option") else "")
        + f' <code class="soft">{escape(each["code"])}</code></li>'
        for each in found
    ]
    return f"<ul>{''.join(items)}</ul>" if items else ""


def _table(header, lines, numbers=frozenset()) -> str:
    cell = lambda tag, place, text: f"<{tag}{aligned if place in numbers else ''}>{text}</{tag}>"  # noqa: E731
    aligned, picked = ' class="n"', ' class="pick"'
    head = "".join(cell("th", place, escape(text)) for place, text in enumerate(header))
    line = lambda cells: "".join(cell("td", place, text) for place, text in enumerate(cells))  # noqa: E731
    body = "".join(f"<tr{picked if pick else ''}>{line(cells)}</tr>" for cells, pick in lines)
    return f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>'


def _pairs(entries, escaped=False) -> str:
    shown = [(key, value if escaped else escape(str(value))) for key, value in entries if value is not None and value != ""]
    return f"<dl>{''.join(f'<dt>{key}</dt><dd>{value}</dd>' for key, value in shown)}</dl>"


def _name(row) -> str:
    return row.get("candidate") or row["model"]


def _sentence(reason) -> str:
    return reason.get("text") or reason.get("says") or "" if isinstance(reason, dict) else str(reason)


def _number(value, digits: int = 3) -> str:
    return "" if value is None else f"{value:.{digits}g}" if abs(value) < 1000 else f"{value:.0f}"


def _values(value) -> str:
    """A number; for many channels their range."""
    if isinstance(value, list):
        numbers = [each for each in value if isinstance(each, (int, float))]
        if len(numbers) > 3:
            return f"{min(numbers):.3g} to {max(numbers):.3g} ({len(value)} channels)"
        return escape(", ".join(_values(each) for each in value))
    return "" if value is None else f"{value:.4g}" if isinstance(value, float) else escape(str(value))


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %" if share < 1 else f"a factor of {1 + share:.2g}"

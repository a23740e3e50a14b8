"""What was found about a data file, in words."""

from .ranking import heading
from .table import columns, row_lines

MOST_LINES = 28  # of the table of incidences
MOST_CHANNELS = 12  # that are all named
SIGNS = {"outside": "outside", "error": "error", "warning": "doubt", "note": "-"}


def text(result: dict) -> str:
    """The document for people: the file, its coverage, what was found."""
    data = result["data"]
    what = f"{heading(data)}\nformat: {data['format']}{_channels(data)}"
    parts = [f"{_verdict(result)}\n\n{what}", _coverage(result["coverage"]["by_theta_i"])]
    parts += [_list("as read", data["findings"]), _list("examined", result["findings"])]
    parts.append(_list("a fit would change or leave out", result["corrections"]))
    parts.append("`brdfguide --explain CODE`: what a code in the second column means")
    return "\n\n".join(part for part in parts if part)


def _verdict(result: dict) -> str:
    """What a fit would make of the file, in one sentence."""
    found = [*result["data"]["findings"], *result["findings"]]
    doubts = sum(each.get("severity", "note") != "note" for each in found)
    changed = len(result["corrections"])
    if result["status"] == "outside":
        verdict = "no model should be trusted on these data: a fit ends with status 1, unless --anyway"
    elif result["status"] == "error":
        verdict = "these data contradict themselves: a fit refuses them, unless --anyway"
    elif doubts:
        verdict = f"usable, with {doubts} doubt{'s' * (doubts > 1)}"
    else:
        verdict = "usable, without a doubt"
    change = (
        f"a fit would change or leave out {changed} thing{'s' * (changed > 1)}"
        if changed
        else "a fit would change nothing"
    )
    return f"{verdict}; {change}"


def _channels(data: dict) -> str:
    """The channels with their wavelengths, where there are several: a line of its own."""
    names, nm = data["channels"], data["wavelength_nm"]
    if len(names) < 2 or len(nm) != len(names):
        return ""
    if any(name != f"{each:g}nm" for name, each in zip(names, nm, strict=True)):
        listed = [f"{name} ({each:g} nm)" for name, each in zip(names, nm, strict=True)]
    else:
        listed = [f"{each:g}" for each in nm]
    if len(listed) > MOST_CHANNELS:
        listed = [*listed[:3], "...", listed[-1]]
    unit = "" if "(" in listed[0] else " nm"
    return f"\nchannels: {', '.join(listed)}{unit}"


def _coverage(rows: list[dict]) -> str:
    step = max(1, -(-len(rows) // MOST_LINES))
    header = ("theta_i", "directions", "theta_r", "missing", "brightest 1/sr", "at theta_r, phi")
    lines = [
        (
            f"{row['theta_i_deg']:g}",
            row["directions"],
            f"{row['theta_r_from_deg']:.1f}..{row['theta_r_to_deg']:.1f}",
            row["missing"],
            "-" if row["peak_per_sr"] is None else f"{row['peak_per_sr']:.3g}",
            f"{row['peak_theta_r_deg']:.1f}, {row['peak_phi_deg']:.0f}",
        )
        for row in rows[::step]
    ]
    return columns(header, lines, right=tuple(range(6)))


def _list(title: str, findings: list[dict]) -> str:
    """One line for each finding: how grave, its code, the sentence, what follows, what overrides it."""
    if not findings:
        return ""
    rows = []
    for each in findings:
        rest = f"; {each['consequence']}" if each.get("consequence") else ""
        option = f" [{each['option']}]" if each.get("option") else ""
        rows.append((f"  {SIGNS[each.get('severity', 'note')]}", each["code"], f"{each['text']}{rest}{option}"))
    lines = row_lines(("", "", ""), rows)[1:]
    return "\n".join([f"{title}:", *("\n".join(row) for row in lines)])

"""What was found about a data file, in words."""

from .folding import folded
from .ranking import heading
from .table import columns

MOST_LINES = 28  # of the table of incidences
MOST_CHANNELS = 12  # that are all named
SIGNS = {"outside": "outside the guide: ", "error": "error: ", "warning": "", "note": ""}
KEY = "[code]: `brdfguide --explain CODE` says what it means; --name: the option that says otherwise"
IN_THE_TABLE = "coverage"  # what the heading and the table of incidences say already


def text(result: dict) -> str:
    """The document for people: the file, its coverage, what was found."""
    data = result["data"]
    what = f"{folded(heading(data), further='  ')}\nformat: {data['format']}{_channels(data)}"
    parts = [f"{_verdict(result)}\n\n{what}", _coverage(result["coverage"]["by_theta_i"])]
    read, examined = data["findings"], [each for each in result["findings"] if each["code"] != IN_THE_TABLE]
    parts.append(_list("doubts", [each for each in (*read, *examined) if not _is_note(each)]))
    parts += [_list("as read", list(filter(_is_note, read))), _list("examined", list(filter(_is_note, examined)))]
    parts.append(_list("`fit` changes or leaves out", result["corrections"]))
    parts.append(folded(KEY, further="  "))
    return "\n\n".join(part for part in parts if part)


def _verdict(result: dict) -> str:
    """What a fit would make of the file, in one sentence."""
    found = [*result["data"]["findings"], *result["findings"]]
    doubts = sum(not _is_note(each) for each in found)
    changed = len(result["corrections"])
    if result["status"] == "outside":
        verdict = "no model should be trusted on these data: `fit` ends with status 1, unless --anyway"
    elif result["status"] == "error":
        verdict = "these data contradict themselves: `fit` refuses them, unless --anyway"
    elif doubts:
        verdict = f"usable, with {doubts} doubt{'s' * (doubts > 1)}"
    else:
        verdict = "usable, without a doubt"
    change = (
        f"changes or leaves out {changed} thing{'s' * (changed > 1)}" if changed else "takes the values as they are"
    )
    return folded(f"{verdict}; `fit` {change}", further="  ")


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
            "-" if row["peak_per_sr"] is None else _three_digits(row["peak_per_sr"]),
            f"{row['peak_theta_r_deg']:.1f}, {row['peak_phi_deg']:.0f}",
        )
        for row in rows[::step]
    ]
    return columns(header, lines, right=tuple(range(6)))


def _list(title: str, findings: list[dict]) -> str:
    """A paragraph for each finding: the sentence, what follows, what overrides it, its code."""
    paragraphs = []
    for each in findings:
        rest = f"; {each['consequence']}" if each.get("consequence") else ""
        option = f"; {each['option']}" if each.get("option") else ""
        sign = SIGNS[each.get("severity", "note")]
        paragraphs.append(folded(f"{sign}{each['text']}{rest}{option} [{each['code']}]", "  - ", "    "))
    return "\n".join([f"{title}:", *paragraphs]) if paragraphs else ""


def _three_digits(value: float) -> str:
    """Without an exponent up to a million."""
    return f"{float(f'{value:.3g}'):g}"


def _is_note(finding: dict) -> bool:
    return finding.get("severity", "note") == "note"

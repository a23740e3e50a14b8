"""The ranking on a page: errors, times and flags, by angle of incidence and by scale."""

from html import escape

from ..printable import off_words_of
from .documents.findings import codes
from .elements import html_number, html_table, name_of
from .page_floor import floor_bar


def ranking(document) -> str:
    rows = document.get("ranking") or []
    if not rows:
        return ""
    worst = max(row["rms_ln"] for row in rows)
    timed = any(row.get("time_per_sample_ns") for row in rows)
    held = any(row.get("held_out_rms_ln") is not None for row in rows)
    header = (
        ["rank", "model", "off", "", "seen L*", "side by side", "behind the best"]
        + ["held out"] * held
        + ["ns per sample"] * timed
        + ["flags"]
    )
    lines = []
    for row in rows:
        cells = [
            f"{row['rank']}{'=' if row.get('tied') and row['rank'] == 1 else ''}",
            escape(name_of(row)),
            f'<span title="rms ln {row["rms_ln"]:.3g}">{off_words_of(row["rms_ln"])}</span>',
            f'<span class="bar" style="width:{1.2 * row["rms_ln"] / worst:.2f}rem"></span>',
            html_number(row.get("seen"), 2) + ("~" if row.get("close") else ""),
            escape(_band(row)),
            _behind(row),
        ]
        held_out = row.get("held_out_rms_ln")
        cells += ["" if held_out is None else off_words_of(held_out)] * held
        cells += [html_number(row.get("time_per_sample_ns")) + (" ◆" if row.get("on_front") else "")] * timed
        cells += [escape(", ".join(codes(row.get("flags", ()))).replace(" %", "\u00a0%"))]
        lines.append((cells, name_of(row) == document.get("recommended")))
    front = "◆ no other model is better in both error and operations. " if timed else ""
    note = (
        f'<p class="soft">off: typically, from the data; behind the best: in rms ln; held out: off at incidence angles '
        f"that were not fitted. {front}= cannot be told from the best by these data. ~ comes close enough to it. seen: "
        f"rms difference in lightness of two spheres, averaged over lamps all around (weights: "
        f"{escape(str(document.get('seen_weights')))}); below 3.5 they look alike side by side.</p>"
    )
    return (
        html_table(header, lines, numbers={0, 2, 4, *range(6, len(header) - 1)})
        + note
        + floor_bar(document)
        + _baselines(document)
        + _by_angle(rows, document)
        + _by_scale(rows, document)
    )


def _band(row) -> str:
    """How a model looks beside the data, in words."""
    return (row.get("seen_words") or "").partition(" (")[0].removesuffix(" side by side")


def _behind(row) -> str:
    behind = row.get("behind")
    return f"{html_number(behind)} ± {html_number(row.get('behind_se'), 1)}" if behind else "best"


def _by_angle(rows, document) -> str:
    """Error at each incidence angle: the guide's main difference between models is their growth toward grazing."""
    angles = sorted({key for row in rows for key in row.get("rms_ln_by_theta_i") or {}}, key=float)
    if len(angles) < 2:
        return ""
    risen = next((row["growth"] for row in rows if row.get("growth")), None)

    def rise(growth, of=""):
        if not risen:
            return []
        return [html_number(growth[f"r_{name}{of}"] if growth else None) for name in ("mirror", "max")]

    lines = [
        (
            [
                escape(name_of(row)),
                *(html_number((row.get("rms_ln_by_theta_i") or {}).get(angle)) for angle in angles),
                *rise(row.get("growth")),
            ],
            name_of(row) == document.get("recommended"),
        )
        for row in rows
    ]
    if risen:
        lines.insert(0, (["<i>the data</i>", *[""] * len(angles), *rise(risen, "_data")], False))
    header = ["model", *(f"{float(a):g}°" for a in angles), *(("R-mirror", "R-max") if risen else ())]
    note = (
        (
            f'<p class="soft">R: how many times the value in the mirror direction, and the greatest, grow from '
            f"{risen['theta_i_deg'][0]:g}° to {risen['theta_i_deg'][1]:g}°.</p>"
        )
        if risen
        else ""
    )
    return (
        "<h3>rms ln at each angle of incidence, and growth toward grazing</h3>"
        + html_table(header, lines, numbers=set(range(1, 99)))
        + note
    )


def _by_scale(rows, document) -> str:
    """The error and the place on every scale, and what each scale counts."""
    scales = document.get("scales") or {}
    if not scales:
        return ""
    cells = {
        name: {
            each["candidate"]: (html_number(each["error"]), str(place))
            for place, each in enumerate(scale["order"], start=1)
        }
        for name, scale in scales.items()
    }
    lines = [
        (
            [escape(name_of(row)), *(cell for name in scales for cell in cells[name][name_of(row)])],
            name_of(row) == document.get("recommended"),
        )
        for row in rows
    ]
    counts = "; ".join(f"<b>{escape(name)}</b> {escape(scale['counts'])}" for name, scale in scales.items())
    return (
        "<h3>error on each scale</h3>"
        + html_table(
            ["model", *(word for name in scales for word in (name, "place"))], lines, numbers=set(range(1, 99))
        )
        + f'<p class="soft">{counts}.</p>'
    )


def _baselines(document) -> str:
    """What general representations take for the same data; ranked with nothing."""
    rows = document.get("baselines") or []
    if not rows:
        return ""
    lines = [
        (
            [
                escape(row["name"]),
                str(row["coefficients"]),
                html_number(row["rms_ln"]),
                html_number(row["left_out_rms_ln"]),
                html_number(row.get("ns_per_sample")),
                escape(row["note"]),
            ],
            False,
        )
        for row in rows
    ]
    header = ["representation", "numbers", "rms ln", "left out", "ns per sample", ""]
    return "<h3>what general representations take, ranked with nothing</h3>" + html_table(
        header, lines, numbers={1, 2, 3, 4}
    )

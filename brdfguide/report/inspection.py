"""What was found about a data file, as a document and as text."""

import numpy as np

from ..measurement import Measurement
from .data import data_block, finding
from .plain import plain
from .ranking import heading
from .table import columns

SHOWN_INCIDENCES = 14
RECIPROCITY = ("reciprocal", "not-reciprocal", "dim-values-off", "cosine-weighted", "cosine-i-weighted")
SIGNS = {"outside": "outside", "error": "error", "warning": "doubt", "note": "-"}


def document(measurement: Measurement, found, corrections) -> dict:
    """`brdfguide inspect --json`: the file as it was read, what was found, and what a fit would change."""
    by_code = {each.code: dict(each.numbers) for each in found}
    energy = by_code.get("reflectance") or by_code.get("reflectance-factor") or by_code.get("too-bright")
    return plain({
        "schema": "brdfguide/inspect/1",
        "data": data_block(measurement),
        "coverage": {**by_code.get("coverage", {}), "by_theta_i": incidences(measurement)},
        "reciprocity": next((by_code[code] for code in RECIPROCITY if code in by_code), None),
        "energy": energy,
        "noise_relative": by_code.get("noise", {}).get("relative"),
        "findings": [finding(each) for each in found],
        "corrections": [finding(each) for each in corrections],
        "status": status((*measurement.findings, *found)),
    })  # fmt: skip


def status(found) -> str:
    """inside, flagged, outside or contradictory."""
    worst = {each.severity for each in found}
    return "contradictory" if "error" in worst else "outside" if "outside" in worst else "flagged" if "warning" in worst else "inside"


def incidences(measurement: Measurement) -> list[dict]:
    """For each incidence: how much was measured, and where it is brightest; bands where there are very many."""
    geom = measurement.geom
    theta_i = geom.theta_i_deg[:, 0]
    groups = measurement.theta_i_groups
    if len(groups) > 3 * SHOWN_INCIDENCES:
        width = 90 / (SHOWN_INCIDENCES + 1)
        band = np.floor(theta_i / width).astype(int)
        groups = {float((k + 0.5) * width): np.flatnonzero(band == k) for k in np.unique(band)}
    level = np.where(measurement.usable, measurement.brdf, 0.0).max(axis=1)
    signed, phi = geom.signed_theta_r_deg[:, 0], np.remainder(geom.phi_deg[:, 0], 360.0)
    rows = []
    for angle, members in groups.items():
        peak = members[np.argmax(level[members])]
        rows.append({
            "theta_i_deg": round(angle, 1), "directions": len(members), "theta_r_from_deg": float(signed[members].min()), "theta_r_to_deg": float(signed[members].max()),
            "missing": int(np.count_nonzero(~measurement.usable[members])), "peak_per_sr": float(level[peak]) if level[peak] > 0 else None,
            "peak_theta_r_deg": float(signed[peak]), "peak_phi_deg": float(phi[peak]),
        })  # fmt: skip
    return rows


def text(result: dict) -> str:
    """The document for people: the file, its coverage, what was found."""
    data = result["data"]
    parts = [f"{heading(data)}\nformat: {data['format']}", _coverage(result["coverage"]["by_theta_i"])]
    parts += [_list("as read", data["findings"]), _list("examined", result["findings"])]
    parts.append(_list("a fit would change or leave out", result["corrections"]) or "a fit would change nothing")
    parts.append(f"status: {result['status']}")
    return "\n\n".join(part for part in parts if part)


def _coverage(rows: list[dict]) -> str:
    step = max(1, -(-len(rows) // (2 * SHOWN_INCIDENCES)))
    header = ("theta_i", "directions", "theta_r from", "to", "missing", "brightest 1/sr", "at theta_r", "phi")
    lines = [
        (f"{row['theta_i_deg']:g}", row["directions"], f"{row['theta_r_from_deg']:.1f}", f"{row['theta_r_to_deg']:.1f}", row["missing"],
         "-" if row["peak_per_sr"] is None else f"{row['peak_per_sr']:.3g}", f"{row['peak_theta_r_deg']:.1f}", f"{row['peak_phi_deg']:.0f}")
        for row in rows[::step]
    ]  # fmt: skip
    return columns(header, lines, right=tuple(range(8)))


def _list(title: str, findings: list[dict]) -> str:
    """One line for each finding: how grave, its code, the sentence, what follows, what overrides it."""
    if not findings:
        return ""
    grave = max(len(SIGNS[each.get("severity", "note")]) for each in findings)
    code = max(len(each["code"]) for each in findings)
    lines = []
    for each in findings:
        rest = f"; {each['consequence']}" if each.get("consequence") else ""
        option = f" [{each['option']}]" if each.get("option") else ""
        lines.append(f"  {SIGNS[each.get('severity', 'note')].ljust(grave)}  {each['code'].ljust(code)}  {each['text']}{rest}{option}")
    return "\n".join([f"{title}:", *lines])

"""What a code in an answer means, in words."""

from .folding import folded


def explained_text(entry: dict) -> str:
    """First what it means, then how grave it is and what overrides it, or where the guide says so."""
    if entry["is"] == "rule":
        return "\n".join(
            [
                folded(f"{entry['code']}: {' '.join(entry['meaning'].split())}", "", "  "),
                folded(
                    f"a rule that fills in a description, from section {entry['section']} of the guide", "  ", "    "
                ),
                folded("it never overrides what was observed; `recommend --explain` tells when it spoke", "  ", "    "),
            ]
        )
    lines = [folded(f"{entry['code']}: {entry['meaning']}", "", "  ")]
    lines += [folded(f"{name}: {meaning}", "  ", "    ") for name, meaning in entry["severities"].items()]
    if entry["subject"]:
        lines.append(
            folded(f"printed with its {entry['subject']}, as {entry['code']}:{entry['subject'].upper()}", "  ")
        )
    if entry["does"]:
        lines.append(folded(f"what it does besides: {entry['does']}", "  ", "    "))
    if entry["overridden_by"]:
        lines.append(folded(f"overridden by {entry['overridden_by']}", "  ", "    "))
    lines.append(folded(f"found where: {entry['where'].replace('`', '')}", "  ", "    "))
    return "\n".join(lines)

"""The stability audit in words."""

from .table import columns


def text(result: dict) -> str:
    """A table of laws, then what is declared and what fails, where, then the sentences about a fitted surface."""
    lines, remarks = [], []
    for entry in result["models"]:
        for check in entry["checks"]:
            lines.append(
                (
                    entry["model"],
                    check["law"],
                    check["cases"],
                    _error(check["worst_error"]),
                    _error(check["allowed"]),
                    check["verdict"],
                )
            )
            if check["verdict"] != "holds":
                reason = f": {check['reason']}" if check.get("reason") else ""
                remarks.append(
                    f"{check['verdict']}  {entry['model']} {check['law']}{reason}\n          worst "
                    f"{_error(check['worst_error'])} at {_place(check['at'])}"
                )
    table = columns(("model", "law", "cases", "worst error", "allowed", "verdict"), lines, right=(2, 3, 4))
    sentences = [
        f"{found['severity']}: {found['text']}" + (f"; {found['consequence']}" if found["consequence"] else "")
        for found in result.get("findings", ())
    ]
    return "\n\n".join(part for part in (table, "\n".join(remarks), "\n".join(sentences), _tally(lines)) if part)


def _tally(lines) -> str:
    def count(verdict):
        return sum(line[-1] == verdict for line in lines)

    return (
        f"{len(lines)} laws tried: {count('holds')} hold, {count('declared')} broken as declared, {count('fails')} fail"
    )


def _error(value: float) -> str:
    return "0" if value == 0 else f"{value:.1e}"


def _place(at: dict) -> str:
    return (
        "  ".join(f"{name} {value:g}" if isinstance(value, float) else f"{name} {value}" for name, value in at.items())
        or "no single place"
    )

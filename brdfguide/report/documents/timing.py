"""What each law costs, as a document."""

from ...audit.bench import SEED, TimingRow
from ...numerics import pareto


def document(
    machine: dict,
    found: list[TimingRow],
    operations: dict[str, dict],
    errors: dict[str, float] | None = None,
    data: str | None = None,
) -> dict:
    """The JSON of `brdfguide bench`; `errors` are rms ln by name where data were fitted."""
    largest = max(row.n for row in found)
    on_front = _on_front([row for row in found if row.n == largest], errors) if errors else set()
    entries = []
    for row in found:
        entry = {
            "model": row.name,
            "n": row.n,
            "time_per_sample_ns": {"min": round(row.least, 2), "median": round(row.median, 2)},
        }
        entry["operations"] = {kind: round(count, 1) for kind, count in operations[row.name].items()}
        entries.append(entry | ({"rms_ln": errors[row.name], "on_front": row.name in on_front} if errors else {}))
    return {
        "schema": "brdfguide/bench/1",
        "machine": machine,
        "directions_seed": SEED,
        **({"data": data} if data else {}),
        "rows": entries,
    }


def _on_front(timed: list[TimingRow], errors: dict[str, float]) -> set[str]:
    unbeaten = pareto.on_front([(row.least, errors[row.name]) for row in timed])
    return {row.name for row, best in zip(timed, unbeaten, strict=True) if best}

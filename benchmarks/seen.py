"""What the eye changes: rankings of measured files by ln and by S, and what ties alone and look recommend.

    python benchmarks/seen.py FILE...      writes the table of docs/seen.md to standard output

Files that the guide does not hold for are named on stderr. Times are of this machine.
"""

import sys
from dataclasses import replace

import numpy as np

from brdfguide.errors import BrdfguideError
from brdfguide.fitting import choosing
from brdfguide.fitting.compare import compare
from brdfguide.fitting.job import Job, case
from brdfguide.fitting.ranked import Ranking, Row

HEADER = ("file", "weights", "alike of", "least error", "S", "least S", "S", "ties alone", "look", "S", "times cheaper")


def ranked(file: str) -> tuple[Ranking, Ranking]:
    """With look, and with ties alone."""
    found = case(file, Job())
    look = compare(found.measurement, found.candidates, Job().options, grows=found.grows, kind=found.kind)
    return look, choosing.recommending(replace(look, close="none"), found.measurement)


def line(file: str, look: Ranking, ties: Ranking) -> list[str]:
    """A row of the table."""
    good = choosing.trusted(look.rows)
    nearest = min(good, key=lambda row: row.seen)
    pick, other = look.recommended, ties.recommended
    return [
        file.rpartition("/")[2],
        look.seen_weights,
        f"{sum(row.close for row in look.rows)} of {len(look.rows)}",
        *named(good[0]),
        *(named(nearest) if nearest.seen < 0.99 * good[0].seen else ("the same", "")),
        other.fit.name,
        *(named(pick) if pick.fit is not other.fit else ("the same", f"{pick.seen:.1f}")),
        f"{other.work / pick.work:.1f}" if pick.fit is not other.fit else "",
    ]


def named(row: Row) -> tuple[str, str]:
    return row.fit.name, f"{row.seen:.1f}"


def main(files: list[str]) -> None:
    print(f"| {' | '.join(HEADER)} |\n|{'---|' * len(HEADER)}")
    ratios, saved = [], []
    for file in files:
        try:
            look, ties = ranked(file)
        except BrdfguideError as error:
            print(error, file=sys.stderr)
            continue
        print(f"| {' | '.join(line(file, look, ties))} |", flush=True)
        good = choosing.trusted(look.rows)
        ratios.append(good[0].seen / min(row.seen for row in good))
        if look.recommended.fit is not ties.recommended.fit:
            saved.append(ties.recommended.work / look.recommended.work)
    farther = sum(ratio > 1.01 for ratio in ratios)
    times = np.exp(np.mean(np.log(saved)))
    print(f"\nof {len(ratios)} files the least error is not the least S in {farther}: by up to {max(ratios):.2f} times")
    print(f"the recommendation changes in {len(saved)}, to {times:.1f} times fewer operations in the geometric mean")


if __name__ == "__main__":
    main(sys.argv[1:])

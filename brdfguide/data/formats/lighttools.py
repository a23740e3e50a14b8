"""Text of a Reflet bench as exported for LightTools: for each position of the lamp a grid of theta by phi.

Every block repeats its header of `key : value` lines: among them the data type, theta from, to, step, phi from, to,
step, and `Calibration Value : TM : 30 PM : -90 TL : 30`, the detector and lamp angles at which the mirror was seen: PM
is therefore the azimuth of the mirror direction. `Theta Lighting` is the incidence; below it a row for each theta, a
column for each phi.
"""

import re

import numpy as np

from ...finding import Finding
from ..measurement import Measurement
from .format import Format, Options, Source, check_zenith, measurement

NUMBER = r"[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
MOST_CELLS = 1_000_000


def recognises(head: bytes) -> bool:
    return b"Theta Lighting" in head and b"Phi measure" in head


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where a block does not hold the rows and columns that its header promises."""
    if any("BTDF" in text.partition("Data file type")[2] for text in source.lines):
        raise source.error("transmission (BTDF); this program fits reflection")
    rows, notes = [], []
    header: dict[str, float] = {}
    lines = iter(enumerate(source.lines, 1))
    blocks = 0
    for number, text in lines:
        if text.startswith("Name / Comment"):
            header = {}
        if match := re.match(r"\s*'?(Theta|Phi) measure (beginning|end|step)[\s:]*([^\s:]\S*)", text):
            header[f"{match[1]} {match[2]}"] = source.numbers([match[3]], number)[0]
        if match := re.search(rf"\bPM\s*:\s*({NUMBER})", text):
            header["mirror phi"] = float(match[1])
        if match := re.match(r"\s*Theta Lighting\s+(\S+)", text):
            rows += _block(source, header, source.numbers([match[1]], number)[0], lines, number)
            blocks += 1
    if not rows:
        raise source.error("no block under 'Theta Lighting'")
    table = np.array(rows)
    for name, column in (("theta_i", 0), ("theta_r", 1)):
        check_zenith(source, name, table[:, column])
    notes.append(
        Finding(
            "calibrated-mirror-side",
            f"{blocks} blocks; the header's calibration puts the mirror at azimuth {header.get('mirror phi', -90):g}",
        )
    )
    negative = int(np.count_nonzero(table[:, 3] < 0))
    if negative:
        text = (
            f"{negative} of {len(table)} values are negative: dark readings larger than the signal; they take no "
            f"part in a fit"
        )
        notes.append(Finding("negative-values", text, "warning", numbers=(("values", negative),)))
    theta_i, theta_r, phi_r, brdf = table.T
    return measurement(source, "LightTools text", theta_i, 0.0, theta_r, phi_r, brdf, findings=notes)


def _block(source: Source, header, theta_i: float, lines, start: int):
    """(theta_i, theta_r, phi_r with the mirror at 180, value) of one lamp position."""
    thetas, phis = (_steps(source, header, axis, start) for axis in ("Theta", "Phi"))
    mirror = header.get("mirror phi", -90.0)
    if len(thetas) * len(phis) > min(MOST_CELLS, len(source.data)):
        raise source.error(
            f"its header promises {len(thetas)} x {len(phis)} values, more than the file can hold", start
        )
    found = []
    for theta in thetas:
        number, text = next(lines, (start, None))
        if text is None:
            raise source.error(
                f"truncated: the block under Theta Lighting {theta_i:g} ends before theta {theta:g}", start
            )
        values = source.numbers(text.split(), number)
        if len(values) != len(phis) + 1 or abs(values[0] - theta) > 0.5 * max(
            abs(thetas[-1] - thetas[0]) / max(len(thetas) - 1, 1), 1e-6
        ):
            raise source.error(f"found '{text.strip()[:40]}', wanted theta {theta:g} and {len(phis)} values", number)
        found += [
            (theta_i, values[0], phi - mirror + 180.0, value) for phi, value in zip(phis, values[1:], strict=True)
        ]
    return found


def _steps(source: Source, header, axis: str, line: int):
    try:
        low, high, step = (header[f"{axis} {word}"] for word in ("beginning", "end", "step"))
    except KeyError as missing:
        raise source.error(
            f"no '{missing.args[0].replace(' ', ' measure ')}' in the header of this block", line
        ) from None
    finite = all(abs(value) < 1e6 for value in (low, high, step))
    count = 1.0 if step == 0 else (high - low) / step + 1
    if not finite or not 1 <= count <= MOST_CELLS:
        raise source.error(f"{axis} from {low:g} to {high:g} in steps of {step:g} is no range", line)
    return low + step * np.arange(int(round(count)))


FORMAT = Format("lighttools", (".txt",), recognises, read)

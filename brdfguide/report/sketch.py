"""A ranking's lobes as a few lines of braille, for a UTF-8 terminal: data as dots, the recommended model as a line."""

import numpy as np

from ..measurement import Measurement
from . import lines

ROWS, GAP = 8, 3
DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # of a braille cell: four rows of two
MODEL, PLAIN = "\x1b[36m", "\x1b[0m"
MOST_DECADES = 5.0


def lobes(line: lines.Line, measurement: Measurement, width: int = 100, colour: bool = True) -> str:
    """Up to three angles of incidence side by side, ln BRDF against signed theta_r; "" where there is nothing to draw."""
    channel = lines.nominal_channel(measurement)
    panels, _ = lines.slices(measurement, channel)
    if not panels or width < 40:
        return ""
    wavelength = float(np.broadcast_to(measurement.geom.wavelength, (len(measurement.channels),))[channel])
    columns = min(34, (width - 8 - GAP * (len(panels) - 1)) // len(panels))
    reach = min(90.0, max(np.abs(measurement.geom.theta_r_deg[picked]).max() for _, picked in panels) + 1)
    least = 0.0 if all(measurement.geom.signed_theta_r_deg[picked].min() >= 0 for _, picked in panels) else -reach
    everything = np.concatenate([measurement.brdf[picked, channel] for _, picked in panels])
    high = np.log10(everything.max()) + 0.1
    low = max(np.log10(everything.min()) - 0.1, high - MOST_DECADES)
    place = lambda theta_r, value: (  # noqa: E731
        np.floor((theta_r - least) / (reach - least) * 2 * columns).astype(int), np.floor((high - np.log10(value)) / (high - low) * 4 * ROWS).astype(int),
    )  # fmt: skip
    blocks = []
    for theta_i, picked in panels:
        theta_r = measurement.geom.signed_theta_r_deg[picked, 0]
        grid = np.linspace(least, reach, 8 * columns + 1)
        model = np.maximum(lines.curve(line, theta_i, grid, wavelength, channel), 1e-30)
        blocks.append((f"theta_i {theta_i:g}", _cells(columns, place(theta_r, measurement.brdf[picked, channel])), _cells(columns, place(grid, model))))
    text = [" " * 8 + (" " * GAP).join(f"{title:<{columns}}" for title, _, _ in blocks)]
    for row in range(ROWS):
        label = f"{10**high:7.2g} " if row == 0 else f"{10**low:7.2g} " if row == ROWS - 1 else " " * 8
        text.append(label + (" " * GAP).join(_row(data[row], model[row], colour) for _, data, model in blocks))
    ends = f"{least:<{columns - 4}.0f}{reach:4.0f}"
    text.append(" " * 8 + (" " * GAP).join(ends for _ in blocks))
    text.append(" " * 8 + f"BRDF [1/sr] over theta_r [deg]: data, and {MODEL if colour else ''}{line.name}{PLAIN if colour else ''}")
    return "\n".join(each.rstrip() for each in text)


def _cells(columns: int, points) -> np.ndarray:
    """Braille bits (ROWS, columns) of points given in dots from the upper left corner."""
    x, y = points
    cells = np.zeros((ROWS, columns), int)
    inside = (x >= 0) & (x < 2 * columns) & (y >= 0) & (y < 4 * ROWS)
    for column, row in zip(x[inside], y[inside]):
        cells[row // 4, column // 2] |= DOTS[row % 4][column % 2]
    return cells


def _row(data, model, colour: bool) -> str:
    """One line of cells; those that the model passes through in its colour."""
    return "".join(
        f"{MODEL}{chr(0x2800 + (a | b))}{PLAIN}" if b and colour else chr(0x2800 + (a | b)) if a | b else " " for a, b in zip(data.tolist(), model.tolist())
    )

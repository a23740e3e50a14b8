"""A ranking's lobes as a few lines of braille, for a UTF-8 terminal: data as dots, the recommended model as a line."""

import numpy as np

from ...data.measurement import Measurement
from . import lines
from .panels import panels

ROWS = 8  # of text
GAP = 3  # letters between two panels
DOTS = ((0x01, 0x08), (0x02, 0x10), (0x04, 0x20), (0x40, 0x80))  # of a braille cell: four rows of two
MODEL = "\x1b[36m"  # turns a terminal's letters cyan
PLAIN = "\x1b[0m"
MOST_DECADES = 5.0


def sketch_lobes(line: lines.Line, measurement: Measurement, width: int = 100, colour: bool = True) -> str:
    """Up to three incidences side by side, ln BRDF against signed theta_r; "" where there is nothing to draw."""
    channel = lines.nominal_channel(measurement)
    shown = panels(measurement, channel).shown
    if not shown or width < 40:
        return ""
    columns = min(34, (width - 8 - GAP * (len(shown) - 1)) // len(shown))
    angular_range = min(90.0, max(np.abs(panel.theta_r).max() for panel in shown) + 1)
    least = 0.0 if all(panel.theta_r.min() >= 0 for panel in shown) else -angular_range
    everything = np.concatenate([panel.value for panel in shown])
    high = np.log10(everything.max()) + 0.1
    low = max(np.log10(everything.min()) - 0.1, high - MOST_DECADES)

    def place(theta_r, value):
        return (
            np.floor((theta_r - least) / (angular_range - least) * 2 * columns).astype(int),
            np.floor((high - np.log10(value)) / (high - low) * 4 * ROWS).astype(int),
        )

    blocks = []
    for panel in shown:
        grid = np.linspace(least, angular_range, 8 * columns + 1)
        model = lines.curve(line, channel, panel.theta_i, grid, measurement.solid_angle, panel.azimuth)
        model = np.maximum(model, 1e-30)
        blocks.append(
            (
                f"theta_i {panel.theta_i:g}",
                _cells(columns, place(panel.theta_r, panel.value)),
                _cells(columns, place(grid, model)),
            )
        )
    text = [" " * 8 + (" " * GAP).join(f"{title:<{columns}}" for title, _, _ in blocks)]
    labels = [f"{10**high:7.2g} ", *[" " * 8] * (ROWS - 2), f"{10**low:7.2g} "]
    for row, label in enumerate(labels):
        text.append(label + (" " * GAP).join(_row(data[row], model[row], colour) for _, data, model in blocks))
    ends = f"{least:<{columns - 4}.0f}{angular_range:4.0f}"
    text.append(" " * 8 + (" " * GAP).join(ends for _ in blocks))
    text.append(
        " " * 8
        + f"BRDF [1/sr] over theta_r [deg]: data, and {MODEL if colour else ''}{line.name}{PLAIN if colour else ''}"
    )
    return "\n".join(each.rstrip() for each in text)


def _cells(columns: int, points) -> np.ndarray:
    """Braille bits (ROWS, columns) of points given in dots from the upper left corner."""
    x, y = points
    cells = np.zeros((ROWS, columns), int)
    inside = (x >= 0) & (x < 2 * columns) & (y >= 0) & (y < 4 * ROWS)
    for column, row in zip(x[inside], y[inside], strict=True):
        cells[row // 4, column // 2] |= DOTS[row % 4][column % 2]
    return cells


def _row(data, model, colour: bool) -> str:
    """One line of cells; those that the model passes through in its colour."""

    def cell(data: int, model: int) -> str:
        dots = chr(0x2800 + (data | model)) if data | model else " "
        return f"{MODEL}{dots}{PLAIN}" if model and colour else dots

    return "".join(map(cell, data.tolist(), model.tolist()))

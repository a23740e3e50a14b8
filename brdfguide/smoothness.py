"""What neighbours say about a value: how noisy the data are, and which samples are spikes at the mirror direction."""

import numpy as np

from .geometry import once
from .measurement import Measurement, row_median, rows_by_tenth

SPIKE_DEG = 2.5  # a spike lies this near to the mirror direction
# how far, in ln, a spike stands above its neighbours, and how many times as fast it drops as they go on to fall
SPIKE_DROPS = ((np.log(5.0), 3.0), (np.log(100.0), 1.5))
GRAZING_DEG = 85.0
DENSE = 200_000  # directions beyond which a table is dense and has no single samples
ASKED = 1000  # directions compared with their neighbours where there are no scans
EDGE_DEG = 75.0  # beyond this a scan may be cut off


def noise(measurement: Measurement) -> float | None:
    """Relative standard deviation of a single value, from its departure from a cubic through four neighbours of its scan.

    Scans run over the reflected angle in one plane, or over the incidence at one reflected angle; where there are none,
    directions mirrored at the plane of incidence are compared, or each with a parabola through its neighbours. The median is used, so that peaks do not count as noise.
    In a dense table neighbours stand beside each other in the file. None where nothing can be compared.
    """
    level = measurement.ln
    if len(level) > DENSE:
        return _in_file_order(level)
    departures = [departure for scan in _scans(measurement) for departure in _departures(*scan, level)]
    if sum(len(each) for each in departures) < 40:
        departures += _mirrored(measurement, level)
    if sum(len(each) for each in departures) < 40:
        departures += _scattered(measurement, level)
    values = np.concatenate([np.ravel(each) for each in departures]) if departures else np.zeros(0)
    values = np.abs(values[np.isfinite(values)])
    return float(np.median(values) / 0.6745) if len(values) >= 20 else None


def _in_file_order(level) -> float | None:
    """From third differences along the rows, in which a smooth function leaves nothing; None where the rows are in no order."""
    departures = np.abs(np.diff(level, 3, axis=0)) / np.sqrt(20)
    found = np.nanmedian(departures) / 0.6745 if np.any(np.isfinite(departures)) else np.inf
    return float(found) if found < 0.5 else None


@once
def spikes(measurement: Measurement) -> np.ndarray:
    """(samples,) mask of directions one or two samples wide at the mirror direction that stand far above their surroundings.

    An ideal mirror, seen through the instrument, gives such values; their height says more about the aperture than about the surface.
    """
    mask = np.zeros(len(measurement.geom), bool)
    if len(mask) > DENSE:
        return mask
    level = np.nanmax(np.where(measurement.usable, measurement.ln, -np.inf), axis=1)
    distance = np.degrees(np.sqrt(measurement.geom.mirror_distance2[:, 0]))
    near = (distance <= SPIKE_DEG) & np.isfinite(level)
    for rows in _groups(measurement):
        if not near[rows].any():
            continue
        rows = rows[np.isfinite(level[rows])]
        rows = rows[np.argsort(distance[rows], kind="stable")]
        for core in (2, 1):
            if len(rows) < core + 5 or distance[rows[core - 1]] > SPIKE_DEG or distance[rows[core]] < 0.5:
                continue
            around = level[rows[core : core + 4]]
            drop = level[rows[:core]].min() - around.max()
            onward = around[:2].mean() - around[2:].mean()
            if any(drop > least and drop > steeper * onward for least, steeper in SPIKE_DROPS):
                mask[rows[:core]] = True
                break
    return mask


@once
def dark_edges(measurement: Measurement) -> np.ndarray:
    """(samples,) mask of outermost directions of a scan where the value falls to a tenth within five degrees.

    No surface does that far from its mirror direction; an aperture cut off by the horizon or the holder does.
    """
    mask = np.zeros(len(measurement.geom), bool)
    if len(mask) > DENSE:
        return mask
    level = row_median(measurement.ln)
    distance = np.degrees(np.sqrt(measurement.geom.mirror_distance2[:, 0]))
    for rows, angle in _scans(measurement):
        keep = np.isfinite(level[rows]) & (np.abs(angle) >= EDGE_DEG - 8)
        for side in (angle > 0, angle < 0):
            outward = rows[keep & side][np.argsort(np.abs(angle[keep & side]))]
            steps = np.diff(level[outward]), np.abs(np.diff(measurement.geom.theta_r_deg[outward, 0]))
            slope = np.divide(*steps, out=np.zeros_like(steps[0]), where=steps[1] > 0)
            before = np.r_[-np.inf, slope[:-1]]  # a lobe that dies out falls fast as well, but no faster than it did
            cliff = np.flatnonzero((steps[0] < -np.log(10.0)) & (steps[1] <= 5.5) & (steps[1] > 0) & (slope < 2.5 * before))
            if len(cliff) and np.all(distance[outward[cliff[0] + 1 :]] > 15) and measurement.geom.theta_r_deg[outward[cliff[0] + 1], 0] >= EDGE_DEG:
                mask[outward[cliff[0] + 1 :]] = True
    return mask


def _groups(measurement: Measurement):
    """Rows of one incidence, or of one reflected angle where the incidences are the finer scan."""
    incidences, reflected = measurement.theta_i_groups, rows_by_tenth(measurement.geom.theta_r_deg[:, 0])
    return list((reflected if len(reflected) < len(incidences) else incidences).values())


@once
def _scans(measurement: Measurement) -> list[tuple[np.ndarray, np.ndarray]]:
    """(rows in order, their angle [deg]) of every scan through at least five directions."""
    geom, scans = measurement.geom, []
    if len(geom) > DENSE:
        return scans
    plane = np.round(np.where(geom.sin_i < 1e-6, 0.0, np.remainder(geom.phi_deg + 1e-6, 180.0)), 0)[:, 0] % 180
    sign = np.where(np.remainder(geom.phi_deg[:, 0] + 1e-6, 360.0) >= 179.5, 1.0, -1.0)
    theta_i, theta_r = geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0]
    for fixed, angle in ((theta_i, sign * theta_r), (sign * theta_r, theta_i)):
        keys = np.round(10 * fixed) * 1000 + plane
        order = np.lexsort((angle, keys))
        cuts = np.flatnonzero(np.diff(keys[order])) + 1
        edges = np.r_[0, cuts, len(order)]
        for scan in np.flatnonzero(np.diff(edges) >= 5):  # scattered directions make tens of thousands of scans of one
            rows = order[edges[scan] : edges[scan + 1]]
            scans.append((rows, angle[rows]))
    return scans


def _departures(rows, angle, level):
    """ln f minus the cubic through its two neighbours on either side, in units of one standard deviation if all are alike."""
    keep = np.r_[True, np.diff(angle) > 1e-6]
    rows, x = rows[keep], angle[keep]
    if len(x) < 5:
        return
    stencil = np.stack([x[:-4], x[1:-3], x[3:-1], x[4:]])
    middle = x[2:-2]
    near = (stencil[3] - stencil[0] < 24) & (np.abs(middle) < GRAZING_DEG)
    if not np.any(near):
        return
    weights = np.ones_like(stencil)
    for i in range(4):
        for j in range(4):
            if i != j:
                weights[i] *= (middle - stencil[j]) / (stencil[i] - stencil[j])
    values = level[rows]
    neighbours = np.stack([values[:-4], values[1:-3], values[3:-1], values[4:]])
    guess = np.sum(weights[..., None] * neighbours, axis=0)
    yield ((values[2:-2] - guess) / np.sqrt(1 + np.sum(weights**2, axis=0))[:, None])[near]


def _mirrored(measurement: Measurement, level):
    """Half differences of values at +phi and -phi."""
    geom = measurement.geom
    if len(geom) > DENSE:
        return []
    phi = np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0
    theta_i, theta_r, off = (np.round(100 * angle) for angle in (geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0], np.abs(phi)))
    keys = (theta_i * 1e4 + theta_r) * 1e5 + off
    order = np.lexsort((phi, keys))
    pairs = (np.diff(keys[order]) == 0) & (phi[order[:-1]] < -1e-6) & (phi[order[1:]] > 1e-6)
    return [(level[order[1:][pairs]] - level[order[:-1][pairs]]) / np.sqrt(2)]


def _scattered(measurement: Measurement, level):
    """ln f minus a parabola through the twelve nearest directions of the same incidence, in units of its standard deviation.

    About a thousand directions are asked, evenly spread: a median needs no more.
    """
    geom = measurement.geom
    phi = np.radians(np.abs(np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0))
    places = np.stack([geom.sin_r[:, 0] * np.cos(phi), geom.sin_r[:, 0] * np.sin(phi)], axis=1)
    seen = np.any(np.isfinite(level), axis=1)
    groups = [rows[seen[rows]] for rows in measurement.theta_i_groups.values()]
    groups = [rows for rows in groups if len(rows) >= 20]
    if not groups:
        return []
    rows, sizes = np.concatenate(groups), np.array([len(each) for each in groups])
    places, stride = places[rows], -(-len(geom) // ASKED)
    asked, size = np.arange(0, len(rows), stride), np.repeat(sizes, sizes)[::stride]
    first = np.repeat(np.cumsum(sizes) - sizes, sizes)[::stride]
    near = np.concatenate([_beside(places, *each) for each in zip(*(np.array_split(part, -(-len(asked) * sizes.max() // 2**19)) for part in (asked, first, size)))])
    x, y = np.moveaxis(places[near] - places[asked][:, None], -1, 0)
    x, y = (each / np.maximum(np.hypot(x, y).max(axis=1, keepdims=True), 1e-12) for each in (x, y))
    design = np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)
    across = np.swapaxes(design, 1, 2)
    weights = np.linalg.solve(across @ design + 1e-9 * np.eye(6), across)[:, 0]  # a touch of ridge: the twelve may stand in a line
    level = level[rows]
    guess = np.einsum("nk,nkc->nc", weights, level[near])
    return [(level[asked] - guess) / np.sqrt(1 + np.sum(weights**2, axis=1))[:, None]]


def _beside(places, asked, first, size):
    """The twelve places nearest to each of those `asked`, out of the `size` from `first` on; (asked, 12)."""
    among = np.arange(size.max())
    columns = np.minimum(first[:, None] + among, len(places) - 1)
    apart = np.sum((places[columns] - places[asked][:, None]) ** 2, axis=2)
    apart[(among >= size[:, None]) | (columns == asked[:, None])] = np.inf
    return np.take_along_axis(columns, np.argpartition(apart, 11, axis=1)[:, :12], axis=1)

"""Light on an explicit random rough interface: shadowing by scan lines, first reflection by its slopes, the rest by
rays.

Nothing here knows a reflectance model: a map of heights is drawn from a power spectrum, its facets reflect by Fresnel's
equations, other parts of the map hide them, and light that hits a second facet is followed by ray tracing. Lengths are
in units of the correlation length. Geometric optics: facets are large against the wavelength.
"""

import numpy as np

CELL = 0.1  # map step, in correlation lengths
SIZE = 512


def fresnel(cos, n, k=0.0):
    """Unpolarised reflectance of a smooth interface."""
    eta2 = (n + 1j * k) ** 2
    root = np.sqrt(eta2 - 1 + cos**2)
    return 0.5 * (np.abs((cos - root) / (cos + root)) ** 2 + np.abs((eta2 * cos - root) / (eta2 * cos + root)) ** 2)


def soft_tailed(k):
    """Power spectrum with more fine detail than a Gaussian."""
    return (1 + k**2 / 2) ** -2.5 * np.exp(-((k / 4) ** 2))


def gaussian(k):
    """Power spectrum of a Gaussian correlation."""
    return np.exp(-((k / 2) ** 2))


class Map:
    """Periodic heights z[y, x] and their exact slopes, from a power spectrum; `slope_sd` is per axis."""

    def __init__(self, spectrum, slope_sd, rng):
        k = 2 * np.pi * np.fft.fftfreq(SIZE, CELL)
        kx, ky = np.meshgrid(k, k)
        field = np.fft.fft2(rng.standard_normal((SIZE, SIZE))) * np.sqrt(spectrum(np.hypot(kx, ky)))
        field[0, 0] = 0
        slopes = [np.fft.ifft2(1j * axis * field).real for axis in (kx, ky)]
        scale = slope_sd / np.sqrt(0.5 * (np.var(slopes[0]) + np.var(slopes[1])))
        self.z = scale * np.fft.ifft2(field).real
        self.sx, self.sy = scale * slopes[0], scale * slopes[1]

    def turned(self):
        """The same map seen from the four sides, as (z, slope along x, slope along y)."""
        z, sx, sy = self.z, self.sx, self.sy
        yield z, sx, sy
        yield z.T, sy.T, sx.T
        yield z[:, ::-1], -sx[:, ::-1], sy[:, ::-1]
        yield z.T[:, ::-1], -sy.T[:, ::-1], sx.T[:, ::-1]


def visible(z, theta_deg):
    """Which cells a direction in the xz plane sees; theta_deg < 0 leans to -x, where the light is."""
    if theta_deg > 0:
        return visible(z[:, ::-1], -theta_deg)[:, ::-1]
    if theta_deg == 0:
        return np.ones(z.shape, bool)
    x = CELL * np.arange(2 * SIZE, dtype=np.float32)
    rising = np.concatenate((z, z), axis=1) + x / np.float32(np.tan(np.radians(-theta_deg)))
    highest = np.maximum.accumulate(rising, axis=1)
    return rising[:, SIZE:] >= highest[:, SIZE:]


def first_reflection(maps, thetas_i, thetas_r, n, k=0.0, width=0.05):
    """BRDF [1/sr] of light reflected once, (theta_i, theta_r): the share of the map that is seen by both and tilted
    right.

    f = F(cos d) P(slope) / (4 cos i cos r cos^4 h), with P the density of visible slopes in a window `width` wide.
    """
    i, r = np.radians(thetas_i)[:, None], np.radians(thetas_r)[None, :]
    slope = (np.sin(i) - np.sin(r)) / (np.cos(i) + np.cos(r))
    count = np.zeros(slope.shape)
    cells = 0
    for each in maps:
        for z, sx, sy in each.turned():
            near = np.flatnonzero(np.abs(sy.ravel()) < width / 2)
            near = near[np.argsort(sx.ravel()[near])]
            tilt = sx.ravel()[near]
            z32 = np.ascontiguousarray(z, np.float32)
            lit = [visible(z32, -t).ravel()[near] for t in thetas_i]
            visible_from = [visible(z32, t).ravel()[near] for t in thetas_r]
            low, high = np.searchsorted(tilt, slope - width / 2), np.searchsorted(tilt, slope + width / 2)
            for a, b in np.ndindex(*slope.shape):
                rows = slice(low[a, b], high[a, b])
                count[a, b] += np.count_nonzero(lit[a][rows] & visible_from[b][rows])
            cells += z.size
    cos_d = np.cos((i + r) / 2)
    return fresnel(cos_d, n, k) * count / cells / width**2 * (1 + slope**2) ** 2 / (4 * np.cos(i) * np.cos(r))


def trace(each, theta_i_deg, n, k, rays, rng, most=4):
    """Follow rays from theta_i: (reflected share, transmitted share, leaving directions, weights, bounces)."""
    z, sx, sy = each.z, each.sx, each.sy
    top, step = z.max(), CELL / 2
    theta = np.radians(theta_i_deg)
    at = np.column_stack((rng.uniform(0, SIZE * CELL, (rays, 2)), np.full(rays, top)))
    go = np.tile((np.sin(theta), 0.0, -np.cos(theta)), (rays, 1))
    weight, bounces, transmitted = np.ones(rays), np.zeros(rays, int), 0.0
    alive = np.arange(rays)
    out = []
    while alive.size:
        here = at[alive]
        there = here + step * go[alive]
        gap = there[:, 2] - _at(z, there)
        gone = (there[:, 2] > top) & (go[alive, 2] > 0)
        hit = (gap < 0) & ~gone
        at[alive] = there
        if hit.any():
            rows = alive[hit]
            before = np.maximum(here[hit, 2] - _at(z, here[hit]), 0.0)
            at[rows] = here[hit] + (before / (before - gap[hit]))[:, None] * (there[hit] - here[hit])
            normal = np.column_stack((-_at(sx, at[rows]), -_at(sy, at[rows]), np.ones(rows.size)))
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            facing = -np.sum(go[rows] * normal, axis=1)
            # a grazing miss of the interpolation passes on
            share = np.where(facing > 0, fresnel(np.abs(facing), n, k), 1.0)
            transmitted += np.sum(weight[rows] * (1 - share))
            weight[rows] *= share
            turn = np.where(facing > 0, 2 * facing, 0.0)
            go[rows] += turn[:, None] * normal
            at[rows, 2] = _at(z, at[rows]) + 1e-6
            bounces[rows] += 1
        out.append(alive[gone])
        alive = alive[~gone & (bounces[alive] <= most)]
    left = np.concatenate(out)
    return weight[left].sum() / rays, transmitted / rays, go[left], weight[left] / rays, bounces[left]


def later_reflections(maps, thetas_i, thetas_r, n, k=0.0, rays=100_000, wedge=15.0, bin_deg=5.0, rng=None):
    """BRDF [1/sr] of light reflected more than once, and the share transmitted at each theta_i."""
    edges = np.arange(-90, 90.1, bin_deg)
    middle = 0.5 * (edges[1:] + edges[:-1])
    solid = np.radians(2 * wedge) * np.abs(np.cos(np.radians(edges[:-1])) - np.cos(np.radians(edges[1:])))
    f, passed = np.zeros((len(thetas_i), len(thetas_r))), np.zeros(len(thetas_i))
    for place, theta_i in enumerate(thetas_i):
        histogram = np.zeros(middle.size)
        for each in maps:
            reflected, transmitted, go, weight, bounces = trace(each, theta_i, n, k, rays // len(maps), rng)
            assert abs(reflected + transmitted - 1) < 2e-3, (theta_i, reflected, transmitted)
            azimuth = np.degrees(np.arctan2(np.abs(go[:, 1]), np.abs(go[:, 0])))
            wanted = (bounces > 1) & (azimuth < wedge)
            theta = np.degrees(np.arccos(np.clip(go[wanted, 2], -1, 1))) * np.sign(go[wanted, 0])
            histogram += np.histogram(theta, edges, weights=weight[wanted])[0] / len(maps)
            passed[place] += transmitted / len(maps)
        f[place] = np.interp(thetas_r, middle, histogram / (solid * np.cos(np.radians(middle))))
    return f, passed


def _at(values, at):
    """Bilinear value of a periodic map."""
    u, v = at[:, 0] / CELL, at[:, 1] / CELL
    x, y = np.floor(u).astype(int), np.floor(v).astype(int)
    a, b = u - x, v - y
    x0, y0, x1, y1 = x % SIZE, y % SIZE, (x + 1) % SIZE, (y + 1) % SIZE
    return (1 - b) * ((1 - a) * values[y0, x0] + a * values[y0, x1]) + b * (
        (1 - a) * values[y1, x0] + a * values[y1, x1]
    )

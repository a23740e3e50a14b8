"""RGL material database `.bsdf`: a table over half-vector coordinates that follow the surface's own facets.

With u(θ) = √(2θ/π) and wrapped azimuths, h = normalise(i + r), u_m = (u(θ_h), (φ_h - φ_i + π)/2π), u_i = (u(θ_i), (φ_i + π)/2π):

    f cos θ_r = c(s(u_m)) ndf(u_m) / (4 sigma(u_i)),       s = the cumulative distribution of `vndf` at u_m

`vndf` and c (`rgb` or `spectra`) are tables for each θ_i (and φ_i where the sample is anisotropic) between whose slices one
goes linearly. A table is no scatter of samples: directions are chosen on a grid even in u_m, which is dense near the
mirror direction, at every stored θ_i.

Source: Dupuy and Jakob 2018, "An adaptive parameterization for efficient material acquisition and rendering".
"""

import numpy as np

from ..geometry import Geometry, rows
from ..measurement import Finding, Measurement
from . import _tensor
from ._base import RGB_UM, Format, Options, Source, averaged, nominal_colours

LIMIT = 2**30
GRID_THETA, GRID_PHI = 40, 36  # half-vector directions for each incidence, even in u_m
STEEPEST_DEG = 80.0  # the table divides by cos theta_r: beyond, its own noise is what one sees
NEEDED = ("phi_i", "theta_i", "sigma", "ndf", "vndf")


def recognises(head: bytes) -> bool:
    return head.startswith(_tensor.MAGIC)


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged container and missing fields. An anisotropic table gives its mean, marked as outside the guide."""
    fields = _checked(source, _tensor.fields(source))
    phi_i = _turns(fields)
    theta_i = np.degrees(fields["theta_i"].astype(float))
    theta_i = theta_i[theta_i <= STEEPEST_DEG]
    geom = _directions(theta_i)
    brdf = _averaged(fields, geom, phi_i)
    channels, um, notes = _channels(fields)
    text = f"a table: {len(geom)} directions chosen at its {len(theta_i)} stored incidences, even in the root of the half angle, to {STEEPEST_DEG:g} degrees"
    found = [Finding("table", text, consequence="dense near the mirror direction", numbers=(("directions", len(geom)),))]
    if phi_i is not None:
        found.append(averaged(len(phi_i), _spread(fields, geom, phi_i, brdf), options))
    return Measurement(geom.at(um), brdf, channels, name=source.name, format="RGL .bsdf", findings=(*found, *notes))


def function(source: Source, options: Options):
    """The table at any direction; anisotropic ones averaged over the rotation where the options ask for it."""
    fields = _checked(source, _tensor.fields(source))
    phi_i = _turns(fields)
    if phi_i is not None and not options.average_phi_i:
        raise source.error(f"anisotropic: {len(phi_i)} azimuths of the light were measured; --average-phi-i takes their mean")
    return lambda geom: _averaged(fields, geom, phi_i), _channels(fields)[0]


def _turns(fields):
    """The azimuths of the light [deg] of an anisotropic table, None for an isotropic one."""
    return np.degrees(fields["phi_i"].astype(float)) if len(fields["phi_i"]) > 2 else None


def _spread(fields, geom: Geometry, phi_i, mean) -> float:
    """rms of ln (value / mean) over the rotations, brightest channel, at a hundred directions."""
    some = np.linspace(0, len(geom) - 1, 100).astype(int)
    channel = int(np.argmax(mean.sum(axis=0)))
    ratio = np.stack([evaluate(fields, geom[some], turn)[:, channel] for turn in phi_i[:-1]]) / np.maximum(mean[some, channel], 1e-12)
    return float(np.sqrt(np.mean(np.log(np.clip(ratio, 1e-3, 1e3)) ** 2)))


def _averaged(fields, geom: Geometry, phi_i) -> np.ndarray:
    """The BRDF, or its mean over a turn of the sample (trapezoid between the stored azimuths)."""
    if phi_i is None:
        return evaluate(fields, geom)
    steps = np.diff(phi_i)
    shares = (np.r_[steps, 0.0] + np.r_[0.0, steps]) / (2 * steps.sum())
    return sum(share * evaluate(fields, geom, turn) for turn, share in zip(phi_i, shares))


def evaluate(fields, geom: Geometry, phi_i_deg: float = 0.0) -> np.ndarray:
    """BRDF [1/sr] (samples, channels) at directions (samples, 1) with the light at azimuth `phi_i_deg` of the sample."""
    theta_i = np.arctan2(geom.sin_i, geom.cos_i)[:, 0]
    phi_i = np.radians(phi_i_deg)
    isotropic = len(fields["phi_i"]) <= 2
    theta_h, phi_h = _half(geom)
    u_m = np.stack([_u(theta_h), np.mod((phi_h + (0.0 if isotropic else phi_i) + np.pi) / (2 * np.pi), 1.0)])
    u_i = np.stack([_u(theta_i), np.full_like(theta_i, np.mod((phi_i + np.pi) / (2 * np.pi), 1.0))])
    slices = _slices(fields, theta_i, phi_i)
    s = _pushed(fields["vndf"].astype(float), slices, u_m)
    table = fields["rgb"] if "rgb" in fields else fields["spectra"]
    colour = sum(weight[:, None] * _bilinear(table, s, where) for where, weight in slices)
    factor = _bilinear(fields["ndf"], u_m) / (4 * _bilinear(fields["sigma"], u_i) * geom.cos_r[:, 0])
    return np.maximum(colour, 0.0) * factor[:, None]


def _u(theta):
    return np.sqrt(2 * theta / np.pi)


def _half(geom: Geometry):
    """Zenith of the half vector, and its azimuth counted from the light's [rad]."""
    theta = np.arctan(np.sqrt(geom.tan2_h))[:, 0]
    phi = np.radians(geom.phi_deg)
    return theta, np.arctan2(geom.sin_r * np.sin(phi), geom.sin_i + geom.sin_r * np.cos(phi))[:, 0]


def _slices(fields, theta_i, phi_i: float):
    """Pairs of (slice for each sample as (phi index, theta index), weight), for linear interpolation over incidence."""
    found = []
    for p, p_weight in _bracket(fields["phi_i"].astype(float), np.full_like(theta_i, phi_i)):
        for t, t_weight in _bracket(fields["theta_i"].astype(float), theta_i):
            found.append(((p, t), p_weight * t_weight))
    return [(where, weight) for where, weight in found if np.any(weight)]


def _bracket(nodes, x):
    if len(nodes) == 1:
        return [(np.zeros(len(x), int), np.ones(len(x)))]
    low = np.clip(np.searchsorted(nodes, x, side="right") - 1, 0, len(nodes) - 2)
    weight = np.clip((x - nodes[low]) / (nodes[low + 1] - nodes[low]), 0, 1)
    return [(low, 1 - weight), (low + 1, weight)]


def _cell(u, shape):
    """Indices and weights of the cell of [0,1]² in which `u` lies; tables are [y, x]."""
    x, y = u[0] * (shape[-1] - 1), u[1] * (shape[-2] - 1)
    i, j = np.clip(x.astype(int), 0, shape[-1] - 2), np.clip(y.astype(int), 0, shape[-2] - 2)
    return i, j, x - i, y - j


def _bilinear(table, u, where=None):
    """Values of a table [y, x], or of the slice `where` of [phi, theta, (channel,) y, x] as (samples, channels)."""
    i, j, a, b = _cell(u, table.shape)
    if where is None:
        corner = lambda dj, di: table[j + dj, i + di].astype(float)  # noqa: E731
    else:
        corner = lambda dj, di: table[where[0], where[1], :, j + dj, i + di].astype(float)  # noqa: E731
        a, b = a[:, None], b[:, None]
    return (1 - b) * ((1 - a) * corner(0, 0) + a * corner(0, 1)) + b * ((1 - a) * corner(1, 0) + a * corner(1, 1))


def _pushed(density, slices, u):
    """The point of [0,1]² to which the cumulative distribution of `density` carries `u`: first along x within the row, then along y."""
    along = np.zeros_like(density)
    along[..., 1:] = np.cumsum(0.5 * (density[..., 1:] + density[..., :-1]), axis=-1)
    row = along[..., -1]
    upward = np.zeros_like(row)
    upward[..., 1:] = np.cumsum(0.5 * (row[..., 1:] + row[..., :-1]), axis=-1)
    total = upward[..., -1:]
    along, density, row, upward = along / total[..., None], density / total[..., None], row / total, upward / total
    i, j, a, b = _cell(u, density.shape)

    def blended(table, *index):
        return sum(weight * table[(*where, *index)] for where, weight in slices)

    left = (1 - b) * blended(density, j, i) + b * blended(density, j + 1, i)
    right = (1 - b) * blended(density, j, i + 1) + b * blended(density, j + 1, i + 1)
    below, above = blended(row, j), blended(row, j + 1)
    x = a * (left + 0.5 * a * (right - left)) + (1 - b) * blended(along, j, i) + b * blended(along, j + 1, i)
    width = (1 - b) * below + b * above
    y = b * (below + 0.5 * b * (above - below)) + blended(upward, j)
    x = np.divide(x, width, out=np.full_like(x, 0.5), where=width > 0)
    return np.stack([np.clip(x, 0, 1), np.clip(y, 0, 1)])


def _directions(theta_i_deg) -> Geometry:
    """Reflected directions whose half vectors lie on a grid even in u_m, above the horizon and not too near it."""
    u = (np.arange(GRID_THETA) + 0.5) / GRID_THETA
    theta_h = 0.5 * np.pi * u**2
    phi_h = 2 * np.pi * (np.arange(GRID_PHI) + 0.5) / GRID_PHI
    theta_i, theta_h, phi_h = (a.reshape(-1) for a in np.meshgrid(np.radians(theta_i_deg), theta_h, phi_h, indexing="ij"))
    light = np.stack([np.sin(theta_i), 0 * theta_i, np.cos(theta_i)], axis=-1)
    half = np.stack([np.sin(theta_h) * np.cos(phi_h), np.sin(theta_h) * np.sin(phi_h), np.cos(theta_h)], axis=-1)
    reflected = 2 * np.sum(light * half, axis=-1, keepdims=True) * half - light
    keep = (reflected[:, 2] >= np.cos(np.radians(STEEPEST_DEG))) & (np.sum(light * half, axis=-1) > 0)
    return rows(Geometry.from_vectors(light[keep], reflected[keep] / np.linalg.norm(reflected[keep], axis=-1, keepdims=True)))


def _channels(fields):
    if "rgb" in fields:
        return ("R", "G", "B"), np.array([RGB_UM[name] for name in "RGB"]), [nominal_colours("RGB")]
    nm = fields["wavelengths"].astype(float)
    return tuple(f"{each:g}nm" for each in nm), nm / 1000, []


def _checked(source: Source, fields):
    """The fields of a reflectance table, all of matching shapes and finite. Raises InputError."""
    values = "rgb" if "rgb" in fields else "spectra"
    for name in (*NEEDED, values):
        if name not in fields:
            raise source.error(f"no field '{name}'; found {', '.join(fields)[:120]}: not a reflectance table of the RGL database")
        if fields[name].size == 0 or fields[name].dtype.kind != "f":
            raise source.error(f"field '{name}' holds no real numbers")
    phis, thetas = fields["phi_i"].size, fields["theta_i"].size
    wanted = {"phi_i": 1, "theta_i": 1, "sigma": 2, "ndf": 2, "vndf": 4, values: 5}
    channels = 3 if values == "rgb" else fields["wavelengths"].size if "wavelengths" in fields else -1
    for name, dimensions in wanted.items():
        shape = fields[name].shape
        fits = len(shape) == dimensions and (dimensions < 4 or shape[:2] == (phis, thetas)) and (dimensions < 2 or min(shape[-2:]) > 1)
        if not fits or (name == values and shape[2] != channels):
            raise source.error(f"field '{name}' has shape {shape}, which does not go with {phis} phi_i, {thetas} theta_i and {channels} channels")
        if not np.all(np.isfinite(fields[name])):
            raise source.error(f"field '{name}' holds values that are not finite")
    if thetas > 1 and np.any(np.diff(fields["theta_i"]) <= 0) or phis > 1 and np.any(np.diff(fields["phi_i"]) <= 0):
        raise source.error("the stored incidences do not rise")
    for name in ("vndf", "ndf", "sigma"):
        if np.any(fields[name] < 0) or not np.any(fields[name] > 0):
            raise source.error(f"field '{name}' is negative somewhere, or zero everywhere; a density is neither")
    return fields


FORMAT = Format("rgl", (".bsdf",), recognises, read, limit=LIMIT, function=function)

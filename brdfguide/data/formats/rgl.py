"""RGL material database `.bsdf`: a table over half-vector coordinates that follow the surface's own facets.

With u(θ) = √(2θ/π) and wrapped azimuths, h = normalise(i + r), u_m = (u(θ_h), (φ_h - φ_i + π)/2π), u_i = (u(θ_i), (φ_i
+ π)/2π):

    f cos θ_r = c(s(u_m)) ndf(u_m) / (4 sigma(u_i)),       s = the cumulative distribution of `vndf` at u_m

`vndf` and c (`rgb` or `spectra`) are tables for each θ_i (and φ_i where the sample is anisotropic) between whose slices
one goes linearly. c is even in s, so that every node of it is one direction that was aimed at: all of them are the
measurement.

Source: Dupuy and Jakob 2018, "An adaptive parameterization for efficient material acquisition and rendering".
"""

from dataclasses import replace

import numpy as np

from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from ...physics.geometry import Geometry, rows
from ..measurement import Measurement
from . import _tensor, _warp
from ._rotations import ISOTROPIC
from .format import Format, Options, Source, averaged, nominal_colours

LIMIT = 2**30
# least cosine of a direction; a slice at 90 degrees closes the table, no light is reflected
HORIZON = np.cos(np.radians(89.99))
NEEDED = ("phi_i", "theta_i", "sigma", "ndf", "vndf")


def recognises(head: bytes) -> bool:
    return head.startswith(_tensor.MAGIC)


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a damaged container and missing fields.

    Of an anisotropic table every rotation is kept, each with its share of the rows; or their mean, as the options say.
    """
    fields = _checked(source, _tensor.tensor_fields(source))
    phi_i = _turns(fields)
    geom, stored, below = _stored(fields, phi_i)
    if not len(geom):
        raise source.error("no node of the table lies above the horizon")
    if phi_i is None:
        brdf, turned = stored * _facets(fields, geom), []
    else:
        geom, brdf, turned = _turned(fields, geom, stored, phi_i, options)
    channels, um, notes = _channels(fields)
    what = "the whole table" if phi_i is None else "the nodes of all rotations by turns"
    text = f"{what}: {len(geom)} directions, each a node that counts alike; {below} nodes lie below the horizon"
    consequence = "nodes crowd where the surface sends the light"
    found = [
        Finding("table", text, consequence=consequence, numbers=(("directions", len(geom)), ("below_horizon", below)))
    ]
    steep = int(np.count_nonzero(geom.theta_r_deg > 80))
    text = (
        f"{steep} directions lie within 10 degrees of grazing, where the stored values were divided by a small cos "
        f"theta_r"
    )
    found.append(
        Finding(
            "near-grazing",
            text,
            consequence="their errors grow alike",
            option="--theta-max 80",
            numbers=(("directions", steep),),
        )
    )
    findings = (*found, *turned, *notes)
    return Measurement(geom.at(um), brdf, channels, name=source.name, format="RGL .bsdf", findings=findings)


def _turned(fields, geom: Geometry, stored, phi_i, options: Options):
    """Directions, values and notes of an anisotropic table whose rows have the light where it stood on the sample."""
    upright = Geometry(replace(geom.directions, phi_i_deg=np.zeros_like(geom.phi_i_deg)), geom.wavelength)
    mean = _averaged(fields, upright, phi_i)
    spread = _spread(fields, upright, phi_i, mean)
    notes = [averaged(len(phi_i), spread, options)]
    if np.ptp(phi_i) < 359.0:
        text = f"azimuths of the light from {phi_i[0]:g} to {phi_i[-1]:g} degrees: the rest follows by half a turn"
        notes.append(Finding("part-of-a-turn", text, consequence="facets that lean to one side would not be seen"))
    if spread < ISOTROPIC or options.average_phi_i:
        return upright, mean, notes
    return geom, stored * _facets(fields, geom, geom.phi_i_deg[:, 0]), notes


def function(source: Source, options: Options):
    """The table at any direction; anisotropic ones averaged over the rotation where the options ask for it."""
    fields = _checked(source, _tensor.tensor_fields(source))
    phi_i = _turns(fields)
    if phi_i is not None and not options.average_phi_i:
        raise source.error(
            f"anisotropic: {len(phi_i)} azimuths of the light were measured; --average-phi-i takes their mean"
        )
    return lambda geom: _averaged(fields, geom, phi_i), _channels(fields)[0]


def _turns(fields):
    """The azimuths of the light [deg] of an anisotropic table, None for an isotropic one."""
    return np.degrees(fields["phi_i"].astype(float)) if len(fields["phi_i"]) > 2 else None


def _spread(fields, geom: Geometry, phi_i, mean) -> float:
    """rms of ln (value / mean) over the rotations, brightest channel, at a hundred directions."""
    some = np.linspace(0, len(geom) - 1, 100).astype(int)
    channel = int(np.argmax(np.nansum(mean, axis=0)))
    ratio = np.stack([evaluate(fields, geom[some], turn)[:, channel] for turn in phi_i[:-1]]) / np.maximum(
        mean[some, channel], 1e-12
    )
    ratio = ratio[np.isfinite(ratio)]
    return float(np.sqrt(np.mean(np.log(np.clip(ratio, 1e-3, 1e3)) ** 2))) if len(ratio) else 0.0


def _averaged(fields, geom: Geometry, phi_i) -> np.ndarray:
    """The BRDF, or its mean over a turn of the sample (trapezoid between the stored azimuths)."""
    if phi_i is None:
        return evaluate(fields, geom)
    steps = np.diff(phi_i)
    shares = (np.r_[steps, 0.0] + np.r_[0.0, steps]) / (2 * steps.sum())
    return sum(share * evaluate(fields, geom, turn) for turn, share in zip(phi_i, shares, strict=True))


def evaluate(fields, geom: Geometry, phi_i_deg: float = 0.0) -> np.ndarray:
    """BRDF [1/sr] (samples, channels) at directions (samples, 1), the light at azimuth `phi_i_deg` of the sample."""
    slices = _slices(fields, np.arctan2(geom.sin_i, geom.cos_i)[:, 0], np.radians(phi_i_deg))
    s = _warp.pushed(fields["vndf"].astype(float), slices, _half(fields, geom, phi_i_deg))
    c = sum(weight[:, None] * _warp.bilinear(_table(fields), s, where) for where, weight in slices)
    return np.maximum(c, 0.0) * _facets(fields, geom, phi_i_deg)


def _facets(fields, geom: Geometry, phi_i_deg: float = 0.0) -> np.ndarray:
    """ndf(u_m) / (4 sigma(u_i) cos theta_r), (samples, 1)."""
    theta_i = np.arctan2(geom.sin_i, geom.cos_i)[:, 0]
    u_i = np.stack([_u(theta_i), np.full_like(theta_i, np.mod(np.radians(phi_i_deg) / (2 * np.pi) + 0.5, 1.0))])
    area = _warp.bilinear(fields["sigma"], u_i)
    ratio = _warp.bilinear(fields["ndf"], _half(fields, geom, phi_i_deg)) / (4 * np.where(area > 0, area, np.nan))
    return ratio[:, None] / geom.cos_r


def _half(fields, geom: Geometry, phi_i_deg: float):
    """u_m: the half vector's zenith, and its azimuth counted from the light's where the sample is isotropic."""
    theta, phi = np.arctan(np.sqrt(geom.tan2_h))[:, 0], np.radians(geom.phi_deg)
    phi = np.arctan2(geom.sin_r * np.sin(phi), geom.sin_i + geom.sin_r * np.cos(phi))[:, 0]
    turn = 0.0 if len(fields["phi_i"]) <= 2 else np.radians(phi_i_deg)
    return np.stack([_u(theta), np.mod((phi + turn + np.pi) / (2 * np.pi), 1.0)])


def _u(theta):
    return np.sqrt(2 * theta / np.pi)


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


def _stored(fields, phi_i):
    """Directions (samples, 1) of the nodes of the table, with the light where it stood on the sample, c there (samples,
    channels), and how many nodes lie below the horizon.

    Of an anisotropic table every rotation gives its share of the rows, so that they are no more than those of one
    rotation.
    """
    turns = 1 if phi_i is None else len(phi_i) - 1
    lights, views, stored, azimuths, nodes = [], [], [], [], 0
    for t, theta_i in enumerate(fields["theta_i"].astype(float)):
        light = np.array([np.sin(theta_i), 0.0, np.cos(theta_i)])
        for p in range(turns):
            half, values = _nodes(fields, p, t, slice(p, -1, turns), 0.0 if phi_i is None else np.radians(phi_i[p]))
            view = 2 * (half @ light)[:, None] * half - light
            view /= np.linalg.norm(view, axis=-1, keepdims=True)
            lit = (view[:, 2] > HORIZON) & (light[2] > HORIZON)
            nodes += len(lit)
            views.append(view[lit])
            lights.append(np.broadcast_to(light, views[-1].shape))
            stored.append(values[lit])
            azimuths.append(np.full(len(values[lit]), 0.0 if phi_i is None else phi_i[p]))
    light, view = np.concatenate(lights), np.concatenate(views)
    geom = rows(Geometry.from_vectors(light, view))
    if phi_i is not None:
        geom = Geometry(replace(geom.directions, phi_i_deg=np.concatenate(azimuths)[:, None]), geom.wavelength)
    return geom, np.concatenate(stored), nodes - len(view)


def _nodes(fields, p: int, t: int, picked: slice, turn: float):
    """Half vectors (nodes, 3) of some rows of one slice, with the light at azimuth 0, and what is stored there (nodes,
    channels).

    The seam is stored as the first row and as the last, which is left out; all nodes at u = 0 are the mirror direction
    and have their mean.
    """
    table = _table(fields)
    u = _warp.pulled(fields["vndf"][p, t].astype(float), table.shape[-2:])[:, picked].reshape(2, -1)
    values = np.moveaxis(table[p, t], 0, -1)[picked].astype(float).reshape(u.shape[1], table.shape[2])
    mirror = np.flatnonzero(u[0] == 0)
    if len(mirror):
        values[mirror[0]] = values[mirror].mean(axis=0)
    theta, phi = 0.5 * np.pi * u[0] ** 2, 2 * np.pi * u[1] - np.pi - turn
    half = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], axis=-1)
    return np.delete(half, mirror[1:], axis=0), np.delete(values, mirror[1:], axis=0)


def _table(fields):
    return fields["rgb"] if "rgb" in fields else fields["spectra"]


def _channels(fields):
    if "rgb" in fields:
        return ("R", "G", "B"), np.array([CHANNEL_UM[name] for name in "RGB"]), [nominal_colours("RGB")]
    nm = fields["wavelengths"].astype(float)
    return tuple(f"{each:g}nm" for each in nm), nm / 1000, []


def _checked(source: Source, fields):
    """The fields of a reflectance table, all of matching shapes and finite. Raises InputError."""
    values = "rgb" if "rgb" in fields else "spectra"
    for name in (*NEEDED, values):
        if name not in fields:
            raise source.error(
                f"no field '{name}'; found {', '.join(fields)[:120]}: not a reflectance table of the RGL database"
            )
        if fields[name].size == 0 or fields[name].dtype.kind != "f":
            raise source.error(f"field '{name}' holds no real numbers")
    phis, thetas = fields["phi_i"].size, fields["theta_i"].size
    wanted = {"phi_i": 1, "theta_i": 1, "sigma": 2, "ndf": 2, "vndf": 4, values: 5}
    channels = 3
    if values == "spectra":
        channels = fields["wavelengths"].size if "wavelengths" in fields else -1
    if values == "spectra" and "wavelengths" in fields:
        wanted["wavelengths"] = 1
    for name, dimensions in wanted.items():
        shape = fields[name].shape
        fits = (
            len(shape) == dimensions
            and (dimensions < 4 or shape[:2] == (phis, thetas))
            and (dimensions < 2 or min(shape[-2:]) > 1)
        )
        if not fits or (name == values and shape[2] != channels):
            raise source.error(
                f"field '{name}' has shape {shape}, which does not go with {phis} phi_i, {thetas} theta_i and "
                f"{channels} channels"
            )
        if not all(np.all(np.isfinite(part)) for part in fields[name]):
            raise source.error(f"field '{name}' holds values that are not finite")
    if thetas > 1 and np.any(np.diff(fields["theta_i"]) <= 0) or phis > 1 and np.any(np.diff(fields["phi_i"]) <= 0):
        raise source.error("the stored incidences do not rise")
    least, most = float(fields["theta_i"].min()), float(fields["theta_i"].max())
    if least < -1e-6 or most > 1.5709:
        raise source.error(f"field 'theta_i' reaches from {least:g} to {most:g}; wanted radians, within 0..pi/2")
    for name in ("vndf", "ndf", "sigma"):
        slices = fields[name].reshape(-1, fields[name].shape[-2] * fields[name].shape[-1])
        if np.any(fields[name] < 0) or not np.all(np.any(slices > 0, axis=1)):
            raise source.error(f"field '{name}' is negative somewhere, or zero everywhere; a density is neither")
    return fields


FORMAT = Format("rgl", (".bsdf",), recognises, read, limit=LIMIT, function=function, options=("average_phi_i",))

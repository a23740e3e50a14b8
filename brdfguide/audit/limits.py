"""Where every law has a known limit: at the normal, the horizon, without interface, loss or roughness."""

import numpy as np

from ..models import Model
from ..physics import fresnel, hemisphere
from ..physics.geometry import Geometry, in_plane, rows
from .trials import Outcome, Worst, parameter_sets

SMOOTH = {"alpha": 1e-3, "exponent": 1e5}  # shapes narrow enough to be a mirror to the eye


def normal(term: Model) -> Outcome:
    """Relative change from 1e-9° off the normal to the normal itself, for either direction and both."""
    worst, angles = Worst(), np.array([0.0, 0.0, 30.0])
    others = np.array([0.0, 30.0, 0.0])
    there, near = (rows(Geometry.from_degrees(angles + tilt, 20.0, others + tilt, 200.0)) for tilt in (0.0, 1e-9))
    for values in parameter_sets(term, 31):
        f, g = term(there, **values), term(near, **values)
        worst.see(np.abs(f - g) / np.maximum(np.maximum(f, g), 1e-200), there, values)
    return worst.outcome()


def grazing(term: Model) -> Outcome:
    """1 for each value 1e-9° above the horizon that is negative or no number: light, detector and both."""
    worst, low = Worst(), 90 - 1e-9
    geom = rows(
        Geometry.from_degrees(
            np.array([low, 20, low, low, low]),
            0.0,
            np.array([20, low, low, low, low]),
            np.array([180.0, 180, 180, 0, 90]),
        )
    )
    for values in parameter_sets(term, 32):
        f = term(geom, **values)
        worst.see(~(np.isfinite(f) & (f >= 0)), geom, values)
    return worst.outcome()


def weak(term: Model) -> Outcome:
    """n to 1: the lobe is (n-1)² times one shape, so that a tenth of n - 1 gives a hundredth of the lobe."""
    worst, geom = Worst(), rows(in_plane(np.array([0.0, 30, 60, 80]), np.array([5.0, 30, -40, 78])))
    if term.has_index and term.base is None:  # under a coat it is against the coat's index that one vanishes
        for small in (1e-8, 1e-10):
            f, g = (_of(term, geom, n=1 + step, k=0.0) for step in (small, small / 10))
            ratio = ((1 + small) - 1) / ((1 + small / 10) - 1)  # of the numbers as they are held
            worst.see(np.where(f > 0, f / np.where(g > 0, g, 1) / ratio**2 - 1, 0.0), geom, {"n": 1 + small})
    return worst.outcome()


def opaque(term: Model) -> Outcome:
    """k to infinity: F is 1, and a thousandfold k changes nothing more."""
    worst, geom = Worst(), rows(in_plane(np.array([0.0, 30, 60, 80]), np.array([5.0, 30, -40, 78])))
    if term.has_index:
        for k in (1e9, 1e12):
            f, g = _of(term, geom, n=1.5, k=k), _of(term, geom, n=1.5, k=1e3 * k)
            worst.see(np.where(f > 0, g / np.where(f > 0, f, 1) - 1, 0.0), geom, {"k": k})
    return worst.outcome()


def smooth(term: Model) -> Outcome:
    """The narrowest lobe reflects what a mirror does: Fresnel's reflectance, or its share, at 0° to 60°."""
    angles, names = np.array([0.0, 30.0, 60.0]), term.defaults()
    shape = next((name for name in SMOOTH if name in names), None)
    if {"n", "k"} <= names.keys():
        wanted = fresnel.fresnel(np.cos(np.radians(angles)), names["n"], names["k"])
    elif term.amplitude is not None and term.parameter(term.amplitude).high == 1.0:
        wanted = np.array([names[term.amplitude], np.nan, np.nan])
    else:
        return Outcome(0, 0.0)
    if shape is None or term.base is not None:
        return Outcome(0, 0.0)
    worst = Worst()
    values = {**names, shape: SMOOTH[shape]}
    got = hemisphere.dhr(lambda geom: term(geom, **values), angles)[:, 0]
    known = np.isfinite(wanted)
    worst.see(got[known] / wanted[known] - 1, in_plane(angles[known], 0.0), values)
    return worst.outcome()


def _of(term: Model, geom: Geometry, **values):
    return term(geom, **{**term.defaults(), **values})

"""A fitted surface under audit: the laws at its own parameters, and what a renderer will meet, in sentences."""

import numpy as np

from ..finding import Finding
from ..models.surface import Surface
from ..physics import hemisphere
from ..physics.geometry import in_plane, rows
from . import audit as check
from .checks import jacobian_condition
from .trials import SCAN

ANGLES = (0.0, 15.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, *np.arange(82.0, 90.0), 89.5, 89.9, 89.99)
TURNS_DEG = np.array([0.0, 45.0, 90.0, 135.0])  # of a surface with a grain, from its axis
ENERGY = 1.002  # reflectance above which a surface gains energy; the quadrature is right to 1e-3
COARSE = 2 * hemisphere.STEP  # between nodes: right to 1e-3 for lobes wider than 0.1°
NARROW = 2.0  # full width [deg] below which blind sampling of directions misses a lobe
RIDGE = 1e3  # condition number beyond which single parameters mean little


def audit_fitted(surface: Surface):
    """(checks, findings) of one fitted surface."""
    model, brdf = surface.model, surface.brdf
    breaks = {check: f"{term.label} {why}" for term in model.terms for check, why in term.model.breaks.items()}
    checks = tuple(check.audit_surface(model.name, brdf, breaks))
    findings = (
        *_energy(surface),
        *_exchange(brdf),
        *_rise(brdf),
        *_lobe(brdf),
        *_spike(surface),
        *_bounds(surface),
        *_ridge(surface),
    )
    return checks, findings


def _turns_deg(surface: Surface) -> np.ndarray:
    """Azimuths of the light across the grain, along it and between."""
    of_terms = (surface.values_of(term) for term in surface.model.terms)
    axes = [float(np.mean(values["axis"])) for values in of_terms if "axis" in values]
    return np.degrees(axes[0] if axes else 0.0) + TURNS_DEG


def _energy(surface: Surface):
    """Where more comes out than goes in, mirror reflection included; of a surface with a grain under any turn."""
    if surface.model.turns:
        dhr = hemisphere.dhr_under_turns(surface.brdf, ANGLES, _turns_deg(surface)).max(axis=0)
    else:
        dhr = hemisphere.dhr(surface.brdf, ANGLES, step=COARSE)
    dhr = dhr + surface.mirror(rows(in_plane(np.array(ANGLES), 0.0)))
    most = dhr.max(axis=1)
    too_much = np.flatnonzero(most > ENERGY)
    if not too_much.size:
        place = int(np.argmax(most))
        text = f"never sends more than it receives: at most {most[place]:.3g}, at {ANGLES[place]:g} deg"
        yield Finding(
            "energy-kept", text, numbers=(("greatest_reflectance", float(most[place])), ("theta_i_deg", ANGLES[place]))
        )
        return
    first, place = too_much[0], int(np.argmax(most))
    text = (
        f"gains energy {'at every angle' if first == 0 else f'beyond {ANGLES[max(first - 1, 0)]:g} deg'}: sends "
        f"{most[place]:.3g} times what it receives at {ANGLES[place]:g} deg"
    )
    consequence = (
        "a path tracer brightens at every bounce there; clamp the albedo or choose a bounded law such as ward-gmd or "
        "ggx"
    )
    yield Finding(
        "gains-energy",
        text,
        "warning",
        consequence,
        numbers=(("beyond_deg", ANGLES[max(first - 1, 0)]), ("greatest_reflectance", float(most[place]))),
    )


def _exchange(brdf):
    f, swapped = brdf(SCAN), brdf(SCAN.swapped())
    ratio = float(np.max(np.where(swapped > 1e-12, f / np.maximum(swapped, 1e-12), 1.0)))
    if ratio > 1.001:
        text = f"not reciprocal: exchanging light and eye changes it up to {ratio:.3g} times below 85 deg"
        yield Finding(
            "not-reciprocal",
            text,
            "warning",
            "light and camera tracing will not give the same image",
            numbers=(("greatest_ratio", ratio),),
        )


def _rise(brdf):
    """How the mirror peak still grows where no fit had data."""
    low, high = (float(np.max(brdf(rows(in_plane(np.array([angle]), angle))))) for angle in (75.0, 89.9))
    if low > 0 and high / low > 30:
        text = f"grows {high / low:.3g}-fold from 75 deg to 89.9 deg in the mirror direction"
        yield Finding(
            "steep-rise",
            text,
            "note",
            "bright rims and fireflies on silhouettes; sample by the lobe's own density",
            numbers=(("growth", high / low),),
        )


def _lobe(brdf):
    """The full width of the lobe about its peak at 45°, if it is too narrow for blind sampling."""
    offsets = np.concatenate([-np.geomspace(44, 1e-4, 120), [0.0], np.geomspace(1e-4, 44, 120)])
    f = brdf(rows(in_plane(45.0, 45 + offsets))).max(axis=1)
    above = f > 0.5 * f.max()
    width = float(offsets[above].max() - offsets[above].min())
    if width < NARROW:
        text = f"its lobe at 45 deg is {width:.2g} deg wide"
        yield Finding(
            "narrow-lobe",
            text,
            "note",
            "uniform sampling of directions will miss it; small lights need its own density",
            numbers=(("full_width_deg", width),),
        )


def _spike(surface: Surface):
    if surface.model.has_mirror:
        near, far = (float(np.max(surface.mirror(in_plane([[angle]], angle)))) for angle in (0.0, 80.0))
        if max(near, far) > 1e-6:
            text = f"a mirror reflection of {near:.2g} at the normal and {far:.2g} at 80 deg stands beside the lobe"
            yield Finding(
                "mirror-part", text, "note", "needs a perfect-specular lobe of its own; a finite BRDF cannot show it"
            )


def _bounds(surface: Surface):
    for key, p in surface.model.parameters.items():
        value = np.atleast_1d(surface.values.get(key, p.default))
        for bound, at in ((p.low, value <= p.low), (p.high, value >= p.high)):
            if p.free and np.any(at) and not (p.linear and bound == p.low):  # an amplitude of 0 only says: not needed
                where = f" in {np.count_nonzero(at)} of {value.size} channels" if value.size > 1 else ""
                yield Finding(
                    "at-bound",
                    f"{key} stands at its bound {bound:g}{where}",
                    "note",
                    "the law was stretched to its limit here",
                    subject=key,
                )


def _ridge(surface: Surface):
    """Whether a scan in the plane of incidence tells the parameters apart; the first channel stands for all."""
    first = surface.channel(0)
    values = dict(first.values)
    origins = {
        key: p.origin
        for key, p in surface.model.parameters.items()
        if (p.free or key in surface.model.free) and values.get(key, 0.0) != p.origin
    }
    number = jacobian_condition(lambda v: first.model(SCAN.at(first.wavelength), v), values, origins)
    if number > RIDGE:
        text = f"its parameters cannot be told apart: condition number {number:.2g}"
        yield Finding(
            "ridge", text, "warning", "move them together; a single one means little", numbers=(("condition", number),)
        )

"""How far a pruned model can be trusted: outside the angles it was pruned for, beyond the data it was fitted to."""

from collections.abc import Mapping

import numpy as np

from .geometry import Geometry
from .measurement import Finding
from .models._base import Sum
from .quadrature import Quadrature
from .scene import Scene

SLACK_DEG = 2.5  # half the step of a usual goniometer scan


def at_bounds(pruned: Sum, values: Mapping) -> tuple[Finding, ...]:
    """Refitted amplitudes that would go on if they could."""
    stuck = [key for key, p in pruned.parameters.items() if p.linear and p.high > 0 and np.any(np.asarray(values[key]) >= p.high * (1 - 1e-9))]
    return tuple(
        Finding("refit-at-bound", f"{key}, refitted over the scene, reached its bound {pruned.parameters[key].high:g}", "warning", "the error could be smaller with more room")
        for key in stuck
    )


def strays(scene: Scene, moved) -> tuple[Finding, ...]:
    """A warning where the tolerance is lost once camera and lights stray by 10 %."""
    if all(errors.within(scene.tolerance) for errors in moved):
        return ()
    worst = max(errors.visible for errors in moved)
    text = f"with camera and lights 10 % off the stated angles the difference reaches {worst:.2g} JND at worst"
    return (Finding("scene-may-stray", text, "warning", "keep to the box of angles", "camera_moves: true in the scene", (("worst_jnd", worst),)),)


def beyond_data(quadrature: Quadrature, data: Geometry | None) -> tuple[Finding, ...]:
    """A warning where the scene looks at angles that the values were not fitted to; there the whole model is a guess too."""
    if data is None:
        return ()
    scene = quadrature.centres
    lit = scene.lit & (np.repeat(quadrature.weights, quadrature.to_lights.shape[1]) > 0)
    share = np.repeat(quadrature.weights, quadrature.to_lights.shape[1])[lit]
    scene = scene[lit]
    found = []
    outside = np.zeros(len(share), bool)
    for name in ("theta_i_deg", "theta_r_deg"):
        angle, measured = getattr(scene, name), getattr(data, name)
        low, high = float(np.min(measured)), float(np.max(measured))
        missed = (angle < low - SLACK_DEG) | (angle > high + SLACK_DEG)
        outside |= missed
        if missed.any():
            found.append(f"{name} {angle.min():.0f}..{angle.max():.0f} against {low:.0f}..{high:.0f}")
    if np.all(data.off_plane_deg < 0.1) and np.any(scene.off_plane_deg > SLACK_DEG):
        outside |= scene.off_plane_deg > SLACK_DEG
        found.append("directions out of the plane of incidence, none of which were measured")
    if not found:
        return ()
    part = float(share[outside].sum() / share.sum())
    text = f"{part:.0%} of the picture lies beyond the measured directions: {'; '.join(found)}"
    return (Finding("scene-beyond-data", text, "warning", "there the whole model, not only what is left of it, is an extrapolation", "", (("share", part),)),)

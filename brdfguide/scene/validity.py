"""How far a pruned model can be trusted: outside the angles it was pruned for, beyond the data it was fitted to."""

import numpy as np

from ..finding import Finding
from ..models.cost import Time
from ..models.surface import Surface
from ..physics.geometry import Geometry
from .radiance import Quadrature
from .scene import Scene

SLACK_DEG = 2.5  # half the step of a usual goniometer scan


def at_bounds(pruned: Surface) -> tuple[Finding, ...]:
    """Refitted amplitudes that would go on if they could."""
    parameters = pruned.model.parameters
    stuck = [
        key
        for key, p in parameters.items()
        if p.linear and p.high > 0 and np.any(np.asarray(pruned.values[key]) >= p.high * (1 - 1e-9))
    ]
    return tuple(
        Finding(
            "refit-at-bound",
            f"{key}, refitted over the scene, reached its bound {parameters[key].high:g}",
            "warning",
            "the error could be smaller with more room",
        )
        for key in stuck
    )


def of_perturbed_views(scene: Scene, moved) -> tuple[Finding, ...]:
    """A warning where the tolerance is lost once camera and lights are perturbed by 10 %."""
    if all(errors.within(scene.tolerance) for errors in moved.values()):
        return ()
    worst = max(errors.visible for errors in moved.values())
    text = f"with camera and lights 10 % off the stated angles the difference reaches {worst:.2g} JND at worst"
    return (
        Finding(
            "scene-may-stray",
            text,
            "warning",
            "keep to the box of angles",
            "camera_moves: true in the scene",
            (("worst_jnd", worst),),
        ),
    )


def unsettled(scene: Scene, convergence: float, pixels: int) -> tuple[Finding, ...]:
    """A note where more pixels would still change the numbers that decide."""
    if convergence <= 0.5 * max(scene.tolerance.worst, scene.tolerance.p95):
        return ()
    text = f"with {pixels} pixels the errors near the tolerance are known to about {convergence:.2g} JND"
    return (
        Finding(
            "scene-not-converged",
            text,
            consequence="the check on fresh directions is what to go by",
            numbers=(("change_jnd", convergence),),
        ),
    )


def beyond_data(quadrature: Quadrature, data: Geometry | None) -> tuple[Finding, ...]:
    """A warning where the scene looks at angles that nothing was fitted to; there the whole model is a guess too."""
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
    return (
        Finding(
            "scene-beyond-data",
            text,
            "warning",
            "there the whole model, not only what is left of it, is an extrapolation",
            "",
            (("share", part),),
        ),
    )


def over_budget(scene: Scene, time: Time, front) -> tuple[Finding, ...]:
    """What the scene's budget would buy, where the pick costs more."""
    if scene.budget_ns is None or time.ns <= scene.budget_ns:
        return ()
    cheap = min(
        (each for each in front if each.time.ns <= scene.budget_ns), key=lambda each: each.errors.visible, default=None
    )
    says = (
        f"{cheap} it would, and differ by {cheap.errors.visible:.2g} JND at worst"
        if cheap
        else "no part of the model does"
    )
    return (
        Finding(
            "over-budget",
            f"{time.ns:.0f} ns per evaluation do not fit the budget of {scene.budget_ns:g}; {says}",
            "warning",
        ),
    )

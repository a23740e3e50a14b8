"""Gloss readings and the lobes behind them, as documents."""

from ... import models
from ...models.surface import Surface
from ...models.visible_change import begins_to_show
from ...physics import gloss as meter

SCHEMA = "brdfguide/gloss/1"
ALONE_N = 1.5  # index of a dielectric of which nothing is known


def of_lobes(alpha: float, n: float | None, albedo: float, lobes) -> dict:
    """What a glossmeter reads of each lobe."""
    n = n or ALONE_N
    units = {
        lobe: {
            str(angle): meter.facet_units(angle, alpha, n, lobe) + albedo * meter.DIFFUSE[angle]
            for angle in meter.ANGLES
        }
        for lobe in lobes
    }
    shows = {lobe: alpha_shows_from(lobe, alpha, n, albedo) for lobe in lobes}
    return {
        "schema": SCHEMA,
        "alpha": alpha,
        "n": n,
        "albedo": albedo,
        "gloss_gu": units,
        "alpha_shows_from": shows,
    }


def alpha_shows_from(lobe: str, alpha: float, n: float, albedo: float) -> float | None:
    """The share by which the lobe has to widen on this body until it shows."""
    values = {"lambertian.albedo": albedo, f"{lobe}.alpha": alpha, f"{lobe}.n": n}
    surface = Surface(models.get(f"lambertian+{lobe}"), values)
    return begins_to_show(surface, [f"{lobe}.alpha"])[f"{lobe}.alpha"]


def of_readings(readings: dict[int, float], n: float | None, albedo: float, lobes) -> dict:
    """The lobes that give these readings [GU] by angle, with what each would give."""
    fits = [meter.roughness_from(readings, n, lobe, albedo) for lobe in lobes]
    return {
        "schema": SCHEMA,
        "albedo": albedo,
        "readings_gu": {str(angle): value for angle, value in readings.items()},
        "agrees": min(fits, key=lambda each: each.worst).agrees,
        "fits": [
            {
                "lobe": fit.lobe,
                "alpha": fit.alpha,
                "alpha_shows_from": alpha_shows_from(fit.lobe, fit.alpha, fit.n, albedo),
                "n": fit.n,
                "sigma_over_tau": fit.alpha / 2,
                "phong_exponent": max(0.0, (2 / fit.alpha**2 - 2) / 4),
                "agrees": fit.agrees,
                "worst_in_tolerances": fit.worst,
                "predicted_gu": {str(angle): value for angle, value in fit.predicted.items()},
                "alpha_of_each": {str(angle): value for angle, value in fit.each.items()},
            }
            for fit in fits
        ],
    }

"""From the angles at which a mirror image emerges along and across a grain to one height and two correlation lengths.

A Gaussian surface has one sigma, whichever way it is turned, and in the mirror direction its lobe is as high from all
azimuths (`he-torrance-aniso`): the criterion of `emergence` holds with tau_x tau_y for tau², and what differs between
both azimuths is the shadowing alone, which knows the slope in the plane of incidence:

    Ein(g_n) = λ²/(π tau_x tau_y cos θn Ω),   g_n = (4π σ_n cos θn/λ)²,   σ_n = sigma effective(sigma/tau_n, θn)

across the grain with tau_x at one angle, along it with tau_y at the other. Slopes below 0.1 shadow nothing before 80°,
and the angles then differ by less than an eye reads. Source: ours, after He et al. 1991. `math` alone, as `emergence`.
"""

from math import exp, inf, log, pi

from ..errors import NoAnswer
from .emergence import (
    LEAST_SIGMA,
    MOST_SIGMA,
    OMEGA,
    STEEPEST,
    WAVELENGTH,
    cos_of_degrees,
    effective,
    ln_ein,
    ln_target,
    sign_change,
    tau_for_sigma,
)

SEEN_DEG = 0.01  # what is less is no difference
MOST_RATIO = 100.0  # tau_y/tau_x, as in the laws with a grain
STEPS = 60  # of the ratio's logarithm, between which an angle is taken to bend once
SAME = 1e-6  # deg, by which both angles may differ and be one


def both_lengths(
    along_deg: float,
    across_deg: float,
    slope: float | None = None,
    sigma: float | None = None,
    wavelength: float = WAVELENGTH,
    omega: float = OMEGA,
) -> tuple[float, float, float]:
    """(sigma, tau_x, tau_y) [µm], x across the grain, where the image emerges at `along_deg` with the plane of
    incidence along the grooves and at `across_deg` across them: the least ratio of both lengths that does it.

    Beside both angles one number is known: `slope`, sigma/tau_x, or else `sigma` [µm]. Raises NoAnswer where no ratio
    up to 100 gives such angles, and says which slopes would.
    """

    def surface(ratio: float) -> tuple[float, float, float]:
        return _at_ratio(across_deg, ratio, slope, sigma, wavelength, omega)

    def miss(ln_ratio: float) -> float:
        return _excess(along_deg, *surface(exp(ln_ratio)), wavelength, omega)

    if abs(along_deg - across_deg) <= SAME:
        return surface(1.0)
    before, value = 0.0, miss(0.0)
    for step in range(1, STEPS + 1):
        here = log(MOST_RATIO) * step / STEPS
        there = miss(here)
        if (value < 0) != (there < 0):
            return surface(exp(sign_change(miss, before, here)))
        before, value = here, there
    raise NoAnswer(_why_not(along_deg, across_deg, slope, wavelength, omega))


def most_difference(across_deg: float, slope: float, wavelength: float = WAVELENGTH, omega: float = OMEGA) -> float:
    """By how much later [deg] than across the grain an image can emerge along it, over ratios of 1 to 100."""
    latest = 0.0
    for step in range(STEPS + 1):
        found = _at_ratio(across_deg, MOST_RATIO ** (step / STEPS), slope, None, wavelength, omega)
        if _excess(across_deg + latest, *found, wavelength, omega) > 0:
            latest = max(latest, _angle_along(*found, wavelength, omega) - across_deg)
    return latest


def _at_ratio(across_deg, ratio, slope, sigma, wavelength, omega) -> tuple[float, float, float]:
    """The surface of this ratio whose image emerges across the grain at this angle."""
    target = ln_target(across_deg, wavelength, omega) - log(ratio)
    if sigma is not None:
        # Ein by tau_x tau_y = ratio tau_x²: the criterion of a surface without a grain, seen by another pupil
        tau = tau_for_sigma(across_deg, sigma, wavelength, omega * ratio)
        return sigma, tau, ratio * tau
    share = (4 * pi * effective(slope, across_deg) * cos_of_degrees(across_deg) / wavelength) ** 2

    def miss(ln_sigma: float) -> float:
        return ln_ein(share * exp(2 * ln_sigma))[0] + 2 * (ln_sigma - log(slope)) - target

    found = exp(sign_change(miss, log(LEAST_SIGMA), log(MOST_SIGMA)))
    return found, found / slope, ratio * found / slope


def _excess(along_deg, sigma, tau_x, tau_y, wavelength, omega) -> float:
    """ln of diffuse over mirror light along the grain: above 0 before the image has emerged."""
    own = sigma * effective(sigma / tau_y, along_deg) * cos_of_degrees(along_deg)
    value = ln_ein((4 * pi * own / wavelength) ** 2)[0]
    return value + log(tau_x) + log(tau_y) - ln_target(along_deg, wavelength, omega)


def _angle_along(sigma, tau_x, tau_y, wavelength, omega) -> float:
    """The angle [deg] at which the image emerges along the grain; 89.9 where it does not below."""

    def excess(degrees: float) -> float:
        return _excess(degrees, sigma, tau_x, tau_y, wavelength, omega)

    return 89.9 if excess(89.9) > 0 else sign_change(excess, 0.0, 89.9)


def _why_not(along_deg, across_deg, slope, wavelength, omega) -> str:
    """Why no ratio gives these angles, and what would."""
    told = f"along the grain at {along_deg:g} deg, across it at {across_deg:g}"
    if across_deg > along_deg:
        return f"{told}: steeper slopes shadow more and let the image emerge sooner: were the two exchanged?"
    if slope is None:
        return f"{told}: with this sigma no two correlation lengths do that"
    wanted = along_deg - across_deg
    most = most_difference(across_deg, slope, wavelength, omega)
    apart = "do not differ" if most < SEEN_DEG else f"differ by at most {most:.2g} deg"
    allowed = f"{told}: at sigma/tau {slope:g} across the grain the two {apart}"
    steeper = [step / 20 for step in range(1, 21) if slope < step / 20 <= STEEPEST]
    enough = (each for each in steeper if most_difference(across_deg, each, wavelength, omega) >= wanted)
    least = next(enough, inf)
    if least < inf:
        return f"{allowed}; from a slope of {least:g} on (--slope) they do"
    return (
        f"{allowed}, and no slope up to 1 makes it {wanted:.3g}: one height has one mirror image in all azimuths, and "
        f"only shadowing tells them apart"
    )

"""From the angle at which a mirror image emerges to the roughness behind it: sigma and tau [µm].

The report offers an empirical formula, sigma = C/(tau^0.7 + 6) with C from Table 2 (Westin et al. 2004, Eq. 3), fitted
to contours of its Figure 14. Those contours are where He and Torrance's specular and directional diffuse reflection in
the mirror direction are equal; index, shadowing and subsurface light drop out of that and leave

    Ein(g) = λ²/(π tau² cos θ Ω),   Ein(g) = Ei(g) - ln g - γ = Σ g^m/(m m!),   g = (4π σ cos θ/λ)²
    σ² = sigma²/(1 + W(K²/8π)),   K = 2 tan θ erfc(tau cot θ/(2 sigma))            (He et al. 1991, Eqs. 70-83)

with Ω [sr] the solid angle that the eye takes in. Table 2 fits Ω = π (1.5 mm/0.6 m)², a pupil at arm's length, the
default here; its row at 85° does not, and is 20 to 25 % low. Written with `math` alone, since shell loops call it.
"""

from itertools import pairwise
from math import cos, erfc, exp, expm1, inf, isfinite, log, log1p, pi, radians, sin, sqrt

from ..errors import InputError, NoAnswer

WAVELENGTH = 0.55  # µm, as in the report
PUPIL_MM = 3.0  # diameter, as Table 2 has it
DISTANCE_MM = 600.0  # of the eye: an arm's length
LEAST_PUPIL_MM = 1e-3  # below this and beyond the next the numbers mean nothing
MOST_DISTANCE_MM = 1e9
TABLE_2 = ((15, 1.1), (45, 1.6), (60, 2.4), (75, 5.5), (80, 9.0), (85, 20.0))  # angle [deg], C
TAU_LOW = 0.5  # µm, where the abscissa of Figure 14 begins
TAU_HIGH = 50.0  # µm, where it ends
LEAST_SIGMA = 1e-7  # µm, where a search for sigma begins
MOST_SIGMA = 1e7  # µm, where it ends
STEEPEST = 1.0  # sigma/tau beyond which the theory does not hold (shaded in Figure 14)


def pupil_solid_angle(pupil_mm: float = PUPIL_MM, distance_mm: float = DISTANCE_MM) -> float:
    """What a pupil takes in at a distance [sr]. Raises InputError unless 0.001 mm <= pupil < distance <= 1000 km."""
    if not LEAST_PUPIL_MM <= pupil_mm < distance_mm <= MOST_DISTANCE_MM:
        raise InputError(
            f"pupil {pupil_mm:g} mm at {distance_mm:g} mm: the pupil has at least {LEAST_PUPIL_MM:g} mm, the distance "
            f"at most {MOST_DISTANCE_MM:g} mm, the pupil the smaller"
        )
    return pi * (0.5 * pupil_mm / distance_mm) ** 2


OMEGA = pupil_solid_angle()


# --- Eq. 3 -------------------------------------------------------------------------------------------


def eq3_constant(angle_deg: float) -> float:
    """C of Eq. 3: Table 2, between its angles ln C linear in ln(1/cos θ) (ours; 1.5 % where the table itself is right).

    Below 15° the first segment is continued, to 1 %. Raises NoAnswer beyond 85°, where the formula itself fails.
    """
    _check_angle(angle_deg)
    if angle_deg > TABLE_2[-1][0]:
        raise NoAnswer(f"Eq. 3 ends at 85 deg: Table 2 has no C for {angle_deg:g}")
    (low, c_low), (high, c_high) = next(pair for pair in pairwise(TABLE_2) if angle_deg <= pair[1][0])
    x_low, x_high, x = (-log(cos_of_degrees(angle)) for angle in (low, high, angle_deg))
    share = (x - x_low) / (x_high - x_low)
    if share in (0, 1):  # the table's own digits
        return c_high if share else c_low
    return exp(log(c_low) + share * log(c_high / c_low))


def formula_sigma(angle_deg: float, tau: float, wavelength: float = WAVELENGTH) -> float:
    """sigma by Eq. 3. Only sigma/λ and tau/λ matter, so other wavelengths scale both."""
    scale = wavelength / WAVELENGTH
    sigma = scale * eq3_constant(angle_deg) / ((tau / scale) ** 0.7 + 6)
    return _within(sigma, tau, scale)[0]


def formula_tau(angle_deg: float, sigma: float, wavelength: float = WAVELENGTH) -> float:
    """tau by Eq. 3, which has one only for sigma < C/6."""
    scale = wavelength / WAVELENGTH
    rest = eq3_constant(angle_deg) * scale / sigma - 6
    if rest <= 0:
        raise NoAnswer(
            f"Eq. 3 has no tau for sigma = {sigma:g} um: at {angle_deg:g} deg sigma stays below C/6 = "
            f"{scale * eq3_constant(angle_deg) / 6:.3g} um"
        )
    return _within(sigma, scale * rest ** (1 / 0.7), scale)[1]


def formula_crossing(angle_deg: float, slope: float, wavelength: float = WAVELENGTH) -> tuple[float, float]:
    """(sigma, tau) where Eq. 3 meets sigma/tau = slope."""
    _check_slope(slope)
    scale, c = wavelength / WAVELENGTH, eq3_constant(angle_deg)
    tau = scale * exp(sign_change(lambda x: x + log(exp(0.7 * x) + 6) - log(c / slope), -15.0, 15.0))
    return _within(slope * tau, tau, scale)


def formula_angle(sigma: float, tau: float, wavelength: float = WAVELENGTH) -> float:
    """The angle [deg] at which Eq. 3 passes through (sigma, tau)."""
    scale = wavelength / WAVELENGTH
    _within(sigma, tau, scale)
    c = sigma / scale * ((tau / scale) ** 0.7 + 6)
    if not eq3_constant(0.0) <= c <= TABLE_2[-1][1]:
        raise NoAnswer(
            f"Eq. 3 needs C = {c:.3g} for sigma = {sigma:g}, tau = {tau:g} um: Table 2 goes from "
            f"{eq3_constant(0.0):.3g} to 20"
        )
    return sign_change(lambda angle: log(eq3_constant(angle) / c), 0.0, float(TABLE_2[-1][0]))


def _within(sigma, tau, scale):
    """(sigma, tau), if Eq. 3 was ever meant for them."""
    if sigma / tau > STEEPEST:
        raise NoAnswer(f"Eq. 3 gives sigma/tau = {sigma / tau:.3g}: beyond 1 the theory does not hold")
    if not TAU_LOW * scale * (1 - 1e-12) <= tau <= TAU_HIGH * scale * (1 + 1e-12):
        raise NoAnswer(
            f"Eq. 3 gives tau = {tau:.3g} um: it was fitted for {TAU_LOW * scale:.3g} to {TAU_HIGH * scale:.3g} um"
        )
    return sigma, tau


# --- the criterion itself ----------------------------------------------------------------------------


def crossing(
    angle_deg: float, slope: float, wavelength: float = WAVELENGTH, omega: float = OMEGA, near: float | None = None
) -> tuple[float, float]:
    """(sigma, tau) where the contour of this angle meets sigma/tau = slope: one point at every angle in 0..90.

    With `near`, a tau close by, sooner and to 1e-6 only.
    """
    _check_slope(slope)
    target = ln_target(angle_deg, wavelength, omega)
    share = slope * effective(slope, angle_deg) * cos_of_degrees(angle_deg)
    # ln Ein + 2 ln tau is convex in ln tau and Ein >= g, so Newton from where Ein is taken for g comes down to the root
    x = 0.25 * (target - 2 * log(4 * pi * share / wavelength)) if near is None else log(near)
    exact = 1e-15 if near is None else 1e-4
    for _ in range(100):
        g = (4 * pi * share / wavelength * exp(x)) ** 2
        if g > 1e4:  # still far to the right
            x -= 0.5 * log(g / 1e4) + 1e-3
            continue
        value, rate = ln_ein(g)
        step = (value + 2 * x - target) / (2 * rate + 2)
        x -= step
        if abs(step) < exact * max(1.0, abs(x)):
            break
    return slope * exp(x), exp(x)


def sigmas_for_tau(
    angle_deg: float, tau: float, wavelength: float = WAVELENGTH, omega: float = OMEGA
) -> tuple[float, ...]:
    """Every sigma on the contour at this tau, smallest first: one below 88.68°, up to three beyond."""
    wanted = log(_effective_sigma(angle_deg, tau, wavelength, omega) / tau)

    def miss(x):
        return x + log(effective(exp(x), angle_deg)) - wanted

    if angle_deg < 88.6:  # grows with sigma, and the effective roughness is the smaller one
        low = wanted - 1e-9
        high = low + 1
        while miss(high) < 0:
            high += 1
        return (tau * exp(sign_change(miss, low, high)),)
    steps = [wanted - 1e-9 + 0.02 * step for step in range(600)]
    values = [miss(x) for x in steps]
    places = [place for place in range(len(steps) - 1) if (values[place] < 0) != (values[place + 1] < 0)]
    return tuple(tau * exp(sign_change(miss, steps[place], steps[place + 1])) for place in places)


def tau_for_sigma(angle_deg: float, sigma: float, wavelength: float = WAVELENGTH, omega: float = OMEGA) -> float:
    """The tau on the contour at this sigma: one at every angle. Raises NoAnswer where sigma/tau would exceed 100."""
    target = ln_target(angle_deg, wavelength, omega)

    def miss(x):
        g = (4 * pi * sigma * effective(sigma / exp(x), angle_deg) * cos_of_degrees(angle_deg) / wavelength) ** 2
        return ln_ein(g)[0] + 2 * x - target

    low = log(sigma / 100)
    if miss(low) > 0:
        raise NoAnswer(f"the criterion has no tau above {exp(low):.3g} um for sigma = {sigma:g} um")
    high = low + 4
    while miss(high) < 0:
        high += 4
    return exp(sign_change(miss, low, high))


def emergence_angle(sigma: float, tau: float, wavelength: float = WAVELENGTH, omega: float = OMEGA) -> float | None:
    """Angle [deg] from which the mirror image stands out; 0 if it always does, None if it does not below 89.9°."""

    def excess(angle_deg):
        g = (4 * pi * sigma * effective(sigma / tau, angle_deg) * cos_of_degrees(angle_deg) / wavelength) ** 2
        return ln_ein(g)[0] + 2 * log(tau) - ln_target(angle_deg, wavelength, omega)

    if excess(0.0) <= 0:
        return 0.0
    if excess(89.9) > 0:
        return None
    return sign_change(excess, 0.0, 89.9)


def contour(angle_deg: float, taus, wavelength: float = WAVELENGTH, omega: float = OMEGA) -> list[tuple[float, float]]:
    """(tau, sigma) along the contour, as Figure 14 draws it."""
    return [(tau, sigma) for tau in taus for sigma in sigmas_for_tau(angle_deg, tau, wavelength, omega)]


def tau_steps(wavelength: float = WAVELENGTH, per_decade: int = 20) -> list[float]:
    """tau over the abscissa of Figure 14, evenly spaced in its logarithm."""
    return [wavelength / WAVELENGTH * TAU_LOW * 10 ** (step / per_decade) for step in range(2 * per_decade + 1)]


def effective(slope: float, angle_deg: float) -> float:
    """Effective over true roughness where light and eye are both at this angle: 1 seen steeply, less at grazing."""
    cot = cos_of_degrees(angle_deg) / max(sin(radians(angle_deg)), 1e-300)
    spread = 2 / cot * erfc(0.5 * cot / slope) if cot < 60 * slope else 0.0
    return 1 / sqrt(1 + _lambert_w(spread * spread / (8 * pi)))


def ln_ein(g: float) -> tuple[float, float]:
    """ln Ein(g) and its derivative by ln g, (e^g - 1)/Ein, for g > 0."""
    if g < 50:
        term = total = g
        m = 1
        while term > 1e-17 * total:
            m += 1
            term *= g / m
            total += term / m
        return log(total), expm1(g) / total
    term = total = 1.0
    m = 0
    while term > 1e-17:  # the smallest term, at m = g, is below e^-50
        m += 1
        term *= m / g
        total += term
    return g - log(g) + log(total), g / total


def _effective_sigma(angle_deg, tau, wavelength, omega):
    """The effective roughness that the criterion asks for, from Ein inverted by Newton; ln Ein is convex in ln g."""
    target = ln_target(angle_deg, wavelength, omega) - 2 * log(tau)
    x = target if target < 1 else log(target + 2 * log(target) + 2)
    for _ in range(100):
        value, rate = ln_ein(exp(x))
        step = (value - target) / rate
        x -= step
        if abs(step) < 1e-15 * max(1.0, abs(x)):
            break
    return wavelength * exp(0.5 * x) / (4 * pi * cos_of_degrees(angle_deg))


def ln_target(angle_deg, wavelength, omega):
    """ln of tau² Ein(g) on the contour."""
    _check_angle(angle_deg)
    return log(wavelength**2 / (pi * cos_of_degrees(angle_deg) * omega))


def _lambert_w(z):
    """W with W e^W = z >= 0; as in `special`, for one number."""
    p = log1p(z)
    w = p * (1 - log1p(p) / (2 + p))
    for _ in range(2):
        miss = w - z * exp(-w)
        w -= miss / (1 + w - miss * (2 + w) / (2 + 2 * w))
    return w


def cos_of_degrees(degrees):
    """cos of an angle [deg], exact at 90."""
    return sin(radians(90.0 - degrees)) if degrees > 45 else cos(radians(degrees))


def _check_angle(angle_deg):
    if not (isfinite(angle_deg) and 0 <= angle_deg < 90):
        raise InputError(f"angle {angle_deg:g} deg: an angle of emergence lies in 0 <= angle < 90, from the normal")


def _check_slope(slope):
    if not 0 < slope < inf:
        raise InputError(f"slope {slope:g}: sigma/tau is a number above 0")
    if slope > STEEPEST:
        raise NoAnswer(
            f"sigma/tau = {slope:g}: beyond 1 the theory does not hold, and neither Eq. 3 nor the criterion answers"
        )


def sign_change(f, low, high):
    """Where `f` changes sign between `low` and `high`: regula falsi with halving (Illinois), to the last digits."""
    f_low, f_high = f(low), f(high)
    kept = 0
    for _ in range(200):
        if f_low == f_high:
            break
        x = (low * f_high - high * f_low) / (f_high - f_low)
        if not min(low, high) < x < max(low, high):
            break
        value = f(x)
        if value == 0:
            return x
        if (value < 0) == (f_low < 0):
            low, f_low = x, value
            f_high, kept = (0.5 * f_high, 1) if kept == 1 else (f_high, 1)
        else:
            high, f_high = x, value
            f_low, kept = (0.5 * f_low, -1) if kept == -1 else (f_low, -1)
        if abs(high - low) <= 4e-16 * max(1.0, abs(x)) or abs(value) < 1e-15:
            return x
    return low if abs(f_low) < abs(f_high) else high

"""How rough it looks, and what a roughness means: bounds, colours, contradictions of the look (section 5.2).

Widths are alpha, √2 times the rms slope along a line: alpha = 2 sigma/tau for a Gaussian correlation. What was read is
in `joint`; here the look fills what is left.
"""

from math import atan, degrees, exp, log, log1p, pi, sqrt

from ...errors import NoAnswer
from ...physics import emergence
from ..material import Material
from ..profile import height_of, kept, length_of
from .guideline import Advice, rule

# The widths whose lobe of n = 1.5 reads 87, 27, 9 and 2 units at 60°: what the trade calls so (ours).
WIDTH_OF = {"high gloss": 0.012, "satin": 0.065, "low gloss": 0.15, "matt": 0.35}
TYPICAL_SLOPE = 0.1  # the report's assumption where nothing tells (section 5.2)
LEAST_KEPT = 0.5  # of the variance, below which a profile's cut-offs hide the surface (ours)
SMOOTH_UM = 0.02  # the report's limit of "perfectly smooth" (section 3.2.2)


def wavelength(material: Material) -> float:
    return material.wavelength or emergence.WAVELENGTH


@rule("5.2")
def slopes_of_stylus(material: Material) -> Advice | None:
    """What sigma over tau of a profile is called, and which scales it holds."""
    slope = _observed_slope(material)
    if slope is None:
        return None
    says = (
        f"sigma/tau = {slope:.3g}, which other instruments print as an rms slope of {sqrt(2) * slope:.3g} (Rdq) or "
        f"{2 * slope:.3g} (Sdq), and shaders as alpha = {2 * slope:.3g}"
    )
    band = "no cut-off given; light sees the finest, steepest scale, which a long cut-off hides"
    return Advice(says, f"stylus; {f'cut-off {material.cutoff:.4g} µm' if material.cutoff else band}")


@rule("5.2")
def numbers_of_a_workshop(material: Material) -> Advice | None:
    """Ra, RSm, Rdq and TIS as rms height and correlation length, with what that takes for granted."""
    told = [known for known in (height_of(material.given), length_of(material.given)) if known and known.how]
    if not told:
        return None
    return Advice("; ".join(known.how for known in told), ", ".join(known.key for known in told))


@rule("5.2")
def cut_offs(material: Material) -> Advice | None:
    """Which part of the heights a profile's cut-offs keep, and which waves the light sees of them."""
    stylus = material.given.get("stylus", {})
    share = kept(stylus, material.tau) if material.tau else None
    if share is None:
        return None
    says = (
        f"its cut-offs keep {share:.0%} of the variance of a Gaussian correlation of {material.tau:.3g} µm; light sees "
        f"waves longer than {wavelength(material):.3g} µm"
    )
    return Advice(says, "cut-offs of the stylus", conflict=share < LEAST_KEPT)


def _observed_slope(material: Material) -> float | None:
    """sigma over tau where a stylus gave both."""
    if not (material.sigma and material.tau) or {"sigma", "tau"} & material.filled_by.keys():
        return None
    return material.sigma / material.tau


@rule("5.2, Table 2")
def formula_beside_criterion(material: Material) -> Advice | None:
    """The report's Eq. 3 beside the criterion it was fitted to; at 85° its table is 20 to 25 % low."""
    if material.emergence is None or material.slope is None or not 15 <= degrees(material.emergence) <= 85:
        return None
    angle = degrees(material.emergence)
    try:
        sigma, tau = emergence.formula_crossing(angle, material.slope, wavelength(material))
    except NoAnswer:
        return None
    exact, _ = emergence.crossing(angle, material.slope, wavelength(material), material.solid_angle)
    return Advice(
        f"the report's short formula would give sigma {sigma:.3g} µm, tau {tau:.3g} µm: {sigma / exact - 1:+.0%}",
        f"emergence at {angle:g}°",
    )


@rule("5.2")
def never_a_mirror_image(material: Material) -> Advice | None:
    """No mirror image at any angle: sigma lies above the contour of 85°."""
    if material.emerges is not False:
        return None
    slope = material.alpha / 2 if material.alpha else material.slope or TYPICAL_SLOPE
    least = None
    if 1e-3 <= slope <= emergence.STEEPEST:
        least = emergence.crossing(85, slope, wavelength(material), material.solid_angle)[0]
    if least is None:
        return Advice("no mirror term", "no mirror image at any angle", drops={"mirror": "no mirror image was seen"})
    says = (
        f"sigma above {least:.2g} µm at sigma/tau = {slope:.3g}; a bright body hides an image earlier, so this bound "
        f"is soft"
    )
    return Advice(says, "no mirror image at any angle", drops={"mirror": "no mirror image was seen"})


@rule("5.2")
def emergence_on_matt(material: Material) -> Advice | None:
    """A mirror image that shows near the normal contradicts a matt finish; one near grazing does not."""
    if material.emergence is None or material.finish not in ("matt", "low gloss") or degrees(material.emergence) >= 75:
        return None
    says = f"a mirror image from {degrees(material.emergence):g}° on, yet said to be {material.finish}"
    return Advice(says, "emergence against finish", conflict=True)


@rule("5.2")
def mirror_that_never_shows(material: Material) -> Advice | None:
    """A mirror finish shows its image at every angle."""
    if material.finish not in ("mirror", "high gloss"):
        return None
    if material.emerges is False:
        observed = "never seen"
    elif material.emergence is not None and degrees(material.emergence) > 45:
        observed = f"seen only from {degrees(material.emergence):g}° on"
    else:
        return None
    says = f"a {material.finish} finish shows its mirror image near the normal, yet it is {observed}"
    return Advice(says, "finish against emergence", conflict=True)


@rule("5.2")
def finish_against_width(material: Material) -> Advice | None:
    """The look and the measured width must be of one sort."""
    if material.finish is None or material.alpha is None or material.under_a_coat:
        return None
    if material.sigma is not None and (4 * pi * material.sigma / wavelength(material)) ** 2 < 20:
        return None  # a mirror image covers the lobe, whose width the eye does not see
    alpha, usual = material.alpha, 0.005 if material.finish == "mirror" else WIDTH_OF[material.finish]
    if 1 / 5 <= alpha / usual <= 5 or (material.finish == "mirror" and alpha < usual):
        return None
    nearest = min(WIDTH_OF, key=lambda finish: abs(log(WIDTH_OF[finish] / alpha)))
    if nearest == material.finish or (nearest == "high gloss" and alpha < usual and material.finish != "matt"):
        return None  # sharper than the usual high gloss
    says = f"said to be {material.finish}, yet alpha = {alpha:.3g} is {nearest}"
    return Advice(says, "finish against the measured width", conflict=True)


@rule("5.2")
def width_from_finish(material: Material) -> Advice | None:
    """No measurement: the width that looks so."""
    if material.alpha is not None or material.slope is not None or material.finish not in WIDTH_OF:
        return None
    alpha = WIDTH_OF[material.finish]
    return Advice(f"alpha = {alpha:g}", f"a {material.finish} finish", sets={"alpha": alpha}, guess=True)


@rule("5.2")
def width_from_slope(material: Material) -> Advice | None:
    """alpha = 2 sigma/tau, for a Gaussian correlation; and the slope from a width."""
    if material.alpha is None and material.slope is not None:
        return Advice(f"alpha = {2 * material.slope:.3g}", "twice sigma/tau", sets={"alpha": 2 * material.slope})
    if material.alpha is not None and material.slope is None:
        return Advice(f"sigma/tau = {material.alpha / 2:.3g}", "half of alpha", sets={"slope": material.alpha / 2})
    return None


@rule("5.2")
def usual_width(material: Material) -> Advice | None:
    """Nothing says how rough: a satin width, which is a guess."""
    if material.alpha is not None or material.finish == "mirror":
        return None
    return Advice(
        "alpha = 0.15, for want of a finish, a glossmeter or a highlight's width",
        "nothing observed about roughness",
        sets={"alpha": 0.15, "slope": 0.075},
        guess=True,
    )


@rule("3.2.2, Eq. 1")
def smooth_limit(material: Material) -> Advice | None:
    """The report calls less than 0.02 µm perfectly smooth; Eq. 1 says what is lost."""
    if material.sigma is None or material.sigma > 0.1:
        return None
    g = (4 * pi * material.sigma / wavelength(material)) ** 2
    at_limit = 1 - exp(-((4 * pi * SMOOTH_UM / wavelength(material)) ** 2))
    says = (
        f"roughness of {material.sigma:.3g} µm takes {1 - exp(-g):.1%} of the light from the mirror image, seen "
        f"straight on; what the report calls smooth, {SMOOTH_UM} µm, takes {at_limit:.1%}, and "
        f"{_sigma_for(0.01, material):.4f} µm "
        f"would take 1 %"
    )
    return Advice(says, "Eq. 1")


@rule("5.2")
def only_slope_matters(material: Material) -> Advice | None:
    """Far above the wavelength only sigma/tau shows; sigma alone cannot be told."""
    if (
        material.sigma is None
        or material.emergence is not None
        or material.filled_by.get("sigma") == "roughness_of_all_readings"  # which only waves gave
        or (4 * pi * material.sigma / wavelength(material)) ** 2 < 20
    ):
        return None
    return Advice(
        "so rough that only its slope, sigma/tau, shows: GGX or Beckmann's law of alpha = 2 sigma/tau looks the same "
        "and is cheaper",
        f"sigma {material.sigma:.3g} µm against {1000 * wavelength(material):g} nm",
    )


@rule("5.2")
def slope_beyond_theory(material: Material) -> Advice | None:
    """sigma/tau above 0.3 strains the theory, above 1 it is outside."""
    slope = _observed_slope(material) or material.slope
    if slope is None or slope <= 0.3:
        return None
    angle = degrees(atan(sqrt(2) * slope))
    status = "outside" if slope > emergence.STEEPEST else "flagged"
    says = f"sigma/tau = {slope:.2g} is an rms slope of {angle:.0f}° along a line"
    return Advice(says, "steep slopes", domain=status, needs="Oren-Nayar, or geometry")


@rule("5.2")
def emergence_has_a_colour(material: Material) -> Advice | None:
    """Long waves see a smoother surface: the first mirror image is reddish."""
    if material.emergence is None or material.sigma is None or material.tau is None:
        return None
    blue, red = (
        emergence.emergence_angle(material.sigma, material.tau, light, material.solid_angle) for light in (0.45, 0.65)
    )
    if blue is None or red is None or blue - red < 0.5:
        return None
    return Advice(
        f"the same surface shows its image from {red:.1f}° in red light (650 nm), {blue:.1f}° in blue (450 nm)",
        "sigma and tau",
    )


def _sigma_for(loss: float, material: Material) -> float:
    return wavelength(material) / (4 * pi) * sqrt(-log1p(-loss))


RULES = (
    numbers_of_a_workshop,
    cut_offs,
    slopes_of_stylus,
    formula_beside_criterion,
    never_a_mirror_image,
    emergence_on_matt,
    mirror_that_never_shows,
    finish_against_width,
    width_from_finish,
    width_from_slope,
    usual_width,
    smooth_limit,
    only_slope_matters,
    slope_beyond_theory,
    emergence_has_a_colour,
)

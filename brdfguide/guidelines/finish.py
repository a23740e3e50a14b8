"""How rough: from a stylus, a glossmeter, the highlight's width, the emergence of a mirror image, or the look (section 5.2).

Widths are alpha, √2 times the rms slope along a line: alpha = 2 sigma/tau for a Gaussian correlation. Sources that agree are
combined; sources that do not are shown, and the most direct one is used.
"""

from math import atan, degrees, exp, log, log1p, pi, sqrt, tan

from .. import gloss, roughness
from ..errors import NoAnswer
from ..material import Material
from ._base import Advice, rule

AGREE = 1.5  # widths within this factor agree (ours; a glossmeter and an eye differ by less)
# The widths whose lobe of n = 1.5 reads 87, 27, 9 and 2 units at 60°: what the trade calls so (ours).
WIDTH_OF = {"high gloss": 0.012, "satin": 0.065, "low gloss": 0.15, "matt": 0.35}
TYPICAL_SLOPE = 0.1  # the report's assumption where nothing tells (section 5.2)
SMOOTH_UM = 0.02  # the report's limit of "perfectly smooth" (section 3.2.2)


def wavelength(material: Material) -> float:
    return material.wavelength or roughness.WAVELENGTH


def gloss_width(material: Material) -> gloss.Roughness | None:
    """What the glossmeter says, for a dielectric."""
    if not material.gloss or material.kind == "metal" or not any(material.gloss.values()):
        return None
    body = sum(material.albedo) / len(material.albedo) if material.albedo and material.subsurface != "none" else 0.0
    return gloss.roughness_from(dict(material.gloss), n=material.n[len(material.n) // 2] if material.n else 1.5, albedo=body)


def sources(material: Material) -> list[tuple[float, str]]:
    """(alpha, by what), the most direct first."""
    found = []
    if material.sigma and material.tau:
        found.append((2 * material.sigma / material.tau, f"stylus: sigma {material.sigma:g} µm, tau {material.tau:g} µm"))
    read = gloss_width(material)
    if read and read.agrees:
        found.append((read.alpha, f"glossmeter at {', '.join(f'{angle}°' for angle in material.gloss)}"))
    if material.highlight_width:
        found.append((tan(material.highlight_width / 4) / sqrt(log(2)), f"highlight {degrees(material.highlight_width):g}° wide at half height"))
    return found


@rule("5.2")
def roughness_from_stylus(material: Material) -> Advice | None:
    """A stylus gives sigma and tau, within its band of scales."""
    if not (material.sigma and material.tau) or "sigma" in material.filled_by:
        return None
    slope = material.sigma / material.tau
    says = (
        f"sigma {material.sigma:g} µm, tau {material.tau:g} µm: sigma/tau = {slope:.3g} is an rms slope of {sqrt(2) * slope:.3g} along a line,"
        f" a mean slope of {sqrt(pi) * slope:.3g}, alpha = {2 * slope:.3g}"
    )
    band = f"cut-off {material.cutoff:g} µm" if material.cutoff else "no cut-off given; light sees the finest, steepest scale, which a long cut-off hides"
    return Advice(says, f"stylus; {band}", sets={"slope": slope})


@rule("5.2, Figure 14")
def stylus_against_emergence(material: Material) -> Advice | None:
    """The mirror image that sigma and tau predict, against the one that was seen."""
    if material.emerges is None or material.sigma is None or not (material.tau or material.alpha):
        return None
    tau = material.tau or 2 * material.sigma / material.alpha
    if not 1e-3 <= material.sigma / tau <= roughness.STEEPEST:
        return None
    try:
        predicted = roughness.emergence_angle(material.sigma, tau, wavelength(material), material.solid_angle)
    except NoAnswer:
        return None
    seen = degrees(material.emergence) if material.emerges else None
    if (predicted is None or predicted > 80) and (seen is None or seen > 85):
        return None
    if predicted is not None and seen is not None and abs(predicted - seen) <= 8:
        return Advice(f"the mirror image should appear from {predicted:.0f}° on, and does from {seen:g}°", "stylus and eye agree")
    expected = "at no angle" if predicted is None else f"from {predicted:.0f}° on"
    says = f"a mirror image is expected {expected}, and was seen {'at none' if seen is None else f'from {seen:g}°'}; the stylus is used"
    return Advice(says, "stylus against emergence", conflict=True)


@rule("5.2, Figure 14")
def contour_from_half_a_stylus(material: Material) -> Advice | None:
    """sigma or tau alone, with the emergence angle, gives the other."""
    if material.emergence is None or (material.sigma is None) == (material.tau is None):
        return None
    angle, light = degrees(material.emergence), wavelength(material)
    try:
        return _other_half(material, angle, light)
    except NoAnswer as error:
        return Advice(f"no point on the contour of {angle:g}°: {error}", "half a stylus against emergence", conflict=True)


def _other_half(material: Material, angle: float, light: float) -> Advice:
    if material.tau is None:
        tau = roughness.tau_for_sigma(angle, material.sigma, light, material.solid_angle)
        return Advice(f"tau {tau:.3g} µm on the contour of {angle:g}°", f"sigma {material.sigma:g} µm", sets={"tau": tau, "slope": material.sigma / tau})
    sigma = roughness.sigmas_for_tau(angle, material.tau, light, material.solid_angle)[0]
    return Advice(f"sigma {sigma:.3g} µm on the contour of {angle:g}°", f"tau {material.tau:g} µm", sets={"sigma": sigma, "slope": sigma / material.tau})


@rule("5")
def roughness_from_gloss(material: Material) -> Advice | None:
    """A glossmeter reading is a width, where one lobe gives all readings."""
    read = gloss_width(material)
    if read is None:
        return None
    shown = ", ".join(f"{reading:g} at {angle}°" for angle, reading in material.gloss.items())
    if not read.agrees:
        each = ", ".join(f"{angle}°: " + (f"{alpha:.3g}" if alpha else "none") for angle, alpha in read.each.items())
        says = f"no single lobe of n = {read.n:.3g} reads {shown}; alone each would be a width of {each}. Not averaged"
        return Advice(says, "glossmeter against itself", conflict=True)
    return Advice(f"alpha = {read.alpha:.3g} for a Gaussian lobe of n = {read.n:.3g}", f"glossmeter: {shown}")


@rule("5")
def gloss_of_metal(material: Material) -> Advice | None:
    """Gloss units are defined against black glass; metals read far above 100."""
    if not material.gloss or material.kind != "metal":
        return None
    return Advice("gloss of a metal is outside ISO 2813 and ASTM D523; the readings are not used", "glossmeter on a metal")


@rule("5.2")
def width_of_highlight(material: Material) -> Advice | None:
    """The highlight of a small lamp near the normal is 4 atan(alpha √ln 2) wide at half height."""
    if not material.highlight_width:
        return None
    alpha = tan(material.highlight_width / 4) / sqrt(log(2))
    return Advice(f"alpha = {alpha:.3g}", f"a highlight {degrees(material.highlight_width):g}° wide at half height")


@rule("5.2")
def roughness_combined(material: Material) -> Advice | None:
    """One width from all sources that agree; where they do not, the most direct."""
    found = sources(material)
    if material.alpha is not None or not found:
        return None
    widths = [alpha for alpha, _ in found]
    if max(widths) > AGREE * min(widths):
        says = f"the widths differ by a factor {max(widths) / min(widths):.2g}; the first is used, nothing is averaged"
        return Advice(says, "; ".join(f"alpha {alpha:.3g} by {by}" for alpha, by in found), sets={"alpha": widths[0]}, conflict=True)
    alpha = exp(sum(map(log, widths)) / len(widths))
    return Advice(f"alpha = {alpha:.3g}", "; ".join(f"{each:.3g} by {by}" for each, by in found), sets={"alpha": alpha})


@rule("5.2, Eq. 3, Figure 14")
def roughness_from_emergence(material: Material) -> Advice | None:
    """The angle at which a mirror image appears fixes sigma along a contour; a slope fixes the point on it."""
    if material.emergence is None or material.sigma is not None or material.tau is not None:
        return None
    angle, light = degrees(material.emergence), wavelength(material)
    slope = material.alpha / 2 if material.alpha else material.slope or TYPICAL_SLOPE
    if not 1e-3 <= slope <= roughness.STEEPEST:
        return None
    sigma, tau = roughness.crossing(angle, slope, light, material.solid_angle)
    flat, _ = roughness.crossing(angle, 0.03, light, material.solid_angle)
    steep, _ = roughness.crossing(angle, 0.3, light, material.solid_angle)
    says = f"sigma {sigma:.3g} µm, tau {tau:.3g} µm where the contour of {angle:g}° meets sigma/tau = {slope:.3g}; along it sigma is {steep:.3g} µm at 0.3, {flat:.3g} at 0.03"
    known = "slope from the width" if material.alpha else "slope as observed" if material.slope else "slope assumed"
    return Advice(says, f"a mirror image from {angle:g}° on, {1000 * light:g} nm; {known}", sets={"sigma": sigma, "tau": tau, "slope": slope}, guess=known == "slope assumed")


@rule("5.2, Table 2")
def formula_beside_criterion(material: Material) -> Advice | None:
    """The report's Eq. 3 beside the criterion it was fitted to; at 85° its table is 20 to 25 % low."""
    if material.emergence is None or material.slope is None or not 15 <= degrees(material.emergence) <= 85:
        return None
    angle = degrees(material.emergence)
    try:
        sigma, tau = roughness.formula_crossing(angle, material.slope, wavelength(material))
    except NoAnswer:
        return None
    exact, _ = roughness.crossing(angle, material.slope, wavelength(material), material.solid_angle)
    return Advice(f"Eq. 3 with Table 2 gives sigma {sigma:.3g} µm, tau {tau:.3g} µm, {sigma / exact - 1:+.0%} from the criterion", f"emergence at {angle:g}°")


@rule("5.2")
def never_a_mirror_image(material: Material) -> Advice | None:
    """No mirror image at any angle: sigma lies above the contour of 85°."""
    if material.emerges is not False:
        return None
    slope = material.alpha / 2 if material.alpha else material.slope or TYPICAL_SLOPE
    least = None
    if 1e-3 <= slope <= roughness.STEEPEST:
        least = roughness.crossing(85, slope, wavelength(material), material.solid_angle)[0]
    if least is None:
        return Advice("no mirror term", "no mirror image at any angle", drops={"mirror": "no mirror image was seen"})
    says = f"sigma above {least:.2g} µm at sigma/tau = {slope:.3g}; a bright body hides an image earlier, so this bound is soft"
    settled = {"sigma": 1.5 * least, "slope": slope} if material.finish not in ("mirror", "high gloss") else {}
    return Advice(says, "no mirror image at any angle", sets=settled, drops={"mirror": "no mirror image was seen"})


@rule("5.2")
def emergence_on_matt(material: Material) -> Advice | None:
    """A mirror image that shows near the normal contradicts a matt finish; one near grazing does not."""
    if material.emergence is None or material.finish not in ("matt", "low gloss") or degrees(material.emergence) >= 75:
        return None
    return Advice(f"a mirror image from {degrees(material.emergence):g}° on, yet said to be {material.finish}", "emergence against finish", conflict=True)


@rule("5.2")
def mirror_that_never_shows(material: Material) -> Advice | None:
    """A mirror finish shows its image at every angle."""
    if material.finish not in ("mirror", "high gloss") or (material.emerges is not False and (material.emergence is None or degrees(material.emergence) <= 45)):
        return None
    seen = "never seen" if material.emerges is False else f"seen only from {degrees(material.emergence):g}° on"
    return Advice(f"a {material.finish} finish shows its mirror image near the normal, yet it is {seen}", "finish against emergence", conflict=True)


@rule("5.2")
def finish_against_width(material: Material) -> Advice | None:
    """The look and the measured width must be of one sort."""
    if material.finish is None or material.alpha is None:
        return None
    if material.sigma is not None and (4 * pi * material.sigma / wavelength(material)) ** 2 < 20:
        return None  # a mirror image covers the lobe, whose width the eye does not see
    usual = 0.005 if material.finish == "mirror" else WIDTH_OF[material.finish]
    if 1 / 5 <= material.alpha / usual <= 5 or (material.finish == "mirror" and material.alpha < usual):
        return None
    nearest = min(WIDTH_OF, key=lambda finish: abs(log(WIDTH_OF[finish] / material.alpha)))
    return Advice(f"said to be {material.finish}, yet alpha = {material.alpha:.3g} is {nearest}", "finish against the measured width", conflict=True)


@rule("5.2")
def width_from_finish(material: Material) -> Advice | None:
    """No measurement: the width that looks so."""
    if material.alpha is not None or material.slope is not None or material.finish not in WIDTH_OF:
        return None
    return Advice(f"alpha = {WIDTH_OF[material.finish]:g}", f"a {material.finish} finish", sets={"alpha": WIDTH_OF[material.finish]}, guess=True)


@rule("5.2")
def width_from_slope(material: Material) -> Advice | None:
    """alpha = 2 sigma/tau, for a Gaussian correlation; and the slope from a width."""
    if (material.alpha is None) == (material.slope is None):
        return None
    if material.alpha is None:
        return Advice(f"alpha = {2 * material.slope:.3g}", "twice sigma/tau", sets={"alpha": 2 * material.slope})
    return Advice(f"sigma/tau = {material.alpha / 2:.3g}", "half of alpha", sets={"slope": material.alpha / 2})


@rule("5.2")
def usual_width(material: Material) -> Advice | None:
    """Nothing says how rough: a satin width, which is a guess."""
    if material.alpha is not None or material.finish == "mirror":
        return None
    return Advice("alpha = 0.15, for want of a finish, a glossmeter or a highlight's width", "nothing observed about roughness", sets={"alpha": 0.15, "slope": 0.075}, guess=True)


@rule("3.2.2, Eq. 1")
def smooth_limit(material: Material) -> Advice | None:
    """The report calls less than 0.02 µm perfectly smooth; Eq. 1 says what is lost."""
    if material.sigma is None or material.sigma > 0.1:
        return None
    g = (4 * pi * material.sigma / wavelength(material)) ** 2
    at_limit = 1 - exp(-((4 * pi * SMOOTH_UM / wavelength(material)) ** 2))
    says = f"sigma {material.sigma:.3g} µm takes {1 - exp(-g):.1%} from the mirror at normal incidence; the report's limit of {SMOOTH_UM} µm takes {at_limit:.1%}, and 1 % is lost at {_sigma_for(0.01, material):.4f} µm"
    return Advice(says, "Eq. 1")


@rule("5.2")
def only_slope_matters(material: Material) -> Advice | None:
    """Far above the wavelength only sigma/tau shows; sigma alone cannot be told."""
    if material.sigma is None or material.emergence is not None or (4 * pi * material.sigma / wavelength(material)) ** 2 < 20:
        return None
    return Advice("so rough that only sigma/tau shows; a cheaper facet lobe of alpha = 2 sigma/tau is the same surface", f"sigma {material.sigma:.3g} µm against {1000 * wavelength(material):g} nm")


@rule("5.2")
def slope_beyond_theory(material: Material) -> Advice | None:
    """sigma/tau above 0.3 strains the theory, above 1 it is outside."""
    if material.slope is None or material.slope <= 0.3:
        return None
    angle = degrees(atan(sqrt(2) * material.slope))
    status = "outside" if material.slope > roughness.STEEPEST else "flagged"
    return Advice(f"sigma/tau = {material.slope:.2g} is an rms slope of {angle:.0f}° along a line", "steep slopes", domain=status, needs="Oren-Nayar, or geometry")


@rule("5.2")
def emergence_has_a_colour(material: Material) -> Advice | None:
    """Long waves see a smoother surface: the first mirror image is reddish."""
    if material.emergence is None or material.sigma is None or material.tau is None:
        return None
    blue, red = (roughness.emergence_angle(material.sigma, material.tau, light, material.solid_angle) for light in (0.45, 0.65))
    if blue is None or red is None or blue - red < 0.5:
        return None
    return Advice(f"the same surface shows its image from {red:.1f}° in red light (650 nm), {blue:.1f}° in blue (450 nm)", "sigma and tau")


def _sigma_for(loss: float, material: Material) -> float:
    return wavelength(material) / (4 * pi) * sqrt(-log1p(-loss))


RULES = (
    roughness_from_stylus, stylus_against_emergence, contour_from_half_a_stylus, roughness_from_gloss, gloss_of_metal, width_of_highlight, roughness_combined, roughness_from_emergence,
    formula_beside_criterion, never_a_mirror_image, emergence_on_matt, mirror_that_never_shows, finish_against_width, width_from_finish,
    width_from_slope, usual_width, smooth_limit, only_slope_matters, slope_beyond_theory, emergence_has_a_colour,
)  # fmt: skip

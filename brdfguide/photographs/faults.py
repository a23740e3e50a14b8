"""What is wrong with photographs, as far as they themselves show it: each fault with its consequence."""

import numpy as np

from ..finding import Finding
from .lamp import Lamp, find_lamp, phase_deg
from .solids import Pinhole, Points

GAMMA_OFF = 0.05  # of the exponent of a matt reference's shading
EXPLAINS = 0.5  # of the shading's misfit is left with an exponent, if that is the cause (ours)
GROSS = 1.6  # an exponent beyond, or below its inverse, is one whatever else is wrong (ours)
QUADRANTS = 0.03  # by so much the quadrants of the reference may differ
LEAST_DARK = 50  # points, to tell the light on the dark side from
STRAY = 0.005  # of the greatest value, on the dark side of the reference
BOUNCED = 0.03  # the lower rim over the upper
OFF_DEG = 1.0  # between the lamp that is stated and the one that the shading shows (ours)
OFF_KAPPA = 0.015  # in 1/distance (ours): a lamp at 40 radii taken as far away is 0.025 off
SAME_PHASE_DEG = 5.0  # phases that differ by less are one (ours)
TURNS = 4.0  # widths of a pixel's turn of the normal that the highlight's alpha should have
SPARKLES = 0.10  # scatter of neighbouring pixels beyond which it is no usual noise (ours)
HARMLESS_LAMP = 0.25  # half angle in parts of alpha, which makes alpha 1 % too large (ours, by pictures)
MANY_CLIPPED = 0.005  # of the surface (ours)


def reference_findings(label: str, seen: Points, shading: np.ndarray, stated) -> tuple[Lamp, list[Finding]]:
    """The lamp that a matt reference shows, and what its shading tells of the picture.

    Takes  all points of the reference (n,) inside its rim, lit or not, and their grey light (n,); the stated position
    of the lamp, or None.
    """
    front = seen.cos_r > 0.25
    seen, shading = seen[front], shading[front]
    lamp = find_lamp(seen, shading)
    found: list[Finding] = []
    bent = _bent(lamp)
    if bent:
        found.append(_gamma(label, lamp))
    elif stated is None:
        found.append(_lamp_found(label, lamp))
    else:
        found += _against_stated(label, lamp, np.asarray(stated, float))
    top = float(np.quantile(shading, 0.999))
    found += _stray(label, seen, shading, top, lamp)
    if not bent:
        found += _unevenness(label, seen, shading, lamp)
    return lamp, found


def _bent(lamp: Lamp) -> bool:
    """Whether the codes are not light: an exponent explains the shading, and not a wrong outline or light from below,
    which leave as much unexplained with any."""
    explains = lamp.bent_rms < EXPLAINS * lamp.rms or abs(np.log(lamp.gamma)) > np.log(GROSS)
    return bool(abs(lamp.gamma - 1) > GAMMA_OFF and explains)


def _gamma(label: str, lamp: Lamp) -> Finding:
    hint = "a tone curve was applied: develop the picture without"
    if lamp.gamma < 1 / GROSS:
        hint = "its codes look like those of a display: say transfer: srgb"
    elif lamp.gamma > GROSS:
        hint = "its codes look like light: say transfer: linear"
    text = f"{label}: the matt reference is shaded like the power {lamp.gamma:.3f} of the light, not like light; {hint}"
    consequence = "albedo would be wrong by half or more, and the roughness by a tenth"
    return Finding("gamma", text, "error", consequence, "--anyway", (("exponent", lamp.gamma),))


def _lamp_found(label: str, lamp: Lamp) -> Finding:
    x, y, z = (round(float(each), 2) + 0.0 for each in lamp.position)  # no -0
    text = (
        f"{label}: lamp found from the reference's shading at ({x:.2f}, {y:.2f}, {z:.2f}) radii, phase "
        f"{phase_deg(lamp.position):.1f} degrees, {lamp.distance:.3g} radii away; the shading fits to {lamp.rms:.2%}"
    )
    numbers = (
        ("phase_deg", phase_deg(lamp.position)),
        ("distance_radii", lamp.distance),
        ("rms", lamp.rms),
        ("doubt_deg", lamp.doubt_deg),
    )
    return Finding("lamp-found", text, consequence="half a degree off moves n by 0.01", numbers=numbers)


def _against_stated(label: str, lamp: Lamp, stated) -> list[Finding]:
    distance = float(np.linalg.norm(stated))
    cosine = float(np.dot(stated, lamp.position) / distance / lamp.distance)
    off = float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    if off <= OFF_DEG and abs(1 / distance - 1 / lamp.distance) <= OFF_KAPPA:
        return []
    there = "far away" if distance > 1e4 else f"{distance:.3g} radii away"
    text = (
        f"{label}: the reference's shading puts the lamp {off:.1f} degrees from where it is said to be, "
        f"{lamp.distance:.3g} radii away (stated: {there})"
    )
    consequence = (
        "two degrees move n by 0.03 and a narrow lobe's alpha by 5 %; lamp: reference takes it from the shading"
    )
    return [Finding("lamp-disagrees", text, "warning", consequence, numbers=(("off_deg", off),))]


def _stray(label: str, seen: Points, shading, top: float, lamp: Lamp) -> list[Finding]:
    level = dark_level(seen, shading, lamp)
    if level is None:
        return []
    dark = _away_from(seen, lamp)
    y = seen.normal[:, 1]
    upper, lower = shading[dark & (y > 0.3)] / top, shading[dark & (y < -0.3)] / top
    if min(len(upper), len(lower)) > 50 and np.median(lower) - np.median(upper) > max(STRAY, 0.5 * level):
        return [_from_below(f"{label}: the reference's dark side has {np.median(lower):.1%} of its light below", level)]
    if level <= STRAY:
        return []
    text = f"{label}: the reference's dark side has {level:.1%} of its greatest light: stray light or a second lamp"
    consequence = "dark materials come out too bright by about as much; a black cloth and a lens hood help"
    return [Finding("stray", text, "warning", consequence, numbers=(("share", level),))]


def _away_from(seen: Points, lamp: Lamp) -> np.ndarray:
    """Points that no lamp can light, (n,)."""
    return seen.normal @ (lamp.position / lamp.distance) < -0.2


def dark_level(seen: Points, shading: np.ndarray, lamp: Lamp) -> float | None:
    """Light on the side of a matt reference away from its lamp, in parts of its greatest; None where hardly any of that
    side is seen."""
    dark = _away_from(seen, lamp)
    if np.count_nonzero(dark) < LEAST_DARK:
        return None
    return float(np.median(shading[dark])) / float(np.quantile(shading, 0.999))


def _from_below(text: str, share: float) -> Finding:
    consequence = "put the ball on a thin stand over black cloth; a table of albedo 0.5 moves albedo by 1 %"
    return Finding(
        "interreflection", text + ": the table shines on it", "warning", consequence, numbers=(("share", share),)
    )


def _unevenness(label: str, seen: Points, shading, lamp: Lamp) -> list[Finding]:
    model = seen.irradiance(lamp.position)
    lit = model > 0.2 * model.max()
    ratio = shading[lit] / model[lit]
    middle = float(np.median(ratio)) if ratio.size else 0.0
    if not middle > 0:
        return []
    ratio = ratio / middle
    x, y = seen.normal[lit, 0], seen.normal[lit, 1]
    found = []
    parts = [ratio[(np.sign(x) == a) & (np.sign(y) == b)] for a in (-1, 1) for b in (-1, 1)]
    means = [float(part.mean()) for part in parts if len(part) > 50]
    spread = max(means) - min(means) if len(means) > 1 else 0.0
    rim = np.hypot(x, y) > 0.7
    upper, lower = ratio[rim & (y > 0.3)], ratio[rim & (y < -0.3)]
    bounced = float(lower.mean() - upper.mean()) if min(len(upper), len(lower)) > 50 else 0.0
    if bounced > BOUNCED:
        text = f"{label}: the reference's lower rim is {bounced:.1%} brighter than its upper one"
        found.append(_from_below(text, bounced))
    elif spread > QUADRANTS:
        text = f"{label}: the reference's quadrants differ by {spread:.1%} from the light of one lamp"
        consequence = "the values of a second or uneven lamp are taken for the surface's"
        found.append(Finding("second-lamp", text, "warning", consequence, numbers=(("share", spread),)))
    return found


def phases_finding(phases) -> list[Finding]:
    """One picture, or several with the same phase, is one difference angle."""
    phases = np.asarray(phases)
    if phases.max() - phases.min() > SAME_PHASE_DEG:
        return []
    text = (
        f"one phase, {phases.mean():.0f} degrees, is one difference angle: {phases.mean() / 2:.0f} degrees everywhere"
    )
    consequence = "any law with the right lobe fits; a picture with the lamp elsewhere tells laws apart, and n"
    return [Finding("one-difference-angle", text, "warning", consequence, numbers=(("phase_deg", phases.mean()),))]


def width_findings(alpha: float | None, view: Pinhole, block: int, lamp_half_deg: float | None) -> list[Finding]:
    """Whether the highlight is wide enough for the ball's pixels and for the lamp's size."""
    turn = float(np.degrees(block / view.radius_px))
    found = []
    if alpha is not None and np.degrees(alpha) < TURNS * turn:
        text = f"the highlight is narrow, alpha about {alpha:.2g}, and one pixel turns the normal by {turn:.2g} degrees"
        consequence = "alpha is at most this; a larger ball in the picture tells more"
        found.append(
            Finding("curvature", text, "warning", consequence, numbers=(("pixel_deg", turn), ("alpha", alpha)))
        )
    if alpha is not None and lamp_half_deg is None:
        half = float(np.degrees(alpha)) * HARMLESS_LAMP
        text = f"lamp_half_deg is not stated: the lamp is taken as a point, as one of less than {half:.1g} degrees is"
        consequence = "four times as large, it makes alpha 10 to 20 % too large"
        found.append(Finding("lamp-point", text, consequence=consequence, numbers=(("half_deg", half),)))
    if alpha is not None and lamp_half_deg is not None and np.radians(lamp_half_deg) > alpha / 2:
        text = f"the lamp's half angle, {lamp_half_deg:g} degrees, is more than half the highlight's alpha, {alpha:.2g}"
        consequence = "the highlight is partly the lamp's image, so that alpha comes out too large"
        numbers = (("lamp_half_deg", lamp_half_deg), ("alpha", alpha))
        found.append(Finding("lamp-size", text, "warning", consequence, "--aperture-deg", numbers))
    return found


def pixel_findings(label: str, clipped: int, hot: int, missing: int, surface: int, scatter: float) -> list[Finding]:
    """Pixels that were left out, and how much neighbours scatter."""
    found = []
    if clipped:
        share = clipped / max(surface, 1)
        text = (
            f"{label}: {clipped} pixels ({share:.2%} of the surface) are clipped: left out, with those that touch them"
        )
        consequence = "no harm while the flank of the highlight is there; expose less to see its top"
        severity = "warning" if share > MANY_CLIPPED else "note"
        found.append(Finding("clipped", text, severity, consequence, numbers=(("pixels", clipped), ("share", share))))
    if hot:
        text = f"{label}: {hot} lone bright pixels were left out"
        found.append(Finding("hot-pixels", text, numbers=(("pixels", hot),)))
    if missing:
        text = f"{label}: {missing} pixels hold no light (not a number, infinite or negative): left out"
        found.append(Finding("bad-pixels", text, "warning", numbers=(("pixels", missing),)))
    if scatter > SPARKLES:
        text = f"{label}: neighbouring pixels scatter by {scatter:.0%}: flakes, texture or noise"
        consequence = "the values are means over it; what sparkles is not in any law"
        found.append(Finding("sparkle", text, "warning", consequence, numbers=(("scatter", scatter),)))
    return found

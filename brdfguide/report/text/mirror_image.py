"""Roughness from the dimming of a mirror image, in words."""

from .emergence import emerges


def mirror_text(document: dict) -> str:
    sigma, tau, slope = (document[key] for key in ("sigma_um", "tau_um", "slope"))
    angle = document["emergence_deg"]
    lines = [
        f"sigma {_span(sigma, ' um')}, tau {_span(tau, ' um')}, sigma/tau {_span(slope, '')}, 19 times in 20",
        f"from {document['rows']} ratios in {document['file']}; a mirror image of its own stands out {emerges(angle)}",
    ]
    worst = document["worst"]
    lines.append(
        f"farthest from the law: {worst['ratio']:.3g} at {worst['angle_deg']:g} deg, {worst['wavelength_nm']:g} nm, "
        f"where it gives {worst['of_the_law']:.3g}: {worst['missed_by_doubts']:.2g} of its doubts"
    )
    return "\n".join(lines)


def _span(number: dict, unit: str) -> str:
    low, high = number["low"], number["high"]
    if low is None and high is None:
        return f"{number['value']:.3g}{unit} (open at both ends)"
    if low is None or high is None:
        return f"{number['value']:.3g}{unit} ({'above' if high is None else 'below'} {low or high:.3g})"
    return f"{number['value']:.3g}{unit} ({low:.3g} to {high:.3g})"

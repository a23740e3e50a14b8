"""The answer of `roughness --angle A --angle-across B` in words."""

from .folding import page


def grained_text(result: dict) -> str:
    """The document for people: height and both lengths, how sure the ratio is, and what a renderer would type."""
    found, sigma = result["grain"], result["criterion"]["sigma_um"]
    across, along = found["slope_across"], found["slope_along"]
    lines = [
        f"sigma {sigma:.3g} um, tau {found['tau_across_um']:.3g} um across the grain and "
        f"{found['tau_along_um']:.3g} um along it, ratio {found['ratio']:.3g}: rms height and distances of the "
        f"surface's bumps",
        _doubt(found),
        f"for a mirror image that appears at {result['angle_deg']:.4g} deg from the normal along the grain and "
        f"{found['angle_across_deg']:.4g} across it, {result['wavelength_nm']:g} nm, a pupil of "
        f"{result['pupil_mm']:g} mm at {result['distance_mm']:g} mm ({result['solid_angle_sr']:.4g} sr)",
        "",
        f"to type: he-torrance-aniso.sigma={sigma:.4g} he-torrance-aniso.slope={across:.4g} "
        f"he-torrance-aniso.ratio={found['ratio']:.4g}; where the bumps are far higher than the wavelength, "
        f"alpha {2 * across:.3g} across and {2 * along:.3g} along the grain",
        "the mirror image and the highlight are as bright along the grain as across it: that bumps hide one another "
        "is all that parts the two angles",
    ]
    return page("\n".join(lines)).rstrip("\n") + "\n"


def _doubt(found: dict) -> str:
    low, high = found["ratio_interval"]
    head = f"both angles read to {found['angle_error_deg']:g} deg, the ratio"
    if low == 1.0 and high is None:
        return f"{head} is open: --angle-error says how much better they were read"
    if high is None:
        return f"{head} is {low:.3g} or more, 19 times in 20"
    return f"{head} lies in {low:.3g} to {high:.3g}, 19 times in 20"

"""The answer of `roughness --angle A --angle-across B` in words."""

from .folding import page


def grained_text(result: dict) -> str:
    """The document for people: height and both lengths, how sure the ratio is, and what a renderer would type."""
    found, sigma = result["grain"], result["criterion"]["sigma_um"]
    across, along = found["slope_across"], found["slope_along"]
    lines = [
        f"sigma {sigma:.3g} um, tau {found['tau_across_um']:.3g} um across the grain and "
        f"{found['tau_along_um']:.3g} um along it, ratio {found['ratio']:.3g} (He-Torrance criterion)",
        _doubt(found),
        f"emergence at {result['angle_deg']:.4g} deg along the grain and {found['angle_across_deg']:.4g} across it, "
        f"{result['wavelength_nm']:g} nm, {result['solid_angle_sr']:.4g} sr (pupil {result['pupil_mm']:g} mm at "
        f"{result['distance_mm']:g} mm)",
        "",
        f"to type: he-torrance-aniso.sigma={sigma:.4g} he-torrance-aniso.slope={across:.4g} "
        f"he-torrance-aniso.ratio={found['ratio']:.4g}; far above the wavelength alpha {2 * across:.3g} across and "
        f"{2 * along:.3g} along the grain",
        "one height has one mirror image in all azimuths, and its lobe is as high: shadowing alone makes it emerge "
        "sooner across the grain",
    ]
    return page("\n".join(lines)).rstrip("\n") + "\n"


def _doubt(found: dict) -> str:
    low, high = found["ratio_interval"]
    head = f"both read to {found['angle_error_deg']:g} deg, the ratio"
    if low == 1.0 and high is None:
        return f"{head} is open: --angle-error says how much better they were read"
    if high is None:
        return f"{head} is {low:.3g} or more, 19 times in 20"
    return f"{head} lies in {low:.3g} to {high:.3g}, 19 times in 20"

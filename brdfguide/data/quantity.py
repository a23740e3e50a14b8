"""Which quantity the values are: what reciprocity and energy say about a BRDF, one times a cosine, and one times pi."""

import numpy as np

from ..finding import Finding
from . import dark_level, reciprocity
from .measurement import Measurement, row_median

LEAST_ALONG = 40  # directions
PHONG_LEFT = 0.1  # rms of ln about such a power (ours)
ENERGY_SLACK = 1.1  # a hemispherical reflectance above this is no BRDF in 1/sr; scales are known to about 5 %


def quantity_findings(m: Measurement, level):
    """Findings about reciprocity and energy; `level` is a Reflectance, or None where the coverage does not tell."""
    known = m.settled("scale")
    tested = reciprocity.test(m)
    weighted = False
    if tested:
        pairs = {
            "pairs": tested.pairs,
            "median_ratio": tested.ratio,
            "median_ratio_over_cosine": tested.corrected_ratio,
        }
        if tested.power is not None and tested.power_stderr is not None:
            pairs |= {"power_of_cosine": tested.power, "power_stderr": tested.power_stderr}
        weighted = tested.power is not None and abs(tested.power - 1) < 0.3 and tested.corrected_ratio < tested.ratio
        weighted = weighted and not _is_phong(m)
        open_to_doubt = not m.settled("cosine")
        fades = open_to_doubt and _fades_with_incidence(level)
        yield _reciprocity(m, tested, weighted and open_to_doubt, fades, tuple(pairs.items()))
    if level is None:
        text = "the coverage does not tell the hemispherical reflectance: a factor of pi could not be noticed"
        yield Finding("energy-untold", text, option="--quantity")
        return
    most, least = float(np.max(level.values)), float(np.median(level.least))
    bound = "at least " if level.how == "plane" else ""
    numbers = tuple((f"at_{angle:g}_deg", value) for angle, value in zip(level.theta_i_deg, level.values, strict=True))
    text = (
        f"of the light that comes in, {bound}{_percent(min(level.values), most)} goes out within {level.to_deg:.0f} "
        f"degrees of the normal (hemispherical reflectance{', brightest channel' if len(m.channels) > 1 else ''})"
    )
    if weighted or least <= ENERGY_SLACK:
        yield Finding("reflectance", text, numbers=numbers)
    elif least <= ENERGY_SLACK * np.pi and not known:
        consequence = "albedos and lobes would come out pi times too large"
        yield Finding(
            "reflectance-factor",
            f"{text}: values are reflectance factors, pi times the BRDF",
            "warning",
            consequence,
            "--quantity brdf",
            numbers,
            settles=("scale",),
            undo="reflectance-factor",
        )
    else:
        consequence = "no model that keeps energy can follow; the scale may be relative"
        option = "--quantity reflectance-factor, or --anyway" if not known else "--anyway"
        yield Finding("too-bright", f"{text}: more light than came in", "error", consequence, option, numbers)


def _percent(low: float, high: float) -> str:
    """One share, or from one to another where angles of incidence differ."""
    ends = [f"{100 * each:.2g}" if each < 1 else f"{100 * each:.0f}" for each in (low, high)]
    return f"{ends[0]} %" if ends[0] == ends[1] else f"{ends[0]} to {ends[1]} %"


def _is_phong(m: Measurement) -> bool:
    """Whether value times cos theta_i is a power of the cosine of the angle from the mirror direction: Phong's lobe,
    which exchanges as a BRDF times cos theta_r does, and is one."""
    level, along = row_median(m.ln) + np.log(m.geom.cos_i[:, 0]), m.geom.ln_cos_m[:, 0]
    known = np.isfinite(level) & m.geom.in_front[:, 0]
    if np.count_nonzero(known) < LEAST_ALONG or np.ptp(level[known]) < 1:
        return False
    level, along = level[known], along[known]
    left = level - np.polyval(np.polyfit(along, level, 1), along)
    return bool(np.sqrt(np.mean(left**2)) < PHONG_LEFT)


def _fades_with_incidence(level) -> bool:
    """Whether the hemispherical reflectance falls about as cos theta_i does; that of a surface hardly falls."""
    if level is None or len(level.values) < 3:
        return False
    power = np.polyfit(np.log(np.cos(np.radians(level.theta_i_deg))), np.log(level.values), 1)[0]
    return bool(0.6 < power < 1.4)


def _as_cos_i(m: Measurement, tested) -> bool:
    """Whether exchanged values differ as those of a BRDF times cos theta_i do, and a dark level leaves them farther
    apart."""
    if abs(tested.power + 1) > 0.15 or np.log(tested.corrected_i_ratio) > 0.3 * np.log(tested.ratio):
        return False
    dark = dark_level.dark_level_of(m)
    return dark is None or dark.left_by_cosine < dark.left


def _reciprocity(m: Measurement, tested, weighted: bool, fades: bool, numbers) -> Finding:
    exchanged = f"exchanging light and detector changes the values by (cos theta_r/cos theta_i)^{tested.power or 0:.2f}"
    if weighted:
        text = f"{exchanged}: they are BRDF times cos theta_r"
        return Finding(
            "cosine-weighted",
            text,
            "warning",
            "lobes would seem to fade toward grazing",
            "--quantity brdf",
            numbers,
            settles=("cosine",),
            undo="brdf-cos",
        )
    off = tested.power is not None and abs(tested.power) > max(0.25, 4 * tested.power_stderr)
    as_cos_i = off and _as_cos_i(m, tested)
    if as_cos_i and fades:
        text = (
            f"{exchanged}, and less light comes back as the incidence grows: they are BRDF times cos theta_i, not "
            f"divided by the irradiance"
        )
        return Finding(
            "cosine-i-weighted",
            text,
            "warning",
            "the surface would seem to darken toward grazing",
            "--quantity brdf",
            numbers,
            settles=("cosine",),
            undo="brdf-cos-i",
        )
    if dim := tested.dim:
        how = "low" if dim.offset < 0 else "high"
        cause = "the dark level taken off is too large" if dim.offset < 0 else "background light was left in"
        text = (
            f"reciprocal where bright, to a median factor {dim.bright_ratio:.3g}, but not below "
            f"{dim.below:.2g}/sr: a factor {dim.ratio:.3g}, "
            f"too {how} where light grazes, as if {abs(dim.offset):.1g}/cos theta_i were "
            f"{'missing' if dim.offset < 0 else 'added'}: {cause}"
        )
        consequence = "a fit in ln follows the dim values; another metric counts them less"
        dim_numbers = (
            ("dim_below_per_sr", dim.below),
            ("dim_ratio", dim.ratio),
            ("bright_ratio", dim.bright_ratio),
            ("offset_per_sr", dim.offset),
        )
        return Finding("dim-values-off", text, "warning", consequence, "--metric cube-root", numbers + dim_numbers)
    pairs = f"with light and detector exchanged {tested.pairs} pairs of values"
    if off or tested.ratio > 1.35:
        how = f", as (cos theta_r/cos theta_i)^{tested.power:.2f}" if off else ""
        how += ": as BRDF times cos theta_i would, or divided by cos theta_r" if as_cos_i else ""
        text = f"not reciprocal: {pairs} differ by a factor of {tested.ratio:.3g} (median){how}"
        option = ""
        if off and abs(tested.power) > 0.5:
            option = "--quantity brdf-cos" if tested.power > 0 else "--quantity brdf-cos-i"
        return Finding("not-reciprocal", text, "warning", "no physical model fits better than this", option, numbers)
    text = f"reciprocal: {pairs} agree within a factor of {tested.ratio:.3g} (median)"
    return Finding("reciprocal", text, numbers=numbers)

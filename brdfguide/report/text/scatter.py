"""Scatter of polished surfaces in words: the answer first, then the laws, then what was assumed."""

from ...printable import off_words
from .folding import TIED
from .table import columns
from .values import percent_words

ROWS = 9  # of a curve


def text(document: dict) -> str:
    """The whole answer."""
    parts = [
        heights_text(document),
        agreement_text(document.get("three_ways", {})),
        shape_text(document.get("shape", {})),
        laws_text(document.get("laws", [])),
        curve_text(document.get("curve", {})),
        assumed_text(document),
    ]
    return "\n\n".join(filter(None, parts))


def heights_text(document: dict) -> str:
    """Height and total scatter, each as the other says it; where they hold, and what else they mean."""
    heights = document["heights"]
    where = f"at {document['wavelength_nm']:g} nm and {document['theta_i_deg']:g} degrees"
    if heights["sigma_um"] is None:
        return (
            f"it scatters {percent_words(heights['scattered'])} of the light {where}, more than the smooth surface "
            "would reflect: no rms height does that; the law has to end before the horizon or the mirror direction"
        )
    lines = [
        f"an rms height of {length_text(heights['sigma_um'])} (Ra {length_text(heights['ra_um'])}) scatters "
        f"{percent_words(heights['tis'])} of what is reflected {where}"
    ]
    if "scattered" in heights:
        lines = [
            f"it scatters {percent_words(heights['scattered'])} of the light {where}, "
            f"{percent_words(heights['tis'])} of what is reflected, as an rms height of "
            f"{length_text(heights['sigma_um'])} does"
        ]
    if summed := heights.get("summed"):
        lines = [
            f"it scatters {percent_words(summed['scattered'])} of the light {where} within |beta - beta0| "
            f"{summed['beta'][0]:.2g}..{summed['beta'][1]:.2g}, as {summed['law']} adds it up",
            f"an rms height of {length_text(heights['sigma_um'])} (Ra {length_text(heights['ra_um'])}) is in its "
            "spectrum, which Rayleigh and Rice's theory reads off every direction",
        ]
    if "sigma_total_um" in heights:
        lines.append(f"that is what this light sees of {total_text(heights['sigma_total_um'])}")
    lines += band_lines(heights)
    if heights["smooth"]:
        lines.append(f"smooth: the phase (4 pi sigma cos/lambda)^2 is {heights['phase']:.2g}, below 0.1")
    else:
        lines.append(
            f"not smooth: the phase (4 pi sigma cos/lambda)^2 is {heights['phase']:.2g}, above 0.1; the first order "
            "of the roughness (Rayleigh-Rice, `abc`) does not hold, `he-torrance` does"
        )
    if elsewhere := heights.get("elsewhere"):
        rough = "" if elsewhere["smooth"] else ", beyond the first order of the roughness"
        lines.append(
            f"the same heights scatter {percent_words(elsewhere['tis'])} at {elsewhere['wavelength_nm']:g} nm{rough}"
        )
    return "\n".join(lines)


def total_text(sigma) -> str:
    """The height over all waves."""
    return "heights without a bound: c is 1 or less" if sigma is None else f"{length_text(sigma)} over all waves known"


def band_lines(heights: dict) -> list[str]:
    """From which waves a height is, and at which angles these scatter."""
    if "band_per_um" not in heights:
        return []
    low, high = heights["band_per_um"]
    longest = "the longest" if not low else length_text(1 / low)
    angles = ["beyond the horizon" if each is None else f"{each:.2g} degrees" for each in heights["band_deg"]]
    return [f"of waves from {length_text(1 / high)} to {longest}, which scatter at {angles[0]} to {angles[1]}"]


def agreement_text(ways: dict) -> str:
    """Whether profile, TIS and scan agree, over which waves, and what fails first."""
    if not ways:
        return ""
    names = " and ".join(each["what"] for each in ways["compared"])
    head = f"scan, {names} agree" if ways["agree"] else f"scan, {names} do not agree: {ways['because']}"
    lines = [head]
    for each in ways["compared"]:
        show = length_text if each["what"] == "profile" else percent_words
        low, high = each["band_per_um"]
        lines.append(
            f"{each['what']}: {show(each['read'])} read, {show(each['expected_by_scan'])} expected by the scan, over "
            f"waves from {length_text(1 / high)} to {length_text(1 / low)} ({percent_words(each['share_in_scan'])} of "
            "it measured by the scan)"
        )
    return "\n  ".join(lines)


def shape_text(shape: dict) -> str:
    """What follows of the profile."""
    names = {
        "rdq": ("rms slope of a profile (Rdq)", ""),
        "tau_um": ("correlation length", "length"),
        "slope": ("sigma/tau", ""),
        "alpha": ("alpha of a facet lobe (Sdq)", ""),
        "length_um": ("correlation length", "length"),
        "rq_in_band_um": ("Rq of a profile in the band", "length"),
        "rdq_in_band": ("Rdq of a profile in the band", ""),
        "sigma_in_band_um": ("sigma of the surface in the band", "length"),
    }
    lines = [
        f"{words}: {length_text(shape[key]) if kind else format(shape[key], '.3g')}"
        for key, (words, kind) in names.items()
        if key in shape
    ]
    if "band_per_um" in shape:
        low, high = shape["band_per_um"]
        lines.append(f"the band: waves from {length_text(1 / high)} to {length_text(1 / low)}")
    return "\n".join(lines)


def laws_text(laws: list[dict]) -> str:
    """The scatter in every law, with what it costs to say it so."""
    if not laws:
        return ""
    header = ("law", "off", "at worst", "parameters", "")
    lines = [
        (
            row["law"],
            off_words(row["off_percent"]),
            off_words(row["worst_percent"]),
            "  ".join(f"{name}{TIED}{parameter_text(entry)}" for name, entry in row["parameters"].items()),
            row["by"] + (f" ({', '.join(row['flags'])})" if row["flags"] else ""),
        )
        for row in laws
    ]
    low, high = laws[0]["over_beta"]
    return f"{columns(header, lines, right=(1, 2))}\nover |beta - beta0| from {low:.3g} to {high:.3g}"


def parameter_text(entry: dict) -> str:
    """A value with twice its standard error where that is worth a word."""
    values = entry["value"] if isinstance(entry["value"], list) else [entry["value"]]
    errors = entry["stderr"] if isinstance(entry["stderr"], list) else [entry["stderr"]]
    value, error = values[0], errors[0]
    shown = f"{value:.4g}" if len(values) == 1 else f"{min(values):.4g}..{max(values):.4g}"
    return shown if not error or error < 1e-4 * abs(value) else f"{shown}±{2 * error:.2g}"


def curve_text(curve: dict) -> str:
    """Some rows of the curve; JSON has all."""
    if not curve:
        return ""
    count = len(curve["beta"])
    places = sorted({round(each * (count - 1) / (ROWS - 1)) for each in range(ROWS)})
    header = ("|beta - beta0|", "theta_r deg", "brdf 1/sr", "frequency 1/um", "psd um^4")
    rows = [tuple(f"{values[place]:.4g}" for values in curve.values()) for place in places]
    return columns(header, rows, right=(0, 1, 2, 3, 4))


def assumed_text(document: dict) -> str:
    theory = {
        "rayleigh-rice": "by Rayleigh and Rice's first order of the roughness",
        "correlation in the exponent": "beyond the first order: the correlation in the exponent, as Kirchhoff has it",
    }
    said = [*filter(None, [theory.get(document.get("theory", ""))]), *document.get("assumes", [])]
    return "assumed:\n" + "\n".join(f"  {each}" for each in said) if said else ""


def length_text(um: float) -> str:
    """A length in the unit that people of its size use."""
    if um < 1e-3 * 0.9995 * 1000:
        return f"{1000 * um:.3g} nm"
    return f"{um:.3g} um" if um < 999.5 else f"{um / 1000:.3g} mm"

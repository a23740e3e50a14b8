"""What a fit of polished optics says beyond its parameters, in words."""

from collections.abc import Callable

from ...printable import off_words_of
from .scatter import length_text
from .values import percent_words


def stray_light_text(entries: list[dict], wrapped: Callable[[str], str]) -> str:
    """A paragraph for each law that is told, every line of it `wrapped`; nothing where there is none."""
    return "\n\n".join("\n".join([first, *map(wrapped, rest)]) for first, *rest in map(_entry, entries))


def _entry(entry: dict) -> list[str]:
    """What is told of a law, line by line."""
    nm = f"{entry['wavelength_nm']:g} nm"
    kind = (
        "physics: one spectrum of heights at every wavelength, scattered to first order"
        if entry["is"] == "physics"
        else f"a fit: its numbers hold at {nm} and between the angles measured"
    )
    lines = [f"stray light by {entry['law']} ({kind})"]
    lines += [_interval(name, each) for name, each in entry["intervals_95"].items()]
    lines += [_scattered(each, entry["beta"]) for each in entry["scattered"]]
    lines += [_heights(entry), _elsewhere(entry), _grazing(entry)]
    for typed in entry["numbers"]:
        numbers = ", ".join(f"{name} {value:.6g}" for name, value in typed["numbers"].items())
        lines.append(f"to type: {typed['program']}: {numbers}")
    lines += [_beside(each, entry) for each in entry["beside"]]
    return lines


def _interval(name: str, each: dict) -> str:
    return f"{name} = {each['value']:.6g}, 95 % within {each['low']:.6g}..{each['high']:.6g}"


def _scattered(each: dict, beta: list[float]) -> str:
    return (
        f"of light from {each['theta_i_deg']:g} degrees {percent_words(each['measured'])} is scattered within "
        f"|beta - beta0| {beta[0]:.2g}..{beta[1]:.2g}, {percent_words(each['extrapolated'])} from the mirror direction "
        "to the horizon, extrapolated"
    )


def _heights(entry: dict) -> str:
    low, high = entry["band_per_um"]
    by = "" if entry["is"] == "physics" else ", as the law has it near the normal,"
    text = (
        f"rms height {length_text(entry['sigma_um'])}{by} of waves from {length_text(1 / high)} to "
        f"{length_text(1 / low)}, where the smooth surface reflects {entry['reflectance_taken']:.3g}"
    )
    if entry["phase"] >= 0.1:
        text += f"; the phase is {entry['phase']:.2g}, above 0.1: too rough for the first order, an estimate"
    if entry["is"] == "physics":
        total = entry["sigma_total_um"]
        over_all = "without a bound (c is 1 or less)" if total is None else length_text(total)
        text += f"; over all waves, extrapolated: {over_all}"
        if ends := entry["sigma_total_um_interval"]:
            text += f", 95 % within {length_text(ends[0])}..{length_text(ends[1])}"
    return text


def _elsewhere(entry: dict) -> str:
    smooth = entry["phase"] < 0.1
    if entry["is"] == "physics":
        held = "holds" if smooth else "does not hold"
        return (
            f"at another wavelength: the same a, b, c; the first order {held} here, and from "
            f"{entry['first_order_from_nm']:.0f} nm on for these heights"
        )
    return "at another wavelength: not by this law; its spectrum scales (`abc`, `scatter --to-nm`)"


def _grazing(entry: dict) -> str:
    beyond = (
        "its cosines are those of the first order"
        if entry["is"] == "physics"
        else "the law has no cosines and no Fresnel, and is no guide there"
    )
    return f"toward grazing: measured to {entry['highest_theta_i_deg']:g} degrees of incidence; beyond, {beyond}"


def _beside(each: dict, entry: dict) -> str:
    off = off_words_of(each["rms_ln"])
    text = f"beside it {each['law']} is physics too: typically {off} off"
    if entry["is"] != "physics":
        text = f"physics beside it: {each['law']}, typically {off} off"
    if each["sigma_um"] is not None:
        text += f", rms height {length_text(each['sigma_um'])}"
    if each["agrees"] is None:
        return text
    return text + (
        ": they agree" if each["agrees"] else ": they do not agree; the one that is less off is to be trusted"
    )

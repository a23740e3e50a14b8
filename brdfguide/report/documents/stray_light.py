"""What a fit of polished optics says beyond its parameters, as a block of the fit's document."""

from dataclasses import asdict

from ...fitting.stray_light import AGREE, Beside, StrayLight
from ...physics.height_spectrum import to_surface
from .plain import plain


def stray_light_block(found: tuple[StrayLight, ...]) -> list[dict]:
    """One entry for each law that is told."""
    return [plain(_entry(each)) for each in found]


def _entry(each: StrayLight) -> dict:
    return {
        "law": each.law,
        "is": "physics" if each.physics else "fit",
        "wavelength_nm": 1000 * each.wavelength,
        "intervals_95": {
            name: {"value": v, "low": low, "high": high} for name, (v, low, high) in each.intervals.items()
        },
        "beta": list(each.beta),
        "scattered": [asdict(one) for one in each.scattered],
        "band_per_um": list(each.band),
        "reflectance_taken": each.reflectance,
        "sigma_um": each.sigma,
        "sigma_total_um": each.sigma_total,
        "sigma_total_um_interval": each.sigma_total_ends and list(each.sigma_total_ends),
        "numbers": _numbers(each),
        "has_total": each.sigma_total is not None,
        "phase": each.phase,
        "first_order_from_nm": 1000 * each.shortest,
        "highest_theta_i_deg": each.highest_deg,
        "beside": [_beside(one, each) for one in each.beside],
    }


def _numbers(each: StrayLight) -> list[dict]:
    """What to type into programs that have the law; lengths as they want them."""
    values = {name: value for name, (value, _, _) in each.intervals.items()}
    if {"a", "b", "g"} <= values.keys():
        row = {"Wave [um]": each.wavelength, "Angle [deg]": 0.0, "A": values["a"], "B": values["b"], "g": values["g"]}
        return [{"program": "ABg catalogue (Zemax; FRED, ASAP and TracePro name A, B, g alike)", "numbers": row}]
    if {"b0", "l", "s"} <= values.keys():
        row = {"b0 [1/sr]": values["b0"], "L": values["l"], "S": values["s"]}
        return [{"program": "Harvey-Shack (FRED, ASAP, LightTools)", "numbers": row}]
    if {"a", "b", "c"} <= values.keys():
        level = float(values["a"] * values["b"] * to_surface(values["c"]))
        row = {"A [um^4]": level, "B [um]": values["b"], "C": values["c"] + 1}
        return [{"program": "ABC spectrum of the surface (SCATMECH's ABC_PSD_Function)", "numbers": row}]
    return []


def _beside(one: Beside, each: StrayLight) -> dict:
    """`agrees`: whether its height is the same; null where either has none."""
    sigma = each.sigma_total if each.physics else None
    known = sigma is not None and sigma < float("inf") and one.sigma_um is not None
    agrees = abs(one.sigma_um / sigma - 1) < AGREE if known else None  # type: ignore[operator]
    return {"law": one.law, "rms_ln": one.rms_ln, "tied": one.tied, "sigma_um": one.sigma_um, "agrees": agrees}

"""What an answer on polished optics says beyond its parameters, as far as it follows from other numbers of it.

phase = (4π σ/λ)²,   first order from λ = 4π σ/√0.1,   band = β/λ,   95 % = value ± 1.96 σ, or value e^(±1.96 σ/value)
"""

from mpmath import exp, mpf, pi, sqrt

from .rederived import EXACT, Comparisons

SMOOTH = mpf("0.1")  # of the phase, up to which the first order holds
SIGMAS = mpf("1.96")
NAMES = {"A": "a", "B": "b", "g": "g", "b0 [1/sr]": "b0", "L": "l", "S": "s", "B [um]": "b"}  # typed -> the law's


def compare_stray_light(answer: dict, found: Comparisons) -> None:
    """Intervals from values and standard errors, the band and the phase, what to type, and the laws beside it."""
    rows = {row["candidate"]: row for row in answer["ranking"]}
    for number, told in enumerate(answer.get("stray_light") or ()):
        place, wavelength = f"stray_light[{number}]", mpf(told["wavelength_nm"]) / 1000
        sigma = mpf(told["sigma_um"])
        found.check(f"{place}.phase", told["phase"], (4 * pi * sigma / wavelength) ** 2)
        found.check(f"{place}.first_order_from_nm", told["first_order_from_nm"], 4000 * pi * sigma / sqrt(SMOOTH))
        for end in (0, 1):
            right = mpf(told["beta"][end]) / wavelength
            found.check(f"{place}.band_per_um[{end}]", told["band_per_um"][end], right)
        highest = answer["data"]["theta_i_deg"][-1]
        found.check(f"{place}.highest_theta_i_deg", told["highest_theta_i_deg"], highest, EXACT)
        _typed(told, place, found)
        if (row := rows.get(told["law"])) is not None:
            _intervals(told["intervals_95"], row["parameters"], f"{place}.intervals_95", found)
        for rank, other in enumerate(told["beside"]):
            if other["law"] in rows:
                right = rows[other["law"]]["rms_ln"]
                found.check(f"{place}.beside[{rank}].rms_ln", other["rms_ln"], right, EXACT)


def _typed(told: dict, place: str, found: Comparisons) -> None:
    """What to type into other programs; of a spectrum of heights only its length."""
    for number, card in enumerate(told["numbers"]):
        for name, value in card["numbers"].items():
            interval = told["intervals_95"].get(NAMES.get(name, ""))
            if name == "Wave [um]":
                found.check(f"{place}.numbers[{number}].numbers.{name}", value, mpf(told["wavelength_nm"]) / 1000)
            elif interval is not None:
                found.check(f"{place}.numbers[{number}].numbers.{name}", value, interval["value"], EXACT)


def _intervals(told: dict, parameters: dict, place: str, found: Comparisons) -> None:
    """Of each number that was fitted, in one of the channels: as much to both sides, or as many times."""
    for name, interval in told.items():
        entry = next((each for key, each in parameters.items() if key.rpartition(".")[2] == name), None)
        if entry is None or entry.get("stderr") is None:
            continue
        values, errors = (each if isinstance(each, list) else [each] for each in (entry["value"], entry["stderr"]))
        channel = min(range(len(values)), key=lambda each: abs(values[each] - interval["value"]))
        value, error = mpf(values[channel]), errors[channel if len(errors) > 1 else 0]
        found.check(f"{place}.{name}.value", interval["value"], value, EXACT)
        if error is None or not value:
            continue
        step, times = SIGMAS * mpf(error), exp(SIGMAS * mpf(error) / value)
        for end, rights in (("low", (value - step, value / times)), ("high", (value + step, value * times))):
            right = min(rights, key=lambda each: abs(each - mpf(interval[end])))
            found.check(f"{place}.{name}.{end}", interval[end], right)

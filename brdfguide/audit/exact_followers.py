"""Numbers of an answer that follow from others or from the models, beside its errors: copies, growth, the price out of
the plane of incidence, what to type.

R-mirror = f(mirror, high)/f(mirror, low) and R-max, the same for the largest value in the plane, of the model and of
the data (Westin et al. 2004, section 6).    price² = Σ p error² / Σ p over the laws, alike within 25 %, that are most
probable together    (ours)
"""

from collections.abc import Mapping
from functools import cache, lru_cache
from math import inf
from typing import Protocol

from mpmath import exp, expm1, fsum, log, mp, mpf, radians, sqrt

from .exact_errors import SMALLEST, Readings
from .exact_surface import ExactReading, ExactSurface
from .rederived import CLOSE, EXACT, Comparisons

ONE_PRICE = mpf("1.25")  # times, up to which errors are one
PRICE_DIGITS = 3
NO_ERROR = 1e-5  # rms ln, below which none is printed
WIDEST_DEG = 85.0  # R-max looks no farther
STEPS = 170  # of its scan, from one side to the other
COARSELY, BESIDE = 10, 3  # of these steps
NEAR_DEG = 3.0  # the mirror direction was measured
ROUGH = "rough-regime:"  # of a flag, before the parameter
MOST_COMPARED, HIGHEST_DEG = 120, 88.0  # incidences that are looked at for growth
MOST_HELD = 64  # incidences, beyond which none was held
ALIKE = 1e-9  # deg
HALF_A_STEP = 0.501  # of 255, and what six digits of a colour leave open
HELD_TOGETHER = 0.5e-1  # deg, within which incidences are told as one


class RowOfAnswer(Protocol):
    """One row with its exact surface and error."""

    row: dict
    place: str
    surface: ExactSurface
    rms: mpf


def copies(answer: dict, found: Comparisons) -> None:
    """The recommended row once more, what to type of each row, and what a step took that candidates grew in, where the
    next begins."""
    rows = {row["candidate"]: row for row in answer["ranking"]}
    same = rows.get(answer["recommended"])
    if same is not None:
        found.copy("recommended_fit", answer.get("recommended_fit"), same)
    for place, row in enumerate(answer["ranking"]):
        for key, value in (row.get("typed") or {}).items():
            if key in row["parameters"]:
                found.copy(f"ranking[{place}].typed.{key}", value, row["parameters"][key]["value"])
    steps = answer.get("grown") or []
    for place, (step, after) in enumerate(zip(steps, steps[1:], strict=False)):
        taken = next((each for each in step["tried"] if each["candidate"] == step["taken"] == after["of"]), None)
        if taken is not None:
            found.copy(f"grown[{place + 1}]", {key: after[key] for key in after.keys() & taken.keys()}, taken)


def regimes(row: dict, place: str, found: Comparisons) -> None:
    """Where only sigma/tau is known: from which sigma on, and the tau that goes with it, once more."""
    for flag in row["flags"]:
        if not flag["code"].startswith(ROUGH):
            continue
        key = flag["code"].removeprefix(ROUGH)
        term, told = key.removesuffix("sigma"), flag["numbers"]
        sigma, tau, slope = (row["parameters"].get(term + name) for name in ("sigma", "tau", "slope"))
        if sigma is None or tau is None or slope is None:
            continue
        found.check(f"{place}.flags.{flag['code']}.slope", told["slope"], slope["value"], EXACT)
        found.check(f"{place}.parameters.{key}.above", sigma.get("above"), told["sigma_um_above"], EXACT)
        right = mpf(told["sigma_um_above"]) / mpf(told["slope"])
        found.check(f"{place}.parameters.{term}tau.above", tau.get("above"), right)


def ranks(answer: dict, found: Comparisons) -> None:
    """Rows by error on the answer's scale, to five digits and from the least that is printed on, then by free numbers;
    those that tie are first together. Rows that are alike in both may stand either way round."""
    rows, metric = answer["ranking"], answer["metric"]
    keys = [(_five(row["errors"].get(metric)), row["free_parameters"]) for row in rows]
    ties = sum(bool(row["tied"]) for row in rows)
    for place, (row, key) in enumerate(zip(rows, keys, strict=True)):
        first, last = sum(each < key for each in keys) + 1, sum(each <= key for each in keys)
        right = 1 if row["tied"] and ties > 1 else min(max(row["rank"], first), last)
        found.check(f"ranking[{place}].rank", row["rank"], right)


def _five(error: float | None) -> float:
    return inf if error is None else float(f"{max(error, NO_ERROR):.5g}")


def reflectance_errors(row: dict, place: str, found: Comparisons) -> None:
    """dF0 = 8nk/((n + 1)² + k²)² dk, where F0 stands in place of k alone; told is half the way to the farther end of
    ln F0/(1 - F0) ± 2 dF0/(F0 (1 - F0)). Where n was fitted too both err together, which does not follow, nor at F0 = 0
    or 1."""
    for key, entry in row["parameters"].items():
        label = key.rpartition(".")[0]
        of_n, of_k = (row["parameters"].get(f"{label}.{name}") for name in "nk")
        if not entry.get("in_place_of") or entry.get("stderr") is None or of_n is None or of_n["fitted"]:
            continue
        n, k, error = (_many(each) for each in (of_n["value"], of_k["value"], of_k["stderr"]))
        for channel, told in enumerate(_many(entry["stderr"])):
            at_n, at_k, at_error = (mpf(each[channel if len(each) > 1 else 0]) for each in (n, k, error))
            normal = ((at_n - 1) ** 2 + at_k**2) / ((at_n + 1) ** 2 + at_k**2)
            if not 0 < normal < 1:  # nothing comes back, or all: odds have no end
                continue
            slope = 8 * at_n * at_k / ((at_n + 1) ** 2 + at_k**2) ** 2
            times = exp(2 * slope * at_error / (normal * (1 - normal)))
            odds = normal / (1 - normal)
            low, high = odds / times / (1 + odds / times), odds * times / (1 + odds * times)
            found.check(f"{place}.parameters.{key}.stderr[{channel}]", told, max(normal - low, high - normal) / 2)


def _many(value) -> list:
    return value if isinstance(value, list) else [value]


# --- growth ------------------------------------------------------------------------------------------


def exact_growth(each: RowOfAnswer, data: Readings, found: Comparisons) -> None:
    """R-mirror and R-max of model and data; nothing where the scans were not held."""
    told = each.row.get("growth")
    if told is None or told["r_max"] is None or len(told["theta_i_deg"]) != 2:
        return
    channel, place = len(data.wavelengths) // 2, f"{each.place}.growth"
    for end, right in enumerate(_compared_incidences(data)):
        found.check(f"{place}.theta_i_deg[{end}]", told["theta_i_deg"][end], right)
    low, high = (_scan(data, theta, channel) for theta in told["theta_i_deg"])
    if low is None or high is None:
        return
    lows, highs = _mirrors(data, low), _mirrors(data, high)
    right = max(data.exact[row][channel] for row in high) / max(data.exact[row][channel] for row in low)
    found.check(f"{place}.r_max_data", told["r_max_data"], right)
    if lows and highs:
        ratios = [data.exact[b][channel] / data.exact[a][channel] for a in lows for b in highs]
        found.check(f"{place}.r_mirror_data", told["r_mirror_data"], _nearest(ratios, told["r_mirror_data"]))
    at = [
        _at_mirror(each.surface, data, *pair, channel) for pair in zip(told["theta_i_deg"], (lows, highs), strict=True)
    ]
    ratios = [b / a for a in at[0] for b in at[1] if a > 0]
    if ratios:
        found.check(f"{place}.r_mirror", told["r_mirror"], _nearest(ratios, told["r_mirror"]))
    for steps in (COARSELY, 1):  # every step only where fewer do not agree
        first, last = (_largest(each.surface, data, theta, channel, steps) for theta in told["theta_i_deg"])
        right = last / first if first > 0 else mpf(told["r_max"])
        if abs(right - mpf(told["r_max"])) <= CLOSE * right:
            break
    found.check(f"{place}.r_max", told["r_max"], right)


@lru_cache(maxsize=4)
def _compared_incidences(data: Readings) -> tuple[float, ...]:
    """The lowest and the highest incidence [deg] at which the mirror direction was measured, of those with any value
    where there are no two such; none where none was held."""
    channel = len(data.wavelengths) // 2
    if len({round(10 * each[0]) for each in data.angles}) > MOST_COMPARED:
        return ()
    known = [row for row, told in enumerate(data.told) if told[channel] and data.angles[row][0] < HIGHEST_DEG]
    mirrors = [row for row in known if _off_plane(data.angles[row]) < NEAR_DEG and _near_mirror(data, row)]
    for rows in (mirrors, known):
        angles = {round(10 * data.angles[row][0]) / 10 for row in rows}
        if len(angles) > 1:
            return min(angles), max(angles)
    return ()


def _near_mirror(data: Readings, row: int) -> bool:
    return 2 - 2 * data.sights[row].pair.cos_m <= radians(NEAR_DEG) ** 2


def _off_plane(angles: tuple[float, float, float, float]) -> float:
    turn = (angles[3] - angles[1]) % 180
    return min(turn, 180 - turn) if min(angles[0], angles[2]) > ALIKE else 0.0


def _scan(data: Readings, theta: float, channel: int) -> list[int] | None:
    """Rows of one held incidence with a value, near the plane of incidence; None where there are none."""
    if len({round(each[0], 1) for each in data.angles}) > MOST_HELD:
        return None
    rows = [row for row, each in enumerate(data.angles) if abs(each[0] - theta) < HELD_TOGETHER]
    rows = [row for row in rows if data.told[row][channel] and _off_plane(data.angles[row]) < NEAR_DEG]
    return rows or None


def _mirrors(data: Readings, rows: list[int]) -> list[int]:
    """Rows nearest to the mirror direction, two where it lies between them; none where none is within 3 degrees."""
    away = {row: 2 - 2 * data.sights[row].pair.cos_m for row in rows if _near_mirror(data, row)}
    least = min(away.values(), default=mpf(0))
    return [row for row, each in away.items() if each <= least * (1 + ALIKE) + ALIKE**2]


def _at_mirror(surface: ExactSurface, data: Readings, theta: float, rows: list[int], channel: int) -> list:
    """The model at the measured directions nearest to the mirror's, at the mirror's where there is none."""
    sights = [data.sights[row] for row in rows] or [ExactReading((theta, 0.0, theta, 180.0), data.solid_angle)]
    return [sight.reading(surface, channel, data.wavelengths[channel]) for sight in sights]


def _largest(surface: ExactSurface, data: Readings, theta: float, channel: int, each: int):
    """The model's largest value in the plane of incidence, in steps of a degree; or `each` so many steps, and all
    beside the largest of them, the mirror direction and the light."""
    side = min(WIDEST_DEG, max(angles[2] for angles in data.angles))
    step = 2 * side / STEPS

    @cache
    def value(number: int):
        theta_r = side if number == STEPS else number * step - side
        sight = _in_the_plane(theta, theta_r, data.solid_angle, mp.prec)
        return sight.reading(surface, channel, data.wavelengths[channel])

    places = {*range(0, STEPS + 1, each), STEPS}
    for around in (theta, -theta):
        places |= _beside(round((around + side) / step), BESIDE)
    return max(value(number) for number in places | _beside(max(places, key=value), each))


@lru_cache(maxsize=4096)
def _in_the_plane(theta: float, theta_r: float, solid_angle: float | None, prec: int) -> ExactReading:
    """Once for all rows, to `prec` bits; θr [deg] is negative on the light's side."""
    return ExactReading((theta, 0.0, abs(theta_r), 0.0 if theta_r < 0 else 180.0), solid_angle)


def _beside(number: int, most: int) -> set[int]:
    """Steps around one."""
    return set(range(max(number - most, 0), min(number + most, STEPS) + 1))


def _nearest(ratios: list, told):
    """Of equally near directions the one that was taken."""
    return min(ratios, key=lambda each: abs(each - mpf(told if told is not None else 0)))


# --- out of the plane --------------------------------------------------------------------------------


def price(answer: dict, rows: Mapping[str, RowOfAnswer], data: Readings, found: Comparisons) -> None:
    """The expected error out of the plane from its parts, and where rivals part from the recommended law."""
    told, best = answer.get("off_plane"), rows.get(answer["recommended"])
    if told is None or best is None:
        return
    expected, probability, grazing = _most_probable(told["if_right"], mpf(told["rms_ln"]))
    found.loosened(best.surface.slack).check("off_plane.in_plane_rms_ln", told["in_plane_rms_ln"], best.rms)
    found.check("off_plane.rms_ln", told["rms_ln"], expected)
    found.check("off_plane.probability", told["probability"], probability)
    found.rounded("off_plane.expected_percent", told["expected_percent"], _percent(expected), PRICE_DIGITS)
    steep = told["toward_grazing"]
    if steep is not None and grazing is not None:
        place = "off_plane.toward_grazing"
        found.check(f"{place}.rms_ln", steep["rms_ln"], grazing)
        found.rounded(f"{place}.expected_percent", steep["expected_percent"], _percent(grazing), PRICE_DIGITS)
    then = {each["candidate"]: mpf(each["rms_ln"]) for each in told["if_right"]}
    for number, each in enumerate(told["apart"]):
        place = f"off_plane.apart[{number}]"
        if each["candidate"] in then:
            percent = _percent(then[each["candidate"]])
            found.rounded(f"{place}.then_percent", each["then_percent"], percent, PRICE_DIGITS)
        rival = rows.get(each["candidate"])
        for rank, at in enumerate(each["at"] if rival is not None else ()):
            assert rival is not None
            sight = ExactReading((at["theta_i_deg"], 0.0, at["theta_r_deg"], at["phi_deg"]), data.solid_angle)
            right = _mean_ln(rival.surface, sight, data) - _mean_ln(best.surface, sight, data)
            both = found.loosened(best.surface.slack + rival.surface.slack)
            both.check(f"{place}.at[{rank}].ln_ratio", at["ln_ratio"], right, absolute=1e-12)


def _most_probable(laws: list[dict], told):
    """The error that is told, its probability, and the same laws' error toward grazing: of the laws around one, the
    group with most; of groups with as much, as where two laws stand for each other, the one that is nearest to what was
    told."""
    groups = []
    for one in laws:
        near = [each for each in laws if _alike(each["rms_ln"], one["rms_ln"])]
        weight = fsum(mpf(each["probability"]) for each in near)
        if weight > 0:
            groups.append((weight, _mean_error(near, "rms_ln", weight), near))
    most = max(weight for weight, _, _ in groups)
    total = fsum(mpf(each["probability"]) for each in laws)
    weight, expected, near = min(
        (each for each in groups if each[0] >= most * (1 - mpf(CLOSE))), key=lambda each: abs(each[1] - told)
    )
    steep = all(each["grazing_rms_ln"] is not None for each in near)
    return expected, weight / total, _mean_error(near, "grazing_rms_ln", weight) if steep else None


def _mean_error(laws: list[dict], key: str, weight):
    """rms over the laws by their probability."""
    return sqrt(fsum(mpf(each["probability"]) * mpf(each[key]) ** 2 for each in laws) / weight)


def _alike(one: float, other: float) -> bool:
    return 1 / ONE_PRICE <= mpf(one) / mpf(other) <= ONE_PRICE


def _mean_ln(surface: ExactSurface, sight: ExactReading, data: Readings):
    """ln of what is read there, the mean over the channels."""
    every = [max(sight.reading(surface, c, um), SMALLEST) for c, um in enumerate(data.wavelengths)]
    return fsum(log(each) for each in every) / len(every)


def _percent(rms):
    return 100 * expm1(min(rms, mpf(50)))


# --- what to type into other programs ----------------------------------------------------------------


def programs(answer: dict, found: Comparisons) -> None:
    """Percentages from the errors beside them, and the colours in sRGB from those in linear light."""
    for number, card in enumerate(answer.get("numbers") or ()):
        place = f"numbers[{number}]"
        for error, percent in (("rms_ln", "off_percent"), ("measured_rms_ln", "measured_off_percent")):
            if card.get(error) is not None:
                found.rounded(f"{place}.{percent}", card.get(percent), _percent(mpf(card[error])))
        for label, told in card["hex"].items():
            for channel, linear in enumerate(_many(card["numbers"].get(label, []))):
                found.check(
                    f"{place}.hex.{label}[{channel}]",
                    _byte(told[1 + 2 * channel : 3 + 2 * channel]),
                    255 * _encoded(linear),
                    absolute=HALF_A_STEP,
                )


def _byte(two_digits: str) -> int:
    """-1 where they are none."""
    try:
        return int(two_digits, 16)
    except ValueError:
        return -1


def _encoded(linear: float):
    """sRGB's curve (IEC 61966-2-1)."""
    light = min(max(mpf(linear), mpf(0)), mpf(1))
    if light <= mpf("0.0031308"):
        return mpf("12.92") * light
    return mpf("1.055") * exp(log(light) / mpf("2.4")) - mpf("0.055")

"""An answer of `fit` derived again from the numbers it prints and the data: which of them agree, and which do not.

Parameters are taken as printed; from them, with mpmath and the laws of `textbook`, follow residuals, errors,
differences and what stands beside them: standard errors, growth, the price out of the plane, what is told twice; from
the numbers found without a group of incidences the held-out errors; from the data alone the noise of single values and
the floor under every law. What a fit found on its way cannot follow from its answer: that is said, and only the
answer's digest holds it.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import pi

from mpmath import cos, erfc, expm1, mpc, mpf, radians, sin, sqrt, tan, workdps

from ..data.measurement import Measurement
from ..errors import InputError
from ..records import dataclass
from . import exact_errors, exact_followers
from .answer_shape import refuse_gaps
from .exact_as_shader import compare_as_shader
from .exact_errors import Readings
from .exact_exports import compare_exports
from .exact_floor import compare_floor
from .exact_held_out import LookedAt, compare_held_out
from .exact_instrument import compare_instrument, undrifted
from .exact_intervals import FittedRow, compare_stderrs
from .exact_kind import compare_kind
from .exact_neighbours import compare_discrepancy
from .exact_noise import compare_noise
from .exact_ring import Ring
from .exact_stray_light import compare_stray_light
from .exact_surface import NoLaw, RoundingDecides, TooNarrow, surface_of
from .rederived import Comparisons, Rederived

DIGITS = 30  # of the arithmetic
ROUNDED = 1e-12  # deg, of a double near 90
LEFT_OUT = {"spikes", "dark-edge"}  # findings that take values out of a fit
WHITE = 39  # L* by which white changes with ln f, 116/3
LEAST_CHANCE = 1e-305  # of which a double has all its digits
ROUNDED_L = 1e-12  # L* that rounding leaves of a model that is exact


@dataclass(frozen=True)
class Verification:
    """What was derived, what was only used, what could not be derived, and why."""

    derived: tuple[Rederived, ...]
    used: int  # numbers that the derivation starts from
    left: dict[str, str]  # row -> why nothing was derived
    only_sealed: int  # numbers that do not follow from the answer

    @property
    def wrong(self) -> tuple[Rederived, ...]:
        return tuple(each for each in self.derived if not each.agrees)


def verify(
    answer: dict, data: Readings, only: str | None = None, progress: Callable[[str], None] = lambda name: None
) -> Verification:
    """Everything that follows from an answer's parameters and the data it was fitted to, in 30 digits.

    Takes  a document of `fit --json`; `only` the row of one model. The answer's own counts and ranges are compared with
    the data first.    Gives  every comparison; nothing is raised for a number that is wrong.    Raises InputError where
    numbers are lacking that others follow from.
    """
    refuse_gaps(answer)
    found, left = Comparisons(), dict[str, str]()
    with workdps(DIGITS):
        _data_block(answer["data"], data, found)
        found.check("noise.values_told", answer["noise"].get("values_told"), sum(map(sum, data.told)))
        compare_noise(answer, data, found)
        if only is None:
            compare_kind(answer, data, found)
        grey = _grey_ring(answer, data)
        rows, again = {}, LookedAt.of(answer, data)
        drifted = any(_has(row, "instrument") or row.get("instrument") for row in answer["ranking"])
        for place, row in enumerate(answer["ranking"]):
            progress(row["candidate"])
            if only is not None and only not in (row["candidate"], row["model"]):
                continue
            if drifted and not ("instrument" in row or _has(row, "instrument") or _has(row, "coarse")):
                left[row["candidate"]] = "what the instrument did beside it is not in the answer"
                continue
            if drifted and any(data.limits):
                left[row["candidate"]] = "what the instrument did changes which values are too dim to tell"
                continue
            try:
                rows[place] = _Row(row, f"ranking[{place}]", data, grey, answer["metric"], again)
            except NoLaw as missing:
                left[row["candidate"]] = f"no law called {missing} is written down a second time"
            except TooNarrow:
                left[row["candidate"]] = "of a lobe so narrow the program's series tells too few digits"
            except RoundingDecides:
                left[row["candidate"]] = "its lobe ends where some directions lie: rounding decides on which side"
            else:
                rows[place].errors(found)
        _noise_and_floor(answer, rows, data, found)
        _differences(rows, len(rows) == len(answer["ranking"]), found)
        by_name = {each.row["candidate"]: each for each in rows.values()}
        exact_followers.price(answer, by_name, data, found)
        written = compare_exports(answer, by_name.get(answer["recommended"]), data, found)
        written += compare_as_shader(answer, data, found)
        if only is None:
            _orders(answer, found)
            exact_followers.ranks(answer, found)
            exact_followers.copies(answer, found)
            exact_followers.programs(answer, found)
            compare_stray_light(answer, found)
    used = (
        written + sum(map(_parameters_of, answer["ranking"])) + len((answer.get("held_out_on") or {"rows": ()})["rows"])
    )
    return Verification(tuple(found.derived), used, left, max(_numbers(answer) - used - len(found.derived), 0))


def readings_of(measurement: Measurement, answer: dict, before: Measurement | None = None) -> Readings:
    """A measurement as it was read for the fit, with what the answer says of its values; `before` anything was left out
    of it, where something was.

    Raises InputError where the answer has other channels.
    """
    geom, channels = measurement.geom, len(measurement.channels)
    if len(answer["data"]["channels"]) != channels:
        told = len(answer["data"]["channels"])
        found = f"{channels} channel{'s' * (channels != 1)}"
        raise InputError(f"{measurement.name}: found {found}; the answer has {told}: are they its data?")
    columns = (geom.theta_i_deg, geom.phi_i_deg, geom.theta_r_deg, geom.phi_i_deg + geom.phi_deg)
    beyond = (_beyond(geom.theta_i_deg, geom.theta_i), _beyond(geom.theta_r_deg, geom.theta_r))
    wavelengths = geom.wavelength.tolist() if hasattr(geom.wavelength, "tolist") else geom.wavelength
    wavelengths = wavelengths if isinstance(wavelengths, list) else [wavelengths]
    codes = _codes(answer)
    errors = measurement.stated_errors
    return Readings(
        angles=tuple(zip(*(column.ravel().tolist() for column in columns), strict=True)),
        values=tuple(map(tuple, measurement.brdf.tolist())),
        limits=tuple(answer["noise"].get("told_from_per_sr") or [0.0] * channels),
        wavelengths=tuple(wavelengths if len(wavelengths) == channels else wavelengths * channels),
        solid_angle=measurement.solid_angle or answer["data"].get("solid_angle_sr"),
        by_scan="weighed-by-scan" in codes,
        by_error="weighed-by-stderr" in codes,
        missed=answer["noise"].get("missed"),
        doubt=tuple(answer["noise"].get("absolute_per_sr") or [0.0] * channels),
        stated=tuple(map(tuple, errors.tolist())) if errors is not None else None,
        robust="weighed-robustly" in codes,
        faults=bool(measurement.otherwise),
        beyond=tuple(zip(*(column.ravel().tolist() for column in beyond), strict=True)),
        as_read=_as_read(measurement, lacks_some(answer), before),
    )


def lacks_some(answer: dict) -> bool:
    """Whether values may have been left out of the fit."""
    return not _codes(answer).isdisjoint(LEFT_OUT)


def _codes(answer: dict) -> set[str]:
    return {each["code"] for each in answer["data"]["findings"]}


def _as_read(measurement: Measurement, lacks: bool, before: Measurement | None):
    """The values before anything was left out; None where that is not known."""
    if before is not None and len(before.brdf) == len(measurement.brdf):
        return tuple(map(tuple, before.brdf.tolist()))
    return None if lacks else tuple(map(tuple, measurement.brdf.tolist()))


def _parameters_of(row: dict) -> int:
    """How many numbers of one row are parameters: its own, those found without a group of incidences or turns, and
    those of an instrument beside it."""
    values, folds = [entry["value"] for entry in row["parameters"].values()], row.get("held_out_fits") or []
    values += [value for fold in folds for value in (*fold["values"].values(), fold.get("turns_deg"))]
    values += (row.get("instrument") or {}).values()
    return sum(map(_size, values))


def _beyond(told, radians):
    """What zeniths [deg] are beyond the digits that people read, 1e-9: those of vectors and of radians have more."""
    more = radians * (180 / pi) - told
    return more * (abs(more) > ROUNDED)


def _has(row: dict, code: str) -> bool:
    return any(flag["code"] == code for flag in row["flags"])


def _size(value) -> int:
    return len(value) if isinstance(value, list) else int(value is not None)


def _numbers(document) -> int:
    """How many numbers stand in a document."""
    if isinstance(document, dict):
        return sum(map(_numbers, document.values()))
    if isinstance(document, list):
        return sum(map(_numbers, document))
    return int(isinstance(document, (int, float)) and not isinstance(document, bool))


def _data_block(block: dict, data: Readings, found: Comparisons) -> None:
    """What the answer says of the data themselves."""
    found.check("data.samples", block["samples"], len(data.angles))
    found.check("data.values", block["values"], len(data.angles) * len(data.wavelengths))
    found.check("data.missing", block.get("missing"), sum(not known for row in data.looked_at for known in row))
    for name, place in (("theta_i_deg", 0), ("theta_r_deg", 2)):
        angles = [each[place] for each in data.angles]
        found.check(f"data.{name}[0]", block[name][0], min(angles))
        found.check(f"data.{name}[1]", block[name][1], max(angles))
    for place, nm in enumerate(block["wavelength_nm"]):
        found.check(f"data.wavelength_nm[{place}]", nm, round(1e3 * data.wavelengths[place], 6))


def _grey_ring(answer: dict, data: Readings) -> tuple[Ring, list] | None:
    """How S is taken of one channel in the plane of incidence, and the data's lightness; None elsewhere."""
    if answer.get("seen_weights") != "ring" or len(data.wavelengths) != 1:
        return None
    ring = Ring(data)
    return ring, ring.lightness(None)


class _Row:
    """One row with its exact residuals."""

    def __init__(
        self, row: dict, place: str, data: Readings, grey: tuple[Ring, list] | None, metric: str, again: LookedAt
    ):
        self.row, self.place, self.grey, self.metric, self.again = row, place, grey, metric, again
        self.surface = surface_of(row["model"], row["parameters"])
        by_flag = next((each["numbers"] for each in row["flags"] if each["code"] == "instrument"), None)
        self.drift = row.get("instrument") or by_flag
        left = data if self.drift is None else undrifted(data, self.drift)
        self.data = data if self.drift is None else replace(data, taken=left.told)
        self.residuals = exact_errors.exact_residuals(self.surface, left)
        self.rms = exact_errors.exact_rms(self.residuals, data.share)
        self.lightness = grey[0].lightness(self.residuals, self.surface) if grey else None

    def errors(self, found: Comparisons) -> None:
        """Its own errors, and the numbers that follow from its parameters."""
        row, place, found = self.row, self.place, found.loosened(self.surface.slack)
        found.check(f"{place}.rms_ln", row["rms_ln"], self.rms)
        found.rounded(f"{place}.off_percent", row["off_percent"], 100 * expm1(min(self.rms, mpf(50))))
        by_theta = exact_errors.by_incidence(self.residuals, self.data)
        for angle, told in row["rms_ln_by_theta_i"].items():
            right = by_theta.get(float(angle), mpf("nan"))
            found.check(f"{place}.rms_ln_by_theta_i.{angle}", told, right, absolute=self.surface.lost)
        scales = {"ln": self.rms, **exact_errors.on_scales(self.residuals, self.data)}
        for name, right in scales.items():
            found.check(f"{place}.errors.{name}", row["errors"][name], right, absolute=self.surface.lost)
        if self.grey and self.lightness:
            right = self.grey[0].apart(self.lightness, self.grey[1])
            for key, told in (("seen", row["seen"]), ("errors.seen", row["errors"]["seen"])):
                found.check(f"{place}.{key}", told, right, absolute=ROUNDED_L + WHITE * found.slack)
        fitted = (_size(each["value"]) for each in row["parameters"].values() if each.get("fitted"))
        found.check(f"{place}.free_parameters", row["free_parameters"], sum(fitted))
        self._parameters(found)
        if self.drift is None and not found.slack:  # what gains and zero leave open was found on the way
            fitted_row = FittedRow(
                row["parameters"], self.surface, self.residuals, not _has(row, "coarse"), self.metric
            )
            compare_stderrs(fitted_row, place, self.data, found)
        exact_followers.reflectance_errors(row, place, found)
        exact_followers.regimes(row, place, found)
        exact_followers.exact_growth(self, self.data, found)
        compare_held_out(row, place, self.data, self.again, found)
        compare_instrument(row, place, found)
        for flag in row["flags"]:
            if flag["code"] == "discrepancy":
                self._discrepancy(flag["numbers"], f"{place}.flags.discrepancy", found)
        self.surface.known.clear()  # of a large table all rows together would hold much

    def _discrepancy(self, told: dict, place: str, found: Comparisons) -> None:
        """How neighbours err together, and what follows: 100 (e^(rms √ρ) - 1), and the chance of a z so large."""
        compare_discrepancy(told, self.residuals, place, self.data, found)
        plain = exact_errors.exact_rms(self.residuals, [mpf(1)] * len(self.residuals))
        part = plain * sqrt(max(mpf(told["correlation"]), mpf(0)))
        found.check(f"{place}.systematic_rms_ln", told["systematic_rms_ln"], part)
        found.check(f"{place}.percent", told["percent"], 100 * expm1(min(part, mpf(300))))
        found.check(f"{place}.chance", told["chance"], erfc(mpf(told["z"]) / sqrt(2)) / 2, absolute=LEAST_CHANCE)

    def _parameters(self, found: Comparisons) -> None:
        """What follows from its parameters, and how well those are known."""
        for key, entry in self.row["parameters"].items():
            place = f"{self.place}.parameters.{key}"
            values = entry["value"] if isinstance(entry["value"], list) else [entry["value"]]
            law = key.rpartition(".")[2] if entry.get("derived") else ""
            for channel, value in enumerate(values if law in FOLLOWS else ()):
                own = {
                    name.rpartition(".")[2]: self.surface.at(name, channel)
                    for name in self.surface.values
                    if name.rpartition(".")[0] == key.rpartition(".")[0]
                }
                found.check(f"{place}.value[{channel}]", value, FOLLOWS[law](**own))
            if entry.get("known_to") is not None and entry["stderr"] is not None:
                found.check(f"{place}.known_to", entry["known_to"], _known_to(values, entry["stderr"]))


def _known_to(values: list, stderr) -> float:
    """Two standard errors as a share of the value, the median over channels."""
    errors = stderr if isinstance(stderr, list) else [stderr]
    shares = sorted(2 * error / value for value, error in zip(values, errors, strict=True) if value and value > 0)
    middle = len(shares) // 2
    return shares[middle] if len(shares) % 2 else (shares[middle - 1] + shares[middle]) / 2


def _c_z(*, tilt, **_):
    wide = abs(tilt) < 45
    return mpf(1) if wide else cos(radians(tilt)) / abs(sin(radians(tilt)))


def _c_xy(*, tilt, **_):
    sign = (tilt > 0) - (tilt < 0)
    return -tan(radians(tilt)) if abs(tilt) < 45 else mpf(-sign)


def _at_82_degrees(*, n, k, **_):
    """F as the mean of |r_s|² and |r_p|² by Fresnel's own two equations."""
    c, index2 = cos(radians(mpf(82))), mpc(n, k) ** 2
    q = sqrt(index2 - 1 + c**2)
    return (abs((c - q) / (c + q)) ** 2 + abs((index2 * c - q) / (index2 * c + q)) ** 2) / 2


FOLLOWS: dict[str, Callable] = {  # numbers beside the parameters -> how they follow
    "tau": lambda *, sigma, slope, **_: sigma / slope,
    "alpha": lambda *, alpha_x, alpha_y, **_: sqrt(alpha_x * alpha_y),
    "ratio": lambda *, alpha_x, alpha_y, **_: alpha_x / alpha_y,
    "F0": lambda *, n, k, **_: ((n - 1) ** 2 + k**2) / ((n + 1) ** 2 + k**2),
    "F82": _at_82_degrees,
    "c_xy": _c_xy,
    "c_z": _c_z,
}


def _noise_and_floor(answer: dict, rows: dict[int, _Row], data: Readings, found: Comparisons) -> None:
    """By how much single values scatter, from their doubts or, where those are not known, from the first row's
    residuals; and the floor under the row that errs least."""
    told, floor = answer["noise"], answer.get("floor")
    first = next((each for each in rows.values() if each.row["rank"] == 1 and each.row["behind"] == 0), None)
    noise = None
    if told.get("relative") is not None and "absolute_per_sr" in told:
        noise = exact_errors.noise_of_values(data, told["relative"], first and first.rms)
    elif "absolute_per_sr" in told and first is not None:
        noise = exact_errors.noise_of_residuals(data, first.residuals, first.rms)
    if noise is not None:
        found.rounded("noise_rms_ln", answer["noise_rms_ln"], noise, 6)
    if floor is None:
        return
    if noise is not None:
        found.rounded("floor.noise", floor.get("noise"), noise)
    under = next((each for each in rows.values() if each.row["candidate"] == floor["candidate"]), None)
    if under is not None and not under.surface.slack:
        compare_floor(answer, under.surface, under.residuals, data, found)


def _differences(rows: dict[int, _Row], complete: bool, found: Comparisons) -> None:
    """How far each row lies behind the best, with its standard error, and how different the two look. Of all rows the
    best is the one that says that it is least behind."""
    tied = [each for each in rows.values() if each.row["tied"]]
    best = min(tied, key=lambda each: abs(each.row["behind"]), default=None)
    if best is None or not (complete or best.row["behind"] == 0):
        return
    for each in rows.values():
        found = found.loosened(max(each.surface.slack, best.surface.slack))
        right, error = exact_errors.exact_behind(each.residuals, best.residuals, each.data)
        found.check(f"{each.place}.behind", each.row["behind"], right, absolute=1e-12)
        lost = max(0.1 * max(each.surface.lost, best.surface.lost), 1e-15)
        found.check(f"{each.place}.behind_se", each.row["behind_se"], error, 1e-8, lost)
        if each.grey and each.lightness and best.lightness:
            apart = each.grey[0].apart(each.lightness, best.lightness)
            allowed = 1e-11 + 2 * WHITE * found.slack
            found.check(f"{each.place}.seen_from_best", each.row["seen_from_best"], apart, absolute=allowed)


def _orders(answer: dict, found: Comparisons) -> None:
    """The same errors where candidates are put in order."""
    rows = {row["candidate"]: row for row in answer["ranking"]}
    for place, entry in _entries(answer):
        row = rows.get(entry["candidate"])
        if row is None:
            continue
        name = "seen" if "seen" in entry else place.split(".")[1]
        key = "seen" if "seen" in entry else "error"
        right = row["errors"].get(name)
        if right is not None:
            found.check(f"{place}.{key}", entry[key], right)


def _entries(answer: dict) -> Iterator[tuple[str, dict]]:
    for name, scale in answer.get("scales", {}).items():
        for place, entry in enumerate(scale["order"]):
            yield f"scales.{name}.order[{place}]", entry
    for place, entry in enumerate(answer.get("seen_order", ())):
        yield f"seen_order[{place}]", entry

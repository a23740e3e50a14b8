"""The answer of `roughness` as a document. Loads nothing but `math`: shell loops call it."""

from math import pi, sqrt

from ...errors import InputError, NoAnswer
from ...physics import emergence

SCHEMA = "brdfguide/roughness/1"
SLOPE = 0.1  # sigma/tau where nothing is known, as in the report's example
OTHER_NM = (450.0, 650.0)
ANGLE_ERROR = 2.0  # deg, one standard deviation of how an eye reads the angle (ours)
MOST_ERROR = 45.0  # deg
WITHIN = 1.96  # standard deviations that hold 95 %
STEEPEST_DEG = 89.9
# outside it is taken for a typing error
SLOPES = (1e-6, 1e6)  # sigma/tau
LENGTHS = (1e-6, 1e6)  # µm
WAVES = (1.0, 1e6)  # nm
# By which share sigma/tau has to grow until it shows side by side, 2.5 L* of `physics.seen`: the widths 0.1 to 0.3 of
# a Gaussian lobe with n = 1.5, and with gold's index in red on the metal. Computed by `models.visible_change`; a test
# does it again
SHOWS_FROM = {"bare metal": 0.035, "dark plastic (albedo 0.02)": 0.16, "light plastic (albedo 0.3)": 0.33}


def document(
    angle=None,
    slope=None,
    sigma_um=None,
    tau_um=None,
    wavelength_nm=1000 * emergence.WAVELENGTH,
    pupil_mm=emergence.PUPIL_MM,
    distance_mm=emergence.DISTANCE_MM,
    contour=False,
    never=False,
    angle_error=None,
    brief=False,
) -> dict:
    """What Eq. 3 and the criterion say. Raises InputError for a wrong question, NoAnswer where neither answers.

    `brief` leaves out the angles in other light, which cost a third of the rest and which only --full and --json show.
    """
    if never and angle is None:
        angle = 85.0  # as far as people usually look
    _check(angle, slope, sigma_um, tau_um, wavelength_nm)
    _check_error(angle_error, angle, never)
    omega = emergence.pupil_solid_angle(pupil_mm, distance_mm)
    um = wavelength_nm / 1000
    unknown = slope is None and sigma_um is None and tau_um is None
    question = {"slope": SLOPE if unknown else slope, "sigma": sigma_um, "tau": tau_um}
    standard = (pupil_mm, distance_mm) == (emergence.PUPIL_MM, emergence.DISTANCE_MM)
    eq3 = _answer(lambda: _by_formula(angle, **question, um=um, standard=standard), "eq3_refused", angle, c=None)
    criterion = _answer(lambda: _by_criterion(angle, **question, um=um, omega=omega), "criterion_refused", angle)
    if eq3["sigma_um"] is None and criterion["sigma_um"] is None:
        raise NoAnswer("; ".join(dict.fromkeys(flag["text"] for part in (eq3, criterion) for flag in part["flags"])))
    if eq3["sigma_um"] is not None:
        eq3["flags"] += _doubts_of_table(eq3["angle_deg"])
    if criterion["sigma_um"] is not None:
        criterion["flags"] += _doubts_of_theory(criterion)
    result = {
        "schema": SCHEMA,
        "angle_deg": angle if angle is not None else criterion["angle_deg"],
        "emergence": "never" if never else "seen",
        "wavelength_nm": wavelength_nm,
        "solid_angle_sr": omega,
        "pupil_mm": pupil_mm,
        "distance_mm": distance_mm,
        "eq3": eq3,
        "criterion": criterion,
    }
    if eq3["sigma_um"] and criterion["sigma_um"] and angle is not None:
        key = "tau_um" if sigma_um is not None else "sigma_um"
        result["difference"] = {"of": key, "eq3_over_criterion_percent": 100 * (eq3[key] / criterion[key] - 1)}
    if criterion["sigma_um"] and angle is not None and not never:
        result["doubt"] = _doubt(angle, angle_error, question, um, omega, criterion["tau_um"])
    if criterion["sigma_um"]:
        result["slopes"] = _slopes(criterion["slope"])
    if criterion["sigma_um"] and not brief:
        result["other_wavelengths"] = _in_other_light(criterion, omega)
    if contour:
        if angle is None:
            raise InputError("--contour needs --angle")
        result["contour"] = emergence.contour(angle, emergence.tau_steps(um), um, omega)
    return result


def _check(angle, slope, sigma_um, tau_um, wavelength_nm) -> None:
    """Raises InputError for a typing error, and for a question that asks too little or too much."""
    for name, value, (low, high) in (
        ("slope", slope, SLOPES),
        ("sigma-um", sigma_um, LENGTHS),
        ("tau-um", tau_um, LENGTHS),
        ("wavelength-nm", wavelength_nm, WAVES),
    ):
        if value is not None and not low <= value <= high:
            raise InputError(f"--{name} {value:g} is outside {low:g} to {high:g}")
    if angle is None and (sigma_um is None or tau_um is None):
        raise InputError(
            "say at which --angle the mirror image emerges, or give --sigma-um and --tau-um to ask for that angle"
        )
    if angle is not None and sum(value is not None for value in (slope, sigma_um, tau_um)) > 1:
        raise InputError("with --angle, one of --slope, --sigma-um and --tau-um: the others follow")


def _check_error(angle_error, angle, never) -> None:
    """Raises InputError for an error that is none, and for one without a reading that it could be of."""
    if angle_error is None:
        return
    if angle is None or never:
        raise InputError("--angle-error is the doubt of a reading, and there is none: give --angle, without --never")
    if not 0 <= angle_error <= MOST_ERROR:
        raise InputError(f"--angle-error {angle_error:g} is outside 0 to {MOST_ERROR:g} deg")


def _doubt(angle, angle_error, question, um, omega, tau):
    """What the number that was asked for would be at the ends of the reading's interval of 95 %."""
    angle_error = ANGLE_ERROR if angle_error is None else angle_error
    of, ends = "tau_um" if question["sigma"] is not None else "sigma_um", []
    for end in (angle - WITHIN * angle_error, angle + WITHIN * angle_error):
        found = None
        if 0 <= end <= STEEPEST_DEG:
            try:
                found = _at_end(end, **question, um=um, omega=omega, near=tau)
            except NoAnswer:
                found = None
        ends.append(found)
    low, high = ends
    if low is not None and high is not None and low > high:
        low, high = high, low
    return {"of": of, "angle_error_deg": angle_error, "low": low, "high": high}


def _at_end(angle, slope, sigma, tau, um, omega, near):
    """The number that was asked for, at another angle."""
    if tau is not None:
        return emergence.sigmas_for_tau(angle, tau, um, omega)[0]
    if sigma is not None:
        return emergence.tau_for_sigma(angle, sigma, um, omega)
    return emergence.crossing(angle, slope, um, omega, near)[0]


def _by_formula(angle, slope, sigma, tau, um, standard):
    if not standard:
        raise NoAnswer("Eq. 3 holds for a pupil of 3 mm at 600 mm only")
    if angle is None:
        angle = emergence.formula_angle(sigma, tau, um)
    elif tau is not None:
        sigma = emergence.formula_sigma(angle, tau, um)
    elif sigma is not None:
        tau = emergence.formula_tau(angle, sigma, um)
    else:
        sigma, tau = emergence.formula_crossing(angle, slope, um)
    return {
        "c": emergence.eq3_constant(angle),
        "angle_deg": angle,
        "sigma_um": sigma,
        "tau_um": tau,
        "slope": sigma / tau,
        "flags": [],
    }


def _by_criterion(angle, slope, sigma, tau, um, omega):
    flags = []
    if angle is None:
        angle = emergence.emergence_angle(sigma, tau, um, omega)
        if angle is None:
            raise NoAnswer("by the criterion the mirror image of this surface stands out nowhere below 89.9 deg")
    elif tau is not None:
        sigma, *more = emergence.sigmas_for_tau(angle, tau, um, omega)
        if more:
            flags.append(
                _flag(
                    "several_sigmas",
                    f"beyond 88.68 deg one tau has several sigma; also {', '.join(f'{s:.3g}' for s in more)} um",
                )
            )
    elif sigma is not None:
        tau = emergence.tau_for_sigma(angle, sigma, um, omega)
    else:
        sigma, tau = emergence.crossing(angle, slope, um, omega)
    if sigma / tau > emergence.STEEPEST:
        raise NoAnswer(f"the criterion gives sigma/tau = {sigma / tau:.3g}: beyond 1 the theory does not hold")
    return {"angle_deg": angle, "sigma_um": sigma, "tau_um": tau, "slope": sigma / tau, "flags": flags}


def _answer(ask, code, angle, **empty):
    """What `ask` says, or nulls with the reason."""
    try:
        return ask()
    except NoAnswer as reason:
        return {
            **empty,
            "angle_deg": angle,
            "sigma_um": None,
            "tau_um": None,
            "slope": None,
            "flags": [_flag(code, str(reason))],
        }


def _doubts_of_table(angle):
    if angle < 15:
        return [_flag("eq3_below_15", "Table 2 begins at 15 deg: C is continued below it")]
    return [_flag("eq3_low_at_85", "Table 2 is 20 to 25 % low at 85 deg: prefer the criterion")] if angle > 80 else []


def _doubts_of_theory(point):
    if point["slope"] > 0.3:
        return [
            _flag(
                "steep", f"sigma/tau = {point['slope']:.3g}: above 0.3 the theory loses light, its slopes are too steep"
            )
        ]
    return (
        [_flag("shallow", f"sigma/tau = {point['slope']:.3g}: most surfaces lie in 0.01 to 1")]
        if point["slope"] < 0.01
        else []
    )


def _slopes(slope):
    """What else is called the slope of such a surface."""
    return {
        "sigma_over_tau": slope,
        "rms_along_a_line": sqrt(2) * slope,
        "mean_gradient": sqrt(pi) * slope,
        "beckmann_alpha": 2 * slope,
        "shows_from": SHOWS_FROM,
    }


def _in_other_light(point, omega):
    """From where on the mirror image of the criterion's surface stands out at other wavelengths."""
    surface = point["sigma_um"], point["tau_um"]
    return [
        {"wavelength_nm": nm, "angle_deg": emergence.emergence_angle(*surface, nm / 1000, omega)} for nm in OTHER_NM
    ]


def _flag(code, text):
    return {"code": code, "text": text}

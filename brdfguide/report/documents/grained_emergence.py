"""The answer of `roughness --angle A --angle-across B` as a document. Loads nothing but `math`."""

from math import inf, sqrt

from ...errors import InputError, NoAnswer
from ...physics import emergence
from ...physics.grained_emergence import both_lengths
from .emergence import ANGLE_ERROR, LENGTHS, MOST_ERROR, SCHEMA, SLOPE, SLOPES, STEEPEST_DEG, WAVES, WITHIN

REFUSED = "Eq. 3 knows no grain"


def grained_document(
    angle: float,
    angle_across: float,
    slope: float | None = None,
    sigma_um: float | None = None,
    wavelength_nm: float = 1000 * emergence.WAVELENGTH,
    pupil_mm: float = emergence.PUPIL_MM,
    distance_mm: float = emergence.DISTANCE_MM,
    angle_error: float | None = None,
) -> dict:
    """One height and both correlation lengths from the angle along the grooves and the angle across them [deg].

    Of `slope`, sigma/tau across the grain (0.1 unless given), and sigma [µm] one is known. Raises InputError for a
    wrong question, NoAnswer where no ratio of lengths gives such angles.
    """
    _check(angle, angle_across, slope, sigma_um, wavelength_nm, angle_error)
    omega, um = emergence.pupil_solid_angle(pupil_mm, distance_mm), wavelength_nm / 1000
    if slope is None and sigma_um is None:
        slope = SLOPE
    question: dict = {"slope": slope, "sigma": sigma_um, "wavelength": um, "omega": omega}
    sigma, tau_x, tau_y = both_lengths(angle, angle_across, **question)
    if sigma / tau_x > emergence.STEEPEST:
        raise NoAnswer(f"sigma/tau = {sigma / tau_x:.3g} across the grain: beyond 1 the theory does not hold")
    error = ANGLE_ERROR if angle_error is None else angle_error
    tau = sqrt(tau_x * tau_y)
    empty = {"c": None, "angle_deg": angle, "sigma_um": None, "tau_um": None, "slope": None}
    return {
        "schema": SCHEMA,
        "angle_deg": angle,
        "emergence": "seen",
        "wavelength_nm": wavelength_nm,
        "solid_angle_sr": omega,
        "pupil_mm": pupil_mm,
        "distance_mm": distance_mm,
        "eq3": {**empty, "flags": [{"code": "eq3_refused", "text": REFUSED}]},
        "criterion": {"angle_deg": angle, "sigma_um": sigma, "tau_um": tau, "slope": sigma / tau, "flags": []},
        "grain": {
            "angle_across_deg": angle_across,
            "tau_across_um": tau_x,
            "tau_along_um": tau_y,
            "slope_across": sigma / tau_x,
            "slope_along": sigma / tau_y,
            "ratio": tau_y / tau_x,
            "angle_error_deg": error,
            "ratio_interval": _interval(angle, angle_across, error, question),
        },
    }


def _interval(along: float, across: float, error: float, question: dict) -> list[float | None]:
    """Ratios that the ends of the difference's interval of 95 % give, both angles being read to `error`; None where
    every ratio from there on fits."""
    off = WITHIN * error / sqrt(2)  # of each angle, the other way round: the difference's own interval
    found: list[float | None] = []
    for sign in (-1, 1):
        low, high = along + sign * off, across - sign * off
        ratio = 1.0 if sign < 0 else inf
        if high < low < STEEPEST_DEG and high > 0:
            try:
                sigma, tau_x, tau_y = both_lengths(low, high, **question)
                ratio = tau_y / tau_x
            except NoAnswer:
                pass
        found.append(None if ratio == inf else ratio)
    return found


def _check(angle, angle_across, slope, sigma_um, wavelength_nm, angle_error) -> None:
    for name, value, (low, high) in (
        ("slope", slope, SLOPES),
        ("sigma-um", sigma_um, LENGTHS),
        ("wavelength-nm", wavelength_nm, WAVES),
        ("angle-error", angle_error, (0.0, MOST_ERROR)),
    ):
        if value is not None and not low <= value <= high:
            raise InputError(f"--{name} {value:g} is outside {low:g} to {high:g}")
    for name, value in (("angle", angle), ("angle-across", angle_across)):
        if not 0 < value <= STEEPEST_DEG:
            raise InputError(f"--{name} {value:g}: an angle of emergence lies above 0 and up to {STEEPEST_DEG:g} deg")
    if slope is not None and sigma_um is not None:
        raise InputError("with --angle-across, one of --slope and --sigma-um: the other follows")
    if slope is not None and slope > emergence.STEEPEST:
        raise NoAnswer(f"sigma/tau = {slope:g}: beyond 1 the theory does not hold")

"""The answer of `roughness` as one document, and that document as text. Loads nothing but `math`: shell loops call it."""

from math import pi, sqrt

from .. import roughness
from ..errors import BrdfguideError, InputError, NoAnswer

SCHEMA = "brdfguide/roughness/1"
SLOPE = 0.1  # sigma/tau where nothing is known, as in the report's example
OTHER_NM = (450.0, 650.0)
SLOPES, LENGTHS, WAVES = (1e-6, 1e6), (1e-6, 1e6), (1.0, 1e6)  # what is taken for a typing error outside


def document(
    angle=None, slope=None, sigma_um=None, tau_um=None,
    wavelength_nm=1000 * roughness.WAVELENGTH, pupil_mm=roughness.PUPIL_MM, distance_mm=roughness.DISTANCE_MM, contour=False, never=False,
) -> dict:  # fmt: skip
    """What Eq. 3 and the criterion say. Raises InputError for a wrong question, NoAnswer where neither answers."""
    for name, value, (low, high) in (("slope", slope, SLOPES), ("sigma-um", sigma_um, LENGTHS), ("tau-um", tau_um, LENGTHS), ("wavelength-nm", wavelength_nm, WAVES)):
        if value is not None and not low <= value <= high:
            raise InputError(f"--{name} {value:g} is outside {low:g} to {high:g}")
    if never and angle is None:
        angle = 85.0  # as far as people usually look
    if angle is None and (sigma_um is None or tau_um is None):
        raise InputError("say at which --angle the mirror image emerges, or give --sigma-um and --tau-um to ask for that angle")
    if angle is not None and sum(value is not None for value in (slope, sigma_um, tau_um)) > 1:
        raise InputError("with --angle, one of --slope, --sigma-um and --tau-um: the others follow")
    omega = roughness.solid_angle(pupil_mm, distance_mm)
    um = wavelength_nm / 1000
    question = {"slope": SLOPE if slope is None and sigma_um is None and tau_um is None else slope, "sigma": sigma_um, "tau": tau_um}
    standard = (pupil_mm, distance_mm) == (roughness.PUPIL_MM, roughness.DISTANCE_MM)
    eq3 = _answer(lambda: _by_formula(angle, **question, um=um, standard=standard), "eq3_refused", angle, c=None)
    criterion = _answer(lambda: _by_criterion(angle, **question, um=um, omega=omega), "criterion_refused", angle)
    if eq3["sigma_um"] is None and criterion["sigma_um"] is None:
        raise NoAnswer("; ".join(dict.fromkeys(flag["text"] for part in (eq3, criterion) for flag in part["flags"])))
    if eq3["sigma_um"] is not None:
        eq3["flags"] += _doubts_of_table(eq3["angle_deg"])
    if criterion["sigma_um"] is not None:
        criterion["flags"] += _doubts_of_theory(criterion)
    result = {
        "schema": SCHEMA, "angle_deg": angle if angle is not None else criterion["angle_deg"], "emergence": "never" if never else "seen",
        "wavelength_nm": wavelength_nm, "solid_angle_sr": omega, "pupil_mm": pupil_mm, "distance_mm": distance_mm,
        "eq3": eq3, "criterion": criterion,
    }  # fmt: skip
    if eq3["sigma_um"] and criterion["sigma_um"] and angle is not None:
        key = "tau_um" if sigma_um is not None else "sigma_um"
        result["difference"] = {"of": key, "eq3_over_criterion_percent": 100 * (eq3[key] / criterion[key] - 1)}
    if criterion["sigma_um"]:
        point = criterion["sigma_um"], criterion["tau_um"]
        result["slopes"] = _slopes(criterion["slope"])
        result["other_wavelengths"] = [{"wavelength_nm": nm, "angle_deg": roughness.emergence_angle(*point, nm / 1000, omega)} for nm in OTHER_NM]
    if contour:
        if angle is None:
            raise InputError("--contour needs --angle")
        result["contour"] = roughness.contour(angle, roughness.tau_steps(um), um, omega)
    return result


def _by_formula(angle, slope, sigma, tau, um, standard):
    if not standard:
        raise NoAnswer("Eq. 3 holds for a pupil of 3 mm at 600 mm only")
    if angle is None:
        angle = roughness.formula_angle(sigma, tau, um)
    elif tau is not None:
        sigma = roughness.formula_sigma(angle, tau, um)
    elif sigma is not None:
        tau = roughness.formula_tau(angle, sigma, um)
    else:
        sigma, tau = roughness.formula_crossing(angle, slope, um)
    return {"c": roughness.constant(angle), "angle_deg": angle, "sigma_um": sigma, "tau_um": tau, "slope": sigma / tau, "flags": []}


def _by_criterion(angle, slope, sigma, tau, um, omega):
    flags = []
    if angle is None:
        angle = roughness.emergence_angle(sigma, tau, um, omega)
        if angle is None:
            raise NoAnswer("by the criterion the mirror image of this surface stands out nowhere below 89.9 deg")
    elif tau is not None:
        sigma, *more = roughness.sigmas_for_tau(angle, tau, um, omega)
        if more:
            flags.append(_flag("several_sigmas", f"beyond 88.68 deg one tau has several sigma; also {', '.join(f'{s:.3g}' for s in more)} um"))
    elif sigma is not None:
        tau = roughness.tau_for_sigma(angle, sigma, um, omega)
    else:
        sigma, tau = roughness.crossing(angle, slope, um, omega)
    if sigma / tau > roughness.STEEPEST:
        raise NoAnswer(f"the criterion gives sigma/tau = {sigma / tau:.3g}: beyond 1 the theory does not hold")
    return {"angle_deg": angle, "sigma_um": sigma, "tau_um": tau, "slope": sigma / tau, "flags": flags}


def _answer(ask, code, angle, **empty):
    """What `ask` says, or nulls with the reason."""
    try:
        return ask()
    except NoAnswer as reason:
        return {**empty, "angle_deg": angle, "sigma_um": None, "tau_um": None, "slope": None, "flags": [_flag(code, str(reason))]}


def _doubts_of_table(angle):
    if angle < 15:
        return [_flag("eq3_below_15", "Table 2 begins at 15 deg: C is continued below it")]
    return [_flag("eq3_low_at_85", "Table 2 is 20 to 25 % low at 85 deg: prefer the criterion")] if angle > 80 else []


def _doubts_of_theory(point):
    if point["slope"] > 0.3:
        return [_flag("steep", f"sigma/tau = {point['slope']:.3g}: above 0.3 the theory loses light, its slopes are too steep")]
    return [_flag("shallow", f"sigma/tau = {point['slope']:.3g}: most surfaces lie in 0.01 to 1")] if point["slope"] < 0.01 else []


def _slopes(slope):
    """What else is called the slope of such a surface."""
    return {"sigma_over_tau": slope, "rms_along_a_line": sqrt(2) * slope, "mean_gradient": sqrt(pi) * slope, "beckmann_alpha": 2 * slope}


def _flag(code, text):
    return {"code": code, "text": text}


# --- as text -----------------------------------------------------------------------------------------


def text(result: dict) -> str:
    """The document for people: Eq. 3 and the criterion side by side."""
    eq3, criterion = result["eq3"], result["criterion"]
    never = result["emergence"] == "never"
    sign = "> " if never else ""
    head = "no emergence up to" if never else "emergence at"
    lines = [
        f"{head} {result['angle_deg']:.4g} deg, {result['wavelength_nm']:g} nm, {result['solid_angle_sr']:.4g} sr"
        f" (pupil {result['pupil_mm']:g} mm at {result['distance_mm']:g} mm)",
        f"{'':24}  {'sigma [um]':>10}  {'tau [um]':>10}  {'angle [deg]':>11}",
    ]
    for name, part in ((f"Eq. 3, Table 2: C = {eq3['c']:.3g}" if eq3["sigma_um"] else "Eq. 3", eq3), ("He-Torrance criterion", criterion)):
        cells = [sign + f"{part[key]:.3g}" if part["sigma_um"] else "-" for key in ("sigma_um", "tau_um")]
        angle = f"{part['angle_deg']:.4g}" if part["sigma_um"] else "-"
        lines.append(f"{name:24}  {cells[0]:>10}  {cells[1]:>10}  {angle:>11}")
    if never:
        lines.append(f"no mirror image seen: the surface lies above the contour, sigma > {criterion['sigma_um']:.3g} um along sigma/tau = {criterion['slope']:.3g}")
    if "difference" in result:
        percent, of = result["difference"]["eq3_over_criterion_percent"], result["difference"]["of"].removesuffix("_um")
        lines.append(f"Eq. 3 is {abs(percent):.1f} % {'above' if percent > 0 else 'below'} the criterion in {of}")
    lines += _report_example(result)
    if "slopes" in result:
        slopes = result["slopes"]
        lines.append(
            f"sigma/tau {slopes['sigma_over_tau']:.3g} is an rms slope of {slopes['rms_along_a_line']:.3g} along a line,"
            f" a mean gradient of {slopes['mean_gradient']:.3g}, a Beckmann alpha of {slopes['beckmann_alpha']:.3g}"
        )
        others = [f"{_angle(other['angle_deg'])} at {other['wavelength_nm']:g} nm" for other in result["other_wavelengths"]]
        lines.append(f"the criterion's surface emerges {' and '.join(others)}")
    for tau, sigma in result.get("contour", ()):
        if (tau, sigma) == tuple(result["contour"][0]):
            lines += ["", f"{'tau [um]':>10}  {'sigma [um]':>10}"]
        lines.append(f"{tau:10.4g}  {sigma:10.4g}")
    return "\n".join(lines) + "\n"


def _angle(degrees):
    return "nowhere below 89.9 deg" if degrees is None else "at every angle" if degrees == 0 else f"at {degrees:.3g} deg"


def _report_example(result):
    """The report's worked example, said beside the answers that it belongs to and that it does not."""
    point = result["criterion"]
    if point["sigma_um"] is None or round(point["slope"], 9) != 0.1:
        return []
    if f"{point['sigma_um']:.2f}, {point['tau_um']:.1f}" == "0.50, 5.0":
        return ["the report's worked example (0.50, 5.0) lies on this contour, though it names 80 deg"]
    return ["the report's worked example (0.50, 5.0) belongs to 75 deg, not to 80"] if result["angle_deg"] == 80 else []


def notes(result: dict) -> list[str]:
    """The doubts, for stderr."""
    return [flag["text"] for part in ("eq3", "criterion") for flag in result[part]["flags"]]


def answer(json: bool = False, **question) -> tuple[str, list[str]]:
    """stdout and the notes for stderr. Both ways to run the command end here."""
    result = document(**question)
    return (_json(result) + "\n", []) if json else (text(result), notes(result))


def _json(value, margin="\n") -> str:
    """As `json.dumps(value, indent=2)` writes it; importing that costs half of a bare Python again."""
    inside = margin + "  "
    if value is None or value == [] or value == {}:
        return "null" if value is None else str(value)
    if isinstance(value, dict):
        return "{" + ",".join(f'{inside}"{key}": {_json(item, inside)}' for key, item in value.items()) + margin + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(inside + _json(item, inside) for item in value) + margin + "]"
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, str) and value.isascii() and value.isprintable() and '"' not in value and "\\" not in value:
        return f'"{value}"'
    from json import dumps

    return dumps(value)


# --- many questions in one process -------------------------------------------------------------------

COLUMNS = ("angle_deg", "wavelength_nm", "eq3_sigma_um", "eq3_tau_um", "sigma_um", "tau_um", "note")


def batch(lines, json: bool = False, **common):
    """One answer for each line such as `80`, `80 slope=0.2` or `tau-um=5 angle=75`: (text, exit status).

    Blank lines and those that begin with # are passed over.
    """
    if not json:
        yield "\t".join(COLUMNS) + "\n", 0
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.lstrip().startswith("#"):
            continue
        try:
            result, status = document(**common | _question(line)), 0
        except BrdfguideError as error:
            result, status = {"schema": SCHEMA, "line": number, "error": str(error)}, error.exit_status
        if json:
            from json import dumps

            yield dumps(result, allow_nan=False) + "\n", status
        elif status:
            yield "\t" * (len(COLUMNS) - 1) + f"line {number}: {result['error']}\n", status
        else:
            values = [result["angle_deg"], result["wavelength_nm"], *(result[part][key] for part in ("eq3", "criterion") for key in ("sigma_um", "tau_um"))]
            yield "\t".join("" if value is None else f"{value:.6g}" for value in values) + "\t" + "; ".join(notes(result)) + "\n", status


def _question(line):
    known = ("angle", "slope", "sigma-um", "tau-um", "wavelength-nm", "pupil-mm", "distance-mm")
    question = {}
    for word in line.split():
        name, _, value = word.rpartition("=")
        name = name or "angle"
        if name not in known:
            raise InputError(f"'{word}': a request is an angle or name=value with {', '.join(known)}")
        try:
            question[name.replace("-", "_")] = float(value)
        except ValueError:
            raise InputError(f"'{word}': '{value}' is no number") from None
    return question

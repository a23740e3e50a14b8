"""The criterion of emergence against its reference table, at every angle and wavelength; both ways to run the
command.
"""

import csv
import json
import math
import subprocess
import sys
from itertools import pairwise

import mpmath
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from brdfguide import cli
from brdfguide.cli import _fast
from brdfguide.errors import InputError, NoAnswer
from brdfguide.numerics import special
from brdfguide.physics import emergence as roughness
from brdfguide.report.documents import emergence
from brdfguide.report.text.emergence import COLUMNS

from ..conftest import ROOT

SPEC = ROOT.parent / "shared" / "spec"
angles = st.floats(0, 89.9)


# --- physics ------------------------------------------------------------------------------------------


def test_contours_agree_with_the_reference_table_to_1e_12():
    if not (SPEC / "figure14_contours.csv").is_file():
        pytest.skip(f"no table of contours in {SPEC}")
    with open(SPEC / "figure14_contours.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 486
    for row in rows:
        angle, tau, sigma = float(row["theta_deg"]), float(row["tau_um"]), float(row["sigma0_um"])
        assert roughness.sigmas_for_tau(angle, tau) == pytest.approx((sigma,), rel=1e-12)
        assert roughness.tau_for_sigma(angle, sigma) == pytest.approx(tau, rel=1e-12)


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.floats(0, 88), st.floats(-3, 0), st.floats(-2, 2), st.floats(-9, -2))
def test_crossing_and_both_inverses_meet_in_one_point(angle, ln_slope, ln_wavelength, ln_omega):
    slope, wavelength, omega = 10**ln_slope, 10**ln_wavelength, 10**ln_omega
    sigma, tau = roughness.crossing(angle, slope, wavelength, omega)
    assert roughness.sigmas_for_tau(angle, tau, wavelength, omega) == pytest.approx((sigma,), rel=1e-9)
    assert roughness.tau_for_sigma(angle, sigma, wavelength, omega) == pytest.approx(tau, rel=1e-9)
    if angle > 0.01:
        assert roughness.emergence_angle(sigma, tau, wavelength, omega) == pytest.approx(angle, abs=1e-5)


@pytest.mark.parametrize(
    "angle, slope, wavelength, omega",
    [(0, 0.1, 0.55, 2e-5), (62, 0.3, 5.7, 1e-6), (85, 0.02, 0.4, 1e-4), (88, 1.0, 0.55, 2e-5), (89.9, 0.5, 0.55, 2e-5)],
)
def test_crossing_satisfies_the_criterion_at_40_digits(angle, slope, wavelength, omega):
    sigma, tau = (mpmath.mpf(value) for value in roughness.crossing(angle, slope, wavelength, omega))
    with mpmath.workdps(40):
        theta = mpmath.radians(angle)
        spread = 2 * mpmath.tan(theta) * mpmath.erfc(tau / (2 * sigma * mpmath.tan(theta))) if angle else 0
        effective = sigma / mpmath.sqrt(1 + mpmath.lambertw(spread**2 / (8 * mpmath.pi)).real)
        g = (4 * mpmath.pi * effective * mpmath.cos(theta) / wavelength) ** 2
        ein = mpmath.ei(g) - mpmath.log(g) - mpmath.euler
        assert float(ein * mpmath.pi * tau**2 * mpmath.cos(theta) * omega / wavelength**2) == pytest.approx(
            1, rel=1e-11
        )


def test_every_sigma_is_found_where_one_tau_has_several():
    """At 89.9 deg the effective roughness first grows with sigma, falls, and grows again."""
    angle, tau = 89.9, 800.0
    wanted = roughness._effective_sigma(angle, tau, 0.55, roughness.OMEGA)
    found = roughness.sigmas_for_tau(angle, tau)
    assert len(found) >= 1
    for sigma in found:
        assert sigma * roughness.effective(sigma / tau, angle) == pytest.approx(wanted, rel=1e-10)
    steps = [tau * 10 ** (x / 200) for x in range(-600, 600)]
    values = [s * roughness.effective(s / tau, angle) - wanted for s in steps]
    assert len(found) == sum((a < 0) != (b < 0) for a, b in pairwise(values))


@pytest.mark.parametrize("g", [1e-12, 1e-4, 0.3, 7.0, 49.999, 50.001, 700.0, 1e6])
def test_ln_ein_and_its_slope(g):
    with mpmath.workdps(60):
        ein = (
            mpmath.ei(g) - mpmath.log(g) - mpmath.euler
            if g > 1e-3
            else mpmath.nsum(lambda m: mpmath.mpf(g) ** m / (m * mpmath.factorial(m)), [1, 12])
        )
        value, rate = float(mpmath.log(ein)), float(mpmath.expm1(g) / ein)
    assert roughness.ln_ein(g) == pytest.approx((value, rate), rel=1e-14, abs=1e-14)


def test_lambert_w_is_the_same_with_and_without_numpy():
    for z in (0.0, 1e-300, 1e-8, 0.3, 2.0, 1e5, 1e200):
        assert roughness._lambert_w(z) == pytest.approx(float(special.lambert_w(z)), rel=1e-14)


# --- Eq. 3 --------------------------------------------------------------------------------------------


def test_table_2_is_returned_exactly_at_its_angles_and_monotone_between():
    for angle, c in roughness.TABLE_2:
        assert roughness.eq3_constant(angle) == c
    values = [roughness.eq3_constant(angle / 10) for angle in range(851)]
    assert all(a < b for a, b in pairwise(values))
    # ln C is linear in ln(1/cos): half way between 15 and 45 in that variable, C is the geometric mean
    middle = math.degrees(math.acos(math.sqrt(math.cos(math.radians(15)) * math.cos(math.radians(45)))))
    assert roughness.eq3_constant(middle) == pytest.approx(math.sqrt(1.1 * 1.6), rel=1e-12)


@pytest.mark.parametrize(
    "call",
    [
        lambda: roughness.eq3_constant(85.001),
        lambda: roughness.formula_sigma(80, 0.4),
        lambda: roughness.formula_sigma(80, 51),
        lambda: roughness.formula_sigma(85, 2.0),
        lambda: roughness.formula_tau(80, 1.6),
        lambda: roughness.formula_crossing(80, 1.2),
        lambda: roughness.crossing(80, 1.2),
        lambda: roughness.formula_angle(5.0, 5.0),
    ],
)
def test_refuses_what_it_cannot_answer(call):
    with pytest.raises(NoAnswer):
        call()


@pytest.mark.parametrize(
    "call",
    [
        lambda: roughness.eq3_constant(-1),
        lambda: roughness.crossing(90, 0.1),
        lambda: roughness.crossing(math.nan, 0.1),
        lambda: roughness.crossing(80, 0.0),
        lambda: roughness.pupil_solid_angle(0, 600),
    ],
)
def test_refuses_what_makes_no_sense(call):
    with pytest.raises(InputError):
        call()


def test_formula_and_its_inverses_agree_at_any_wavelength():
    for wavelength in (0.45, 0.55, 10.6):
        sigma, tau = roughness.formula_crossing(70, 0.2, wavelength)
        assert sigma / tau == pytest.approx(0.2, rel=1e-14)
        assert roughness.formula_sigma(70, tau, wavelength) == pytest.approx(sigma, rel=1e-13)
        assert roughness.formula_tau(70, sigma, wavelength) == pytest.approx(tau, rel=1e-12)
        assert roughness.formula_angle(sigma, tau, wavelength) == pytest.approx(70, rel=1e-11)


# --- the command --------------------------------------------------------------------------------------


def full(argv, capsys):
    with pytest.raises(SystemExit) as end:
        cli.main(argv)
    return end.value.code, *capsys.readouterr()


numbers = {
    "--angle": st.one_of(st.floats(0, 90), st.sampled_from(["80", "75", "8e1", "abc", "-5", "nan", ""])),
    "--slope": st.one_of(st.floats(1e-4, 2), st.sampled_from(["0", "-1"])),
    "--sigma-um": st.floats(0.01, 20),
    "--tau-um": st.floats(0.1, 100),
    "--wavelength-nm": st.floats(200, 10000),
    "--pupil-mm": st.sampled_from(["3", "4.5", "700"]),
    "--distance-mm": st.sampled_from(["600", "0"]),
}
option = st.sampled_from(sorted(numbers)).flatmap(
    lambda name: numbers[name].flatmap(lambda v: st.sampled_from([[name, str(v)], [f"{name}={v}"]]))
)
switch = st.sampled_from(
    [["--json"], ["-q"], ["--quiet"], ["--never"], ["--contour"], ["--frobnicate"], ["stray"], ["-h"]]
)
lines = st.lists(st.one_of(option, option, option, switch), max_size=5).map(
    lambda parts: ["roughness"] + [word for part in parts for word in part]
)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(
    st.one_of(
        lines, lines.map(lambda line: [*line, "--angle", "80"]), st.sampled_from([["--version"], ["-V"], ["roughness"]])
    )
)
def test_quick_way_answers_as_the_full_parser_does(line):
    import contextlib
    import io

    def run(command):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            result = command()
        return result, out.getvalue(), err.getvalue()

    def ended():
        try:
            cli.main(line)
        except SystemExit as end:
            return end.code or 0

    answered, *quickly = run(lambda: _fast.answered(list(line)))
    if answered:
        assert (0, *quickly) == run(ended)
    else:
        assert quickly == ["", ""]


def test_quick_way_takes_what_shell_loops_use(capsys):
    assert _fast.answered(["roughness", "--angle", "80", "--slope=0.1", "-q"])
    assert _fast.answered(["--version"])
    assert (
        not _fast.answered(["roughness", "--help"]) and not _fast.answered(["fit", "x.csv"]) and not _fast.answered([])
    )


def test_prints_eq_3_and_the_criterion_side_by_side(capsys):
    status, out, err = full(["roughness", "--angle", "80", "--slope", "0.1"], capsys)
    rows = {line.split("  ")[0]: line.split()[-3:] for line in out.splitlines()}
    assert status == 0 and err == ""
    assert rows["Eq. 3 with C = 9"] == ["0.857", "8.57", "80"]
    assert rows["He-Torrance criterion"] == ["0.781", "7.81", "80"]
    assert "Eq. 3, gives a sigma 9.7 % larger than the full criterion" in out


@pytest.mark.parametrize(
    "line, status, sentence",
    [
        ("--angle 95", 2, "angle 95 deg: an angle of emergence lies in 0 <= angle < 90"),
        ("--angle 80 --slope 2", 1, "beyond 1 the theory does not hold"),
        ("--angle 80 --slope 0.1 --tau-um 5", 2, "one of --slope, --sigma-um and --tau-um"),
        ("", 2, "say at which --angle"),
        ("--sigma-um 0.5", 2, "say at which --angle"),
        ("--angle 80 --pupil-mm 700", 2, "pupil 700 mm at 600 mm"),
        ("--angle 80 --tau-um 1e9", 2, "--tau-um 1e+09 is outside"),
        ("--angle 88 --tau-um 5", 1, "the criterion gives sigma/tau = 1.77"),
        ("--sigma-um 500 --tau-um 1000", 1, "stands out nowhere below 89.9 deg"),
        ("--batch no-such-file", 2, "no-such-file: there is no such file"),
    ],
)
def test_errors_are_one_sentence_and_a_status(line, status, sentence, capsys):
    got, out, err = full(["roughness", *line.split()], capsys)
    assert (got, out) == (status, "")
    assert sentence in err and err.count("\n") == 1


def test_json_is_what_the_json_module_would_write(capsys):
    for line in ("--angle 80", "--angle 86 --contour", "--angle 10 --never", "--sigma-um 0.5 --tau-um 5"):
        status, out, err = full(["roughness", *line.split(), "--json"], capsys)
        document = json.loads(out)
        assert out == json.dumps(document, indent=2) + "\n" and err == ""
        assert document["schema"] == "brdfguide/roughness/1"
        assert {"c", "sigma_um", "tau_um", "slope", "flags"} <= document["eq3"].keys()
        assert {"sigma_um", "tau_um", "slope", "flags"} <= document["criterion"].keys()


def test_doubts_have_codes(capsys):
    def codes(**question):
        document = emergence.document(**question)
        return [flag["code"] for part in ("eq3", "criterion") for flag in document[part]["flags"]]

    assert codes(angle=80.0) == []
    assert codes(angle=85.0) == ["eq3_low_at_85"]
    assert codes(angle=10.0) == ["eq3_below_15"]
    assert codes(angle=87.0) == ["eq3_refused"]
    assert codes(angle=80.0, pupil_mm=4.0) == ["eq3_refused"]
    assert codes(angle=80.0, slope=0.5) == ["steep"]
    assert codes(angle=80.0, slope=0.005) == ["eq3_refused", "shallow"]


def test_no_emergence_gives_an_inequality(capsys):
    _, out, _ = full(["roughness", "--never"], capsys)
    assert "without a mirror image up to 85 deg" in out and "rougher than sigma 2.01 um at sigma/tau = 0.1" in out


def test_batch_answers_each_line_and_keeps_the_worst_status():
    requests = "80\n\n# comment\n75 slope=0.2\nangle=x\n88 tau-um=5\nangle=80 tau-um=5 wavelength-nm=633\n"
    run = subprocess.run(
        [sys.executable, "-m", "brdfguide", "roughness", "--batch", "-"],
        input=requests,
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    header, *rows = [line.split("\t") for line in run.stdout.splitlines()]
    assert run.returncode == 2 and run.stderr == "" and tuple(header) == COLUMNS
    assert rows[0][:6] == ["80", "550", "0.857192", "8.57192", "0.781154", "7.81154"]
    assert rows[2][6] == "line 5: 'angle=x': 'x' is no number"
    assert len(rows) == 5 and all(len(row) == 9 for row in rows)
    assert float(rows[0][7]) < 0.781154 < float(rows[0][8])


def test_a_closed_pipe_ends_quietly():
    program = [sys.executable, "-m", "brdfguide", "roughness", "--angle", "80"]
    run = subprocess.Popen(program, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    run.stdout.close()
    err = run.stderr.read()
    run.stderr.close()
    assert run.wait() == 0 and err == b""

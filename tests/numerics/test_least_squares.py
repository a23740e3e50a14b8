"""The optimiser against problems whose answers NIST certifies to eleven digits, and against its own promises.

Data and certified values: NIST Statistical Reference Datasets, nonlinear regression (US Government work).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import least_squares

from brdfguide.numerics.least_squares import minimise


@dataclass(frozen=True)
class Problem:
    name: str
    law: Callable
    x: tuple
    y: tuple
    starts: tuple
    certified: tuple
    stderr: tuple
    squares: float


# fmt: off
PROBLEMS = (
    Problem(
        "Misra1a", lambda b, x: b[0] * (1 - np.exp(-b[1] * x)),
        x=(77.6, 114.9, 141.1, 190.8, 239.9, 289, 332.8, 378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760,),
        y=(10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02, 44.82, 50.76, 55.05, 61.01, 66.4, 75.47, 81.78,),
        starts=((500, 0.0001), (250, 0.0005)),
        certified=(238.94212918, 0.00055015643181),
        stderr=(2.7070075241, 7.2668688436e-06),
        squares=0.12455138894,
    ),
    Problem(
        "DanWood", lambda b, x: b[0] * x ** b[1],
        x=(1.309, 1.471, 1.49, 1.565, 1.611, 1.68,),
        y=(2.138, 3.421, 3.597, 4.34, 4.882, 5.66,),
        starts=((1, 5), (0.7, 4)),
        certified=(0.76886226176, 3.8604055871),
        stderr=(0.01828197386, 0.051726610913),
        squares=0.0043173084083,
    ),
    Problem(
        "Lanczos3", lambda b, x: b[0] * np.exp(-b[1] * x) + b[2] * np.exp(-b[3] * x) + b[4] * np.exp(-b[5] * x),
        x=(
            0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9,
            0.95, 1, 1.05, 1.1, 1.15,
        ),
        y=(
            2.5134, 2.0443, 1.6684, 1.3664, 1.1232, 0.9269, 0.7679, 0.6389, 0.5338, 0.4479, 0.3776, 0.3197, 0.272,
            0.2325, 0.1997, 0.1723, 0.1493, 0.1301, 0.1138, 0.1, 0.0883, 0.0783, 0.0698, 0.0624,
        ),
        starts=((1.2, 0.3, 5.6, 5.5, 6.5, 7.6), (0.5, 0.7, 3.6, 4.2, 4, 6.3)),
        certified=(0.086816414977, 0.95498101505, 0.84400777463, 2.9515951832, 1.5825685901, 4.9863565084),
        stderr=(0.017197908859, 0.097041624475, 0.041488663282, 0.10766312506, 0.058371576281, 0.034436403035),
        squares=1.6117193594e-08,
    ),
    Problem(
        "MGH17", lambda b, x: b[0] + b[1] * np.exp(-x * b[3]) + b[2] * np.exp(-x * b[4]),
        x=(
            0, 10, 20, 30, 40, 50, 60, 70, 80, 90, 100, 110, 120, 130, 140, 150, 160, 170, 180, 190, 200, 210,
            220, 230, 240, 250, 260, 270, 280, 290, 300, 310, 320,
        ),
        y=(
            0.844, 0.908, 0.932, 0.936, 0.925, 0.908, 0.881, 0.85, 0.818, 0.784, 0.751, 0.718, 0.685, 0.658,
            0.628, 0.603, 0.58, 0.558, 0.538, 0.522, 0.506, 0.49, 0.478, 0.467, 0.457, 0.448, 0.438, 0.431, 0.424,
            0.42, 0.414, 0.411, 0.406,
        ),
        starts=((50, 150, -100, 1, 2), (0.5, 1.5, -1, 0.01, 0.02)),
        certified=(0.37541005211, 1.9358469127, -1.4646871366, 0.01286753464, 0.022122699662),
        stderr=(0.0020723153551, 0.22031669222, 0.22175707739, 0.00044861358114, 0.00089471996575),
        squares=5.4648946975e-05,
    ),
    Problem(
        "MGH09", lambda b, x: b[0] * (x**2 + x * b[1]) / (x**2 + x * b[2] + b[3]),
        x=(4, 2, 1, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625,),
        y=(0.1957, 0.1947, 0.1735, 0.16, 0.0844, 0.0627, 0.0456, 0.0342, 0.0323, 0.0235, 0.0246,),
        starts=((25, 39, 41.5, 39), (0.25, 0.39, 0.415, 0.39)),
        certified=(0.19280693458, 0.19128232873, 0.12305650693, 0.13606233068),
        stderr=(0.011435312227, 0.19633220911, 0.080842031232, 0.090025542308),
        squares=0.00030750560385,
    ),
    Problem(
        "MGH10", lambda b, x: b[0] * np.exp(b[1] / (x + b[2])),
        x=(50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 105, 110, 115, 120, 125,),
        y=(34780, 28610, 23650, 19630, 16370, 13720, 11540, 9744, 8261, 7030, 6005, 5147, 4427, 3820, 3307, 2872,),
        starts=((2, 400000, 25000), (0.02, 4000, 250)),
        certified=(0.005609636471, 6181.3463463, 345.22363462),
        stderr=(0.00015687892471, 23.309021107, 0.78486103508),
        squares=87.945855171,
    ),
    Problem(
        "BoxBOD", lambda b, x: b[0] * (1 - np.exp(-b[1] * x)),
        x=(1, 2, 3, 5, 7, 10,),
        y=(109, 149, 149, 191, 213, 224,),
        starts=((1, 1), (100, 0.75)),
        certified=(213.80940889, 0.54723748542),
        stderr=(12.354515176, 0.10455993237),
        squares=1168.0088766,
    ),
    Problem(
        "Rat43", lambda b, x: b[0] / (1 + np.exp(b[1] - b[2] * x)) ** (1 / b[3]),
        x=(1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,),
        y=(
            16.08, 33.83, 65.8, 97.2, 191.55, 326.2, 386.87, 520.53, 590.03, 651.92, 724.93, 699.56, 689.96,
            637.56, 717.41,
        ),
        starts=((100, 10, 1, 1), (700, 5, 0.75, 1.3)),
        certified=(699.6415127, 5.2771253025, 0.75962938329, 1.2792483859),
        stderr=(16.302297817, 2.0828735829, 0.19566123451, 0.68761936385),
        squares=8786.404908,
    ),
    Problem(
        "Eckerle4", lambda b, x: b[0] / b[1] * np.exp(-0.5 * ((x - b[2]) / b[1]) ** 2),
        x=(
            400, 405, 410, 415, 420, 425, 430, 435, 436.5, 438, 439.5, 441, 442.5, 444, 445.5, 447, 448.5, 450,
            451.5, 453, 454.5, 456, 457.5, 459, 460.5, 462, 463.5, 465, 470, 475, 480, 485, 490, 495, 500,
        ),
        y=(
            0.0001575, 0.0001699, 0.000235, 0.0003102, 0.0004917, 0.000871, 0.0017418, 0.00464, 0.0065895,
            0.0097302, 0.0149002, 0.023731, 0.0401683, 0.0712559, 0.1264458, 0.2073413, 0.2902366, 0.3445623,
            0.3698049, 0.3668534, 0.3106727, 0.2078154, 0.1164354, 0.0616764, 0.03372, 0.0194023, 0.0117831,
            0.0074357, 0.0022732, 0.00088, 0.0004579, 0.0002345, 0.0001586, 0.0001143, 7.1e-05,
        ),
        starts=((1, 10, 500), (1.5, 5, 450)),
        certified=(1.5543827178, 4.0888321754, 451.54121844),
        stderr=(0.015408051163, 0.046803020753, 0.046800518816),
        squares=0.0014635887487,
    ),
    Problem(
        "Thurber",
        lambda b, x: (b[0] + b[1] * x + b[2] * x**2 + b[3] * x**3) / (1 + b[4] * x + b[5] * x**2 + b[6] * x**3),
        x=(
            -3.067, -2.981, -2.921, -2.912, -2.84, -2.797, -2.702, -2.699, -2.633, -2.481, -2.363, -2.322, -1.501,
            -1.46, -1.274, -1.212, -1.1, -1.046, -0.915, -0.714, -0.566, -0.545, -0.4, -0.309, -0.109, -0.103,
            0.01, 0.119, 0.377, 0.79, 0.963, 1.006, 1.115, 1.572, 1.841, 2.047, 2.2,
        ),
        y=(
            80.574, 84.248, 87.264, 87.195, 89.076, 89.608, 89.868, 90.101, 92.405, 95.854, 100.696, 101.06,
            401.672, 390.724, 567.534, 635.316, 733.054, 759.087, 894.206, 990.785, 1090.109, 1080.914, 1122.643,
            1178.351, 1260.531, 1273.514, 1288.339, 1327.543, 1353.863, 1414.509, 1425.208, 1421.384, 1442.962,
            1464.35, 1468.705, 1447.894, 1457.628,
        ),
        starts=((1000, 1000, 400, 40, 0.7, 0.3, 0.03), (1300, 1500, 500, 75, 1, 0.4, 0.05)),
        certified=(1288.13968, 1491.0792535, 583.23836877, 75.416644291, 0.96629502864, 0.39797285797, 0.049727297349),
        stderr=(4.6647963344, 39.571156086, 28.698696102, 5.567537027, 0.031333340687, 0.014984928198, 0.0065842344623),
        squares=5642.7082397,
    ),
)
# fmt: on
DIGITS = 6  # of every certified parameter, as NIST asks of good software


def residuals_of(problem: Problem):
    """Residuals and an exact Jacobian by the complex step."""
    x, y = np.array(problem.x), np.array(problem.y)

    def residuals(b, per_channel, want_jacobian):
        with np.errstate(all="ignore"):
            r = (problem.law(b, x) - y)[:, None]
            if not want_jacobian:
                return r
            steps = [problem.law(b + 1e-30j * np.eye(len(b))[place], x).imag / 1e-30 for place in range(len(b))]
        return r, np.stack(steps, axis=1)[None], np.zeros((1, len(x), 0))

    return residuals


CASES = [
    pytest.param(problem, place, id=f"{problem.name}-start{place + 1}") for problem in PROBLEMS for place in (0, 1)
]


@pytest.mark.parametrize("problem, place", CASES)
def test_reaches_the_certified_digits(problem, place):
    end = minimise(residuals_of(problem), np.array(problem.starts[place], float), tolerance=1e-14, most=1000)
    digits = -np.log10(np.maximum(np.abs(end.shared - problem.certified) / np.abs(problem.certified), 1e-11))
    assert end.converged
    assert digits.min() >= DIGITS, (
        f"{problem.name}: {end.shared} after {end.evaluations}, certified {problem.certified}"
    )
    assert end.cost == pytest.approx(problem.squares, rel=1e-6)


@pytest.mark.parametrize("problem, place", CASES)
def test_ends_where_scipys_trust_region_ends(problem, place):
    start, tight = np.array(problem.starts[place], float), 1e-14
    residuals = residuals_of(problem)
    with np.errstate(all="ignore"):
        judge = least_squares(
            lambda b: residuals(b, None, False)[:, 0],
            start,
            jac=lambda b: residuals(b, None, True)[1][0],
            x_scale="jac",
            ftol=tight,
            xtol=tight,
            gtol=tight,
            max_nfev=2000,
        )
    end = minimise(residuals, start, tolerance=tight, most=1000)
    assert end.cost == pytest.approx(2 * judge.cost, rel=1e-9)


def test_rounding_does_not_decide_whether_a_far_start_arrives():
    """Ten starts that differ from the two hardest ones by 1e-12, as another machine's arithmetic might, seed 1."""
    rng = np.random.default_rng(1)
    for name in ("BoxBOD", "MGH10"):
        problem = next(each for each in PROBLEMS if each.name == name)
        for _ in range(10):
            start = np.array(problem.starts[0], float) * (1 + 1e-12 * rng.standard_normal(len(problem.certified)))
            end = minimise(residuals_of(problem), start, tolerance=1e-14, most=1000)
            assert end.shared == pytest.approx(problem.certified, rel=1e-6)


def test_the_first_step_goes_no_further_than_the_start_is_far():
    """BoxBOD's first Gauss-Newton step is 190 times as long and ends where the cost is flat."""
    problem = next(each for each in PROBLEMS if each.name == "BoxBOD")
    residuals, asked = residuals_of(problem), []

    def watched(b, per_channel, want_jacobian):
        asked.append(b)
        return residuals(b, per_channel, want_jacobian)

    start = np.array(problem.starts[0], float)
    scale = np.sqrt(np.sum(residuals(start, None, True)[1][0] ** 2, axis=0))
    minimise(watched, start, most=2)
    assert 0.85 < np.linalg.norm(scale * (asked[1] - start)) / np.linalg.norm(scale * start) < 1.15


def test_a_step_to_where_there_is_no_number_is_taken_back():
    """ln b from b = 1000: Gauss and Newton's step goes below 0."""

    def residuals(b, _, want_jacobian):
        with np.errstate(invalid="ignore"):
            r = (np.log(b) - np.log(20.0))[None]
        return (r, 1 / b[None, None], np.zeros((1, 1, 0))) if want_jacobian else r

    end = minimise(residuals, [1000.0], tolerance=1e-12)
    assert end.converged
    assert end.shared == pytest.approx([20.0], rel=1e-9)


@pytest.mark.parametrize("problem", PROBLEMS, ids=lambda problem: problem.name)
def test_covariance_gives_the_certified_standard_errors(problem):
    end = minimise(residuals_of(problem), np.array(problem.certified), tolerance=1e-14, most=5000)
    shared, _ = end.normal.covariance()
    variance = end.cost / (len(problem.x) - len(problem.certified))
    assert np.sqrt(np.diag(shared) * variance) == pytest.approx(problem.stderr, rel=1e-5)


def arrow(channels, samples, seed):
    """y = a_c exp(-k x) + b_c with one k for all channels: an arrow-shaped problem and its dense equal."""
    rng = np.random.default_rng(seed)
    x = np.linspace(0, 3, samples)
    height, floor = rng.uniform(1, 2, channels), rng.uniform(0, 0.5, channels)
    y = height * np.exp(-1.3 * x[:, None]) + floor + 0.01 * rng.standard_normal((samples, channels))

    def residuals(shared, per_channel, want_jacobian):
        fall = np.exp(-shared[0] * x)[:, None]
        r = per_channel[:, 0] * fall + per_channel[:, 1] - y
        if not want_jacobian:
            return r
        j_shared = (-x[:, None] * per_channel[:, 0] * fall).T[:, :, None]
        j_per_channel = np.stack([np.broadcast_to(fall, y.shape).T, np.ones((channels, samples))], axis=2)
        return r, j_shared, j_per_channel

    def dense(b, _, want_jacobian):
        parts = residuals(b[:1], b[1:].reshape(channels, 2), want_jacobian)
        if not want_jacobian:
            return parts.reshape(-1, 1)
        r, j_shared, j_per_channel = parts
        full = np.zeros((samples, channels, 1 + 2 * channels))
        for channel in range(channels):
            full[:, channel, 0] = j_shared[channel, :, 0]
            full[:, channel, 1 + 2 * channel : 3 + 2 * channel] = j_per_channel[channel]
        return r.reshape(-1, 1), full.reshape(1, samples * channels, -1), np.zeros((1, samples * channels, 0))

    return residuals, dense


def test_channels_with_a_shared_shape_end_where_the_dense_problem_ends():
    residuals, dense = arrow(5, 40, seed=3)
    one = minimise(residuals, [0.5], np.ones((5, 2)), tolerance=1e-14)
    other = minimise(dense, np.r_[0.5, np.ones(10)], tolerance=1e-14)
    assert np.r_[one.shared, one.per_channel.ravel()] == pytest.approx(other.shared, rel=1e-8)
    shared, per_channel = one.normal.covariance()
    full, _ = other.normal.covariance()
    assert shared[0, 0] == pytest.approx(full[0, 0], rel=1e-6)
    assert per_channel[2, 1, 1] == pytest.approx(full[6, 6], rel=1e-6)


def test_stops_at_a_bound_and_lets_the_rest_settle():
    residuals, _ = arrow(3, 40, seed=4)
    end = minimise(residuals, [0.5], np.ones((3, 2)), low=[0.1], high=[1.0], per_channel_low=0.0)
    assert end.converged and end.shared[0] == 1.0
    held, _ = arrow(3, 40, seed=4)
    rest = minimise(
        lambda shared, per_channel, want: held(np.array([1.0]), per_channel, want),
        [1.0],
        np.ones((3, 2)),
        low=[1.0],
        high=[1.0],
        per_channel_low=0.0,
        tolerance=1e-13,
    )
    assert end.per_channel == pytest.approx(rest.per_channel, rel=1e-6)


def test_bounded_channels_end_where_scipys_dense_problem_ends():
    _, dense = arrow(4, 30, seed=6)
    residuals, _ = arrow(4, 30, seed=6)
    low, high = np.r_[0.1, np.zeros(8)], np.r_[0.8, np.tile([np.inf, 0.2], 4)]
    judge = least_squares(
        lambda b: dense(b, None, False)[:, 0],
        np.r_[0.5, np.tile([1.0, 0.1], 4)],
        jac=lambda b: dense(b, None, True)[1][0],
        bounds=(low, high),
        ftol=1e-14,
        xtol=1e-14,
        gtol=1e-14,
    )
    end = minimise(
        residuals,
        [0.5],
        np.tile([1.0, 0.1], (4, 1)),
        low=[0.1],
        high=[0.8],
        per_channel_low=0.0,
        per_channel_high=[np.inf, 0.2],
        tolerance=1e-14,
    )
    assert np.any(end.per_channel[:, 1] == 0.2) and np.any(end.per_channel[:, 1] < 0.2) and end.shared[0] == 0.8
    assert end.cost == pytest.approx(2 * judge.cost, rel=1e-8)


def test_says_when_it_ran_out_of_evaluations():
    residuals, _ = arrow(3, 40, seed=5)
    assert not minimise(residuals, [5.0], np.ones((3, 2)), most=2).converged


def test_a_parameter_without_effect_gets_an_enormous_variance():
    x = np.linspace(0, 1, 20)

    def residuals(b, per_channel, want_jacobian):
        r = (b[0] * x - 2 * x + 0.01 * np.sin(40 * x))[:, None]
        return (r, np.stack([x, np.zeros(20)], axis=1)[None], np.zeros((1, 20, 0))) if want_jacobian else r

    shared, _ = minimise(residuals, [1.0, 1.0]).normal.covariance()
    assert shared[0, 0] < 1 and shared[1, 1] > 1e12

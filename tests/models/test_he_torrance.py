"""What is peculiar to He-Torrance: values to 17 digits, its limits, its mirror part."""

import csv
import json

import mpmath
import numpy as np
import pytest

from brdfguide.models import _series_cells
from brdfguide.models import he_torrance as he
from brdfguide.models._series import by_products, by_terms
from brdfguide.models._series_cells import CELLS, compute_cells
from brdfguide.models._series_patches import ln_series
from brdfguide.physics.geometry import Geometry, in_plane

from ..conftest import ROOT

SPEC = ROOT.parent / "shared" / "spec"


# angles [deg], sigma, slope, d f/d ln sigma, d f/d ln slope
DERIVATIVES = (
    ((50, 55, 175), 0.2, 0.1, -0.06889005485867, -0.5481557316296),
    ((80, 84, 180), 0.9, 0.2, 1.326096467724, -25.53632299053),
    ((20, 30, 90), 0.05, 0.03, -2.599139698428e-5, 5.825621628054e-5),
    ((40, 40, 180), 3, 0.15, -5.006005783319e-5, -0.1378679216438),
)


def spec_rows(name):
    if not (SPEC / name).is_file():
        pytest.skip(f"no table of reference values at {SPEC / name}")
    with open(SPEC / name, newline="") as file:
        return list(csv.DictReader(file))


def columns(rows, *names):
    return [np.array([float(row[name]) for row in rows]) for name in names]


def close(got, right, rtol=1e-10):
    """Relative where the reference is a number of ordinary size, absolute below."""
    large = np.abs(right) > 1e-280
    assert np.all(np.abs(got[~large]) < 1e-270)
    np.testing.assert_allclose(got[large], right[large], rtol=rtol)


def test_every_row_of_the_reference_table_within_1e_10():
    rows = spec_rows("hetorrance_cases.csv")
    angles = columns(rows, "theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg", "lambda_um")
    geom = Geometry.from_degrees(*angles)
    sigma, tau, n, k, g, x = columns(rows, "sigma0_um", "tau_um", "n", "k", "g", "x")
    rho_dd, rho_s, series = columns(rows, "rho_dd", "rho_s", "series")
    values = {"sigma": sigma, "slope": sigma / tau, "n": n, "k": k, "scale": 1.0}
    close(he.MODEL(geom, **values), rho_dd)
    close(he.MODEL.mirror(geom, **values), rho_s)
    close(np.exp(ln_series(g, x / 4)), series)


def test_every_hard_case_of_the_stability_table():
    rows = [row for row in spec_rows("stability_cases.csv") if row["quantity"].startswith("ht_")]
    assert len(rows) == 54
    for row in rows:
        close(np.array([part_of_the_law(row)]), np.array([float(row["right"])]))


def part_of_the_law(row):
    """Ours for the quantity that a row of the table names."""
    p = json.loads(row["params_json"])
    geom = Geometry.from_degrees(
        *(float(row[a]) for a in ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg")), p.get("lambda_um", 0.55)
    )
    slope = p["sigma0_um"] / p["tau_um"] if "tau_um" in p else None
    return {
        "ht_series": lambda: np.exp(ln_series(p["g"], p["x"] / 4)),
        "ht_G": lambda: (geom.v2 / geom.v_z) ** 2,
        "ht_F": lambda: he.optics.fresnel(geom.cos_d, p["n"], p["k"]),
        "ht_S": lambda: product(geom, slope) * geom.cos_i * geom.cos_r,
        "ht_shadow_over_cos": lambda: he.shadowing(geom.cos_i, geom.sin_i, slope)[0],
        "ht_sigma_eff": lambda: p["sigma0_um"] * he.shadow_free(spread(geom, slope)),
        "ht_rho_dd": lambda: he.MODEL(geom, sigma=p["sigma0_um"], slope=slope, n=p["n"], k=p["k"]),
        "ht_rho_s": lambda: he.MODEL.mirror(geom, sigma=p["sigma0_um"], slope=slope, n=p["n"], k=p["k"], scale=1.0),
    }[row["quantity"]]()


# --- the sum ------------------------------------------------------------------------------------------


def term_by_term(g, y):
    """ln S and its derivatives at 40 digits."""
    with mpmath.workdps(40):
        g, y = mpmath.mpf(float(g)), mpmath.mpf(float(y))
        u = mpmath.lambertw(2 * y / g**2).real / 2
        top = g * mpmath.exp(u)
        width = mpmath.sqrt(top / (1 + 2 * u))
        first, last = max(1, int(top - 12 * width - 6)), int(top + 20 * width + 40)
        term = mpmath.exp(first * mpmath.log(g) - g - mpmath.loggamma(first + 1) - y / first) / first
        total = up = down = mpmath.mpf(0)
        for m in range(first, last + 1):
            total, up, down = total + term, up + m * term, down + term / m
            term *= g * m / mpmath.mpf(m + 1) ** 2 * mpmath.exp(y / (m * (m + 1)))
        return float(mpmath.log(total)), float(up / total - g), float(-down / total)


def test_sum_and_its_derivatives_agree_with_40_digits_with_seed_31():
    random = np.random.default_rng(31)
    g = 10 ** random.uniform(-10, 4, 300)
    y = np.where(np.arange(300) % 3 == 0, g * 10 ** random.uniform(-3, 2, 300), 10 ** random.uniform(-4, 4, 300))
    y[::10] = 0.0
    right = np.array([term_by_term(*each) for each in zip(g, y, strict=True)]).T
    deep = right[0] < -650  # where S itself underflows its logarithm is right to fewer digits
    fast, slow = np.array(ln_series(g, y, derivatives=True)), by_terms(g, y)
    assert np.max(np.abs(slow[0] - right[0])[~deep]) < 5e-13
    assert np.max(np.abs(fast[0] - right[0])[~deep]) < 1e-11
    np.testing.assert_allclose(fast[0][deep], right[0][deep], rtol=1e-12)
    for row in (1, 2):
        assert (
            np.max((np.abs(fast[row] - right[row]) / np.maximum(1.0 if row == 1 else 1e-3, np.abs(right[row])))[~deep])
            < 1e-8
        )
        assert (
            np.max((np.abs(slow[row] - right[row]) / np.maximum(1.0 if row == 1 else 1e-3, np.abs(right[row])))[~deep])
            < 1e-10
        )


def test_sums_and_cells_hang_on_no_others_to_the_last_digit_with_seed_36():
    """Or a fit would depend on what was fitted before it in its process."""
    draw = np.random.default_rng(36)
    g, y = 2.0 ** draw.uniform(-8, 12, 1500), 2.0 ** draw.uniform(-2, 14, 1500)
    few = [by_terms(*each) for each in zip(np.split(g, 500), np.split(y, 500), strict=True)]
    np.testing.assert_array_equal(by_terms(g, y), np.concatenate(few, axis=1))
    ln_series(g, y)
    known = {code: cell for code, cell in CELLS.items() if cell is not None}
    for code in sorted(known)[::7]:
        del CELLS[code]
        compute_cells([code])
        np.testing.assert_array_equal(CELLS[code], known[code])


def test_products_of_orders_are_the_terms_and_a_cell_hangs_on_no_other_with_seed_33():
    random = np.random.default_rng(33)
    g = 2.0 ** (random.integers(-42, 2, 120)[:, None] + np.linspace(0.99, 0.01, 5))
    y = 4 * (2.0 ** (random.integers(0, 128, 120)[:, None] / 8 + np.linspace(0.125, 0, 7)) - 1)
    found = by_products(g, y)
    pairs = (each.ravel() for each in np.broadcast_arrays(g[:, :, None], y[:, None, :]))
    right = by_terms(*pairs)[0].reshape(found.shape)
    assert np.max(np.abs(found - right) / np.maximum(1.0, np.abs(right) / 200)) < 5e-13
    alone = [by_products(g[[each]], y[[each]])[0] for each in range(0, 120, 7)]
    np.testing.assert_array_equal(found[::7], alone)


@pytest.mark.parametrize("g", [1e-6, 0.3, 4.0, 33.0, 64.0, 1000.0, 1e7])
def test_sum_at_the_mirror_direction_is_an_exponential_integral(g):
    with mpmath.workdps(50):
        ein = (
            mpmath.ei(g) - mpmath.log(g) - mpmath.euler
            if g < 1e5
            else mpmath.exp(g) / g * mpmath.hyp2f0(1, 1, mpmath.mpf(1) / g)
        )
        right = float(mpmath.log(ein) - g)
    assert float(ln_series(g, 0.0)) == pytest.approx(right, abs=1e-11)


def test_no_step_is_visible_across_the_cells_with_seed_32():
    """Both sides of an edge between cells differ by no more than the smooth trend."""
    random = np.random.default_rng(32)
    edge = 2.0 ** random.integers(-12, 20, 400)
    y = edge * 10 ** random.uniform(-3, 1, 400)
    below, at, above = (ln_series(edge * (1 + h), y) for h in (-1e-13, 0.0, 1e-13))
    assert np.max(np.abs(above - below)[at > -650]) < 2e-11


def test_a_sample_hangs_on_no_other_in_its_cell_with_seed_34():
    """Cells of few samples are evaluated together, those of many alone."""
    random = np.random.default_rng(34)
    g, y = 10 ** random.uniform(-4, 2, 40), 10 ** random.uniform(-3, 3, 40)
    few = np.array(ln_series(g, y, derivatives=True))
    many = np.array(ln_series(np.repeat(g, 40), np.repeat(y, 40), derivatives=True))[:, ::40]
    np.testing.assert_allclose(few, many, rtol=2e-14, atol=1e-14)


def test_what_lies_in_no_cell_keeps_no_new_cell_from_being_computed():
    """One sample outside all cells, one in a cell that nothing touched before: 2^-39 is in no other test."""
    g, y = np.array([1e-14, 1.5 * 2.0**-39]), np.array([0.3, 11.0])
    np.testing.assert_allclose(ln_series(g, y), by_terms(g, y)[0], rtol=1e-12)


def test_few_samples_and_many_are_summed_alike_with_seed_35():
    random = np.random.default_rng(35)
    g, y = 10 ** random.uniform(-6, 3, 20_000), 10 ** random.uniform(-3, 3, 20_000)
    many = np.array(ln_series(g, y, derivatives=True))
    few = np.concatenate(
        [np.array(ln_series(*each, True)) for each in zip(np.split(g, 40), np.split(y, 40), strict=True)], axis=1
    )
    np.testing.assert_allclose(few[0], many[0], rtol=1e-13, atol=2e-11)
    np.testing.assert_allclose(few[1:], many[1:], rtol=1e-8, atol=1e-8)


def test_patches_of_every_kind_of_cell_are_its_polynomial_with_seed_36():
    """At random and in corners of patches: cells with 4 patches along y, and with up to 32."""
    random = np.random.default_rng(36)
    octave = random.integers(0, _series_cells.OCTAVES_G * _series_cells.OCTAVES_Y, 500)
    row, column = np.divmod(octave, _series_cells.OCTAVES_Y)
    inside = np.where(random.random((2, 500)) < 0.3, random.integers(0, 32, (2, 500)) / 32, random.random((2, 500)))
    g = 2.0 ** (_series_cells.G_FIRST + row + inside[0])
    y = (2.0 ** (column + inside[1]) - 1) * np.maximum(g, 4)
    few, many = np.array(ln_series(g, y, derivatives=True)), _series_cells.by_cells(g, y, derivatives=True)
    assert np.max(np.abs(few[0] - many[0]) / np.maximum(1.0, np.abs(many[0]) / 650)) < 2e-11
    shallow = many[0] > -650
    assert np.max((np.abs(few - many)[1] / np.maximum(1.0, np.abs(many[1])))[shallow]) < 1e-8
    assert np.max((np.abs(few - many)[2] / np.maximum(1e-3, np.abs(many[2])))[shallow]) < 1e-8


def test_outside_the_cells_the_terms_are_summed():
    g, y = np.array([1e-14, 1e-20, 1e9, 3.0]), np.array([0.3, 2.0, 1e9, 1e6])
    np.testing.assert_array_equal(ln_series(g, y), by_terms(g, y)[0])


@pytest.mark.parametrize("g", [18.5, 40.0, 80.0, 200.0, 2000.0])
def test_first_wave_correction_keeps_within_24_over_g_squared(g):
    """The declared bound of the law without the series: up to four times the facets' exponent of e-folding, x <= 9."""
    x = np.linspace(0, 9, 200)
    exact = np.exp(ln_series(np.full_like(x, g), x * g))
    worst = np.max(np.abs(np.exp(-x) / g * (1 + (x * x - 4 * x + 2) / (2 * g)) / exact - 1))
    assert 4 / g**2 < worst < 24 / g**2
    assert np.max(np.abs(np.exp(-x) / g / exact - 1)) > 1 / g  # Beckmann alone is a whole order worse


# --- the law ------------------------------------------------------------------------------------------


def scattered(seed, count=400, grazing=89.999):
    random = np.random.default_rng(seed)
    theta = 90 - 10 ** random.uniform(np.log10(90 - grazing), np.log10(90), (2, count))
    geom = Geometry.from_degrees(
        theta[0], 0.0, theta[1], random.uniform(0, 360, count), 10 ** random.uniform(-0.4, 1, count)
    )
    return geom, {
        "sigma": geom.wavelength * 10 ** random.uniform(-4, 3, count),
        "slope": 10 ** random.uniform(-4, np.log10(2), count),
        "n": 1 + 10 ** random.uniform(-9, 1, count),
        "k": np.where(random.random(count) < 0.5, 0.0, 10 ** random.uniform(-3, 3, count)),
    }


@pytest.mark.parametrize("seed", [41, 42, 43, 44, 45])
def test_finite_and_not_negative_over_the_whole_domain_with_seed(seed):
    """sigma/λ 1e-4..1e3, tau/sigma 0.5..1e4, angles to 89.999°, n from 1 + 1e-9, k to 1e3; NumPy raises on anything
    else.
    """
    geom, values = scattered(seed, 4000)
    f, rho = he.MODEL(geom, **values), he.MODEL.mirror(geom, **values, scale=1.0)
    assert np.all(np.isfinite(f)) and np.all(f >= 0)
    assert np.all(np.isfinite(rho)) and np.all((rho >= 0) & (rho <= 1))
    slopes = he.gradient(geom, ("sigma", "slope"), **values, scale=1.0)
    assert all(np.all(np.isfinite(each)) for each in slopes.values())


def test_reciprocal_and_free_of_units_with_seed_46():
    geom, values = scattered(46)
    f = he.MODEL(geom, **values)
    keep = f > 1e-280
    np.testing.assert_allclose(he.MODEL(geom.swapped(), **values)[keep], f[keep], rtol=1e-14)
    in_nm = he.MODEL(geom.at(geom.wavelength * 1000), **{**values, "sigma": values["sigma"] * 1000})
    near = keep & (f > 1e-20)  # far off the lobe the last digit of x counts as often as x is large
    np.testing.assert_allclose(in_nm[near], f[near], rtol=1e-13)


def test_ln_of_the_lobe_where_the_lobe_underflows():
    geom = in_plane(10, -60)
    values = {"sigma": 0.3, "slope": 0.004, "n": 1.5, "k": 0.0, "scale": 1.0}
    assert float(he.brdf(geom, **values)) == 0.0
    tau = 0.3 / 0.004
    g, y = (2 * np.pi * 0.3 / 0.55) ** 2 * geom.v_z**2, (np.pi * tau / 0.55) ** 2 * geom.vxy2
    right = term_by_term(g, y)[0] + np.log(
        np.pi / 4 * (tau / 0.55) ** 2 * 0.04 * (geom.v2 / geom.v_z) ** 2 / (geom.cos_i * geom.cos_r)
    )
    assert float(he.ln_brdf(geom, **values)) == pytest.approx(float(right), rel=2e-4)  # F(θd) is not quite 0.04


def test_smooth_limit_is_rayleigh_and_rice():
    """f -> 16 π² cos² F PSD(0)/λ⁴ (cos_i cos_r = cos²) in the mirror direction, PSD(0) = π sigma² tau²."""
    geom, sigma, tau = in_plane(35, 35), 1e-4, 3e-3
    psd = np.pi * sigma**2 * tau**2
    right = 16 * np.pi**2 * geom.cos_i**2 * he.optics.fresnel(geom.cos_d, 1.5) * psd / 0.55**4
    assert float(he.MODEL(geom, sigma=sigma, slope=sigma / tau)) == pytest.approx(float(right), rel=2e-5)


def test_rough_limit_is_beckmanns_lobe_to_first_order_in_1_over_g():
    geom = in_plane(20, np.array([5.0, 20.0, 35.0]))
    alpha, t = 0.2, geom.tan2_h
    facets = (
        he.optics.fresnel(geom.cos_d, 1.5)
        * np.exp(-t / alpha**2)
        * ((1 + t) / alpha) ** 2
        / np.pi
        / (4 * geom.cos_i * geom.cos_r)
    )
    for sigma in (10.0, 100.0, 1000.0):
        g = (2 * np.pi * sigma / 0.55 * geom.v_z) ** 2
        assert np.max(np.abs(he.MODEL(geom, sigma=sigma, slope=0.1) / facets - 1) * g) < 2.0


@pytest.mark.parametrize(
    "sigma, slope", [(0.055, 0.05), (0.055, 0.5), (0.11, 0.1), (0.3, 0.15), (0.55, 0.3), (1.5, 0.1)]
)
def test_reflects_no_more_than_1_05_of_what_arrives(sigma, slope):
    """Mirror and lobe together for a perfect reflector: the theory itself goes up to 1.039 (ours, a scan)."""
    values = {"sigma": sigma, "slope": slope, "n": 1.0, "k": 1e9, "scale": 1.0}
    # half vectors evenly spread in what they make of the lobe: x = tan² of their tilt over alpha², and azimuth
    for theta_i in (0.0, 30.0, 60.0, 80.0):
        u, weight = np.polynomial.legendre.leggauss(160)
        mu, azimuth = 0.5 * (1 + u), np.pi * 0.5 * (1 + u)
        theta_r = np.degrees(np.arccos(mu))[:, None]
        geom = Geometry.from_degrees(theta_i, 0.0, theta_r, 180 + np.degrees(azimuth)[None, :])
        lobe = np.einsum("ij,i,j->", he.MODEL(geom, **values) * mu[:, None], 0.5 * weight, np.pi * weight)
        rho = float(he.MODEL.mirror(in_plane(theta_i, theta_i), **values))
        assert 0.05 < lobe + rho < 1.05


def test_derivatives_agree_with_50_digit_pins():
    """d f/d ln sigma and d f/d ln slope at 50 digits, by differences of 1e-14 in the formulas of the docstring."""
    for angles, sigma, slope, right_sigma, right_slope in DERIVATIVES:
        geom = Geometry.from_degrees(angles[0], 0.0, angles[1], angles[2])
        got = he.gradient(geom, ("sigma", "slope"), sigma=sigma, slope=slope, n=1.5, k=0.0, scale=1.0)
        assert float(got["sigma"]) * sigma == pytest.approx(
            right_sigma, abs=1e-9 * float(he.MODEL(geom, sigma=sigma, slope=slope))
        )
        assert float(got["slope"]) * slope == pytest.approx(right_slope, rel=1e-9)


def product(geom, slope):
    return he.shadowing(geom.cos_i, geom.sin_i, slope)[0] * he.shadowing(geom.cos_r, geom.sin_r, slope)[0]


def spread(geom, slope):
    return he.shadowing(geom.cos_i, geom.sin_i, slope)[1] + he.shadowing(geom.cos_r, geom.sin_r, slope)[1]


def test_a_second_wavelength_is_not_answered_with_the_first_ones_values():
    """The directions are so many that they are evaluated piece by piece."""
    theta_r, values = np.linspace(-80, 80, 5001), {"sigma": 0.2, "slope": 0.1}
    geom = in_plane(45.0, theta_r, 0.45)
    blue, red = he.MODEL(geom, **values), he.MODEL(geom.at(0.65), **values)
    assert np.array_equal(red, he.MODEL(in_plane(45.0, theta_r, 0.65), **values))
    assert np.median(np.abs(np.log(red / blue))) > 0.1

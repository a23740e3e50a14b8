"""One surface in every convention of the field: whatever names, units and angles say, the same directions come back."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import formats
from brdfguide.errors import InputError
from brdfguide.physics.geometry import Geometry, rows

from ...surfaces import table

GRID = np.meshgrid([15.0, 40.0, 60.0], [0.0, 10.0, 25.0, 40.0, 65.0], [30.0, 90.0, 140.0, 180.0], indexing="ij")
THETA_I, THETA_R, PHI = (each.ravel() for each in GRID)  # phi is that of the detector, the light's is 0
PLANE_I, PLANE_R = (each.ravel() for each in np.meshgrid([15.0, 40.0, 60.0], np.r_[-70.0:71.0:10.0], indexing="ij"))


def value(geom: Geometry) -> np.ndarray:
    """A lobe about the mirror direction over a body [1/sr], (rows,)."""
    return 0.1 + 0.5 * np.exp(-20 * geom.tan2_h[:, 0]) / (geom.cos_i + geom.cos_r)[:, 0]


DOME = rows(Geometry.from_degrees(THETA_I, 0.0, THETA_R, PHI))
PLANE = rows(Geometry.from_degrees(PLANE_I, 0.0, np.abs(PLANE_R), np.where(PLANE_R < 0, 0.0, 180.0)))
BRDF, IN_PLANE = value(DOME), value(PLANE)


def read(tmp_path, text, **options):
    (tmp_path / "run.csv").write_text(text)
    return formats.read(tmp_path / "run.csv", **options)


def codes(measurement) -> set[str]:
    return {finding.code for finding in measurement.findings}


def check(measurement, geom=DOME, brdf=BRDF, tolerance=1e-6) -> None:
    """The same pairs of directions with the same values, in the same order."""
    assert len(measurement.geom) == len(geom)
    for name in ("cos_i", "cos_r", "vxy2"):
        np.testing.assert_allclose(getattr(measurement.geom, name), getattr(geom, name), atol=tolerance)
    np.testing.assert_allclose(measurement.brdf[:, 0], brdf, rtol=1e-5)


def half_and_difference() -> list[np.ndarray]:
    """theta_h, theta_d, phi_d [rad] of the dome's directions, from their definition: h to the pole, then d."""
    i, r, p = np.radians(THETA_I), np.radians(THETA_R), np.radians(PHI)
    light = np.stack([np.sin(i), 0 * i, np.cos(i)])
    view = np.stack([np.sin(r) * np.cos(p), np.sin(r) * np.sin(p), np.cos(r)])
    half = light + view
    half /= np.linalg.norm(half, axis=0)
    theta_h, phi_h = np.arccos(np.clip(half[2], -1, 1)), np.arctan2(half[1], half[0])
    x = np.cos(phi_h) * light[0] + np.sin(phi_h) * light[1]
    y = -np.sin(phi_h) * light[0] + np.cos(phi_h) * light[1]
    x, z = np.cos(theta_h) * x - np.sin(theta_h) * light[2], np.sin(theta_h) * x + np.cos(theta_h) * light[2]
    return [theta_h, np.arctan2(np.hypot(x, y), z), np.arctan2(y, x)]


def test_zeniths_and_relative_azimuth(tmp_path):
    check(read(tmp_path, table(("theta_i", "theta_r", "dphi", "brdf"), THETA_I, THETA_R, PHI, BRDF)))


def test_half_and_difference_angles_in_radians_and_in_degrees(tmp_path):
    angles = half_and_difference()
    check(read(tmp_path, table(("theta_h", "theta_d", "phi_d", "brdf"), *angles, BRDF), unit="rad"), tolerance=3e-6)
    check(
        read(tmp_path, table(("theta_half_rad", "theta_diff_rad", "phi_diff_rad", "f_r"), *angles, BRDF)),
        tolerance=3e-6,
    )
    measurement = read(tmp_path, table(("theta_h", "theta_d", "phi_d", "brdf"), *np.degrees(angles), BRDF))
    check(measurement)
    assert "half-difference-angles" in codes(measurement)


def test_incidence_emission_and_phase(tmp_path):
    cosine = DOME.dot_xy + DOME.cos_i * DOME.cos_r
    phase = np.degrees(np.arccos(cosine[:, 0]))
    for names in (("incidence", "emission", "phase"), ("i", "e", "g"), ("SZA", "VZA", "phase angle (deg)")):
        measurement = read(tmp_path, table((*names, "brdf"), THETA_I, THETA_R, phase, BRDF))
        check(measurement, tolerance=1e-4)
    assert "azimuth-from-phase" in codes(measurement)


def test_a_rounded_phase_angle_in_the_plane_of_incidence_stays_in_it(tmp_path):
    phase = np.round(np.abs(PLANE_I + PLANE_R), 0)
    ahead = np.where(PLANE_R < 0, np.abs(PLANE_I - np.abs(PLANE_R)), PLANE_I + PLANE_R)
    assert np.allclose(phase, ahead)
    measurement = read(
        tmp_path, table(("incidence", "emission", "phase", "brdf"), PLANE_I, np.abs(PLANE_R), phase, IN_PLANE)
    )
    check(measurement, PLANE, IN_PLANE)
    assert measurement.in_plane


def test_an_impossible_phase_angle_is_refused_with_its_line(tmp_path):
    with pytest.raises(
        InputError, match=r"line 3: phase angle 80 degrees: beside incidence 20 and emission 30 it lies"
    ):
        read(tmp_path, "incidence,emission,phase,brdf\n20,30,40,.1\n20,30,80,.1\n")


def test_a_phase_angle_tells_from_where_azimuths_count(tmp_path):
    phase = np.degrees(np.arccos((DOME.dot_xy + DOME.cos_i * DOME.cos_r)[:, 0]))
    text = table(("incidence", "emission", "azimuth", "phase", "brdf"), THETA_I, THETA_R, PHI + 180, phase, BRDF)
    measurement = read(tmp_path, text)
    check(measurement)
    assert "azimuth-turned" in codes(measurement)


def test_elevations_stand_for_zeniths(tmp_path):
    names = ("sun elevation", "view elevation (deg)", "RAA", "BRDF")
    check(read(tmp_path, table(names, 90 - THETA_I, 90 - THETA_R, PHI, BRDF)))


@pytest.mark.parametrize(
    ("unit", "degrees"), [("gon", 0.9), ("rad", 180 / np.pi), ("mrad", 0.18 / np.pi), ("arcmin", 1 / 60), ("°", 1.0)]
)
def test_units_of_angles(tmp_path, unit, degrees):
    names = (f"theta_i [{unit}]", f"theta_r [{unit}]", f"dphi [{unit}]", "brdf")
    check(read(tmp_path, table(names, THETA_I / degrees, THETA_R / degrees, PHI / degrees, BRDF)), tolerance=1e-5)


def test_each_column_has_the_unit_of_its_name(tmp_path):
    names = ("theta_i (deg)", "theta_r (rad)", "dphi (gon)", "brdf")
    check(read(tmp_path, table(names, THETA_I, np.radians(THETA_R), PHI / 0.9, BRDF)), tolerance=1e-5)
    text = table(("theta_i", "theta_r", "dphi", "brdf"), THETA_I / 0.9, THETA_R / 0.9, PHI / 0.9, BRDF)
    check(read(tmp_path, text, unit="gon"), tolerance=1e-5)
    check(read(tmp_path, "# angles in gon\n" + text), tolerance=1e-5)


def test_cosines_of_the_zeniths(tmp_path):
    text = table(("mu0", "mu", "dphi", "brdf"), np.cos(np.radians(THETA_I)), np.cos(np.radians(THETA_R)), PHI, BRDF)
    check(read(tmp_path, text))
    text = table(("theta_i", "cos(theta_r)", "dphi", "brdf"), THETA_I, np.cos(np.radians(THETA_R)), PHI, BRDF)
    check(read(tmp_path, text))


def test_vectors_with_and_without_their_third_component(tmp_path):
    i, r, p = np.radians(THETA_I), np.radians(THETA_R), np.radians(PHI)
    light = [np.sin(i), 0 * i, np.cos(i)]
    view = [np.sin(r) * np.cos(p), np.sin(r) * np.sin(p), np.cos(r)]
    names = ("wi_x", "wi_y", "wi_z", "wo_x", "wo_y", "wo_z", "f_r")
    check(read(tmp_path, table(names, *light, *view, BRDF)))
    check(read(tmp_path, table(names, *light, *(3 * each for each in view), BRDF)))  # of any length
    check(read(tmp_path, table(("wi_x", "wi_y", "wo_x", "wo_y", "f_r"), *light[:2], *view[:2], BRDF)))
    with pytest.raises(InputError, match="--unit deg has no effect"):
        read(tmp_path, table(names, *light, *view, BRDF), unit="deg")
    reversed_ = read(tmp_path, table(names, *(-each for each in light), *view, BRDF))
    check(reversed_)
    assert "vectors-reversed" in codes(reversed_)


def test_angles_and_sines_from_the_mirror_direction(tmp_path):
    check(
        read(tmp_path, table(("theta_i", "angle from specular", "brdf"), PLANE_I, PLANE_R - PLANE_I, IN_PLANE)),
        PLANE,
        IN_PLANE,
    )
    beta_0, beta = np.sin(np.radians(PLANE_I)), np.sin(np.radians(PLANE_R))
    for names, columns in (
        (("theta_i", "beta-beta0", "brdf"), (PLANE_I, beta - beta_0)),
        (("beta_0", "beta_s", "brdf"), (beta_0, beta)),
        (("theta_i (deg)", "beta_s", "brdf"), (PLANE_I, beta)),
        (("AOI", "β - β₀", "BSDF"), (PLANE_I, beta - beta_0)),
    ):
        check(read(tmp_path, table(names, *columns, IN_PLANE)), PLANE, IN_PLANE)


def test_direction_cosines_out_of_the_plane(tmp_path):
    i, r, p = np.radians(THETA_I), np.radians(THETA_R), np.radians(PHI)
    along, across = -np.sin(r) * np.cos(p), np.sin(r) * np.sin(p)  # beta points to the mirror direction
    check(read(tmp_path, table(("beta_i", "beta_s", "alpha_s", "brdf"), np.sin(i), along, across, BRDF)))


def test_angles_from_the_mirror_direction_beside_azimuths_are_refused(tmp_path):
    text = table(("theta_i", "angle from specular", "azimuth", "brdf"), THETA_I, THETA_R, PHI, BRDF)
    with pytest.raises(InputError, match="whether these turn about the mirror direction or the normal is not said"):
        read(tmp_path, text)


def test_the_rotation_of_the_sample_is_kept_as_the_azimuth_of_the_light(tmp_path):
    psi = np.tile([0.0, 30.0], len(PLANE_I))
    twice = [np.repeat(each, 2) for each in (PLANE_I, PLANE_R, IN_PLANE)]
    names = ("sample rotation (deg)", "theta_i", "theta_r", "brdf")
    measurement = read(tmp_path, table(names, psi, *twice[:2], twice[2]))
    np.testing.assert_allclose(measurement.geom.phi_i_deg[:, 0], -psi)
    check(measurement[::2], PLANE, IN_PLANE)
    check(measurement[1::2], PLANE, IN_PLANE)
    assert "sample-rotation" in codes(measurement)


TURNS = (0.0, 30.0, 60.0, 90.0, 120.0, 150.0)


def grained(theta_i, phi_i, theta_r, phi_r):
    """A metal's lobe, three times as wide along azimuth 37 as across it."""
    geom = rows(Geometry.from_degrees(theta_i, phi_i, np.abs(theta_r), np.where(theta_r < 0, phi_r + 180, phi_r)))
    values = {"alpha_x": 0.3, "alpha_y": 0.1, "axis": np.radians(37.0), "n": 1.0, "k": 6.0}
    return models.term("ggx-aniso")(geom, **values)[:, 0]


def scans(name: str, brdf, comment: str = "") -> str:
    """A table of scans with theta_r from -70 to 70 under a column of azimuths."""
    turn = np.repeat(TURNS, PLANE_I.size)
    theta_i, theta_r = (np.tile(each.ravel(), len(TURNS)) for each in (PLANE_I, PLANE_R))
    made = [turn, theta_i, theta_r, brdf(turn, theta_i, theta_r)]
    return comment + table([name, "theta_i", "theta_r", "brdf"], *made)


def of_sample(turn, theta_i, theta_r):
    return grained(theta_i, turn, theta_r, turn + 180)


@pytest.mark.parametrize(
    ("name", "options", "sign", "code"),
    [
        ("phi_i", {}, 1, "in-plane-assumed"),
        ("azimuth", {}, 1, "azimuth-of-sample"),
        ("phi", {}, 1, "azimuth-of-sample"),
        ("azimuth (cw)", {}, -1, "azimuth-clockwise"),
        ("azimuth", {"rotation_sense": "ccw"}, -1, "sample-rotation"),
        ("azimuth", {"rotation_sense": "cw"}, 1, "sample-rotation"),
        ("psi", {}, -1, "sample-rotation"),
        ("sample azimuth", {}, -1, "sample-rotation"),
        ("rotation (cw)", {}, 1, "sample-rotation"),
        ("rotation (cw)", {"rotation_sense": "ccw"}, -1, "sample-rotation"),
        ("rotation ccw", {"rotation_sense": "cw"}, 1, "sample-rotation"),
    ],
)
def test_an_azimuth_beside_signed_zeniths_is_that_of_the_sample(tmp_path, name, options, sign, code):
    found = read(tmp_path, scans(name, of_sample), **options)
    assert np.unique(found.geom.phi_i_deg).tolist() == sorted(sign * each + 0.0 for each in TURNS)
    assert np.max(np.abs(np.remainder(found.geom.phi_deg + 90, 180) - 90)) < 1e-9  # in the plane of incidence
    assert code in codes(found)


def test_a_comment_says_in_which_sense_the_sample_turned(tmp_path):
    found = read(tmp_path, scans("psi", of_sample, "# sample rotated clockwise by psi\n"))
    assert np.unique(found.geom.phi_i_deg).tolist() == list(TURNS)
    assert any("as a comment says" in each.text for each in found.findings)


def test_an_azimuth_under_which_the_mirror_direction_is_lost_is_the_detectors(tmp_path):
    def of_detector(turn, theta_i, theta_r):
        return grained(theta_i, 0.0, theta_r, turn)

    found = read(tmp_path, scans("azimuth", of_detector))
    assert np.all(found.geom.phi_i_deg == 0) and "azimuth-of-detector" in codes(found)
    assert len(np.unique(np.round(found.geom.phi_deg))) == 12
    told = read(tmp_path, scans("azimuth", of_sample), columns="dphi=azimuth")
    assert np.all(told.geom.phi_i_deg == 0) and len(np.unique(np.round(told.geom.phi_deg))) == 12


def test_a_column_for_each_incidence_or_each_reflected_angle(tmp_path):
    grid = IN_PLANE.reshape(3, -1)
    by_incidence = table(("theta_r", "15", "40", "60"), PLANE_R.reshape(3, -1)[0], *grid)
    check(read(tmp_path, by_incidence), PLANE, IN_PLANE)
    names = ("theta_i", *(f"BRDF @ {angle:g} deg" for angle in PLANE_R.reshape(3, -1)[0] if angle >= 0))
    ahead = PLANE_R >= 0
    text = table(names, PLANE_I.reshape(3, -1)[:, 0], *grid.T[PLANE_R.reshape(3, -1)[0] >= 0])
    measurement = read(tmp_path, text)
    order = np.lexsort((PLANE_I[ahead], PLANE_R[ahead]))
    check(measurement, PLANE[ahead][order], IN_PLANE[ahead][order])
    assert "reflected-columns" in codes(measurement)


def test_a_sheet_of_incidences_times_wavelengths_with_their_doubts(tmp_path):
    grid = IN_PLANE.reshape(3, -1)
    names, columns = ["theta_r"], [PLANE_R.reshape(3, -1)[0]]
    for place, angle in enumerate((15, 40, 60)):
        for nm, factor in ((450, 1.0), (650, 2.0)):
            names += [f"BRDF {nm} nm {angle} deg", f"u(BRDF) {nm} nm {angle} deg"]
            columns += [factor * grid[place], 0.01 * factor * grid[place]]
    measurement = read(tmp_path, table(names, *columns))
    check(measurement, PLANE, IN_PLANE)
    assert measurement.channels == ("450nm", "650nm")
    np.testing.assert_allclose(measurement.brdf[:, 1], 2 * IN_PLANE, rtol=1e-6)
    np.testing.assert_allclose(measurement.stderr, 0.01 * measurement.brdf, rtol=1e-6)


def test_one_number_for_an_angle_of_the_whole_table(tmp_path):
    keep = THETA_I == 40
    text = table(("theta_r", "brdf"), THETA_R[keep & (PHI == 90)], BRDF[keep & (PHI == 90)])
    measurement = read(tmp_path, text, columns="theta_i=40,phi_r=90")
    check(measurement, DOME[keep & (PHI == 90)], BRDF[keep & (PHI == 90)])


def test_what_is_mapped_keeps_its_unit_and_form(tmp_path):
    names = ("Lampe hoch, Sonne elevation (gon)", "Kopf (gon)", "dphi (gon)", "f")
    text = table([f'"{name}"' for name in names], (90 - THETA_I) / 0.9, THETA_R / 0.9, PHI / 0.9, BRDF)
    columns = {"theta_i": names[0], "theta_r": names[1]}
    check(read(tmp_path, text, columns=columns), tolerance=1e-5)


def test_of_two_columns_for_one_angle_the_plain_one_counts(tmp_path):
    cosine = np.cos(np.radians(THETA_R))
    text = table(("theta_i", "theta_r", "cos_theta_r", "dphi", "brdf"), THETA_I, THETA_R, cosine, PHI, BRDF)
    measurement = read(tmp_path, text)
    check(measurement)
    (note,) = [finding for finding in measurement.findings if finding.code == "columns-ignored"]
    assert "'cos_theta_r' ('theta_r' says it outright)" in note.text


@pytest.mark.parametrize("angle", [0.0, 90.0])
def test_the_normal_and_the_horizon_themselves(tmp_path, angle, recwarn):
    text = table(
        ("theta_i", "theta_r", "dphi", "brdf"), [angle, 30.0, 30.0], [30.0, angle, 30.0], [180.0] * 3, [0.1] * 3
    )
    measurement = read(tmp_path, text)
    assert len(measurement.geom) == (3 if angle == 0 else 1)
    assert ("below-horizon" in codes(measurement)) == (angle == 90)
    assert not recwarn

"""The other instruments' files: where the mirror is, which quantity, which channels; made-up files and real ones."""

import numpy as np
import pytest
from scipy.interpolate import LinearNDInterpolator

from brdfguide.data import examine, formats
from brdfguide.errors import InputError

from . import containers


def read(tmp_path, text, name="run.dat", **options):
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return formats.read(path, **options)


def codes(measurement):
    return {finding.code for finding in measurement.findings}


def at_mirror(measurement, theta_i):
    """The value nearest to the mirror direction of an incidence."""
    rows = measurement.theta_i_groups[theta_i]
    return measurement.brdf[rows[np.argmin(measurement.geom.mirror_distance2[rows, 0])], 0]


def test_cornell_angles_come_back_round(tmp_path):
    measurement = read(tmp_path, containers.cornell())
    assert measurement.channels == ("400nm", "500nm", "600nm") and set(measurement.theta_i_groups) == {20.0, 50.0}
    np.testing.assert_allclose(measurement.brdf, np.tile([0.1, 0.2, 0.3], (12, 1)))


def test_zemax_angles_stand_about_the_mirror_direction(tmp_path):
    measurement = read(tmp_path, containers.zemax())
    geom = measurement.geom
    rows = measurement.theta_i_groups[20.0]
    # azimuth 0 points from the mirror direction (20 degrees) toward the normal and beyond: 20 - 60 = -40
    expected = sorted([20.0, 0.0, -40.0, 40.0, 80.0])
    in_plane = np.sort(geom.signed_theta_r_deg[rows, 0][geom.off_plane_deg[rows, 0] < 1e-6])
    np.testing.assert_allclose(in_plane, expected, atol=1e-6)
    across = rows[(geom.off_plane_deg[rows, 0] > 1)]
    # azimuth 90, radial 60: cos theta_r = cos 60 cos 20
    np.testing.assert_allclose(
        np.sort(geom.cos_r[across, 0]), np.cos(np.radians(20)) * np.cos(np.radians([60, 20])), atol=1e-9
    )
    assert "below-horizon" in codes(measurement)  # 50 + 60 = 110
    assert at_mirror(measurement, 50.0) == pytest.approx(0.3)


def test_zemax_colours_and_refusals(tmp_path):
    assert read(tmp_path, containers.zemax("TristimulusX", blocks=3)).channels == ("X", "Y", "Z")
    with pytest.raises(InputError, match="ScatterType BTDF: transmission"):
        read(tmp_path, containers.zemax().replace("ScatterType BRDF", "ScatterType BTDF"))
    with pytest.raises(InputError, match="truncated: it ends where value of table 2 was wanted"):
        read(tmp_path, containers.zemax()[:-30])
    with pytest.raises(InputError, match="ScatterRadial promises 300000000 angles"):
        read(tmp_path, containers.zemax().replace("ScatterRadial 3", "ScatterRadial 300000000"))
    turned = "TIS 1\n" + "1 1 1\n" * 3 + "TIS 1\n" + "1 1 1\n" * 3 + "DataEnd"
    brushed = containers.zemax().replace("SampleRotation 1\n0", "SampleRotation 2\n0 90").replace("DataEnd", turned)
    found = read(tmp_path, brushed).findings
    assert [finding.severity for finding in found if finding.code == "anisotropic"] == ["warning"]
    assert "averaged-over-rotation" in codes(read(tmp_path, brushed, average_phi_i=True))


def test_zemax_total_scatter_is_what_the_file_states(data):
    """The integral of f cos theta_r over the directions that the sphere sees, to 80 degrees, at 13 incidences, to 3
    %.
    """
    measurement = formats.read(data / "zemax" / "test_13_planesymmetric_brdf_zemax.bsdf")
    stated = dict(next(finding for finding in measurement.findings if finding.code == "tis").numbers)
    geom = measurement.geom
    theta, phi = np.meshgrid((np.arange(40) + 0.5) * 2, (np.arange(45) + 0.5) * 4, indexing="ij")
    solid = np.cos(np.radians(theta)) * np.sin(np.radians(theta)) * np.radians(2) * np.radians(4) * 2

    def place(t, p):
        return np.stack(
            [np.sin(np.radians(t)) * np.cos(np.radians(p)), np.sin(np.radians(t)) * np.abs(np.sin(np.radians(p)))], -1
        )

    for theta_i, rows in measurement.theta_i_groups.items():
        rows = rows[measurement.usable[rows, 0] & (geom.theta_r_deg[rows, 0] < 82)]
        where, level = place(geom.theta_r_deg[rows, 0], geom.phi_deg[rows, 0]), np.log(measurement.brdf[rows, 0])
        nodes = place(theta, phi)
        value = LinearNDInterpolator(where, level)(nodes)
        nearest = level[np.argmin(np.sum((nodes[..., None, :] - where) ** 2, axis=-1), axis=-1)]
        total = float(np.sum(np.exp(np.where(np.isfinite(value), value, nearest)) * solid))
        assert total == pytest.approx(stated[f"{theta_i:g}_deg"], rel=0.03), theta_i


def test_zemax_and_fred_exports_of_one_run_agree(data):
    zemax, fred = (formats.read(data / "ua_loft" / f"AnoBlackEC1onAlum.{suffix}") for suffix in ("bsdf", "txt"))
    assert zemax.geom.wavelength[0] == pytest.approx(0.65)
    for theta_i in (10.0, 30.0, 50.0, 70.0):
        assert at_mirror(zemax, theta_i) == pytest.approx(at_mirror(fred, theta_i), rel=0.12)


def test_fred_blocks_name_the_specular_direction(tmp_path):
    measurement = read(tmp_path, containers.fred())
    assert at_mirror(measurement, 20.0) == pytest.approx(0.5) and at_mirror(measurement, 50.0) == pytest.approx(0.9)
    logs = read(tmp_path, containers.fred().replace("bsdf=value scale=1", "bsdf=log scale=2"))
    np.testing.assert_allclose(logs.brdf[:, 0], 2 * 10 ** measurement.brdf[:, 0])
    sines = read(tmp_path, "type bsdf_data\nformat angles=sin bsdf=value scale=1\n0.5 0\n0.5 0 3\n0 0.5 1\n")
    np.testing.assert_allclose(sines.geom.theta_r_deg[:, 0], 30)
    assert at_mirror(sines, 30.0) == pytest.approx(3)
    with pytest.raises(InputError, match="line 2: 'format .*': wanted angles=deg or sin"):
        read(tmp_path, containers.fred().replace("angles=deg", "angles=gon"))
    with pytest.raises(InputError, match="line 5: found 4 numbers, wanted 2"):
        read(tmp_path, containers.fred().replace("20 0 0.5", "20 0 0.5 7"))


def test_lighttools_text_takes_the_mirror_azimuth_from_its_calibration(tmp_path):
    measurement = read(tmp_path, containers.lighttools())
    assert len(measurement.geom) == 12
    assert at_mirror(measurement, 30.0) == pytest.approx(2.0)


def test_lighttools_run_at_hand_has_no_value_above_zero_and_says_so(data):
    measurement = formats.read(data / "ua_loft" / "test_lighttools.txt")
    assert not np.any(measurement.usable) and "negative-values" in codes(measurement)
    with pytest.raises(InputError, match="no value is positive: there is nothing to fit"):
        examine.corrected(measurement)


def test_lighttools_bsdf_blocks(tmp_path):
    measurement = read(tmp_path, containers.lighttools_bsdf())
    assert measurement.channels == ("550nm",) and set(measurement.theta_i_groups) == {30.0, 60.0}
    assert at_mirror(measurement, 30.0) == pytest.approx(5)
    assert "blocks-skipped" in codes(measurement)


def test_alta_retro_reflector_is_outside_the_guide(data):
    measurement = formats.read(data / "alta" / "retro-3M-jaune.dat")
    assert "quantity-stated" in codes(measurement)
    assert [finding.code for finding in examine.outside(examine.examine(measurement))] == ["retro-reflector"]


def test_alta_parametrisations_give_the_same_directions(tmp_path):
    theta_i, theta_r, dphi = 0.5, 0.7, 2.0
    light = np.array([np.sin(theta_i), 0, np.cos(theta_i)])
    view = np.array([np.sin(theta_r) * np.cos(dphi), np.sin(theta_r) * np.sin(dphi), np.cos(theta_r)])
    half = (light + view) / np.linalg.norm(light + view)
    theta_h, phi_h = np.arccos(half[2]), np.arctan2(half[1], half[0])
    spun = np.array(
        [
            np.cos(phi_h) * light[0] + np.sin(phi_h) * light[1],
            -np.sin(phi_h) * light[0] + np.cos(phi_h) * light[1],
            light[2],
        ]
    )
    x, z = np.cos(theta_h) * spun[0] - np.sin(theta_h) * spun[2], np.sin(theta_h) * spun[0] + np.cos(theta_h) * spun[2]
    theta_d, phi_d = np.arccos(z), np.arctan2(spun[1], x)
    apart = np.arccos(light @ view)
    toward_normal = np.array([-np.cos(theta_i), 0, np.sin(theta_i)])
    turn = np.arctan2(view[1], view @ toward_normal)
    back = view - light * [1, 1, -1]
    back /= np.linalg.norm(back)
    theta_k, phi_k = np.arccos(back[2]), np.arctan2(back[1], back[0])
    forms = {
        "ISOTROPIC_TV_TL_DPHI": (3, (theta_r, theta_i, dphi)),
        "ISOTROPIC_TL_TV_PROJ_DPHI": (3, (theta_i, theta_r * np.cos(dphi), theta_r * np.sin(dphi))),
        "SPHERICAL_TL_PL_TV_PV": (4, (theta_i, 0.3, theta_r, dphi + 0.3)),
        "RUSIN_TH_TD_PD": (3, (theta_h, theta_d, phi_d)),
        "RUSIN_TH_PH_TD_PD": (4, (theta_h, phi_h, theta_d, phi_d)),
        "RETRO_TL_TVL_PROJ_DPHI": (3, (theta_i, apart * np.cos(turn), apart * np.sin(turn))),
        "SCHLICK_TL_TK_PROJ_DPHI": (3, (theta_i, theta_k * np.cos(phi_k), theta_k * np.sin(phi_k))),
        "CARTESIAN": (6, (*view, *light)),
    }
    for name, (count, cells) in forms.items():
        measurement = read(tmp_path, containers.alta(name, dimensions=f"{count} 1", rows=((*cells, 0.25),)))
        np.testing.assert_allclose(measurement.geom.v2[0, 0], 2 * (1 + light @ view), rtol=1e-8, err_msg=name)
        np.testing.assert_allclose(measurement.geom.tan2_h[0, 0], np.tan(theta_h) ** 2, rtol=1e-8, err_msg=name)


def test_a_quantity_that_alta_does_not_state_is_said_to_be_assumed(tmp_path):
    stated = read(tmp_path, containers.alta())
    silent = read(tmp_path, containers.alta().replace("#PARAM_OUT INV_STERADIAN\n", ""))
    np.testing.assert_array_equal(silent.brdf, stated.brdf)
    codes = [{each.code for each in found.findings} for found in (stated, silent)]
    assert "quantity-stated" in codes[0] and "quantity-assumed" not in codes[0]
    assert "quantity-assumed" in codes[1] and "quantity-stated" not in codes[1]
    assert not silent.settled("cosine") and not silent.settled("scale")


@pytest.mark.parametrize("order", ["little", "big"])
def test_alta_binary_bodies_hold_what_text_holds(tmp_path, order):
    text = read(tmp_path, containers.alta())
    content = containers.alta_binary(order)
    binary = read(tmp_path, content)
    np.testing.assert_array_equal(binary.brdf, text.brdf)
    np.testing.assert_allclose(binary.geom.theta_r_deg, text.geom.theta_r_deg)
    with pytest.raises(InputError, match="truncated: 2 samples of 4 doubles promised"):
        read(tmp_path, content[: content.index(b"#END_STREAM") - 9])


@pytest.mark.parametrize(
    "content, sentence",
    [
        (containers.alta_binary().replace(b"COUNT 2", "COUNT ²".encode()), "truncated: 0 samples"),
        (
            containers.lighttools_bsdf().replace("ScatterRadial 3", "ScatterRadial 1e999").encode(),
            "ScatterRadial promises inf angles",
        ),
    ],
)
def test_counts_that_no_file_can_hold_are_refused(tmp_path, content, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, content)


def test_alta_quantities_and_refusals(tmp_path):
    plain, cosine = (
        read(tmp_path, containers.alta(out=out)) for out in ("INV_STERADIAN", "INV_STERADIAN_COSINE_FACTOR")
    )
    np.testing.assert_allclose(cosine.brdf * cosine.geom.cos_r, plain.brdf)
    with pytest.raises(InputError, match="no ALTA parametrisation in .* called 'COS_TH'"):
        read(tmp_path, containers.alta("COS_TH"))
    with pytest.raises(InputError, match="#DIM says 2 coordinates; ISOTROPIC_TV_TL_DPHI has 3"):
        read(tmp_path, containers.alta(dimensions="2 1"))


def test_astm_angles_are_radians_unless_the_header_says_degrees(tmp_path):
    measurement = read(tmp_path, containers.astm(), "run.astm")
    assert measurement.format == "ASTM E1392 text" and measurement.channels == ("R", "G", "B")
    np.testing.assert_allclose(np.radians(measurement.geom.theta_i_deg[:, 0]), [0.5, 1.0], rtol=1e-9)
    assert abs(np.remainder(measurement.geom.phi_deg[0, 0], 360) - 180) < 1e-3
    rows = ((30.0, 0.0, 40.0, 180.0, 0.1), (30.0, 0.0, 50.0, 170.0, 0.2))
    text = containers.astm("theta_i,phi_i,theta_s,phi_s,550nm", rows).replace(
        "NUM_POINTS", "ANGLE_UNITS degrees\nNUM_POINTS"
    )
    np.testing.assert_allclose(read(tmp_path, text).geom.theta_r_deg[:, 0], [40, 50])
    weighted = read(
        tmp_path,
        containers.astm("theta_i,phi_i,theta_s,phi_s,ccbrdf", tuple((0.5, 0.0, 0.4, 3.1, f) for f in (0.1, 0.2))),
    )
    np.testing.assert_allclose(weighted.brdf[:, 0] * np.cos(0.4), [0.1, 0.2])
    with pytest.raises(InputError, match="truncated: NUM_POINTS promises 9 rows; found 2"):
        read(tmp_path, containers.astm().replace("NUM_POINTS 2", "NUM_POINTS 9"))
    more = read(tmp_path, containers.astm().replace("NUM_POINTS 2", "NUM_POINTS 1"))
    assert len(more.brdf) == 2 and "rows-beyond-count" in [each.code for each in more.findings]


ASTM = containers.astm("theta_i,phi_i,theta_s,phi_s,R,G,B")
SAME_AS_ASTM = {
    "a byte order mark": "\ufeff" + ASTM,
    "old Windows lines": ASTM.replace("\n", "\r\n"),
    "a colon after the keys": ASTM.replace("VARS ", "VARS: ").replace("NUM_POINTS ", "NUM_POINTS: "),
    "a tab after VARS": ASTM.replace("VARS ", "VARS\t"),
    "blanks after the commas": ASTM.replace(",", ", "),
    "blanks instead of commas": ASTM.replace(",", " "),
    "comments": "# made up\n" + ASTM.replace("\n0.5", "\n# rows\n\n0.5"),
    "Fortran's exponents": ASTM.replace(",0.1,", ",1.0D-01,"),
    "keys after VARS": ASTM.replace("R,G,B\n", "R,G,B\nOPERATOR Jane 2\n"),
    "VARS that forget phi_s": ASTM.replace("theta_s,phi_s", "theta_s"),
    "names in words": ASTM.replace("R,G,B", "Red BRDF,Green BRDF,Blue BRDF"),
}


@pytest.mark.parametrize("name", SAME_AS_ASTM)
def test_astm_text_with(tmp_path, name):
    plain, same = read(tmp_path, ASTM), read(tmp_path, SAME_AS_ASTM[name])
    assert same.format == "ASTM E1392 text" and same.channels == plain.channels
    np.testing.assert_allclose(same.brdf, plain.brdf)
    np.testing.assert_allclose(same.geom.tan2_h, plain.geom.tan2_h)


def test_astm_cells_may_be_empty_where_colours_share_no_direction(tmp_path):
    measurement = read(tmp_path, containers.astm().replace(",0.2,0.3", ",,0.3").replace(",0.4,0.5", ",,0.5"))
    np.testing.assert_array_equal(np.isfinite(measurement.brdf), [[True, False, True], [False, True, True]])


def test_astm_in_degrees_without_a_word_about_it(tmp_path):
    rows = ((30.0, 0.0, 40.0, 180.0, 0.1, 0.1, 0.1), (60.0, 0.0, 50.0, 170.0, 0.2, 0.2, 0.2))
    measurement = read(
        tmp_path,
        containers.astm(rows=rows).replace("NUM_POINTS", "WAVELENGTH 0.6328\nNUM_POINTS").replace("R,G,B", "a,brdf,b"),
    )
    np.testing.assert_allclose(measurement.geom.theta_r_deg[:, 0], [40, 50])
    assert measurement.geom.wavelength[0] == pytest.approx(0.6328)


FRED = containers.fred()
SAME_AS_FRED = {
    "tabs": FRED.replace(" 0 ", "\t0\t"),
    "capitals": FRED.upper(),
    "a byte order mark": "\ufeff" + FRED,
    "old Windows lines": FRED.replace("\n", "\r\n"),
    "blanks about the signs": FRED.replace("=", " = "),
    "commas": FRED.replace("deg bsdf", "deg, bsdf").replace("20 0 0.5", "20, 0, 0.5"),
    "a title and comments": "'a title\n! made up\n" + FRED.replace("50 0\n", "// next\n50 0 ! again\n"),
    "Fortran's exponents": FRED.replace("0.05", "5.0D-02"),
}


@pytest.mark.parametrize("name", SAME_AS_FRED)
def test_fred_text_with(tmp_path, name):
    plain, same = read(tmp_path, FRED), read(tmp_path, SAME_AS_FRED[name])
    assert same.format == "FRED text"
    np.testing.assert_allclose(same.brdf, plain.brdf)
    np.testing.assert_allclose(same.geom.tan2_h, plain.geom.tan2_h)


ZEMAX = containers.zemax()
SAME_AS_ZEMAX = {
    "a byte order mark and old Windows lines": "\ufeff" + ZEMAX.replace("\n", "\r\n"),
    "small letters": ZEMAX.replace("Data", "data").replace("TIS", "tis"),
    "colons": ZEMAX.replace("TIS ", "TIS: "),
    "decimal commas": ZEMAX.replace(".", ","),
    "no DataEnd": ZEMAX.replace("DataEnd\n", ""),
    "no rotation": ZEMAX.replace("SampleRotation 1\n0\n", ""),
    "numbers between commas": ZEMAX.replace("0.3 0.2 0.1", "0.3, 0.2, 0.1"),
}


@pytest.mark.parametrize("name", SAME_AS_ZEMAX)
def test_zemax_text_with(tmp_path, name):
    plain, same = read(tmp_path, ZEMAX), read(tmp_path, SAME_AS_ZEMAX[name])
    np.testing.assert_allclose(same.brdf, plain.brdf)
    np.testing.assert_allclose(same.geom.tan2_h, plain.geom.tan2_h)


def test_openmaterial_with_a_description_longer_than_the_readers_look(tmp_path):
    document = containers.openmaterial().replace('"made up"', '"' + 70_000 * "long " + '"')
    np.testing.assert_array_equal(read(tmp_path, document).brdf, read(tmp_path, containers.openmaterial()).brdf)
    with pytest.raises(InputError, match="no rows under brdf.lookupTable"):
        read(tmp_path, '{"asset": 1}')


def test_openmaterial_rows_become_channels(tmp_path):
    measurement = read(tmp_path, containers.openmaterial(), "paint.json")
    assert measurement.channels == ("550nm", "905nm") and set(measurement.theta_i_groups) == {0.0, 30.0}
    np.testing.assert_allclose(measurement.brdf[:, 0], measurement.brdf[:, 1])
    with pytest.raises(InputError, match=r"lookupTable row 1: found \[1, 2\], wanted \[wavelength, theta_i"):
        read(tmp_path, '{"brdf": {"lookupTable": [[1, 2]]}}')

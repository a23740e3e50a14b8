"""What an examination notices about surfaces and values, on made-up runs where the truth is known, and on real ones."""

import json
from dataclasses import replace

import numpy as np
import pytest
from typer.testing import CliRunner

from brdfguide import models
from brdfguide.cli._app import build
from brdfguide.data import examine, formats, reciprocity, reflectance
from brdfguide.data import noise as smoothness
from brdfguide.data.measurement import Measurement, row_median
from brdfguide.errors import InputError, NoAnswer
from brdfguide.models.candidates import as_metal
from brdfguide.physics.geometry import Geometry, rows

from .. import synthetic
from ..surfaces import SURFACES, dome_run, geometry, in_plane_run, table


def dome(name, seed=1, noise=0.01) -> Measurement:
    theta_i, theta_r, phi, f = dome_run(name, seed, noise)
    return Measurement(geometry(theta_i, theta_r, phi), f[:, None], name=name)


def plane(name, seed=1, noise=0.01) -> Measurement:
    theta_i, theta_r, f = in_plane_run(name, seed, noise)
    return Measurement(geometry(theta_i, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)), f[:, None], name=name)


def codes(measurement):
    return {finding.code: finding for finding in examine.examine(measurement)}


def with_values(measurement, mask, value):
    return replace(measurement, brdf=np.where(mask[:, None], value, measurement.brdf))


@pytest.mark.parametrize("noise", [0.003, 0.01, 0.03, 0.1])
@pytest.mark.parametrize("run", [dome, plane], ids=["dome", "plane"])
def test_noise_is_estimated_from_neighbours(run, noise):
    assert examine.noise(run("white paint", 3, noise)) == pytest.approx(noise, rel=0.4, abs=0.004)


@pytest.mark.parametrize("name", SURFACES)
def test_spike_at_the_mirror_direction_is_found_and_left_out(name):
    clean = plane(name)
    mirror = clean.geom.mirror_distance2[:, 0] < 1e-6
    spiked = with_values(clean, mirror, 3000.0)
    np.testing.assert_array_equal(examine.spikes(spiked), mirror)
    assert not np.any(examine.spikes(clean))
    prepared = examine.prepared(spiked)
    assert not np.any(prepared.usable[mirror]) and np.all(prepared.usable[~mirror])
    assert np.all(examine.prepared(spiked, anyway=True).usable[mirror])


def test_a_narrow_lobe_that_is_resolved_is_no_spike():
    theta_r = np.arange(20.0, 60.1, 0.5)
    geom = rows(Geometry.from_degrees(40.0, 0.0, theta_r, 180.0))
    lobe = 0.1 + 200 * np.exp(-(((theta_r - 40) / 1.5) ** 2))
    assert not np.any(examine.spikes(Measurement(geom, lobe[:, None])))


def test_spikes_of_the_real_clearcoat_are_found(data):
    measurement = formats.read(data / "cornell" / "cayman.brdf")
    found = np.flatnonzero(examine.spikes(measurement))
    distance = np.degrees(np.sqrt(measurement.geom.mirror_distance2[found, 0]))
    assert 4 <= len(found) <= 8 and distance.max() < 2.5
    assert not np.any(examine.spikes(formats.read(data / "cornell" / "garnet_red.brdf")))


@pytest.mark.parametrize("name", SURFACES)
def test_scan_cut_off_at_grazing_is_found_and_left_out(name):
    clean = plane(name)
    cut = (clean.geom.theta_r_deg[:, 0] > 79) & (clean.geom.mirror_distance2[:, 0] > 0.1)
    dark = replace(clean, brdf=np.where(cut[:, None], 0.01 * clean.brdf, clean.brdf))
    assert codes(dark)["dark-edge"].severity == "warning" and "dark-edge" not in codes(clean)
    np.testing.assert_array_equal(examine.prepared(dark).usable[:, 0], ~cut)


def test_retro_lobe_is_outside_the_guide():
    clean = dome("satin plastic")
    source = np.degrees(np.arccos(np.clip(clean.geom.dot_xy + clean.geom.cos_i * clean.geom.cos_r, -1, 1)))
    tape = replace(clean, brdf=0.1 * clean.brdf + 8 * np.exp(-((source / 4) ** 2)))
    assert codes(tape)["retro-reflector"].severity == "outside"
    with pytest.raises(NoAnswer, match="a retro-reflector; no model of the guide has such a lobe; --anyway"):
        examine.prepared(tape)
    assert "retro-reflector" in {finding.code for finding in examine.prepared(tape, anyway=True).findings}


def test_an_opposition_peak_is_a_doubt_only():
    clean = dome("satin plastic")
    source = np.degrees(np.arccos(np.clip(clean.geom.dot_xy + clean.geom.cos_i * clean.geom.cos_r, -1, 1)))
    dusty = replace(clean, brdf=clean.brdf * (1 + 1.2 * np.exp(-((source / 6) ** 2))))
    assert codes(dusty)["retro-peak"].severity == "warning"


@pytest.mark.parametrize("strength", [0.0, 0.8])
def test_anisotropy_is_told_by_turning_the_sample(strength):
    theta_i, theta_r, phi, f = dome_run("bead-blasted steel", seed=5)
    turn = np.repeat([0.0, 45.0, 90.0], len(f))
    brush = 1 + strength * np.cos(np.radians(2 * turn))
    geom = rows(Geometry.from_degrees(np.tile(theta_i, 3), turn, np.tile(theta_r, 3), np.tile(phi, 3) + turn))
    found = codes(Measurement(geom, (np.tile(f, 3) * brush)[:, None]))
    if strength:
        assert (
            found["anisotropic"].severity == "warning"
            and dict(found["anisotropic"].numbers)["rms_ln_over_rotation"] > 0.5
        )
    else:
        assert "isotropic" in found and "anisotropic" not in found


def test_one_rotation_cannot_tell_anisotropy():
    assert "rotation-untold" in codes(plane("rough gold"))


def test_the_largest_angle_is_named():
    measurement = plane("plaster")
    near = (measurement.geom.theta_i_deg[:, 0] <= 45) & (measurement.geom.theta_r_deg[:, 0] <= 60)
    found = codes(measurement[near])
    assert found["no-data-beyond-theta-i"].text.startswith("no data beyond theta_i = 45 degrees: models will differ")
    assert dict(found["no-data-beyond-theta-r"].numbers)["largest_deg"] == 60


def test_saturated_detector_is_noticed():
    measurement = plane("satin plastic")
    limit = float(np.quantile(measurement.brdf, 0.95))
    assert "saturated" in codes(replace(measurement, brdf=np.minimum(measurement.brdf, limit)))


def test_impossible_brightness_is_refused_unless_forced():
    bright = replace(dome("plaster"), brdf=40 * dome("plaster").brdf)
    with pytest.raises(
        InputError, match="more light than came in; --quantity reflectance-factor, or --anyway overrides this"
    ):
        examine.corrected(bright)
    np.testing.assert_array_equal(examine.corrected(bright, anyway=True).brdf, bright.brdf)


@pytest.mark.parametrize("albedo", [0.2, 0.9])
def test_hemispherical_reflectance_of_a_white_surface_seen_in_two_ways(albedo):
    theta_i, theta_r, phi, _ = dome_run("plaster", seed=1)
    flat = Measurement(geometry(theta_i, theta_r, phi), np.full((len(theta_i), 1), albedo / np.pi))
    seen = albedo * np.sin(np.radians(80)) ** 2
    for measurement in (flat, flat[flat.geom.off_plane_deg[:, 0] < 0.1]):
        np.testing.assert_allclose(reflectance.measured_reflectance(measurement).values, seen, rtol=0.01)


def test_white_paper_and_sintered_white_return_their_light(data):
    white = reflectance.measured_reflectance(formats.read(data / "nist" / "PTFE.data.csv"))
    assert min(white.values) > 0.92 and max(white.values) < 1.0
    paper = reflectance.measured_reflectance(formats.read(data / "rgl" / "paper_white_rgb.bsdf"))
    assert min(paper.values) > 0.85 and max(paper.values) < 1.0


REAL = {
    "cornell/garnet_red.brdf": {"dark-level"},
    "cornell/cayman.brdf": {"dark-level", "missing-values", "spikes"},
    "nist/PTFE.data.csv": set(),
    "starlink/chassis_brdf.csv": {"dark-edge"},
    "starlink/aluminum_brdf.csv": set(),
    "mwir/steel_sandblasted.csv": set(),
    "mwir/copper.csv": {"height-against-width"},  # rolled, in one azimuth
    "mwir/lacquer_smooth.csv": {"not-reciprocal"},
    "rgl/paper_white_rgb.bsdf": set(),
    "zemax/test_13_planesymmetric_brdf_zemax.bsdf": set(),
    "ua_loft/AnoBlackEC1onAlum.txt": {"no-data-beyond-theta-i"},
    "alta/retro-3M-jaune.dat": {"no-data-beyond-theta-i", "retro-reflector"},
}


@pytest.mark.parametrize("name", REAL)
def test_doubts_about_real_files(data, name):
    found = examine.examine(formats.read(data / name))
    assert {finding.code for finding in found if finding.severity != "note"} == REAL[name]


@pytest.mark.parametrize("name", [name for name in REAL if "alta" not in name and "cornell" not in name])
def test_real_files_are_left_as_they_are(data, name):
    measurement = formats.read(data / name)
    np.testing.assert_array_equal(examine.corrected(measurement).brdf, measurement.brdf)


def test_inspect_prints_one_json_object_and_draws(tmp_path):
    path, picture = tmp_path / "run.csv", tmp_path / "run.png"
    theta_i, theta_r, phi, f = dome_run("white paint", seed=1)
    path.write_text(table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, np.pi * f))
    result = CliRunner().invoke(build(["inspect"]), ["inspect", str(path), "--json", "--plot", str(picture)])
    assert result.exit_code == 0, result.output
    document = json.loads(result.stdout)
    assert document["schema"] == "brdfguide/inspect/1" and document["data"]["samples"] == len(f)
    assert {"coverage", "reciprocity", "energy", "findings", "corrections", "status"} <= document.keys()
    assert [each["code"] for each in document["corrections"]] == ["reflectance-factor"]
    assert document["coverage"]["by_theta_i"][0]["directions"] == 119
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 20000
    text = CliRunner().invoke(build(["inspect"]), ["inspect", str(path)]).stdout
    assert "reflectance-factor" in text and text.startswith("usable, with 1 doubt;")
    assert max(map(len, text.splitlines()[5:11])) < 100


def test_fit_refuses_a_retro_reflector_with_status_1(data):
    result = CliRunner().invoke(
        build(["fit"]), ["fit", str(data / "alta" / "retro-3M-jaune.dat"), "-m", "lambertian+ggx"]
    )
    assert isinstance(result.exception, NoAnswer)


def beckmann_metal(alpha, k):
    model = as_metal(models.get("beckmann"))
    geom = geometry(
        *(
            a.ravel()
            for a in np.meshgrid(
                [0.0, 20.0, 40.0, 60.0, 75.0], np.r_[0.0:81.0:5.0], np.arange(0.0, 181.0, 30.0), indexing="ij"
            )
        )
    )
    return synthetic.surface(
        model, geom, {**model.defaults(), "beckmann.alpha": alpha, "beckmann.k": k}, noise=0.02, seed=17
    )


@pytest.mark.parametrize("alpha", [0.107, 0.144, 0.236, 0.48])
def test_a_lobe_that_dies_out_has_no_dark_edge(alpha):
    assert not np.any(smoothness.dark_edges(beckmann_metal(alpha, 5.5)))


@pytest.mark.parametrize("alpha", [0.03, 0.043, 0.06])
def test_a_lobe_between_two_steps_of_the_scan_is_not_called_too_bright(alpha):
    found = {finding.code for finding in examine.examine(beckmann_metal(alpha, 7.4))}
    assert not found & {"reflectance-factor", "too-bright"}


def test_of_a_whole_table_nothing_is_left_out(data):
    table = formats.read(data / "merl_format" / "alum-bronze.binary.xz")
    found = examine.examine(table)
    assert not {finding.code for finding in found} & {"spikes", "dark-edge"}
    assert (
        next(dict(finding.numbers)["relative"] for finding in found if finding.code == "noise") < 0.01
    )  # a network's output


# --- what the tests of a file are made of -----------------------------------------------------------


@pytest.mark.parametrize("channels", [1, 2, 3, 4, 7])
def test_median_over_channels_is_numpys_with_seed_0(channels):
    values = np.random.default_rng(0).normal(size=(400, channels))
    values[np.random.default_rng(1).random(values.shape) < 0.4] = np.nan
    some = np.any(np.isfinite(values), axis=1)
    np.testing.assert_array_equal(row_median(values)[some], np.nanmedian(values[some], axis=1))
    assert np.all(np.isnan(row_median(values)[~some]))


@pytest.mark.parametrize("spread", [90.0, 8.0, 0.0], ids=["hemisphere", "few incidences", "one incidence"])
def test_the_nearest_direction_is_the_nearest_of_all_with_seed_2(spread):
    random = np.random.default_rng(2)

    def scattered(count):
        return rows(
            Geometry.from_degrees(
                np.minimum(40 + spread * (random.random(count) - 0.5), 89),
                0.0,
                random.uniform(0, 89, count),
                random.uniform(0, 360, count),
            )
        )

    among, points = (reciprocity._places(scattered(count)) for count in (900, 150))
    index, distance = reciprocity._nearest(points, among)
    apart = np.sqrt(np.sum((points[:, None] - among[None]) ** 2, axis=2))
    np.testing.assert_allclose(distance, apart.min(axis=1), atol=1e-3)  # found in single precision
    np.testing.assert_allclose(distance, apart[np.arange(150), index], rtol=1e-12)
    own = np.arange(150)
    index, distance = reciprocity._nearest(among[own], among, own)
    apart = np.sqrt(np.sum((among[own][:, None] - among[None]) ** 2, axis=2))
    apart[own, own] = np.inf
    np.testing.assert_allclose(distance, apart.min(axis=1), atol=1e-3)
    assert np.all(index != own)


def test_spikes_and_scans_are_found_once_for_each_measurement():
    measurement = plane("white paint", 3, 0.01)
    assert smoothness.spikes(measurement) is smoothness.spikes(measurement)
    assert smoothness._scans(measurement.geom) is smoothness._scans(measurement.noting().geom)
    assert smoothness.spikes(measurement) is not smoothness.spikes(measurement[np.arange(len(measurement.brdf))])


@pytest.mark.parametrize(
    "quantity, settled", [("brdf-cos", "cosine"), ("brdf-cos-i", "cosine"), ("reflectance-factor", "scale")]
)
def test_what_was_undone_is_settled_whatever_its_code(quantity, settled):
    """A finding says itself what is wrong and what it settles: its code is for people and programs."""
    clean = dome("white paint")
    factor = {"brdf-cos": clean.geom.cos_r, "brdf-cos-i": clean.geom.cos_i, "reflectance-factor": np.pi}[quantity]
    wrong = replace(clean, brdf=clean.brdf * factor)
    undone = [finding.undo for finding in examine.examine(wrong) if finding.undo]
    right = examine.corrected(wrong)
    assert undone == [quantity] and not wrong.settled(settled) and right.settled(settled)
    np.testing.assert_allclose(right.brdf, clean.brdf, rtol=1e-12)
    assert not [finding for finding in examine.examine(right) if finding.undo]


def test_what_an_option_states_is_not_asked_again(tmp_path):
    theta_i, theta_r, phi, f = dome_run("white paint", 1, 0.01)
    path = tmp_path / "run.csv"
    path.write_text(table(("theta_i", "theta_r", "phi_r", "brdf"), theta_i, theta_r, phi, np.pi * f))
    stated = formats.read(path, quantity="brdf")
    assert stated.settled("scale") and stated.settled("cosine") and not stated.settled("rotation")
    assert "reflectance-factor" not in codes(stated) and "reflectance-factor" in codes(formats.read(path))

"""Each fault is named with its consequence, or changes less than is printed; the gross ones are always named."""

import numpy as np
import pytest
from scipy.ndimage import gaussian_filter

from brdfguide import fit
from brdfguide.data import examine, formats
from brdfguide.errors import InputError

from .pictures import lamp_at, srgb


def codes(path):
    return {finding.code for finding in formats.read(path).findings}


def ball(size=160, centre=80.0, radius=72.0):
    """Normals' x, y (up), z and where the ball is."""
    y, x = np.mgrid[0:size, 0:size] + 0.5
    x, y = (x - centre) / radius, (centre - y) / radius
    inside = x * x + y * y < 1
    return x, y, np.sqrt(np.where(inside, 1 - x * x - y * y, 0.0)), inside


def test_nothing_is_wrong_with_good_pictures(shots):
    found = formats.read(shots()).findings
    assert {each.code for each in found if each.severity != "note"} == set()
    assert {"lamp-found", "outline-found", "broad-band"} <= {each.code for each in found}


def test_one_picture_is_one_difference_angle(shots):
    assert "one-difference-angle" in codes(shots(phases=(40,)))


@pytest.mark.parametrize("exponent", [0.45, 0.8, 1.1, 2.2])
def test_a_tone_curve_is_refused_unless_anyway(shots, exponent):
    path = shots(lambda light, phase: light**exponent)
    measurement = formats.read(path)
    assert "gamma" in {each.code for each in measurement.findings}
    with pytest.raises(InputError, match="the power .* of the light.*--anyway overrides"):
        examine.prepared(measurement)
    examine.prepared(measurement, anyway=True)


def test_display_codes_taken_for_light_are_told_apart_from_light(shots):
    path = shots(lambda light, phase: srgb(light / 12))
    with pytest.raises(InputError, match="say transfer: srgb"):
        examine.prepared(formats.read(path))


@pytest.mark.parametrize("level", [1.05, 1.4])
def test_a_highlight_that_was_cut_off_is_left_out(shots, level):
    path = shots(lambda light, phase: np.minimum(light, level))
    assert "clipped" in codes(path)
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["ggx.alpha"]["value"] == pytest.approx(0.15, rel=0.01)


def test_a_lamp_that_is_not_where_it_is_said_to_be(shots):
    assert "lamp-disagrees" in codes(shots(lamp=lambda phase: lamp_at(phase + 2)))
    assert "lamp-disagrees" in codes(shots(lamp=lambda phase: lamp_at(phase, 0, 1e6)))
    assert "lamp-disagrees" not in codes(shots(lamp=lamp_at))


def test_an_outline_that_is_wrong(shots):
    head = "camera: {distance: 24}\nreference_albedo: 0.9\noutline: {centre_px: [84, 80], radius_px: 72}"
    assert "outline-differs" in codes(shots(head=head))
    assert "outline-differs" not in codes(shots(head=head.replace("84", "80")))


def test_a_second_lamp_and_stray_light(shots):
    x, y, z, inside = ball()
    other = np.where(inside, np.maximum(-0.2 * x + 0.6 * y + 0.77 * z, 0), 0)[..., None]
    assert codes(shots(lambda light, phase: light + 0.2 * other)) & {"second-lamp", "stray"}
    assert "stray" in codes(shots(lambda light, phase: light + 0.01))


def test_light_from_the_table(shots):
    _, y, _, inside = ball()
    bounced = np.where(inside, (1 - y) / 2, 0)[..., None]
    assert "interreflection" in codes(shots(lambda light, phase: light + 0.06 * bounced, phases=(40,)))


def test_a_far_camera_is_a_doubt(shots):
    assert "camera-far" in codes(shots(head="camera: far\nreference_albedo: 0.9"))


def test_a_large_lamp_and_too_small_a_ball(shots):
    head = "camera: {distance: 24}\nreference_albedo: 0.9\nlamp_half_deg: 6"
    assert "lamp-size" in codes(shots(head=head))
    assert "lamp-size" not in codes(shots(head=head.replace("6", "1")))


def test_lone_bright_pixels_and_pixels_without_light(shots):
    def damaged(light, phase):
        light = light.copy()
        light[60, 90] *= 4
        light[100, 95:98] = np.nan
        light[101, 95] = -1
        return light

    found = codes(shots(damaged))
    assert {"hot-pixels", "bad-pixels"} <= found


def test_flakes_are_told_as_scatter(shots):
    draw = np.random.default_rng(7)
    path = shots(lambda light, phase: light * np.exp(0.3 * draw.standard_normal((*light.shape[:2], 1))))
    assert "sparkle" in codes(path)


def test_without_a_reference_no_level_is_known(shots, tmp_path):
    from .pictures import describe

    shots()
    path = describe(tmp_path, [(f"paint_{p}.tif", None, lamp_at(p)) for p in (40, 110)], head="camera: {distance: 24}")
    assert "level-unknown" in codes(path)


def test_a_patch_beside_the_ball_tells_the_level(shots, tmp_path):
    from .pictures import describe

    def with_patch(light, phase):  # a matt patch of albedo 0.19 that faces the lamp: pi f times the lamp's light
        light = light.copy()
        light[2:8, 2:8] = 0.19
        return light

    def described(patch):
        rows = [(f"paint_{p}.tif", None, f"[{', '.join(map(str, lamp_at(p)))}], chart_px: {patch}") for p in (40, 110)]
        return describe(tmp_path, rows, head="camera: {distance: 24}\nchart_albedo: 0.19")

    shots(with_patch)
    path = described([3, 3, 4, 4])
    assert "level-unknown" not in codes(path)
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["lambertian.albedo"]["value"] == pytest.approx([0.3, 0.2, 0.1], rel=0.01)
    assert row["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.02)
    with pytest.raises(InputError, match="chart_px holds no light"):
        codes(described([150, 2, 6, 6]))
    with pytest.raises(InputError, match="chart_px lies outside"):
        codes(described([158, 2, 6, 6]))


SMALL = {
    "sharp": {},
    "blurred by 0.7 px": {"change": lambda light, phase: gaussian_filter(light, (0.7, 0.7, 0))},
    "blurred by 1.5 px": {"change": lambda light, phase: gaussian_filter(light, (1.5, 1.5, 0))},
    "a veil": {"change": lambda light, phase: light + 0.003},
    "lamps half a degree off": {"lamp": lambda phase: lamp_at(phase + 0.5)},
    "a centre 0.8 px off": {
        "head": "camera: {distance: 24}\nreference_albedo: 0.9\noutline: {centre_px: [80.8, 80], radius_px: 72}"
    },
}


@pytest.mark.parametrize("fault", SMALL)
def test_what_is_not_noticed_moves_nothing_beyond_what_is_printed(shots, fault):
    path = shots(**SMALL[fault])
    assert not {each.code for each in formats.read(path).findings if each.severity != "note"}
    row = fit(path, models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    truths = {"ggx.alpha": 0.15, "ggx.n": [1.5] * 3, "lambertian.albedo": [0.3, 0.2, 0.1]}
    for key, truth in truths.items():
        printed = 1.96 * np.ravel(row[key]["stderr"])
        assert np.all(np.abs(np.ravel(row[key]["value"]) - truth) <= printed)
        assert np.all(printed <= 0.1 * np.ravel(truth))


def test_a_lamp_of_unknown_size_is_a_point(shots):
    assert "lamp-point" in codes(shots())
    head = "camera: {distance: 24}\nreference_albedo: 0.9\nlamp_half_deg: 0.3"
    assert not {"lamp-point", "lamp-size"} & codes(shots(head=head))


def test_noise_moves_nothing_beyond_what_is_printed(shots):
    draw = np.random.default_rng(3)

    def noisy(light, phase):
        return light * (1 + 0.01 * draw.standard_normal(light.shape)) + 1e-4 * draw.standard_normal(light.shape)

    row = fit(shots(noisy), models=["lambertian+ggx"]).document["ranking"][0]["parameters"]
    assert row["ggx.alpha"]["value"] == pytest.approx(0.15, rel=0.01)
    assert row["ggx.n"]["value"] == pytest.approx([1.5] * 3, abs=0.01)

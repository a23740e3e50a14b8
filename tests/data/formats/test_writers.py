"""What is written is read back: the directions to a hundred-thousandth of a degree, the values to nine digits."""

import re

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.data.measurement import Measurement
from brdfguide.errors import InputError
from brdfguide.physics.geometry import Geometry, rows

from ...conftest import ROOT

MODEL = models.get("lambertian+ggx")
VALUES = {"lambertian.albedo": 0.2, "ggx.alpha": 0.25, "ggx.n": 1.5}
TARGETS = formats.writers()
GRIDS = ("zemax", "lighttools", "speos", "speos-anisotropic")  # that hold tables of incidences, azimuths and angles
ONE_CHANNEL = ("zemax", "fred", "lighttools", "speos-anisotropic")
EXAMPLES = sorted((ROOT / "examples").glob("*.csv"))


def of(geom: Geometry, channels=("550nm",), um=(0.55,)) -> Measurement:
    geom = rows(geom).at(np.array(um))
    share = np.linspace(1.0, 0.5, len(channels))
    return Measurement(geom, np.asarray(MODEL(geom, VALUES)) * share, tuple(channels), name="made up", format="table")


def in_plane() -> Geometry:
    theta_i, theta_r = (a.ravel() for a in np.meshgrid([10.0, 30, 50, 70], np.arange(-80.0, 81, 7.5), indexing="ij"))
    return rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))


def hemisphere(phi_i=(0.0,)) -> Geometry:
    grid = np.meshgrid([10.0, 40, 70], phi_i, np.arange(0.0, 86, 15), np.arange(0.0, 181, 30), indexing="ij")
    theta_i, light, theta_r, phi = (each.ravel() for each in grid)
    once = (theta_r > 0) | (phi == 0)
    return rows(Geometry.from_degrees(theta_i[once], light[once], theta_r[once], (light + phi)[once]))


def back(tmp_path, target: str, measurement: Measurement) -> Measurement:
    text, _ = formats.write(target, measurement)
    path = tmp_path / f"{target}.txt"
    path.write_text(text)
    return formats.read(path)


def vectors(geom: Geometry) -> np.ndarray:
    """Both directions in the frame of the light (samples, 4): what does not depend on where azimuths count from."""
    phi = np.radians(geom.phi_deg)
    across = np.abs(geom.sin_r * np.sin(phi))  # a plane of symmetry
    return np.concatenate([geom.sin_i, geom.sin_r * np.cos(phi), across, geom.cos_r], axis=1)


def check(read: Measurement, written: Measurement, rtol=6e-9) -> None:
    """Every value that was written stands at its direction."""
    there, wanted = vectors(read.geom), vectors(written.geom)
    for place in np.flatnonzero(np.all(written.brdf > 0, axis=1)):
        at = int(np.argmin(np.sum((there - wanted[place]) ** 2, axis=1)))
        np.testing.assert_allclose(there[at], wanted[place], atol=3e-6)
        np.testing.assert_allclose(read.brdf[at], written.brdf[place], rtol=rtol)


@pytest.mark.parametrize("target", TARGETS)
def test_a_scan_in_the_plane_of_incidence_comes_back(tmp_path, target):
    written = of(in_plane())
    read = back(tmp_path, target, written)
    check(read, written)
    assert read.geom.wavelength == pytest.approx(0.55) and read.settled("side") == read.settled("side")
    assert not [finding for finding in read.findings if finding.code == "wavelength-assumed"]


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_our_examples_go_through_every_format(tmp_path, target, path):
    written = formats.read(path)
    if target in ONE_CHANNEL and len(written.channels) > 1:
        with pytest.raises(InputError, match="file holds one channel, there are .* choose one with --wavelength NM"):
            formats.write(target, written)
        written = written.of_channels([0])
    check(back(tmp_path, target, written), written)


@pytest.mark.parametrize("target", [target for target in TARGETS if target not in ONE_CHANNEL])
def test_channels_come_back_with_their_wavelengths(tmp_path, target):
    written = of(in_plane(), ("450nm", "633nm"), (0.45, 0.633))
    read = back(tmp_path, target, written)
    assert read.channels == written.channels
    check(read, written)


@pytest.mark.parametrize("target", TARGETS)
def test_a_hemisphere_comes_back(tmp_path, target):
    """About the mirror direction these lie on a grid only by chance: refused there, with what takes them."""
    written = of(hemisphere())
    if target == "zemax":
        written = of(formats.read(zemax_of(tmp_path)).geom)
    check(back(tmp_path, target, written), written)


def zemax_of(tmp_path):
    nodes = {"SampleRotation": [0], "AngleOfIncidence": [0, 20, 60], "ScatterAzimuth": range(0, 181, 30)}
    lists = "".join(f"{key} {len(each)}\n{' '.join(map(str, each))}\n" for key, each in nodes.items())
    block = "TIS 0.1\n" + ("0.1 " * 8 + "\n") * 7
    path = tmp_path / "grid.bsdf"
    path.write_text(f"{lists}ScatterRadial 8\n0 5 10 20 35 50 65 80\nDataBegin\n{block * 3}DataEnd\n")
    return path


def test_directions_on_no_grid_are_refused_with_what_takes_them(tmp_path):
    draw = np.random.default_rng(1)
    written = of(Geometry.from_degrees(*draw.uniform((0, 0, 0, 0), (80, 0, 80, 360), (400, 4)).T))
    for target in GRIDS:
        with pytest.raises(InputError, match="400 directions lie on no grid .* convert to fred, astm, tracepro or csv"):
            formats.write(target, written)
    for target in ("fred", "astm", "tracepro", "csv"):
        check(back(tmp_path, target, written), written)


@pytest.mark.parametrize("target", ["zemax", "fred", "astm", "tracepro", "csv"])
def test_rotations_of_the_sample_are_kept(tmp_path, target):
    geom = formats.read(zemax_of(tmp_path)).geom if target == "zemax" else hemisphere()
    turned = [Geometry.from_degrees(geom.theta_i_deg, phi, geom.theta_r_deg, phi + geom.phi_deg) for phi in (0.0, 90.0)]
    parts = [of(each) for each in turned]
    joined = Geometry.from_degrees(
        *(
            np.concatenate([getattr(each.geom, name) for each in parts])
            for name in ("theta_i_deg", "phi_i_deg", "theta_r_deg")
        ),
        np.concatenate([each.geom.phi_i_deg + each.geom.phi_deg for each in parts]),
    )
    values = np.concatenate([parts[0].brdf, 2 * parts[1].brdf])
    written = Measurement(rows(joined).at(np.array([0.55])), values, ("550nm",), name="made up", format="table")
    read = back(tmp_path, target, written)
    tilted = read.geom.theta_i_deg[:, 0] > 1
    for phi, part, share in ((0, parts[0], 1.0), (90, parts[1], 2.0)):
        here = tilted & (np.abs(np.remainder(read.geom.phi_i_deg[:, 0] - phi + 1, 360.0) - 1) < 0.1)
        truth = np.asarray(MODEL(read.geom[here], VALUES)) * share
        np.testing.assert_allclose(read.brdf[here], truth, rtol=1e-4)
        assert np.count_nonzero(here) >= np.count_nonzero(part.geom.theta_i_deg > 1)
    for grid in ("lighttools", "speos") if target == "fred" else ():
        with pytest.raises(InputError, match="one rotation of the sample, there are 2"):
            formats.write(grid, written)


def test_a_total_is_that_of_the_surface():
    """A body of reflectance 0.2, whose total at every incidence is known."""
    grid = np.meshgrid([0.0, 30, 60], np.arange(0.0, 90, 5), np.arange(0.0, 181, 15), indexing="ij")
    theta_i, theta_r, phi = (each.ravel() for each in grid)
    body = Measurement(
        rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi)).at(np.array([0.55])),
        np.full((len(phi), 1), 0.2 / np.pi),
        name="body",
        format="table",
    )
    text, _ = formats.write("lighttools", body)
    totals = [float(each) for each in re.findall(r"TIS (\S+)", text)]
    assert totals == pytest.approx([0.2] * 3, rel=0.01)
    text, _ = formats.write("speos", body)
    assert float(text.splitlines()[10]) == pytest.approx(20.0, rel=0.01)


@pytest.mark.parametrize("target", GRIDS)
def test_a_file_says_what_it_interpolated_and_missing_values_stay_missing(tmp_path, target):
    written = of(in_plane())
    brdf = written.brdf.copy()
    brdf[5] = np.nan
    text, notes = formats.write(target, Measurement(written.geom, brdf, written.channels, name="gap", format="table"))
    assert any("only the plane of incidence was measured" in note for note in notes)
    read = back(tmp_path, target, written)
    assert "tis-differs" not in {each.code for each in (*read.findings, *examine.examine(read))}


def test_fred_takes_positive_values_alone():
    written = of(in_plane())
    written.brdf[3] = -0.1
    _, notes = formats.write("fred", written)
    assert notes == ["1 directions without a positive value were left out: FRED takes no other"]
    with pytest.raises(InputError, match="no value is positive"):
        formats.write(
            "fred", Measurement(written.geom, 0 * written.brdf, written.channels, name="dark", format="table")
        )

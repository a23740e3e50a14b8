"""RGL tables: our evaluation against one written again, number by number, from the description; and the container's
errors.
"""

from itertools import pairwise
from math import atan2, floor, pi, sqrt

import numpy as np
import pytest

from brdfguide.data import examine, formats
from brdfguide.data.formats import _tensor, _warp, rgl
from brdfguide.data.formats.format import Source
from brdfguide.errors import InputError
from brdfguide.physics.geometry import Geometry, rows

from .containers import rgl_fields, tensor_file


def by_hand(fields, densities, light, view, channel):
    """The description followed literally for one pair of unit vectors; BRDF [1/sr]."""
    half = [a + b for a, b in zip(light, view, strict=True)]
    length = sqrt(sum(a * a for a in half))
    half = [a / length for a in half]

    def u(v):
        return sqrt(2 / pi * atan2(sqrt(v[0] ** 2 + v[1] ** 2), v[2]))

    def phi(v):
        return atan2(v[1], v[0])

    isotropic = len(fields["phi_i"]) <= 2
    y = ((phi(half) - phi(light) if isotropic else phi(half)) + pi) / (2 * pi)
    u_m, u_i = (u(half), y - floor(y)), (u(light), (phi(light) + pi) / (2 * pi))
    nodes = []
    for name, value in (("phi_i", phi(light)), ("theta_i", atan2(sqrt(light[0] ** 2 + light[1] ** 2), light[2]))):
        stored = [float(x) for x in fields[name]]
        if len(stored) == 1:
            nodes.append([(0, 1.0)])
            continue
        k = max(i for i in range(len(stored) - 1) if i == 0 or stored[i] <= value)
        t = min(max((value - stored[k]) / (stored[k + 1] - stored[k]), 0.0), 1.0)
        nodes.append([(k, 1 - t), (k + 1, t)])
    slices = [((p, t), wp * wt) for p, wp in nodes[0] for t, wt in nodes[1]]

    def bilinear(table, x, y):
        height, width = table.shape
        i, j = min(int(x * (width - 1)), width - 2), min(int(y * (height - 1)), height - 2)
        a, b = x * (width - 1) - i, y * (height - 1) - j
        return (
            (1 - a) * (1 - b) * table[j, i]
            + a * (1 - b) * table[j, i + 1]
            + (1 - a) * b * table[j + 1, i]
            + a * b * table[j + 1, i + 1]
        )

    density = sum(w * densities[p] for p, w in slices)
    s = pushed(density, *u_m)
    colour = sum(
        w * bilinear(fields["rgb" if "rgb" in fields else "spectra"][p][channel].astype(float), *s) for p, w in slices
    )
    return (
        max(colour, 0)
        * bilinear(fields["ndf"].astype(float), *u_m)
        / (4 * bilinear(fields["sigma"].astype(float), *u_i) * view[2])
    )


def normalised(table):
    """Over the integral of its bilinear interpolant, in cells."""
    table = table.astype(float)
    corners = 0.25 * (table[:-1, :-1] + table[1:, :-1] + table[:-1, 1:] + table[1:, 1:])
    return table / corners.sum()


def pushed(density, x, y):
    """Integrals of the bilinear interpolant of `density`: along the row at height y up to x, over the whole row; and of
    all rows up to y.
    """
    height, width = density.shape
    j = min(int(y * (height - 1)), height - 2)
    b = y * (height - 1) - j
    row = (1 - b) * density[j] + b * density[j + 1]
    i = min(int(x * (width - 1)), width - 2)
    a = x * (width - 1) - i
    part = sum(0.5 * (row[k] + row[k + 1]) for k in range(i)) + a * (row[i] + 0.5 * a * (row[i + 1] - row[i]))
    total = sum(0.5 * (row[k] + row[k + 1]) for k in range(width - 1))
    sums = [float(line.sum() - 0.5 * (line[0] + line[-1])) for line in density[: j + 2]]
    up = sum(0.5 * (sums[k] + sums[k + 1]) for k in range(j)) + b * (sums[j] + 0.5 * b * (sums[j + 1] - sums[j]))
    return part / total, up


def directions(seed, count):
    draw = np.random.default_rng(seed)
    vectors = draw.standard_normal((2, count, 3))
    vectors[..., 2] = np.abs(vectors[..., 2]) + 0.02
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def compare(fields, seed, count, rotation=None):
    """Largest relative departure of our evaluation from the one by hand."""
    lights, views = directions(seed, count)
    if rotation is not None:
        azimuth = np.arctan2(lights[:, 1], lights[:, 0])
        turn = rotation - azimuth

        def spin(v):
            return np.stack(
                [
                    np.cos(turn) * v[:, 0] - np.sin(turn) * v[:, 1],
                    np.sin(turn) * v[:, 0] + np.cos(turn) * v[:, 1],
                    v[:, 2],
                ],
                1,
            )

        lights, views = spin(lights), spin(views)
    geom = rows(Geometry.from_vectors(lights, views))
    ours = rgl.evaluate(fields, geom, 0.0 if rotation is None else np.degrees(rotation))
    channels = ours.shape[1]
    densities = {p: normalised(fields["vndf"][p]) for p in np.ndindex(fields["vndf"].shape[:2])}
    theirs = np.array(
        [
            [by_hand(fields, densities, light, view, c) for c in (0, channels - 1)]
            for light, view in zip(lights, views, strict=True)
        ]
    )
    scale = np.maximum(np.abs(theirs).max(axis=1, keepdims=True), 1e-9)
    return float(np.max(np.abs(ours[:, [0, channels - 1]] - theirs) / scale))


@pytest.mark.parametrize("name", ["paper_white", "cg_sunflower"])
def test_real_tables_agree_with_the_description_at_1000_directions_seed_5(data, name):
    path = data / "rgl" / f"{name}_rgb.bsdf"
    fields = _tensor.tensor_fields(Source(str(path), path.read_bytes()))
    assert compare(fields, 5, 1000) < 1e-6


@pytest.mark.parametrize("spectral", [False, True])
def test_made_up_tables_agree_with_the_description_seed_6(spectral):
    assert compare(rgl_fields(6, spectral=spectral), 6, 300) < 1e-9


def test_anisotropic_tables_agree_with_the_description_seed_7():
    fields = rgl_fields(7, phis=9)
    assert max(compare(fields, 7, 40, rotation) for rotation in (-2.0, -0.3, 0.0, 1.4)) < 1e-9


def test_white_paper_is_white(data):
    path = data / "rgl" / "paper_white_rgb.bsdf"
    fields = _tensor.tensor_fields(Source(str(path), path.read_bytes()))
    geom = rows(Geometry.from_degrees(0.01, 0.0, [0.5, 5.0], 180.0))
    np.testing.assert_allclose(rgl.evaluate(fields, geom)[:, :2], 0.27, rtol=0.05)


@pytest.mark.parametrize("name", ["paper_white", "cg_sunflower", "vch_golden_yellow", "cc_ibiza_sunset"])
def test_every_stored_value_above_the_horizon_is_a_direction(data, name):
    path = data / "rgl" / f"{name}_rgb.bsdf"
    fields, measurement = _tensor.tensor_fields(Source(str(path), path.read_bytes())), formats.read(path)
    numbers = next(finding.numbers for finding in measurement.findings if finding.code == "table")
    incidences, size = fields["theta_i"].size, fields["rgb"].shape[-1]
    # the seam of a turn is stored twice, and the mirror direction once in every row, but for rows of the closing
    # slice at 90 degrees
    assert 0 <= sum(dict(numbers).values()) - incidences * ((size - 1) * (size - 1) + 1) < size
    assert len(measurement.geom) == dict(numbers)["directions"] > 5500
    # the file marks what lies below the horizon by zeros
    stored = fields["rgb"][0, :-1, :, :-1].max(axis=1)
    assert abs(np.count_nonzero(stored > 0) / measurement.geom.shape[0] - 1) < 0.12


@pytest.mark.parametrize("spectral", [False, True])
def test_the_nodes_carry_what_the_description_gives_there_seed_6(tmp_path, spectral):
    fields = rgl_fields(6, spectral=spectral)
    path = tmp_path / "made_up.bsdf"
    path.write_bytes(tensor_file(**fields))
    measurement = formats.read(path)
    # along the normal the light has no azimuth to count from, and the mirror direction has the mean of many nodes
    clear = (measurement.geom.theta_i_deg[:, 0] > 0) & (measurement.geom.tan2_h[:, 0] > 1e-12)
    assert np.count_nonzero(clear) > 50
    np.testing.assert_allclose(measurement.brdf[clear], rgl.evaluate(fields, measurement.geom)[clear], rtol=1e-7)


def test_a_density_with_empty_rows_and_columns_has_an_inverse_seed_12():
    draw = np.random.default_rng(12)
    density = draw.uniform(0.2, 1.0, (9, 7))
    density[2:4], density[:, 3:5] = 0.0, 0.0
    u = _warp.pulled(density, (20, 30))
    slices = [((np.zeros(600, int), np.zeros(600, int)), np.ones(600))]
    s = _warp.pushed(density[None, None], slices, u.reshape(2, -1)).reshape(u.shape)
    np.testing.assert_allclose(s[0], np.broadcast_to(np.linspace(0, 1, 30), (20, 30)), atol=1e-12)
    np.testing.assert_allclose(s[1], np.broadcast_to(np.linspace(0, 1, 20)[:, None], (20, 30)), atol=1e-12)


def test_anisotropic_table_keeps_its_rotations_and_is_averaged_on_request(tmp_path):
    path = tmp_path / "brushed.bsdf"
    fields = rgl_fields(8, phis=9)
    path.write_bytes(tensor_file(**fields))
    whole = formats.read(path)
    assert {each.code for each in whole.findings} >= {"anisotropic", "table"}
    turns = np.unique(np.round(whole.geom.phi_i_deg, 4))
    np.testing.assert_allclose(turns, np.linspace(-180, 90, 7), atol=1e-3)  # eight rows of nodes, the last a seam
    for turn in (-180.0, 45.0):
        here = (np.abs(whole.geom.phi_i_deg[:, 0] - turn) < 1e-3) & (
            whole.geom.tan2_h[:, 0] > 1e-6
        )  # but the mean there
        want = rgl.evaluate(fields, whole.geom[here], turn)
        np.testing.assert_allclose(whole.brdf[here], want, rtol=2e-3)
    examine.prepared(formats.read(path, average_phi_i=True))
    with pytest.raises(InputError, match="anisotropic: 9 azimuths .* --average-phi-i takes their mean"):
        formats.function(path)
    measurement = formats.read(path, average_phi_i=True)
    geom = measurement.geom
    turns = np.degrees(np.linspace(-np.pi, np.pi, 9))
    want = np.mean(
        [0.5 * (rgl.evaluate(fields, geom, a) + rgl.evaluate(fields, geom, b)) for a, b in pairwise(turns)],
        axis=0,
    )
    np.testing.assert_allclose(measurement.brdf, want, rtol=1e-5)


def test_spectral_table_has_its_wavelengths(tmp_path):
    path = tmp_path / "spectral.bsdf"
    path.write_bytes(tensor_file(**rgl_fields(9, spectral=True)))
    measurement = formats.read(path)
    assert measurement.channels[0] == "400nm" and measurement.brdf.shape[1] == 6
    np.testing.assert_allclose(measurement.geom.wavelength, np.linspace(0.4, 0.65, 6), rtol=1e-6)


DAMAGE = {
    "an offset beyond the end": (lambda f: tensor_file(**f)[:-10], "would end at byte"),
    "an incidence without density": (
        lambda f: tensor_file(**{**f, "vndf": f["vndf"] * (np.arange(5) != 2)[:, None, None].astype("<f4")}),
        "zero everywhere",
    ),
    "a missing field": (
        lambda f: tensor_file(**{k: v for k, v in f.items() if k != "ndf"}),
        "no field 'ndf'; found description",
    ),
    "a value that is no number": (
        lambda f: tensor_file(**{**f, "ndf": f["ndf"] * np.float32(np.nan)}),
        "'ndf' holds values that are not finite",
    ),
    "a negative density": (lambda f: tensor_file(**{**f, "vndf": -f["vndf"]}), "'vndf' is negative somewhere"),
    "shapes that differ": (
        lambda f: tensor_file(**{**f, "rgb": f["rgb"][:, :3]}),
        "'rgb' has shape .* does not go with",
    ),
    "angles that fall": (
        lambda f: tensor_file(**{**f, "theta_i": f["theta_i"][::-1].copy()}),
        "the stored incidences do not rise",
    ),
    "absurd counts": (
        lambda f: tensor_file(**f)[:14] + b"\xff\xff\xff\x7f" + tensor_file(**f)[18:],
        "promises 2147483647 fields",
    ),
    "an absurd shape beside an empty one": (
        lambda f: tensor_file(**{**f, "extra": np.zeros((0, 2**21), "<f4")}).replace(
            (2**21).to_bytes(8, "little"), (2**62).to_bytes(8, "little")
        ),
        "would end at byte",
    ),
    "angles in degrees": (
        lambda f: tensor_file(**{**f, "theta_i": np.degrees(f["theta_i"])}),
        "'theta_i' reaches from .* wanted radians",
    ),
    "angles below zero": (
        lambda f: tensor_file(**{**f, "theta_i": f["theta_i"] - f["theta_i"][1]}),
        "'theta_i' reaches from -.* wanted radians",
    ),
    "a type that reaches into the next field": (
        lambda f: tensor_file(**f).replace(b"sigma" + (2).to_bytes(2, "little") + b"\x0a", b"sigma\x02\0\x0b"),
        "where 'sigma' is: damaged",
    ),
    "a field that stands there twice": (
        lambda f: tensor_file(**f).replace(b"\x03\0ndf", b"\x03\0rgb"),
        "'rgb' stands there twice",
    ),
    "an absurd shape": (
        lambda f: tensor_file(**f).replace((8).to_bytes(8, "little"), (10**12).to_bytes(8, "little")),
        "would end at byte",
    ),
}


@pytest.mark.parametrize("name", DAMAGE)
def test_damaged_container_with(tmp_path, name):
    make, sentence = DAMAGE[name]
    path = tmp_path / "bad.bsdf"
    path.write_bytes(make(rgl_fields(10)))
    with pytest.raises(InputError, match=sentence):
        formats.read(path)


def test_wavelengths_of_two_dimensions_are_refused(tmp_path):
    fields = rgl_fields(5, spectral=True)
    fields["wavelengths"] = fields["wavelengths"].reshape(2, 3)
    (tmp_path / "odd.bsdf").write_bytes(tensor_file(**fields))
    with pytest.raises(InputError, match=r"field 'wavelengths' has shape \(2, 3\)"):
        formats.read(tmp_path / "odd.bsdf")

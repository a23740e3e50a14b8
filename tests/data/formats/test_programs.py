"""Files of the programs that optical engineers and façade planners use: each gives back the surface that it was made
of."""

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.data.formats import klems, utia
from brdfguide.data.formats._hemisphere import phi_weights, theta_weights, total
from brdfguide.data.formats._lz4 import unpacked
from brdfguide.errors import InputError
from brdfguide.physics.geometry import Geometry

PAINT = models.get("lambertian+ggx")
VALUES = {"lambertian.albedo": 0.2, "ggx.alpha": 0.3, "ggx.n": 1.5}
PHI = np.arange(0.0, 361.0, 10.0)
THETA = np.array([0.0, 10, 20, 30, 40, 50, 60, 70, 80, 85, 90])


def truth(geom: Geometry) -> np.ndarray:
    return np.asarray(PAINT(geom, VALUES))


def paint(theta_i, theta_r, phi_r) -> np.ndarray:
    """BRDF [1/sr] of light from azimuth 0; the mirror direction is at 180."""
    return truth(Geometry.from_degrees(theta_i, 0.0, np.minimum(theta_r, 89.999), phi_r))


def speos_table(theta_i: float, factor: float, kind: int) -> tuple[str, float]:
    """A table of values that count in relation only, and the reflectance that it has, as a Speos file holds both."""
    value = paint(theta_i, THETA[:, None], PHI)
    stored = value if kind else value * np.cos(np.radians(THETA))[:, None]
    rows = "\n".join(
        "\t".join(map(repr, [t, *row])) for t, row in zip(THETA.tolist(), (factor * stored).tolist(), strict=True)
    )
    head = "\t".join(f"{phi:g}" for phi in PHI)
    return f"{len(THETA)} {len(PHI)}\n\t{head}\n{rows}\n", float(total(THETA, PHI, stored, cosines=kind))


def anisotropic(*, kind: int, version="v8.0", rotations=(0.0,), incidences=(15.0, 45.0), description="23\nmade") -> str:
    tables = [speos_table(angle, 7.5, kind) for _ in rotations for angle in incidences]
    listed = "\t".join(f"{angle:g}" for angle in incidences)
    lists = f"{len(incidences)}\n{listed}\n" * len(rotations)
    percent = 100 * tables[0][1]
    head = f"OPTIS - Anisotropic BSDF surface file {version}\n0\nmade up\n{description}\n1\t0\t0\n1\t0\n{kind}\n"
    turns = f"{len(rotations)}\n" + "\t".join(f"{each:g}" for each in rotations) + "\n"
    spectrum = f"{incidences[0]:g}\t0\n\n2\n400\t{percent!r}\n800\t{percent!r}\n"
    return head + turns + lists + spectrum + "".join(table for table, _ in tables) + "End of file\n"


def spectral(kind: int = 1) -> str:
    """A Speos .brdf of two incidences and two wavelengths, the second half as bright."""
    head = f"OPTIS - brdf surface file v9.0\n0\nScattering surface\n0\n\n1\t0\n{kind}\n2\t2\n15\t45\n500.0\t600.0\n"
    body = ""
    for angle in (15.0, 45.0):
        for share in (1.0, 0.5):
            table, whole = speos_table(angle, 3.0, kind)
            body += f"{100 * share * whole!r}\n{table}"
    return head + body


def read(tmp_path, content, name="it.txt", **options):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return formats.read(path, **options)


def codes(measurement) -> dict:
    return {finding.code: finding for finding in measurement.findings}


def azimuths(measurement) -> set[int]:
    """Of the light, in whole degrees."""
    return set(np.round(np.remainder(measurement.geom.phi_i_deg, 360)).astype(int).ravel().tolist())


# --- integrals --------------------------------------------------------------------------------------------


@pytest.mark.parametrize("cosines", [0, 1])
def test_the_integral_is_that_of_what_is_linear_between_nodes(cosines):
    nodes, values = np.array([3.0, 10, 45, 80]), np.array([1.0, 4, 2, 3])
    theta = np.linspace(0, np.radians(80), 200001)
    linear = np.interp(np.degrees(theta), nodes, values) * np.cos(theta) ** cosines * np.sin(theta)
    assert theta_weights(nodes, cosines) @ values == pytest.approx(np.trapezoid(linear, theta), rel=1e-9)


@pytest.mark.parametrize("phi", [[0.0], [0, 90, 180], [0, 120, 240], [0, 90, 180, 270, 360]])
def test_azimuths_make_a_full_turn_whether_half_or_without_their_last_step(phi):
    assert phi_weights(phi).sum() == pytest.approx(2 * np.pi)
    assert total([0, 90], phi, np.ones((2, len(phi)))) == pytest.approx(np.pi)


# --- Speos ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", [0, 1])
@pytest.mark.parametrize("version", ["v7.0", "v8.0", "v11"])
def test_speos_tables_are_scaled_to_the_total_that_the_file_states(tmp_path, kind, version):
    measurement = read(tmp_path, anisotropic(kind=kind, version=version), "it.anisotropicbsdf")
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)
    assert measurement.channels == ("brdf",) and set(measurement.theta_i_groups) == {15.0, 45.0}


def test_a_speos_description_of_any_length_is_skipped(tmp_path):
    for description in ("0\n", "4\nmade", "40\nof several lines\n1 0\nsecond"):
        measurement = read(tmp_path, anisotropic(kind=1, description=description))
        np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)


def test_rotations_that_agree_are_averaged_and_said_so(tmp_path):
    measurement = read(tmp_path, anisotropic(kind=1, rotations=(0.0, 90.0)))
    assert "isotropic" in codes(measurement)
    with pytest.raises(InputError, match="--average-phi-i has no effect: 2 rotations of the sample differ by 0.0%"):
        read(tmp_path, anisotropic(kind=1, rotations=(0.0, 90.0)), average_phi_i=True)
    with pytest.raises(InputError, match="--rotation-sense has no effect"):
        read(tmp_path, anisotropic(kind=1, rotations=(0.0, 90.0)), rotation_sense="cw")


def test_rotations_that_differ_are_kept_as_azimuths_of_the_light(tmp_path):
    text = anisotropic(kind=1, rotations=(0.0, 90.0), incidences=(30.0,))
    first, second = text.rsplit("11 37\n", 1)
    rows = [line.split("\t") for line in second.splitlines()]
    doubled = "\n".join(
        "\t".join([row[0], *(repr(2 * float(x)) for x in row[1:])]) if len(row) > 30 and row[0] else "\t".join(row)
        for row in rows
    )
    turned = read(tmp_path, f"{first}11 37\n{doubled}\n")
    assert azimuths(turned) == {0, 270} and "anisotropic" in codes(turned)
    assert turned.geom.mirror_distance2[:, 0].min() < 1e-9  # the azimuths of view turn with the light
    other = read(tmp_path, f"{first}11 37\n{doubled}\n", rotation_sense="cw")
    assert azimuths(other) == {0, 90}
    mean = read(tmp_path, f"{first}11 37\n{doubled}\n", average_phi_i=True)
    np.testing.assert_allclose(mean.brdf, 1.5 * truth(mean.geom), rtol=1e-6)


def test_a_spectral_speos_file_has_a_channel_for_each_wavelength(tmp_path):
    measurement = read(tmp_path, spectral(), "it.brdf")
    assert measurement.channels == ("500nm", "600nm")
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom) * [1.0, 0.5], rtol=1e-9)


@pytest.mark.parametrize("name", ["speos_three_azimuths.anisotropicbsdf", "speos_binary_v9.anisotropicbsdf"])
def test_speos_own_files_are_reciprocal_once_they_are_scaled_alike(name, data):
    measurement = formats.read(data / "anisotropic" / name)
    found = {each.code: each for each in examine.examine(measurement)}
    assert "reciprocal" in found and "a factor of 1 (median)" in found["reciprocal"].text
    assert "the other side is 2.35 times brighter" in codes(measurement)["mirror-side-turned"].text


def test_the_binary_file_is_the_text_file(data):
    one, other = (
        formats.read(data / "anisotropic" / f"speos_{name}.anisotropicbsdf") for name in ("binary_v9", "three_azimuths")
    )
    np.testing.assert_allclose(one.brdf, other.brdf, rtol=1e-14)
    np.testing.assert_array_equal(one.geom.cos_r, other.geom.cos_r)


def test_lz4_blocks_of_literals_copies_and_copies_of_themselves():
    assert unpacked(b"\x50hello", 5) == b"hello"
    assert unpacked(b"\x11a\x01\x00\x10b", 7) == b"aaaaaab"
    assert unpacked(b"\xf0\x05" + b"x" * 20, 20) == b"x" * 20
    for damaged in (b"\xf0", b"\x11a\x05\x00", b"\x11a", b"\x20a"):
        with pytest.raises(ValueError):
            unpacked(damaged, 6)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (("1\t0\n1\n", "0\t1\n1\n"), "transmission alone"),
        (("1\t0\n1\n", "1\t1\n1\n"), "transmission beside the reflection"),
        (("made up", "made up\n2"), "found the mode '0'|flags"),
        (("15\t0\n\n2\n", "nan\t0\n\n2\n"), "incidence where the total was measured"),
        (("End of file\n", ""), None),
    ],
)
def test_a_speos_file_that_is_not_read_says_why(tmp_path, change, sentence):
    text = anisotropic(kind=1).replace(*change)
    if sentence is None:
        with pytest.raises(InputError, match="truncated: this Speos file ends where value of the table at 45 degrees"):
            read(tmp_path, text[:-200])
        return
    if change[0] == "made up":
        assert read(tmp_path, text).brdf.size  # a comment of two lines is no reason to stop
        return
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, text)


def test_a_value_of_a_second_rotation_that_is_no_number_is_refused(tmp_path):
    lines = anisotropic(kind=1, rotations=(0.0, 90.0)).split("\n")
    cells = lines[-8].split("\t")
    lines[-8] = "\t".join((*cells[:5], "inf", *cells[6:]))
    with pytest.raises(InputError, match="no number"):
        read(tmp_path, "\n".join(lines))


def test_the_mirror_side_of_a_speos_file_can_be_told(tmp_path):
    as_read, turned = (read(tmp_path, anisotropic(kind=1), mirror_side=side) for side in ("phi=180", "phi=0"))
    np.testing.assert_allclose(turned.geom.dot_xy, -as_read.geom.dot_xy, atol=1e-12)


# --- TracePro ---------------------------------------------------------------------------------------------

BETA = (0.0, 0.1, 0.3, 0.6, 1.0, 1.5)


def tracepro(sign: float = 1.0, waves=(0.55,), turns=(0,)) -> str:
    lines = ["TracePro Surface Property Data", "File Name\tx", "TracePro Release: 7 0 0", "", "Table_BSDF_Data"]
    lines.append("Temperature\tWavelength\tIncAngle\tAziAngle\tScatterBeta\tScatterAzimuth\tBRDF\tBTDF")
    for wave, turn, angle in ((w, t, a) for w in waves for t in turns for a in (0, 30, 60)):
        for beta in BETA:
            for azimuth in range(0, 360, 30):
                x = np.sin(np.radians(angle)) + sign * beta * np.cos(np.radians(azimuth))
                y = sign * beta * np.sin(np.radians(azimuth))
                value = 0.0
                if np.hypot(x, y) < 1 - 1e-9:
                    value = float(paint(angle, np.degrees(np.arcsin(np.hypot(x, y))), np.degrees(np.arctan2(-y, -x))))
                lines.append(f"300\t{wave}\t{angle}\t{turn}\t{beta}\t{azimuth}\t{value!r}\t0")
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_tracepro_azimuths_count_from_where_no_value_is_below_the_horizon(tmp_path, sign):
    measurement = read(tmp_path, tracepro(sign))
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)
    assert measurement.channels == ("550nm",)
    assert ("toward the normal" if sign < 0 else "away from the normal") in codes(measurement)["mirror-azimuth"].text


def test_tracepro_wavelengths_are_channels_and_rotations_one_surface(tmp_path):
    measurement = read(tmp_path, tracepro(waves=(0.55, 0.65), turns=(0, 90)))
    assert measurement.channels == ("550nm", "650nm") and "isotropic" in codes(measurement)
    np.testing.assert_allclose(measurement.brdf[:, 0], truth(measurement.geom)[:, 0], rtol=1e-9)


def test_a_tracepro_value_beyond_every_number_is_a_lost_one(tmp_path):
    lines = tracepro(turns=(0, 90)).split("\n")
    cells = lines[40].split("\t")
    lines[40] = "\t".join((*cells[:6], "1e999", cells[7]))
    measurement = read(tmp_path, "\n".join(lines))
    assert "isotropic" in codes(measurement)
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("TracePro Surface Property Data\nABg\n", "no Table_BSDF_Data in this TracePro property: one of an ABg model"),
        (tracepro().replace("ScatterBeta", "Beta"), "line 6: no column ScatterBeta under Table_BSDF_Data"),
        (tracepro() + "400" + tracepro()[-30:], "cells, wanted 8|temperatures"),
        (tracepro().replace("\t60\t", "\tx\t"), "found 'x', wanted a number"),
    ],
)
def test_a_tracepro_file_without_a_table_says_why(tmp_path, text, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, text)


# --- Klems ------------------------------------------------------------------------------------------------


def klems_xml(basis: str, direction="Reflection Front", cut: int = 0) -> str:
    patches = klems._patches(None, klems.BASES, f"LBNL/Klems {basis}")
    light, view = patches[None, :, :], patches[:, None, :]
    values = truth(Geometry.from_degrees(light[..., 0], light[..., 1] + 180.0, view[..., 0], view[..., 1]))
    numbers = [repr(x) for x in values.reshape(-1).tolist()]
    data = ",\n".join(numbers[: len(numbers) - cut])
    return (
        '<?xml version="1.0"?>\n<WindowElement xmlns="http://windows.lbl.gov"><FileType>BSDF</FileType><Optical><Layer>'
        "<DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure></DataDefinition><WavelengthData>"
        f"<Wavelength>Visible</Wavelength><WavelengthDataBlock><WavelengthDataDirection>{direction}"
        f"</WavelengthDataDirection><ColumnAngleBasis>LBNL/Klems {basis}</ColumnAngleBasis>"
        f"<RowAngleBasis>LBNL/Klems {basis}</RowAngleBasis><ScatteringData>\n{data}\n</ScatteringData>"
        "</WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>\n"
    )


@pytest.mark.parametrize(("basis", "patches"), [("Full", 145), ("Half", 73), ("Quarter", 41)])
def test_klems_matrices_give_back_the_surface_at_their_patches(tmp_path, basis, patches):
    measurement = read(tmp_path, klems_xml(basis), "it.xml")
    assert len(measurement.brdf) == patches**2
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom), rtol=1e-9)
    assert measurement.geom.mirror_distance2[:: patches + 1].max() < 1e-9  # one number each: they mirror each other


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (klems_xml("Quarter", cut=3), "found 1678 values, wanted 41 x 41 = 1681"),
        (klems_xml("Quarter", "Transmission Front"), "no reflection; found Transmission Front"),
        (klems_xml("Quarter").replace("Columns<", "TensorTree4<"), "its data are a TensorTree4, not a matrix"),
        (klems_xml("Quarter").replace("Klems Quarter", "Klems Tenth"), "basis 'LBNL/Klems Tenth' is unknown"),
        (klems_xml("Quarter")[:-50], "not valid XML"),
        (klems_xml("Quarter").replace("?>\n", "?>\n<!DOCTYPE x>\n"), "document type"),
    ],
)
def test_a_klems_file_that_is_not_read_says_why(tmp_path, text, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, text, "it.xml")


# --- UTIA -------------------------------------------------------------------------------------------------


def utia_table(grain: float = 0.0) -> bytes:
    """Every pair of directions; `grain` makes the sample brighter along its axis."""
    theta, phi = np.meshgrid(utia.THETA, utia.PHI, indexing="ij")
    light, view = (theta.reshape(-1, 1), phi.reshape(-1, 1)), (theta.reshape(1, -1), phi.reshape(1, -1))
    values = truth(Geometry.from_degrees(*light, *view)) * (1 + grain * np.cos(2 * np.radians(light[1])))
    return np.stack([values, values / 2, values / 4]).astype("<f8").tobytes()


def test_a_utia_table_is_known_by_its_size_and_relative(tmp_path):
    measurement = read(tmp_path, utia_table(), "it.bin")
    np.testing.assert_allclose(measurement.brdf, truth(measurement.geom) * [1, 0.5, 0.25], rtol=1e-9)
    assert codes(measurement)["relative-scale"].severity == "warning" and "isotropic" in codes(measurement)
    scaled = read(tmp_path, utia_table(), "it.bin", scale=0.01)
    np.testing.assert_allclose(scaled.brdf, 0.01 * measurement.brdf, rtol=1e-14)
    assert "relative-scale" not in codes(scaled)


def test_a_utia_table_with_a_grain_keeps_its_azimuths(tmp_path):
    measurement = read(tmp_path, utia_table(grain=0.5), "it.bin")
    assert "anisotropic" in codes(measurement) and "sample-rotation" not in codes(measurement)  # the light was turned
    assert len(np.unique(np.round(measurement.geom.phi_i_deg, 1))) == 48
    grain = 1 + 0.5 * np.cos(2 * np.radians(measurement.geom.phi_i_deg))
    tilted = measurement.geom.theta_i_deg[:, 0] > 1
    np.testing.assert_allclose(measurement.brdf[tilted, 0], (truth(measurement.geom) * grain)[tilted, 0], rtol=1e-9)


@pytest.mark.parametrize("size", [-8, 8])
def test_of_another_size_it_is_no_utia_table(tmp_path, size):
    content = utia_table()
    with pytest.raises(InputError, match="no reader knows it|no row of numbers"):
        read(tmp_path, content[:size] if size < 0 else content + b"\0" * size, "it.bin")


FIELD = {  # snippets as they come by mail: two incidences promised and one there; eight numbers of a matrix
    "truncated: this Speos file ends where the number of theta angles of the table at 45 degrees": anisotropic(
        kind=0
    ).rsplit("11 37\n", 1)[0],
    "ScatteringData of this Klems matrix: found 8 values, wanted 41 x 41 = 1681": klems_xml("Quarter", cut=1673),
}


@pytest.mark.parametrize("sentence", FIELD)
def test_a_snippet_is_named_for_what_it_is(tmp_path, sentence):
    with pytest.raises(InputError, match=sentence):
        read(tmp_path, FIELD[sentence])

"""What `benchmarks/fuzz` found, each by its kind: a sentence or an honest reading, in time, and no warning."""

import json
import re
import struct

import numpy as np
import pytest

from brdfguide.data import examine, formats, noise
from brdfguide.errors import BrdfguideError, InputError, NoAnswer
from brdfguide.fitting.compare import compare
from brdfguide.models import candidates

from ...patience import takes_less_than
from .containers import cornell, every, fred, rgl_fields, tensor_file, zemax
from .test_programs import anisotropic, spectral

ROWS = "".join(f"{i},{r},0.2\n" for i in (10, 30, 50) for r in range(-40, 61, 20))


def read(tmp_path, content):
    path = tmp_path / "found"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return formats.read(path)


def test_a_byte_order_mark_before_what_is_no_utf_8_is_no_text(tmp_path):
    measurement = read(tmp_path, b"\xef\xbb\xbf" + cornell().replace("made up", "caf\xe9").encode("latin-1"))
    assert len(measurement.channels) == 3


@pytest.mark.parametrize("angle", ["1e308", "-1e305", "1e300"])
def test_an_angle_that_no_rounding_survives_is_refused(tmp_path, angle):
    table = "theta_i,phi_i,theta_r,phi_r,brdf\n" + "".join(f"10,0,{r},180,0.2\n" for r in (10, 20, 30, 30))
    with pytest.raises(InputError, match="is no angle"):
        read(tmp_path, table.replace("20,180", f"20,{angle}"))
    rows = [[5.5e-7, 0.1, 0.2, float(angle), 0.3], [5.5e-7, 0.1, 0.3, 0.0, 0.3]]
    with pytest.raises(InputError, match="is no angle|wanted a number"):
        read(tmp_path, json.dumps({"brdf": {"lookupTable": rows}}))
    with pytest.raises(InputError):
        read(tmp_path, json.dumps({"brdf": {"lookupTable": [[float(angle), *row[1:]] for row in rows]}}))


def test_vectors_of_any_length_are_directions(tmp_path):
    head = "#DIM 6 1\n#VS 0\n#PARAM_IN CARTESIAN\n#PARAM_OUT INV_STERADIAN\n"
    huge = read(tmp_path, head + "0 3e200 4e200 0 0 1e300 0.5\n0 0 1 0 0 1 0.4\n")
    np.testing.assert_allclose(huge.geom.theta_r_deg[:, 0], [np.degrees(np.arctan2(3, 4)), 0], atol=1e-9)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("scale", ["1e400", "inf", "nan", "0", "-1"])
def test_a_scale_that_scales_nothing_is_refused_with_its_line(tmp_path, scale):
    with pytest.raises(InputError, match=f"line 2: .*{scale}"):
        read(tmp_path, fred().replace("scale=1", f"scale={scale}"))


def test_a_scale_beyond_numbers_leaves_no_value_and_says_so(tmp_path):
    measurement = read(tmp_path, fred().replace("scale=1", "scale=1e300").replace("0.5", "1e9"))
    assert "infinite-values" in [finding.code for finding in measurement.findings]


@pytest.mark.parametrize("phis", [1, 3])
def test_an_area_of_zero_leaves_no_value(tmp_path, phis):
    fields = rgl_fields(4, phis=phis)
    fields["sigma"] = np.zeros_like(fields["sigma"])
    try:
        measurement = read(tmp_path, tensor_file(**fields))
    except BrdfguideError:
        return
    assert not np.any(measurement.has_value)


def test_two_hundred_thousand_tabulators_end_soon(tmp_path):
    def both():
        with pytest.raises(InputError):
            read(tmp_path, zemax().replace("SampleRotation 1", "SampleRotation 1" + "\t" * 200_000))
        read(tmp_path, "theta_i\ttheta_r\tbrdf" + "\t" * 200_000 + "\n" + ROWS.replace(",", "\t"))

    assert takes_less_than(5, both)


@pytest.mark.parametrize("value", ["1e300", "1e308", "1e101"])
def test_values_beyond_what_a_brdf_can_be_are_examined_and_fitted_without(tmp_path, value):
    lines = ROWS.splitlines()
    lines[3] = lines[3].replace("0.2", value)
    measurement = read(tmp_path, "theta_i,theta_r,brdf\n" + "\n".join(lines) + "\n")
    examine.examine(measurement)
    ranked = compare(examine.prepared(measurement, anyway=True), candidates.of_kind(None, ("lambertian",)))
    assert ranked.rows[0].rms_ln < 1e-6
    nothing = read(tmp_path, "theta_i,theta_r,brdf\n" + ROWS.replace("0.2", value))
    examine.examine(nothing)
    with pytest.raises(NoAnswer):
        compare(examine.prepared(nothing, anyway=True), candidates.of_kind(None, ("lambertian",)))


def test_a_table_of_values_that_none_can_be_is_examined(tmp_path):
    content = struct.pack("<3i", 90, 90, 180) + np.full(3 * 90 * 90 * 180, 1e300).tobytes()
    measurement = read(tmp_path, content)
    assert not np.any(measurement.has_value)
    examine.examine(measurement)


@pytest.mark.parametrize("name", [*(name for name, made in every().items() if b"\0" not in made), "speos", "spectral"])
@pytest.mark.parametrize("number", ["1e308", "-1e200", "1e-320"])
def test_a_number_beyond_arithmetic_is_a_sentence_or_a_lost_value(tmp_path, name, number):
    made = {**every(), "speos": anisotropic(kind=1).encode(), "spectral": spectral().encode()}[name].decode("latin-1")
    numbers = list(re.finditer(r"(?<![\w.])\d+\.?\d*(?![\w.])", made))
    for found in numbers[:: max(len(numbers) // 8, 1)]:
        try:
            measurement = read(tmp_path, (made[: found.start()] + number + made[found.end() :]).encode("latin-1"))
        except InputError:
            continue
        examine.examine(measurement)


def test_a_speos_total_beyond_every_number_is_no_warning(tmp_path):
    head = "OPTIS - Anisotropic BSDF surface file v8.0\n0\nmade\n4\nmade\n1\t0\t0\n1\t0\n1\n1\n0\n1\n64\n64\t0\n\n"
    table = "4 3\n\t0\t120\t240\n0\t1e-9\t1e-9\t1e-9\n0.1\t0\t500\t0\n0.2\t0\t0\t0\n60\t1e-9\t0\t0\nEnd of file\n"
    measurement = read(tmp_path, head + "2\n400\t1.7e308\n800\t30\n" + table)
    assert not np.any(np.isfinite(measurement.brdf[:, 0]))


@pytest.mark.parametrize("value", ["1e307", "-1e307"])
def test_a_value_that_none_can_be_is_no_neighbour_of_others(tmp_path, value):
    rows = [f"{i},{r},{0.2 + r / 1000}" for i in (10, 30, 50) for r in range(-60, 61, 4)] + ["30,20.001,0.22"]
    measurement = read(
        tmp_path, "theta_i,theta_r,brdf\n" + "\n".join(rows).replace("30,20,0.22", f"30,20,{value}") + "\n"
    )
    noise.estimated_noise(measurement)
    assert np.count_nonzero(np.isnan(measurement.readings)) == 1


def test_a_number_beyond_arithmetic_is_a_lost_value_in_a_table_of_parts_too(tmp_path, monkeypatch):
    pyarrow = pytest.importorskip("pyarrow")
    parquet = pytest.importorskip("pyarrow.parquet")
    columns = {"theta_i": [10.0, 30.0, 50.0], "theta_r": [10.0, 89.9, 50.0], "ccbrdf": [0.2, 1.7e308, 0.3]}
    parquet.write_table(pyarrow.table(columns), tmp_path / "it.parquet")
    monkeypatch.setattr("brdfguide.data.formats.parquet.LARGEST_CELLS", 1)
    parts = list(formats.in_blocks(tmp_path / "it.parquet"))
    assert [int(np.count_nonzero(part.has_value)) for part in parts] == [2]


def scans(level: float, shine: float, errors=None) -> str:
    """Three scans of a lobe `shine` [1/sr] high on a level; standard errors that are stated, in turn."""
    lines = ["theta_i,theta_r,brdf" + (",stderr" if errors else "")]
    for place, (i, r) in enumerate((i, r) for i in (10, 30, 50) for r in range(-60, 61, 4)):
        value = float(level + shine * np.exp(-(((r - i) / 12) ** 2)))
        lines.append(f"{i},{r},{value!r}" + (f",{errors[place % len(errors)]}" if errors else ""))
    return "\n".join(lines) + "\n"


def fitted(tmp_path, content):
    prepared = examine.prepared(read(tmp_path, content), anyway=True)
    return compare(prepared, candidates.of_kind(None, ("lambertian+ggx", "lambertian")))


@pytest.mark.parametrize("error", ["1e308", "1e150", "-1", "nan"])
def test_a_standard_error_that_none_can_be_weighs_nothing(tmp_path, error):
    """It is as if its value were not there; where all are such, as if none were stated."""
    text = scans(0.1, 1.0, ["0.01", "0.01", error])
    some, without = fitted(tmp_path, text), fitted(tmp_path, re.sub(rf".*,{error}\n", "", text))
    for key, value in without.rows[0].fit.surface.values.items():
        assert some.rows[0].fit.surface.values[key] == pytest.approx(value, rel=1e-4)
    measurement = read(tmp_path, scans(0.1, 1.0, [error]))
    assert measurement.stated_errors is None
    assert fitted(tmp_path, scans(0.1, 1.0, [error])).rows[0].rms_ln == fitted(tmp_path, scans(0.1, 1.0)).rows[0].rms_ln


@pytest.mark.parametrize("scale", [1e-91, 1e90])
def test_a_level_at_the_end_of_arithmetic_is_fitted_or_refused(tmp_path, scale):
    """No law is that dim or bright, and none has a lobe there whose factors could be compared."""
    assert fitted(tmp_path, scans(0.1 * scale, scale)).rows[0].fit.rms_ln > 0.5

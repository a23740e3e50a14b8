"""`convert`: what is written reads back as the same measurement; tables to the last bit; nothing is half written."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from brdfguide import exporters, models
from brdfguide.cli._app import build
from brdfguide.data import formats
from brdfguide.data.formats import merl, table
from brdfguide.errors import InputError
from brdfguide.exporters import _directions
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.exporters.tables import tabulated
from brdfguide.physics.geometry import Directions, Geometry

from ..data.formats.containers import every, rgl_fields, tensor_file
from ..surfaces import dome_run
from ..surfaces import table as csv

KINDS = [name for name in every() if not name.endswith((".gz", ".xz"))]


def run(*words):
    return CliRunner().invoke(build(["convert"]), ["convert", *map(str, words)])


@pytest.mark.parametrize("name", KINDS)
def test_csv_reads_back_as_the_same_measurement(tmp_path, name):
    path, out, again = tmp_path / "in", tmp_path / "out.csv", tmp_path / "again.csv"
    path.write_bytes(every()[name])
    first = formats.read(path)
    out.write_text("\n".join(table.written(first)) + "\n")
    second = formats.read(out)
    assert second.channels == first.channels
    np.testing.assert_array_equal(second.brdf, first.brdf)
    np.testing.assert_allclose(second.geom.wavelength, first.geom.wavelength, rtol=1e-9)
    for field in ("cos_i", "cos_r", "vxy2", "dot_xy"):
        np.testing.assert_allclose(getattr(second.geom, field), getattr(first.geom, field), atol=1e-10)
    again.write_text("\n".join(table.written(second)) + "\n")

    def body(path):
        return [line for line in path.read_text().splitlines() if not line.startswith("#")]

    assert body(again) == body(out)


def test_uncertainties_survive(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("theta_i,theta_r,550nm,stderr_550nm\n30,30,.5,.01\n30,-40,.4,.02\n")
    first = formats.read(path)
    path.write_text("\n".join(table.written(first)) + "\n")
    np.testing.assert_array_equal(formats.read(path).stderr, first.stderr)


def test_a_merl_table_is_written_as_it_was_read(tmp_path):
    draw = np.random.default_rng(4)
    planes = np.where(draw.uniform(size=(3, 90 * 90 * 180)) < 0.1, -1.0, draw.uniform(0, 5000, (3, 90 * 90 * 180)))
    path, out = tmp_path / "in.binary", tmp_path / "out.binary"
    path.write_bytes(np.array([90, 90, 180], "<i4").tobytes() + planes.tobytes())
    content, notes = tabulated.merl(path)
    out.write_bytes(content)
    first, second = formats.read(path), formats.read(out)
    assert notes == [] and len(content) == 34992012
    good = first.brdf >= 0
    np.testing.assert_array_equal(second.brdf[good], first.brdf[good])
    np.testing.assert_array_equal(second.geom.cos_r, first.geom.cos_r)


def test_an_rgl_table_becomes_its_own_values_at_the_cells(tmp_path):
    path, out = tmp_path / "in.bsdf", tmp_path / "out.binary"
    path.write_bytes(tensor_file(**rgl_fields(3)))
    content, _ = tabulated.merl(path)
    out.write_bytes(content)
    measurement = formats.read(out)[::997]
    value, _ = formats.function(path)
    np.testing.assert_allclose(measurement.brdf, value(measurement.geom), rtol=1e-9)


def test_a_fitted_model_becomes_its_own_values_at_the_cells(tmp_path):
    row = {
        "model": "lambertian+ward",
        "candidate": "lambertian+ward",
        "parameters": {
            "lambertian.albedo": {"value": [0.5, 0.4, 0.3]},
            "ward.rho_s": {"value": [0.1, 0.1, 0.1]},
            "ward.alpha": {"value": 0.2},
        },
    }
    data = {"channels": ["R", "G", "B"], "wavelength_nm": [610, 550, 465]}
    path, out = tmp_path / "fit.json", tmp_path / "out.binary"
    path.write_text(
        json.dumps({"schema": "brdfguide/fit/1", "ranking": [row], "recommended": "lambertian+ward", "data": data})
    )
    content, _ = tabulated.merl(path)
    out.write_bytes(content)
    measurement = formats.read(out)[::997]
    model = models.get("lambertian+ward")
    values = {"lambertian.albedo": np.array([0.5, 0.4, 0.3]), "ward.rho_s": np.full(3, 0.1), "ward.alpha": 0.2}
    np.testing.assert_allclose(measurement.brdf, model(measurement.geom, values), rtol=1e-12)


def test_scattered_samples_cannot_become_a_table(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text(csv(("theta_i", "theta_r", "phi_r", "brdf"), *dome_run("plaster", seed=1)))
    with pytest.raises(InputError, match="scattered samples .table. have no values between them; fit them"):
        tabulated.merl(path)


def test_a_cell_is_found_from_its_centre_on_every_shell():
    for theta_h in (0, 1, 45, 89):
        fields = merl.directions(theta_h, 180)
        lit = (fields["cos_i"] > 0) & (fields["cos_r"] > 0)
        fields = {name: values[lit, None] for name, values in fields.items()}
        geom = Geometry(Directions(phi_i_deg=np.zeros((np.count_nonzero(lit), 1)), **fields))
        np.testing.assert_array_equal(merl.cell_of(geom, 180), theta_h * 16200 + np.flatnonzero(lit))


def test_command_writes_whole_and_replaces_only_by_force(tmp_path):
    path, out = tmp_path / "run.csv", tmp_path / "out.csv"
    path.write_text(csv(("theta_i", "theta_r", "phi_r", "brdf"), *dome_run("plaster", seed=2)))
    assert run(path, out).exit_code == 0
    first = out.read_text()
    assert first.startswith("# brdfguide table 1")
    assert isinstance(run(path, out).exception, InputError) and out.read_text() == first
    assert run(path, out, "--force").exit_code == 0
    bad = tmp_path / "bad.csv"
    bad.write_text("theta_i,theta_r,brdf\n30,30,1\n30,40,high\n")
    assert isinstance(run(bad, tmp_path / "never.csv").exception, InputError)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["bad.csv", "out.csv", "run.csv"]


def test_an_exported_table_is_judged_by_what_its_reader_returns(tmp_path):
    values = {"ward.alpha": 0.2, "ward.rho_s": 0.1, "lambertian.albedo": 0.3}
    surface = ColouredSurface(models.get("lambertian+ward"), values)
    made = exporters.export("merl", surface)
    (tmp_path / "out.binary").write_bytes(made.content)
    value, _ = formats.function(tmp_path / "out.binary")
    geom, wanted, _ = _directions.judged_over(surface, None)
    assert _directions.rms_ln(value(geom), wanted) == pytest.approx(made.statement.rms_ln, rel=1e-12)

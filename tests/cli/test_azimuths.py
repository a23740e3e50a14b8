"""One azimuth everywhere: phi_r - phi_i, 180 degrees in the mirror direction, in what is typed, read and written."""

import csv
import io
from contextlib import redirect_stdout

import numpy as np
import pytest

import brdfguide
from brdfguide.cli import main
from brdfguide.data import formats

TYPED = ["ggx", "alpha=0.2", "n=1.5"]


def evaluated(*words: str) -> str:
    out = io.StringIO()
    with redirect_stdout(out), pytest.raises(SystemExit) as end:
        main(["evaluate", *TYPED, *words])
    assert not end.value.code
    return out.getvalue()


@pytest.fixture(scope="module")
def printed() -> str:
    return evaluated("--theta-i", "20,45", "--theta-r=-40,40", "--phi", "100,180,210")


def rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_what_evaluate_prints_can_be_typed_again(printed):
    for row in rows(printed):
        theta_i, theta_r, phi = (row[f"{name}_deg"] for name in ("theta_i", "theta_r", "phi"))
        (again,) = rows(evaluated("--theta-i", theta_i, "--theta-r", theta_r, "--phi", phi))
        assert again == row
        (value,) = brdfguide.evaluate("ggx alpha=0.2 n=1.5", float(theta_i), float(theta_r), float(phi))
        assert value == pytest.approx(float(row["brdf"]), rel=1e-12)


def test_what_evaluate_prints_is_read_as_the_same_directions(printed, tmp_path):
    path = tmp_path / "values.csv"
    path.write_text(printed)
    geom = formats.read(path).geom
    wanted = [tuple(float(row[f"{name}_deg"]) for name in ("theta_i", "theta_r", "phi")) for row in rows(printed)]
    found = np.concatenate((geom.theta_i_deg, geom.theta_r_deg, np.remainder(geom.phi_deg, 360)), axis=1)
    np.testing.assert_allclose(found, wanted, atol=1e-9)


def test_the_mirror_side_is_at_180_and_a_negative_angle_is_half_a_turn_away(printed):
    assert {row["phi_deg"] for row in rows(printed)} == {"100.0", "180.0", "210.0", "280.0", "0.0", "30.0"}
    bright, dim = (brdfguide.evaluate("ggx alpha=0.2 n=1.5", 45, 45, phi)[0] for phi in (180, 0))
    assert bright > 50 * dim
    assert brdfguide.evaluate("ggx alpha=0.2 n=1.5", 45, -45)[0] == dim


def test_a_scan_in_the_plane_of_incidence_has_two_azimuths(tmp_path):
    """The side of the light was printed as 360."""
    scan = tmp_path / "scan.csv"
    scan.write_text("theta_i,theta_r,brdf\n" + "".join(f"30,{theta_r},0.2\n" for theta_r in range(-60, 61, 10)))
    out = io.StringIO()
    with redirect_stdout(out), pytest.raises(SystemExit):
        main(["evaluate", *TYPED, "--data", str(scan)])
    assert {row["phi_deg"] for row in rows(out.getvalue())} == {"0.0", "180.0"}

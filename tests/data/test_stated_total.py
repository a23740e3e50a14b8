"""Total integrated scatter as a file states it, against what its values integrate to."""

import numpy as np
import pytest

from brdfguide.data import examine, formats

from .formats.containers import lighttools_bsdf

AZIMUTHS, RADIALS = np.arange(0, 181, 30), np.r_[0:31:5, 40:81:10]


def sphere(stated: float, albedo: float, lobe: float = 0.0) -> str:
    """A Lambert surface as Radiant Imaging's sphere has it, perhaps with a lobe about the mirror direction."""
    rows = "\n".join(
        "\t".join(f"{albedo / np.pi + lobe * np.exp(-((radial / 8) ** 2)):.6g}" for radial in RADIALS) for _ in AZIMUTHS
    )
    lists = "".join(
        f"{key} {len(values)}\n{' '.join(f'{each:g}' for each in values)}\n"
        for key, values in (("AngleOfIncidence", (10, 40)), ("ScatterAzimuth", AZIMUTHS), ("ScatterRadial", RADIALS))
    )
    tables = "".join(f"TIS {stated}\n{rows}\n" for _ in range(2))
    head = "Source Measured\nSymmetry PlaneSymmetrical\nSpectralContent Monochrome\nScatterType BRDF\n"
    return f"# 550 nm\n{head}SampleRotation 1\n0\n{lists}Monochrome\nDataBegin\n{tables}DataEnd\n"


def found(tmp_path, text: str) -> dict:
    (tmp_path / "run.bsdf").write_text(text)
    measurement = formats.read(tmp_path / "run.bsdf")
    return {each.code: each for each in (*measurement.findings, *examine.examine(measurement))}


def test_a_total_that_is_twice_that_of_the_values_is_doubted(tmp_path):
    codes = found(tmp_path, sphere(stated=0.2, albedo=0.1))
    doubt = codes["tis-differs"]
    assert codes["tis"].text == "total integrated scatter 0.2, as the file states it"
    assert doubt.severity == "warning" and "states a total integrated scatter of 0.2" in doubt.text
    assert dict(doubt.numbers)["at_10_deg"] == pytest.approx(0.1, rel=0.03)


@pytest.mark.parametrize("stated", [0.095, 0.1, 0.11])
def test_a_total_that_is_that_of_the_values_is_said_to_be(tmp_path, stated):
    agreed = found(tmp_path, sphere(stated, albedo=0.1))["tis-agrees"]
    assert f"of {stated:g} at theta_i" in agreed.text and agreed.severity == "note"


def test_the_lighttools_total_is_kept(tmp_path):
    assert dict(found(tmp_path, lighttools_bsdf())["tis"].numbers) == {"30_deg": 0.2, "60_deg": 0.2}


def test_rotations_of_the_sample_give_their_mean(tmp_path):
    from brdfguide.data import stated_total

    note = stated_total.total_note([10, 40, 10, 40], [0.1, 0.2, 0.3, 0.4])
    assert dict(note.numbers) == {"10_deg": pytest.approx(0.2), "40_deg": pytest.approx(0.3)}

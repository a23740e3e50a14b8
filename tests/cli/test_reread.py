"""`verify` and `check --certify` read an answer's data as its fit did: without what that left out, and only that."""

import json

import numpy as np
import pytest

pytest.importorskip("mpmath", reason="mpmath, of the extra `verify`, is not installed")

from brdfguide import models

from .. import synthetic
from .test_fit import brdfguide

LEFT_OUT = {"spikes": 3, "dark-edge": 6}  # code -> samples
MODELS = ("-m", "lambertian+ggx,lambertian+ward")


@pytest.fixture(scope="module")
def spiked(tmp_path_factory):
    """A scan with a mirror's spikes, and with its outermost samples cut off by the holder."""
    geom = synthetic.scan(theta_i=(20, 40, 60), step=2.0)
    made = synthetic.surface(models.get("lambertian+ggx"), geom, {"lambertian.albedo": 0.4}, noise=0.01, seed=5)
    value, signed = made.brdf[:, 0].copy(), geom.signed_theta_r_deg[:, 0]
    value[np.abs(signed - geom.theta_i_deg[:, 0]) < 1e-6] *= 3000
    value[np.abs(signed) > 79] *= 0.01
    path = tmp_path_factory.mktemp("spiked") / "spiked.csv"
    lines = zip(geom.theta_i_deg[:, 0], signed, value, strict=True)
    path.write_text("theta_i_deg,theta_r_deg,brdf\n" + "".join(f"{i:g},{r:g},{f:.6g}\n" for i, r, f in lines))
    return path


@pytest.mark.parametrize("words", [(), ("--anyway",), ("--aperture-deg", "0.5")], ids=" ".join)
def test_what_a_fit_left_out_is_left_out_again(spiked, words):
    made = brdfguide("fit", spiked, *MODELS, "--no-timing", "--json", *words)
    answer = spiked.with_name("fit.json")
    answer.write_text(made.stdout)
    document = json.loads(made.stdout)
    found = {each["code"] for each in document["data"]["findings"]} & LEFT_OUT.keys()
    left = {(): 9, ("--anyway",): 0, ("--aperture-deg", "0.5"): 6}[words]
    assert found == LEFT_OUT.keys() and document["data"]["missing"] == left
    again = brdfguide("verify", answer, "--json", "-q")
    assert again.returncode == 0, again.stdout
    assert json.loads(again.stdout)["differ"] == []
    certified = brdfguide("check", "--fit", answer, "--certify", spiked, "--json", "-q")
    assert "SciPy" in certified.stdout and "wanted the data" not in certified.stderr

"""An index that no dielectric has, or that changes with colour as none does, is said to be none."""

from dataclasses import replace

import numpy as np
import pytest

from brdfguide import fit, models
from brdfguide.finding import Finding
from brdfguide.fitting.index_doubts import LEAST_INDEX, MOST_INDEX, index_doubts

from .. import synthetic
from .test_plausible import row


def told(name="lambertian+ggx", lowest=10.0, heights=None, **index):
    """The doubts about a row with this `n` and its `stderr`."""
    values = {"ggx.n": np.asarray(index["n"])} | ({} if heights is None else {"ggx.scale": np.asarray(heights)})
    of_it = row(name, 0.02, 3, values=values, lowest=lowest)
    stderr = {"ggx.n": np.asarray(index["stderr"])} | ({} if heights is None else {"ggx.scale": 0.01})
    return index_doubts(replace(of_it, fit=replace(of_it.fit, stderr=stderr)))


@pytest.mark.parametrize("n", [[1.5], [1.33], [2.9], [1.48, 1.5, 1.52], [1.2], [3.1]])
def test_an_index_that_a_dielectric_may_have_is_not_doubted(n):
    assert LEAST_INDEX < 1.33 and abs(MOST_INDEX - 3) < 1e-9
    assert told(n=n, stderr=np.full(len(n), 0.06)) == ()


def test_below_every_solid():
    (found,) = told(n=[1.05], stderr=[0.02])
    assert found.printed == "no-index:ggx.n" and found.text == "ggx.n of 1.05 is below any solid's or liquid's (1.3)"


def test_above_every_dielectric_beside_a_free_height():
    (found,) = told("lambertian+ggx (height free)", n=[9.4], stderr=[0.5], heights=[0.05])
    assert found.text == "ggx.n of 9.4 is above any dielectric's (3)"
    assert "hardly rises toward grazing" in found.consequence


def test_above_every_dielectric_from_grazing_alone_a_metal_is_as_likely():
    (found,) = told(n=[7.2], stderr=[0.2], lowest=80.0)
    assert "from 80 degrees of incidence on a metal's lobe looks alike" in found.text and found.option == "--kind"
    assert told(n=[7.2], stderr=[0.2]) == ()  # near the normal the level says it: f0-above-dielectrics


def test_channels_that_cannot_tell_have_one_index_and_those_that_can_a_coloured_lobe():
    """The first as a yellow vinyl was answered."""
    heights = [0.036, 0.071, 0.111]
    (one,) = told("lambertian+ggx (height free)", n=[27.0, 4.45, 2.53], stderr=[32.7, 0.97, 0.61], heights=heights)
    assert one.consequence.startswith(
        "3.08 in all does about as well: -m 'lambertian+ggx (height free)' --fix ggx.n=3.08"
    )
    (coloured,) = told(n=[2.4, 1.9, 1.5], stderr=[0.02, 0.02, 0.02])
    assert (
        "as no dielectric's does" in coloured.text and coloured.consequence == "its lobe is coloured: F0 0.04 to 0.17"
    )


def test_a_metal_and_what_is_doubted_already_are_left_alone():
    metal = row(
        "ggx (metal, edge free)", 0.02, 3, values={"ggx.n": np.array([0.2, 1.4]), "ggx.k": np.array([3.0, 2.0])}
    )
    stderr = {"ggx.n": np.array([0.01, 0.01])}
    assert index_doubts(replace(metal, fit=replace(metal.fit, stderr=stderr))) == ()
    plain = row("lambertian+ggx", 0.02, 3, values={"ggx.n": np.array([1.05])})
    known = Finding("undetermined", "the data do not determine it", "warning", subject="ggx.n")
    doubted = replace(plain, fit=replace(plain.fit, stderr={"ggx.n": np.array([0.01])}, warnings=(known,)))
    assert index_doubts(doubted) == ()


def test_an_answer_says_it_and_a_clean_plastic_s_does_not_seed_0():
    truth = {"lambertian.albedo": 0.3, "ggx.alpha": 0.2, "ggx.n": 1.5}
    data = synthetic.surface(models.get("lambertian+ggx"), synthetic.scan(), truth, noise=0.02)
    assert "no-index:ggx.n" not in [each["code"] for each in fit(data, timing=False).document["warnings"]]
    weak = replace(data, brdf=data.brdf - 0.93 * (data.brdf - 0.3 / np.pi))
    answer = fit(weak, ["lambertian+ggx"], timing=False)
    assert "no-index:ggx.n" in [each["code"] for each in answer.document["warnings"]]

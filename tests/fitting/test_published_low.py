"""The fits that Low et al. printed of two materials, read as they are, lie on their tables; ours lie closer."""

import json
import lzma
import re

import numpy as np
import pytest

from brdfguide import models
from brdfguide.data import subsample
from brdfguide.data.formats import read
from brdfguide.fitting import fit

NUMBER = r"([-+.e\d]+)"
LAWS = {"low-smooth": "low_lowsmooth_E2.fit", "low-facet": "low_lowmicrofacet_E2.fit"}


@pytest.fixture(scope="module", params=["red-plastic", "alum-bronze"])
def material(request, data, tmp_path_factory):
    """Name, and 1,500 directions of its table up to 80 deg."""
    path = tmp_path_factory.mktemp("merl") / f"{request.param}.binary"
    path.write_bytes(lzma.decompress((data / "merl_format" / f"{request.param}.binary.xz").read_bytes()))
    table = read(path)
    low = (table.geom.theta_i_deg[:, 0] <= 80) & (table.geom.theta_r_deg[:, 0] <= 80)
    table = table[np.flatnonzero(low)]
    return request.param, table[subsample.representative_rows(table, 1500)]


def printed(text, material, law):
    """Values of lambertian+law."""
    line = next(line for line in text.splitlines() if line.startswith(f"{material} = "))
    body, height = (np.array(json.loads(re.search(rf"{name} = (\[.*?\])", line)[1])) for name in ("albedo", r"\bA"))
    shape = {
        key: float(re.search(rf"\b{name} = {NUMBER}", line)[1]) for key, name in (("b", "B"), ("c", "C"), ("n", "eta"))
    }
    return {"lambertian.albedo": body, f"{law}.a": height} | {f"{law}.{key}": value for key, value in shape.items()}


@pytest.mark.parametrize("law", LAWS)
def test_printed_fit_lies_on_the_table_and_ours_closer(law, material, data):
    name, table = material
    surface = models.get(f"lambertian+{law}")
    values = printed((data / "merl_fits" / LAWS[law]).read_text(), name, law)
    miss = np.log(surface(table.geom, values) / table.brdf)[np.broadcast_to(table.usable, table.brdf.shape)]
    assert abs(np.median(miss)) < 0.1, "another constant in the height"
    assert fit.fit(surface, table).rms_ln < np.sqrt(np.mean(miss**2)) < 0.6

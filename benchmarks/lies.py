"""How often `inspect` accuses a clean file, and how often it notices a lie and undoes it; the same of files from an
instrument that drifts: 2 % of gain for each incidence, an arm's zero 0.2 degrees off (both normal).

python benchmarks/lies.py [draws]
"""

import os
import sys
import tempfile
from collections import Counter
from functools import partial
from itertools import product
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from benchmarks.recovery import drifted
from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.errors import BrdfguideError
from brdfguide.fitting.layout import Layout
from brdfguide.models.candidates import as_metal
from brdfguide.physics import hemisphere
from brdfguide.physics.geometry import Geometry, rows
from tests import synthetic
from tests.surfaces import table

LAWS = ("lambertian+ggx", "oren-nayar+ggx", "lambertian+beckmann", "lambertian+cook-torrance", "lambertian+he-torrance")
METALS = ("ggx", "beckmann")
GAPS = {"no-data-beyond-theta-i", "no-data-beyond-theta-r", "one-incidence"}  # true of the coverage, no accusation


def dome() -> Geometry:
    grid = np.meshgrid([0.0, 20.0, 40.0, 60.0, 75.0], np.r_[0.0:81.0:5.0], np.arange(0.0, 181.0, 30.0), indexing="ij")
    theta_i, theta_r, phi = (a.ravel() for a in grid)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


PLACES = {"hemisphere, 595 directions": dome(), "in plane, 6 scans of 4 deg": synthetic.scan()}


def sampled_surface(seed: int, geom: Geometry, drift: bool = False):
    """A random surface that keeps energy, with 0.3 to 3 % noise: values (samples,). Under `drift` as an instrument with
    a gain of its own at each incidence and a zero of its arm reports it."""
    random = np.random.default_rng([seed, 55])
    while True:
        name = (*LAWS, *METALS)[random.integers(len(LAWS) + len(METALS))]
        model = as_metal(models.get(name)) if name in METALS else models.get(name)
        values = synthetic.random_values(Layout(model, 1), random)
        values |= {key: random.uniform(0.02, 0.85) for key in values if key.endswith("albedo")}
        if np.max(hemisphere.dhr(partial(model, values=values), [10.0, 45.0, 75.0])) <= 1:
            noise = random.uniform(0.003, 0.03)
            data = synthetic.surface(model, geom, values, noise=noise, seed=seed)
            if drift:
                data = drifted(data, partial(model, values={**model.defaults(), **values}), random, noise)
            return data.brdf[:, 0]


def lies(geom: Geometry, f):
    """name -> columns of the file, codes of which one must appear, and whether the truth must come back."""
    theta_i, theta_r, phi = (a[:, 0] for a in (geom.theta_i_deg, geom.theta_r_deg, np.remainder(geom.phi_deg, 360)))
    signed, cos_i, cos_r = geom.signed_theta_r_deg[:, 0], geom.cos_i[:, 0], geom.cos_r[:, 0]
    plane = bool(np.all(geom.off_plane_deg < 0.1))
    angles = (
        {"theta_i": theta_i, "theta_r": signed} if plane else {"theta_i": theta_i, "theta_r": theta_r, "phi_r": phi}
    )
    turned = {**angles, "theta_r": -signed} if plane else {**angles, "phi_r": phi - 180}
    zero = 0 * theta_i
    named = {"phi_i": theta_i, "theta_i": zero, "phi_o": theta_r, "theta_o": phi}
    source = np.degrees(np.arccos(np.clip(geom.dot_xy + geom.cos_i * geom.cos_r, -1, 1)))[:, 0] < 12
    steep = theta_r > 72
    return {
        "the truth": (angles, f, set()),
        "times pi": (angles, np.pi * f, {"reflectance-factor", "too-bright"}),
        "times cos theta_r": (angles, cos_r * f, {"cosine-weighted"}),
        "times cos theta_i": (angles, cos_i * f, {"cosine-i-weighted", "not-reciprocal"}),
        "times pi cos theta_r": (angles, np.pi * cos_r * f, {"cosine-weighted"}),
        "mirror side exchanged": (turned, f, {"mirror-side-turned", "mirror-side-contradicted"}),
        "phi is the zenith": (named, f, {"phi-is-zenith"}),
        "angles in radians": ({key: np.radians(value) for key, value in angles.items()}, f, {"radians-inferred"}),
        "source blanked by zeros": (angles, np.where(source, 0.0, f), {"blocked-retro-zone"}),
        "grazing blanked by zeros": (angles, np.where(steep, 0.0, f), {"zeros-missing"}),
        "floor of 1e-4 at grazing": (angles, np.where(steep, 1e-4, f), {"floor"}),
    }


def tried(columns, values, truth, geom):
    """Codes found, whether the truth came back where a value is left, and whether values or sides were changed."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.csv"
        kept = np.isfinite(values)
        path.write_text(table((*columns, "brdf"), *(column[kept] for column in columns.values()), values[kept]))
        measurement = formats.read(path)
        try:
            after = examine.corrected(measurement)
        except BrdfguideError:
            return (
                {each.code for each in (*measurement.findings, *examine.examine(measurement))},
                measurement.findings,
                False,
            )
    found = examine.examine(after)
    usable = after.usable[:, 0]
    same = np.allclose(after.brdf[usable, 0], truth[kept][usable], rtol=1e-5) and np.allclose(
        after.geom.dot_xy, geom.dot_xy[kept], atol=1e-5
    )
    return {each.code for each in (*after.findings, *found)}, (*after.findings, *found), same


def main(samples: int) -> None:
    for (place, geom), drift in product(PLACES.items(), (False, True)):
        accused, noticed, undone, counted = Counter(), Counter(), Counter(), Counter()
        for seed in range(samples):
            truth = sampled_surface(seed, geom, drift)
            for name, (columns, values, wanted) in lies(geom, truth).items():
                codes, findings, same = tried(columns, values, truth, geom)
                counted[name] += 1
                noticed[name] += bool(codes & wanted)
                undone[name] += same
                if not wanted:
                    accused.update(
                        {each.code for each in findings if each.severity != "note" and each.code not in GAPS}
                    )
        print(
            f"{place}{', drifting' if drift else ''}: {samples} clean files, {samples - undone['the truth']} changed; "
            f"doubts raised: {dict(accused) or 'none'}"
        )
        for name in counted:
            if name != "the truth":
                print(f"  {name:26} noticed {noticed[name]:4}   right afterwards {undone[name]:4}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 200)

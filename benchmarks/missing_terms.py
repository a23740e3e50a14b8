"""Surfaces with one term beyond what is fitted to them, and plain ones: what `missing_term` names.

    python benchmarks/missing_terms.py [--surfaces 400] [--seed 26]

A body under a lobe of GGX's, with 2 % of noise over the hemisphere; to every surface but the plain ones a term is
added, or a coat put over it, that changes some direction by half at least. A body under GGX alone is fitted.
"""

import argparse
import os
import sys
from collections import Counter
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from brdfguide import models
from brdfguide.fitting import fit as fitting
from brdfguide.fitting.missing_term import missing_term
from tests import synthetic

NOISE = 0.02
LAWS = ("lambertian+ggx", "lambertian+beckmann", "lambertian+ward")
LEAST = 0.4  # |ln| by which the term changes its direction of most
KINDS = ("retro", "second lobe", "haze", "sheen", "flakes", "coat", "second axis")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--surfaces", type=int, default=400)
    parser.add_argument("--seed", type=int, default=26)
    asked = parser.parse_args()
    named: Counter = Counter()
    for number in range(asked.surfaces):
        kind = KINDS[number % len(KINDS)]
        named[kind, told(kind, np.random.default_rng([asked.seed, number]))] += 1
    for kind in KINDS:
        found = {other: count for (one, other), count in named.items() if one == kind}
        print(f"{kind:12} right {found.get(kind, 0)} of {sum(found.values())}; {found}")
    right = sum(count for (one, other), count in named.items() if one == other)
    print(f"named rightly {100 * right / asked.surfaces:.1f} % of {asked.surfaces}")
    plain = Counter(told("", np.random.default_rng([asked.seed + 1, number])) for number in range(asked.surfaces))
    wrong = asked.surfaces - plain[None]
    print(f"plain: invented in {100 * wrong / asked.surfaces:.1f} % of {asked.surfaces}: {dict(plain)}")


def told(kind: str, rng) -> str | None:
    """The kind that is named on a made surface that lacks this one."""
    law = models.get("lambertian+ggx")
    alpha = float(np.exp(rng.uniform(np.log(0.1), np.log(0.3))))
    base = {"lambertian.albedo": rng.uniform(0.05, 0.6), "ggx.alpha": alpha, "ggx.n": rng.uniform(1.4, 1.8)}
    geom = synthetic.hemisphere(500, int(rng.integers(2**31)), 75.0)
    if kind == "second axis":
        geom = turned(geom, rng)
    plain = synthetic.surface(law, geom, {**law.defaults(), **base})
    data = synthetic.surface(law, geom, {**law.defaults(), **base}, noise=NOISE, seed=int(rng.integers(2**31)))
    if kind:
        data.brdf[:] *= with_term(kind, plain, base, alpha, rng) / plain.brdf
    found = min(fitting.fit_all([models.get(each) for each in LAWS], data), key=lambda each: each.rms_ln)
    term = missing_term(found, data)
    return None if term is None else term.kind


def turned(geom, rng):
    """The same with the sample turned by some angle at every direction."""
    from brdfguide.physics.geometry import Geometry, rows

    turn = rng.choice([0.0, 45.0, 90.0], geom.shape)
    return rows(Geometry.from_degrees(geom.theta_i_deg, turn, geom.theta_r_deg, geom.phi_deg + turn))


def with_term(kind: str, plain, base, alpha: float, rng) -> np.ndarray:
    """The values with one term more, so high that it shows."""
    geom = plain.geom
    if kind == "coat":
        sum_of = models.get("ggx+coated:lambertian")
        values = {"lambertian.albedo": base["lambertian.albedo"], "ggx.alpha": alpha}
        return synthetic.surface(sum_of, geom, {**sum_of.defaults(), **sum_of.qualified(values)}).brdf
    if kind == "second axis":
        sum_of, ratio = models.get("lambertian+ggx-aniso"), rng.uniform(1.5, 3.0)
        values = {"albedo": base["lambertian.albedo"], "n": base["ggx.n"], "axis": 0.0}
        values |= {"alpha_x": alpha * np.sqrt(ratio), "alpha_y": alpha / np.sqrt(ratio)}
        return synthetic.surface(sum_of, geom, {**sum_of.defaults(), **sum_of.qualified(values)}).brdf
    expression, values = {
        "retro": ("retro", {"alpha": rng.uniform(0.05, 0.3)}),
        "second lobe": ("ggx", {"alpha": alpha * rng.uniform(0.2, 0.4)}),
        "haze": ("ggx", {"alpha": min(alpha * rng.uniform(2.5, 4.0), 0.8)}),
        "sheen": ("sheen", {"spread": rng.uniform(0.27, 0.6)}),
        "flakes": ("coated:flakes", {"tilt": rng.uniform(0.05, 0.2)}),
    }[kind]
    sum_of = models.get(expression)
    alone = synthetic.surface(sum_of, geom, {**sum_of.defaults(), **sum_of.qualified(values)}).brdf
    ratio = np.nan_to_num(alone) / plain.brdf
    height = np.expm1(rng.uniform(LEAST, 1.5)) / np.quantile(ratio, 0.98)
    return plain.brdf + height * np.nan_to_num(alone)


if __name__ == "__main__":
    main()

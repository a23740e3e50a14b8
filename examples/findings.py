"""What the guide says of its surfaces, each sentence as a question to the stand-ins of `study.py`.

Takes  cases, {(surface, variant, seed): Case}. Gives  (id, sentence of the guide, {(variant, seed): whether it holds}).
"""

import numpy as np

FOUR = ("phong", "ward", "lafortune", "he-torrance")
ALUMINIUM, PLASTIC, PAPER, PAINT = "S1 rough aluminium", "S2 rough plastic", "S3 white paper", "S5 metallic paint"


def all_findings(cases):
    """Those of every surface, then the one that compares them."""
    for of_surface in (of_aluminium, of_plastic, of_paper, of_paint):
        yield from of_surface(cases)
    yield "S0", "no model wins everywhere (of the four, at angles not fitted)", _winners_differ(cases)


def _over(cases, surface, holds):
    """holds(case, the aluminium's first variant with the same seed) for every case of a surface."""
    return {
        (variant, seed): bool(holds(case, cases[ALUMINIUM, "a", seed]))
        for (name, variant, seed), case in cases.items()
        if name == surface
    }


def of_aluminium(cases):
    yield (
        "S1.1",
        "a mirror peak emerges at 75° (5 % and more above the lobe) and not at 10° or 45° (2 %)",
        _over(cases, ALUMINIUM, lambda c, _: excess(c, 75) > 1.05 and max(excess(c, 10), excess(c, 45)) < 1.02),
    )
    yield (
        "S1.3",
        "He-Torrance fits the lobe best of the four",
        _over(cases, ALUMINIUM, lambda c, _: c.e["he-torrance"] < min(c.e[n] for n in FOUR[:3])),
    )
    yield (
        "S1.4",
        "only He-Torrance predicts the peak (model/data 0.5 to 2, the others below 0.3)",
        _over(
            cases,
            ALUMINIUM,
            lambda c, _: 0.5 < c.peak["he-torrance"] < 2 and max(c.peak[n] for n in FOUR[:3]) < 0.3,
        ),
    )
    yield (
        "S1.5a",
        "Phong rises least toward grazing (to 1 %: Ward rises alike by its formula)",
        _over(cases, ALUMINIUM, lambda c, _: c.rise["phong"] <= 1.01 * min(c.rise[n] for n in FOUR)),
    )
    yield (
        "S1.5b",
        "Phong rises not much less than the others (within 0.3 decades of He-Torrance)",
        _over(cases, ALUMINIUM, lambda c, _: abs(np.log10(c.rise["he-torrance"] / c.rise["phong"])) < 0.3),
    )


def of_plastic(cases):
    yield (
        "S2.2",
        "the plastic's lobe grows with angle at least twice as much as the metal's",
        _over(cases, PLASTIC, lambda c, metal: growth(c) > 2 * growth(metal)),
    )
    yield (
        "S2.3a",
        "the plastic's lobe is an order of magnitude below the metal's (5 to 20 times)",
        _over(cases, PLASTIC, lambda c, metal: 5 < lobe(metal) / lobe(c) < 20),
    )
    yield (
        "S2.3b",
        "the same of the whole BRDF in the mirror direction, floor included",
        _over(cases, PLASTIC, lambda c, metal: 5 < metal.truth[10, 10] / c.truth[10, 10] < 20),
    )
    yield (
        "S2.5",
        "the plastic's slope comes out larger than the metal's",
        _over(cases, PLASTIC, lambda c, metal: slope(c) > slope(metal)),
    )
    yield (
        "S2.6a",
        "He-Torrance and Lafortune fit at least twice as well as Phong and Ward",
        _over(
            cases,
            PLASTIC,
            lambda c, _: max(c.e["he-torrance"], c.e["lafortune"]) < 0.5 * min(c.e["ward"], c.e["phong"]),
        ),
    )
    yield (
        "S2.6b",
        "Phong and Ward reach less than half of the data at (75°, 75°)",
        _over(cases, PLASTIC, lambda c, _: max(c.peak["phong"], c.peak["ward"]) < 0.5),
    )


def of_paper(cases):
    yield (
        "S3.2",
        "paper rises strongly toward grazing (mirror direction, 10° to 75°: more than 3 times)",
        _over(cases, PAPER, lambda c, _: c.truth[75, 75] > 3 * c.truth[10, 10]),
    )
    yield (
        "S3.3a",
        "He-Torrance and Lafortune fit paper better than 0.65 of Phong's and Ward's error",
        _over(
            cases,
            PAPER,
            lambda c, _: max(c.e["he-torrance"], c.e["lafortune"]) < 0.65 * min(c.e["ward"], c.e["phong"]),
        ),
    )
    yield (
        "S3.3b",
        "Lafortune (one lobe) fits paper best of the four",
        _over(cases, PAPER, lambda c, _: c.e["lafortune"] <= min(c.e[n] for n in FOUR)),
    )
    yield (
        "S3.3c",
        "Lafortune (two lobes) fits paper better than He-Torrance",
        _over(cases, PAPER, lambda c, _: c.e["lafortune:2"] <= c.e["he-torrance"]),
    )


def of_paint(cases):
    yield (
        "S5.1",
        "metallic paint changes little with incidence (mirror direction, within a factor 1.5)",
        _over(cases, PAINT, lambda c, _: 1 / 1.5 < c.truth[75, 75] / c.truth[10, 10] < 1.5),
    )
    yield (
        "S5.2a",
        "Phong fits metallic paint better than Ward and He-Torrance at 75°",
        _over(cases, PAINT, lambda c, _: c.e75["phong"] < min(c.e75["ward"], c.e75["he-torrance"])),
    )
    yield (
        "S5.2b",
        "the same over all angles",
        _over(cases, PAINT, lambda c, _: c.e["phong"] < min(c.e["ward"], c.e["he-torrance"])),
    )
    yield (
        "S5.2c",
        "the same with He-Torrance's scale set free",
        _over(cases, PAINT, lambda c, _: c.e["phong"] < min(c.e["ward"], c.e["he-torrance, scale free"])),
    )
    yield (
        "S5.2d",
        "Lafortune matches metallic paint best of the four",
        _over(cases, PAINT, lambda c, _: c.e["lafortune"] <= min(c.e[n] for n in FOUR)),
    )
    yield (
        "S5.3a",
        "(ours) flakes under a coat fit metallic paint better than each of the four",
        _over(cases, PAINT, lambda c, _: c.e["coated:flakes"] < min(c.e[n] for n in FOUR)),
    )
    yield (
        "S5.3b",
        "(ours) and rise no more than the paint does (within a factor 1.5 of 1, mirror direction)",
        _over(cases, PAINT, lambda c, _: 1 / 1.5 < c.rise["coated:flakes"] < 1.5),
    )


def _winners_differ(cases):
    """For each seed, over the first variant of each surface."""
    first = {}
    for name, variant, _ in cases:
        first.setdefault(name, variant)
    winners = {seed: set() for _, _, seed in cases}
    for seed, names in winners.items():
        names.update(min(FOUR, key=cases[name, variant, seed].held.get) for name, variant in first.items())
    return {("all", seed): len(names) > 1 for seed, names in winners.items()}


def excess(case, theta) -> float:
    """Data in the mirror direction over a cubic in ln f through the neighbours 4 to 10 degrees off."""
    off = np.array([-10, -8, -6, -4, 4, 6, 8, 10.0])
    smooth = np.polyfit(off, np.log([case.truth[theta, theta + x] for x in off]), 3)
    return case.truth[theta, theta] / np.exp(smooth[-1])


def slope(case) -> float:
    """sigma/tau as He-Torrance finds it."""
    return case.fits["he-torrance"].values["he-torrance.slope"]


def lobe(case) -> float:
    """Peak of the lobe at 10 degrees over the floor."""
    return case.truth[10, 10] - min(value for (i, _), value in case.truth.items() if i == 10)


def growth(case) -> float:
    """Growth of the lobe's peak from 10 to 75 degrees."""
    low, high = ([v for (i, _), v in case.truth.items() if i == theta_i] for theta_i in (10, 75))
    return (max(high) - min(high)) / (max(low) - min(low))

"""The guide's findings about its five surfaces, tried on independent synthetic stand-ins.

    python examples/study.py > docs/study.md

Each model is fitted to what a simulated gonioreflectometer reads at 10, 45 and 75 degrees of incidence, for five seeds of
its noise and each variant of the stand-in, and judged also at 30, 60 and 80 degrees, which no fit has seen. He-Torrance is
fitted with its mirror part as the receiver reads it. A finding re-emerges if it holds for every seed and variant. Nothing
was tuned: thresholds stood in the specification before the first run. Four things were mended after it: S1.1 first compared
the data with a fitted lobe, itself off by more than the peak; S1.5a asked which of two equal numbers is smaller; samples
near the mirror direction at 75 degrees were left out of the fits, which hid from He-Torrance that paper has no peak there;
and its mirror part was counted on the paint, whose data exclude it.
"""

import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np

from brdfguide import fitting, models, predict, preview
from brdfguide.exporters._base import Surface
from brdfguide.geometry import in_plane, rows
from brdfguide.measurement import Measurement

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "samples"))
from instrument import measure, read_truth  # noqa: E402

SEEDS = (1, 2, 3, 4, 5)
SEEN, UNSEEN = (10.0, 45.0, 75.0), (30.0, 60.0, 80.0)
OMEGA = np.pi * np.radians(1.5) ** 2  # of the simulated receiver [sr]
FOUR = ("phong", "ward", "lafortune", "he-torrance")
MORE = ("phong-lewis", "lafortune:2", "cook-torrance", "ggx")
SURFACES = {
    "S1 rough aluminium": ("rough_aluminium", "ab", {"n": 0.958, "k": 6.69}),
    "S2 rough plastic": ("rough_plastic", "ab", {"n": 1.5}),
    "S3 white paper": ("white_paper", "bcl", {"n": 1.5}),
    "S5 metallic paint": ("metallic_paint", "ab", {"n": 1.5}),
}


def measurement(found, omega) -> Measurement:
    theta_i, theta_r, value, stderr = np.array(found).T
    return Measurement(rows(in_plane(theta_i, theta_r, np.array([0.55]))), value[:, None], stderr=stderr[:, None], solid_angle=omega)


class Case:
    """One stand-in, one seed: fits and what they say."""

    def __init__(self, surface, variant, seed):
        stem, _, index = SURFACES[surface]
        self.omega = None if surface.startswith("S5") else OMEGA  # the mirror image of the paint's coat is excluded, as in the report
        _, i, r, f = read_truth(HERE / "samples" / "truth" / f"{stem}_{variant}.csv")
        self.truth = {(a, b): f[m, n] for m, a in enumerate(i) for n, b in enumerate(r)}
        self.seen = measurement(measure(i, r, f, seed, SEEN)[0], self.omega)
        self.unseen = measurement(measure(i, r, f, seed, UNSEEN)[0], self.omega)
        theta_i, theta_r = self.seen.geom.theta_i_deg[:, 0], self.seen.geom.signed_theta_r_deg[:, 0]
        self.fits, self.e, self.e75, self.held, self.peak, self.rise = {}, {}, {}, {}, {}, {}
        for name in FOUR + MORE + ("he-torrance, scale free",):
            law = name.partition(",")[0]
            held = {f"{law}.{key}": value for key, value in index.items()} if law in ("he-torrance", "cook-torrance", "ggx") else {}
            held |= {} if law != "he-torrance" else {"he-torrance.scale": 1.0}
            model = models.get(f"lambertian+{law}")
            if name != law:
                held.pop("he-torrance.scale")
                model = replace(model, free=("he-torrance.scale",))
            found = fitting.fit(model, self.seen, fitting.Options(fixed=held, weights="none"))
            self.fits[name] = found
            residual = self.residual(found, self.seen)
            self.e[name] = rms(residual)
            self.e75[name] = rms(residual[theta_i == 75])
            self.held[name] = rms(self.residual(found, self.unseen))
            self.peak[name] = float(np.exp(np.mean(residual[(theta_i == 75) & (np.abs(theta_r - 75) <= 1)])))
            at = lambda theta: self.reading(found, rows(in_plane([theta], [theta], np.array([0.55]))))[0, 0]  # noqa: E731
            self.rise[name] = at(75) / at(10)

    def reading(self, found, geom):
        return predict.reading(found.model, geom, found.values, self.omega) if self.omega else found.model(geom, found.values)

    def residual(self, found, data):
        return np.log(self.reading(found, data.geom) / data.brdf)[:, 0]


def rms(values) -> float:
    return float(np.sqrt(np.mean(values**2)))


def excess(case, theta) -> float:
    """What sticks out of the curve in the mirror direction: data over a cubic in ln f through the neighbours 4 to 10 degrees off."""
    off = np.array([-10, -8, -6, -4, 4, 6, 8, 10.0])
    smooth = np.polyfit(off, np.log([case.truth[theta, theta + x] for x in off]), 3)
    return case.truth[theta, theta] / np.exp(smooth[-1])


def findings(cases):
    """(id, sentence of the guide, {(variant, seed): holds}, remark)."""
    def over(surface, test):
        return {(v, s): bool(test(case)) for (name, v, s), case in cases.items() if name == surface}

    s1, s2, s3, s5 = SURFACES
    yield "S1.1", "a mirror peak emerges at 75° (5 % and more above the lobe) and not at 10° or 45° (2 %)", over(s1, lambda c: excess(c, 75) > 1.05 and max(excess(c, 10), excess(c, 45)) < 1.02)
    yield "S1.3", "He-Torrance fits the lobe best of the four", over(s1, lambda c: c.e["he-torrance"] < min(c.e[n] for n in FOUR[:3]))
    yield "S1.4", "only He-Torrance predicts the peak (model/data 0.5 to 2, the others below 0.3)", over(s1, lambda c: 0.5 < c.peak["he-torrance"] < 2 and max(c.peak[n] for n in FOUR[:3]) < 0.3)
    yield "S1.5a", "Phong rises least toward grazing (to 1 %: Ward rises alike by its formula)", over(s1, lambda c: c.rise["phong"] <= 1.01 * min(c.rise[n] for n in FOUR))
    yield "S1.5b", "Phong rises not much less than the others (within 0.3 decades of He-Torrance)", over(s1, lambda c: abs(np.log10(c.rise["he-torrance"] / c.rise["phong"])) < 0.3)
    yield "S2.2", "the plastic's lobe grows with angle at least twice as much as the metal's", {
        (v, s): bool(growth(c) > 2 * growth(cases[s1, "a", s])) for (name, v, s), c in cases.items() if name == s2}  # fmt: skip
    yield "S2.3a", "the plastic's lobe is an order of magnitude below the metal's (5 to 20 times)", {
        (v, s): bool(5 < lobe(cases[s1, "a", s]) / lobe(c) < 20) for (name, v, s), c in cases.items() if name == s2}  # fmt: skip
    yield "S2.3b", "the same of the whole BRDF in the mirror direction, floor included", {
        (v, s): bool(5 < cases[s1, "a", s].truth[10, 10] / c.truth[10, 10] < 20) for (name, v, s), c in cases.items() if name == s2}  # fmt: skip
    yield "S2.5", "the plastic's slope comes out larger than the metal's", {
        (v, s): bool(c.fits["he-torrance"].values["he-torrance.slope"] > cases[s1, "a", s].fits["he-torrance"].values["he-torrance.slope"])
        for (name, v, s), c in cases.items() if name == s2}  # fmt: skip
    yield "S2.6a", "He-Torrance and Lafortune fit at least twice as well as Phong and Ward", over(s2, lambda c: max(c.e["he-torrance"], c.e["lafortune"]) < 0.5 * min(c.e["ward"], c.e["phong"]))
    yield "S2.6b", "Phong and Ward reach less than half of the data at (75°, 75°)", over(s2, lambda c: max(c.peak["phong"], c.peak["ward"]) < 0.5)
    yield "S3.2", "paper rises strongly toward grazing (mirror direction, 10° to 75°: more than 3 times)", over(s3, lambda c: c.truth[75, 75] > 3 * c.truth[10, 10])
    yield "S3.3a", "He-Torrance and Lafortune fit paper better than 0.65 of Phong's and Ward's error", over(s3, lambda c: max(c.e["he-torrance"], c.e["lafortune"]) < 0.65 * min(c.e["ward"], c.e["phong"]))
    yield "S3.3b", "Lafortune (one lobe) fits paper best of the four", over(s3, lambda c: c.e["lafortune"] <= min(c.e[n] for n in FOUR))
    yield "S3.3c", "Lafortune (two lobes) fits paper better than He-Torrance", over(s3, lambda c: c.e["lafortune:2"] <= c.e["he-torrance"])
    yield "S5.1", "metallic paint changes little with incidence (mirror direction, within a factor 1.5)", over(s5, lambda c: 1 / 1.5 < c.truth[75, 75] / c.truth[10, 10] < 1.5)
    yield "S5.2a", "Phong fits metallic paint better than Ward and He-Torrance at 75°", over(s5, lambda c: c.e75["phong"] < min(c.e75["ward"], c.e75["he-torrance"]))
    yield "S5.2b", "the same over all angles", over(s5, lambda c: c.e["phong"] < min(c.e["ward"], c.e["he-torrance"]))
    yield "S5.2c", "the same with He-Torrance's scale set free", over(s5, lambda c: c.e["phong"] < min(c.e["ward"], c.e["he-torrance, scale free"]))
    yield "S5.2d", "Lafortune matches metallic paint best of the four", over(s5, lambda c: c.e["lafortune"] <= min(c.e[n] for n in FOUR))
    winner = lambda c: min(FOUR, key=c.held.get)  # noqa: E731
    yield "S0", "no model wins everywhere (of the four, at angles not fitted)", {
        ("all", s): len({winner(cases[name, v, s]) for name, (_, variants, _) in SURFACES.items() for v in variants[:1]}) > 1 for s in SEEDS}  # fmt: skip


def lobe(case) -> float:
    """Peak of the lobe at 10 degrees over the floor."""
    return case.truth[10, 10] - min(value for (i, _), value in case.truth.items() if i == 10)


def growth(case) -> float:
    """Growth of the lobe's peak from 10 to 75 degrees."""
    peak = lambda i: max(v for (a, _), v in case.truth.items() if a == i) - min(v for (a, _), v in case.truth.items() if a == i)  # noqa: E731
    return peak(75) / peak(10)


def verdict(holds) -> str:
    by_variant = defaultdict(list)
    for (variant, _), value in holds.items():
        by_variant[variant].append(value)
    always = [v for v, values in by_variant.items() if all(values)]
    never = [v for v, values in by_variant.items() if not any(values)]
    if len(always) == len(by_variant):
        return "re-emerges"
    if len(never) == len(by_variant):
        return "does not re-emerge"
    if len(always) + len(never) == len(by_variant):
        return f"depends on the variant: holds for {', '.join(always)}, not for {', '.join(never)}"
    return "depends on the noise: " + ", ".join(f"{v} {sum(values)} of {len(values)}" for v, values in by_variant.items())


def table(header, lines) -> str:
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in (header, ["---"] * len(header), *lines))


def steel():
    """S4: the report's own roughness, not fitted, against the stand-in; both divided by their mirror peak at 4 degrees."""
    model = models.get("he-torrance")
    values = {**model.defaults(), "he-torrance.sigma": 0.08, "he-torrance.slope": 0.08 / 1.52, "he-torrance.n": 2.87, "he-torrance.k": 3.36}
    omega = np.pi * np.radians(0.4) ** 2
    lines = []
    for variant in "ab":
        _, i, r, f = read_truth(HERE / "samples" / "truth" / f"smooth_steel_{variant}.csv")
        geom = rows(in_plane(i[:, None], r[None, :], np.array([0.633])))
        model_f = predict.reading(model, geom, values, omega).reshape(f.shape)
        scale = model_f[0, r == i[0]][0] / f[0, r == i[0]][0]
        for theta, curve, own in zip(i, f * scale, model_f):
            off = np.abs(r - theta)
            ratio = lambda low, high: np.exp(np.mean(np.log(own / curve)[(off >= low) & (off < high) & (np.abs(r) < 80)]))  # noqa: E731, B023
            spike = 1 - model(rows(in_plane([theta], [theta], np.array([0.633]))), values)[0, 0] / own[r == theta][0]
            near = curve[(off > 2) & (off < 4)].mean()
            lines.append((variant, f"{theta:g}", f"{own[r == theta][0] / curve[r == theta][0]:.2f}", f"{ratio(2, 10):.2f}", f"{ratio(10, 20):.2f}", f"{ratio(30, 45):.2f}", f"{curve[r == theta][0] / near:.0f}", f"{spike:.2f}"))
    return lines


def rendered(cases):
    """Figures 6 and 8: display-free luminance of Phong over Lafortune on the preview's sphere, sun at the back."""
    seen = preview.view(256)
    sphere = (seen.covered == 1) & (np.arange(256)[:, None] < 0.66 * 256)
    theta = np.degrees(np.arccos(seen.normal[..., 2]))
    for surface, variant in (("S2 rough plastic", "a"), ("S3 white paper", "b")):
        light = []
        for name in ("phong", "lafortune"):
            found = cases[surface, variant, 1].fits[name]
            light.append(preview.luminance(preview.render(Surface(found.model, found.values), 256, "back")))
        yield [surface] + [f"{light[0][m].mean() / light[1][m].mean():.2f}" for m in (sphere & (theta >= a) & (theta < b) for a, b in ((0, 20), (20, 40), (40, 60), (60, 75), (75, 85)))]


def main(seeds: int = len(SEEDS)) -> None:
    global SEEDS
    SEEDS = tuple(range(1, seeds + 1))
    cases = {(name, variant, seed): Case(name, variant, seed) for name, (_, variants, _) in SURFACES.items() for variant in variants for seed in SEEDS}
    print("# The guide's findings on synthetic stand-ins\n")
    print("Made by `python examples/study.py`; do not edit. Nothing here was measured on real aluminium, plastic, paper, steel or paint: the")
    print("stand-ins and their levels of independence are described in `examples/samples/`. He-Torrance is given the true index, which the")
    print("other models do not need; S1 and S4 come from the same physics as He-Torrance with other statistics (level L1), so a comparison")
    print("of it with the rest is tilted its way there; S2, S3 and S5 come from geometric optics (L2), close to the microfacet models.\n")
    print("".join(__doc__.split("\n\n", 2)[2:]).strip() + "\n")
    print("## Findings\n")
    found = [(key, words, verdict(holds)) for key, words, holds in findings(cases)]
    print(table(("id", "the guide says", "here"), found))
    count = lambda word: sum(each[2].startswith(word) for each in found)  # noqa: E731
    print(f"\n{count('re-emerges')} of {len(found)} re-emerge, {count('does not')} do not, {count('depends')} depend on variant or noise.\n")
    print("## Errors, rms ln: median over the seeds (at fitted angles / at 30, 60, 80°)\n")
    names = FOUR + MORE + ("he-torrance, scale free",)
    lines = []
    for name, (_, variants, _) in SURFACES.items():
        for v in variants:
            part = [cases[name, v, s] for s in SEEDS]
            lines.append([f"{name}, {v}"] + [f"{np.median([c.e[n] for c in part]):.3f} / {np.median([c.held[n] for c in part]):.3f}" for n in names])
    print(table(("surface, variant", *names), lines))
    print("\n## Growth from 10° to 75° in the mirror direction, and model over data at (75°, 75°)\n")
    lines = []
    for name, (_, variants, _) in SURFACES.items():
        for v in variants:
            part = [cases[name, v, s] for s in SEEDS]
            lines.append([f"{name}, {v}", f"{part[0].truth[75, 75] / part[0].truth[10, 10]:.2f}"]
                         + [f"{np.median([c.rise[n] for c in part]):.2f}, {np.median([c.peak[n] for c in part]):.2f}" for n in FOUR + ("lafortune:2",)])  # fmt: skip
    print(table(("surface, variant", "data", *FOUR, "lafortune:2"), lines))
    print("\n## S4, nearly smooth steel: He-Torrance at the report's sigma 0.08 um and tau 1.52 um, not fitted\n")
    print("Model over stand-in, both divided by their peak at 4°: at the mirror direction and at 2-10, 10-20, 30-45° from it.\n")
    print(table(("variant", "theta_i", "mirror", "2-10°", "10-20°", "30-45°", "peak over lobe", "mirror share of the peak"), steel()))
    print("\n## Figures 6 and 8 by rendered pixels: luminance of Phong over one-lobe Lafortune on a sphere\n")
    print(table(("surface", "theta_r 0-20°", "20-40°", "40-60°", "60-75°", "75-85°"), rendered(cases)))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

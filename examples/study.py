"""The guide's findings about its five surfaces, tried on independent synthetic stand-ins.

    python examples/study.py > docs/study.md

Each model is fitted to what a simulated gonioreflectometer reads at 10, 45 and 75 degrees of incidence, for five seeds
of its noise and each variant of the stand-in, and judged also at 30, 60 and 80 degrees, which no fit has seen.
He-Torrance is fitted with its mirror part as the receiver reads it. A finding re-emerges if it holds for every seed and
variant. Nothing was tuned: thresholds stood in the specification before the first run. Four things were mended after
it: S1.1 first compared the data with a fitted lobe, itself off by more than the peak; S1.5a asked which of two equal
numbers is smaller; samples near the mirror direction at 75 degrees were left out of the fits, which hid from
He-Torrance that paper has no peak there; and its mirror part was counted on the paint, whose data exclude it.
"""

import sys
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np

from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.fitting import fit
from brdfguide.fitting.reading import reading
from brdfguide.models.surface import Surface
from brdfguide.physics.aperture import Instrument
from brdfguide.physics.colour import luminance
from brdfguide.physics.geometry import in_plane, rows
from brdfguide.report import render

sys.path.insert(0, str(Path(__file__).resolve().parent / "samples"))
from findings import ALUMINIUM, FOUR, PAINT, PAPER, PLASTIC, all_findings
from instrument import measure, read_truth

HERE = Path(__file__).resolve().parent
SEEN, UNSEEN = (10.0, 45.0, 75.0), (30.0, 60.0, 80.0)
OMEGA = np.pi * np.radians(1.5) ** 2  # of the simulated receiver [sr]
MORE = ("phong-lewis", "lafortune:2", "cook-torrance", "ggx", "student-t")
COATED = "coated:flakes"  # of the paint alone: the others show a mirror peak of their own, no coat's
SURFACES = {
    ALUMINIUM: ("rough_aluminium", "ab", {"n": 0.958, "k": 6.69}),
    PLASTIC: ("rough_plastic", "ab", {"n": 1.5}),
    PAPER: ("white_paper", "bcl", {"n": 1.5}),
    PAINT: ("metallic_paint", "ab", {"n": 1.5}),
}


def measurement(found, omega) -> Measurement:
    theta_i, theta_r, value, stderr = np.array(found).T
    return Measurement(
        rows(in_plane(theta_i, theta_r, np.array([0.55]))), value[:, None], stderr=stderr[:, None], solid_angle=omega
    )


class Case:
    """One stand-in, one seed: fits and what they say."""

    def __init__(self, surface, variant, seed):
        stem, _, index = SURFACES[surface]
        # the mirror image of the paint's coat is excluded, as in the report
        self.omega = None if surface == PAINT else OMEGA
        _, i, r, f = read_truth(HERE / "samples" / "truth" / f"{stem}_{variant}.csv")
        self.truth = {(a, b): f[m, n] for m, a in enumerate(i) for n, b in enumerate(r)}
        self.fitted_to = measurement(measure(i, r, f, seed, SEEN)[0], self.omega)
        self.unseen = measurement(measure(i, r, f, seed, UNSEEN)[0], self.omega)
        theta_i, theta_r = self.fitted_to.geom.theta_i_deg[:, 0], self.fitted_to.geom.signed_theta_r_deg[:, 0]
        self.fits, self.e, self.e75, self.held, self.peak, self.rise = {}, {}, {}, {}, {}, {}
        for name in FOUR + MORE + ("he-torrance, scale free",) + ((COATED,) if surface == PAINT else ()):
            model_name = name.partition(",")[0]
            held = (
                {f"{model_name}.{key}": value for key, value in index.items()}
                if model_name in ("he-torrance", "cook-torrance", "ggx", "student-t")
                else {}
            )
            held |= {} if model_name != "he-torrance" else {"he-torrance.scale": 1.0}
            model = models.get("coated:lambertian+flakes" if name == COATED else f"lambertian+{model_name}")
            if name != model_name:
                held.pop("he-torrance.scale")
                model = replace(model, free=("he-torrance.scale",))
            found = fit.fit(model, self.fitted_to, fit.FitOptions(fixed=held, weights="none"))
            self.fits[name] = found
            residual = self.residual(found, self.fitted_to)
            self.e[name] = rms(residual)
            self.e75[name] = rms(residual[theta_i == 75])
            self.held[name] = rms(self.residual(found, self.unseen))
            self.peak[name] = float(np.exp(np.mean(residual[(theta_i == 75) & (np.abs(theta_r - 75) <= 1)])))
            self.rise[name] = self.in_the_mirror(found, 75) / self.in_the_mirror(found, 10)

    def in_the_mirror(self, found, theta):
        return self.reading(found, rows(in_plane([theta], [theta], np.array([0.55]))))[0, 0]

    def reading(self, found, geom):
        return reading(found.surface, Instrument(geom, self.omega))

    def residual(self, found, data):
        return np.log(self.reading(found, data.geom) / data.brdf)[:, 0]


def rms(values) -> float:
    return float(np.sqrt(np.mean(values**2)))


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
    return "depends on the noise: " + ", ".join(
        f"{v} {sum(values)} of {len(values)}" for v, values in by_variant.items()
    )


def table(header, lines) -> str:
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in (header, ["---"] * len(header), *lines))


def steel():
    """S4: the report's own roughness, not fitted, against the stand-in; both divided by their mirror peak at 4
    degrees.
    """
    model = models.get("he-torrance")
    values = {
        **model.defaults(),
        "he-torrance.sigma": 0.08,
        "he-torrance.slope": 0.08 / 1.52,
        "he-torrance.n": 2.87,
        "he-torrance.k": 3.36,
    }
    omega = np.pi * np.radians(0.4) ** 2
    lines = []
    for variant in "ab":
        _, i, r, f = read_truth(HERE / "samples" / "truth" / f"smooth_steel_{variant}.csv")
        geom = rows(in_plane(i[:, None], r[None, :], np.array([0.633])))
        model_f = reading(Surface(model, values, wavelength=geom.wavelength), Instrument(geom, omega)).reshape(f.shape)
        scale = model_f[0, r == i[0]][0] / f[0, r == i[0]][0]
        for theta, curve, own in zip(i, f * scale, model_f, strict=True):
            off = np.abs(r - theta)
            ratios = [
                np.exp(np.mean(np.log(own / curve)[(off >= low) & (off < high) & (np.abs(r) < 80)]))
                for low, high in ((2, 10), (10, 20), (30, 45))
            ]
            spike = 1 - model(rows(in_plane([theta], [theta], np.array([0.633]))), values)[0, 0] / own[r == theta][0]
            near = curve[(off > 2) & (off < 4)].mean()
            lines.append(
                (
                    variant,
                    f"{theta:g}",
                    f"{own[r == theta][0] / curve[r == theta][0]:.2f}",
                    *(f"{ratio:.2f}" for ratio in ratios),
                    f"{curve[r == theta][0] / near:.0f}",
                    f"{spike:.2f}",
                )
            )
    return lines


def rendered(cases):
    """Figures 6 and 8: display-free luminance of Phong over Lafortune on the preview's sphere, sun at the back."""
    view = render.view(256)
    sphere = (view.covered == 1) & (np.arange(256)[:, None] < 0.66 * 256)
    theta = np.degrees(np.arccos(view.normal[..., 2]))
    for surface, variant in ((PLASTIC, "a"), (PAPER, "b")):
        light = []
        for name in ("phong", "lafortune"):
            found = cases[surface, variant, 1].fits[name]
            light.append(luminance(render.render(ColouredSurface(found.model, found.values), 256, "back")))
        yield [surface] + [
            f"{light[0][m].mean() / light[1][m].mean():.2f}"
            for m in (sphere & (theta >= a) & (theta < b) for a, b in ((0, 20), (20, 40), (40, 60), (60, 75), (75, 85)))
        ]


INTRODUCTION = """# The guide's findings on synthetic stand-ins

Made by `python examples/study.py`; do not edit. Nothing here was measured on real aluminium, plastic, paper, steel or
paint: the stand-ins and their levels of independence are described in `examples/samples/`. He-Torrance is given the
true index, which the other models do not need; S1 and S4 come from the same physics as He-Torrance with other
statistics (level L1), so a comparison of it with the rest is tilted its way there; S2, S3 and S5 come from geometric
optics (L2), close to the microfacet models. S5.3 is ours, not the guide's: the law of section 4.5's explanation, flakes
seen through a coat, is nearly the paint's generator, so that its closeness is no evidence; its growth is what is shown.
"""


def main(seeds: int = 5) -> None:
    cases = {
        (name, variant, seed): Case(name, variant, seed)
        for name, (_, variants, _) in SURFACES.items()
        for variant in variants
        for seed in range(1, seeds + 1)
    }
    print(INTRODUCTION)
    print("".join(__doc__.split("\n\n", 2)[2:]).strip() + "\n")
    print("## Findings\n")
    found = [(key, words, verdict(holds)) for key, words, holds in all_findings(cases)]
    print(table(("id", "the guide says", "here"), found))
    again, not_, depends = (
        sum(each[2].startswith(word) for each in found) for word in ("re-emerges", "does not", "depends")
    )
    print(f"\n{again} of {len(found)} re-emerge, {not_} do not, {depends} depend on variant or noise.\n")
    print("## Errors, rms ln: median over the seeds (at fitted angles / at 30, 60, 80°)\n")
    names = FOUR + MORE + ("he-torrance, scale free", COATED)
    print(table(("surface, variant", *names), errors(cases, names, seeds)))
    print("\n## Growth from 10° to 75° in the mirror direction, and model over data at (75°, 75°)\n")
    names = FOUR + ("lafortune:2", COATED)
    print(table(("surface, variant", "data", *names), growths(cases, names, seeds)))
    print("\n## S4, nearly smooth steel: He-Torrance at the report's sigma 0.08 um and tau 1.52 um, not fitted\n")
    print(
        "Model over stand-in, both divided by their peak at 4°: at the mirror direction and at 2-10, 10-20, 30-45° "
        "from it.\n"
    )
    header = ("variant", "theta_i", "mirror", "2-10°", "10-20°", "30-45°", "peak over lobe", "mirror share of the peak")
    print(table(header, steel()))
    print("\n## Figures 6 and 8 by rendered pixels: luminance of Phong over one-lobe Lafortune on a sphere\n")
    print(table(("surface", "theta_r 0-20°", "20-40°", "40-60°", "60-75°", "75-85°"), rendered(cases)))


def over_seeds(cases, seeds: int):
    """(surface and variant in words, its cases with each seed)."""
    for name, (_, variants, _) in SURFACES.items():
        for variant in variants:
            yield f"{name}, {variant}", [cases[name, variant, seed] for seed in range(1, seeds + 1)]


def errors(cases, names, seeds: int):
    for words, part in over_seeds(cases, seeds):
        yield [words, *(two_medians([c.e for c in part], [c.held for c in part], n, ".3f", " / ") for n in names)]


def growths(cases, names, seeds: int):
    for words, part in over_seeds(cases, seeds):
        data = part[0].truth[75, 75] / part[0].truth[10, 10]
        both = (two_medians([c.rise for c in part], [c.peak for c in part], n, ".2f", ", ") for n in names)
        yield [words, f"{data:.2f}", *both]


def two_medians(one, other, name, form, between) -> str:
    """Of a model over the seeds; "-" where it was not fitted."""
    if name not in one[0]:
        return "-"
    return between.join(format(np.median([each[name] for each in values]), form) for values in (one, other))


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))

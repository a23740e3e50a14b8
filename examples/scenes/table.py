"""Every worked scene with six materials: what can be left out, what that changes and saves; and pictures to look at.

    python examples/scenes/table.py [FOLDER]      writes FOLDER/scenes.md, scenes.png and scenes_look.png, by default
                                                  to docs/

Each scene is pruned twice: so that no pixel is seen to change, and with `tolerance: look`, so that the picture keeps
its look side by side. Each picture stands three times: the whole model, what is left of it, and the difference of the
display's code values, amplified about mid grey. What is left is picked by operations and then timed: times are of this
machine; picks and errors are not. A brushed metal beside the six shows what its grain is worth.
"""

import sys
from dataclasses import replace
from math import radians
from pathlib import Path

import numpy as np

from brdfguide import models
from brdfguide.models import cost
from brdfguide.models.surface import Surface
from brdfguide.numerics import sphere
from brdfguide.report.figures import style
from brdfguide.scene import prune, radiance, scene, search
from brdfguide.scene.difference import Picture, lobe_width
from brdfguide.scene.features import Features
from brdfguide.scene.radiance import Quadrature

HERE = Path(__file__).resolve().parent
NAMES = ("frontal_product_shot", "sphere_with_a_lamp", "road_at_sunset", "gallery_light", "satellite_at_grazing_sun")
# ours: heights [um], slopes and albedos that span matt to mirror-like; indices of plastic, and of iron at 550 nm
MATERIALS = {
    "rough plastic": (
        "coupled+he-torrance",
        {"coupled.albedo": 0.5, "he-torrance.sigma": 1.2, "he-torrance.slope": 0.15},
    ),
    "satin black": (
        "coupled+he-torrance",
        {"coupled.albedo": 0.02, "he-torrance.sigma": 0.3, "he-torrance.slope": 0.1},
    ),
    "lapped lacquer": (
        "coupled+he-torrance",
        {"coupled.albedo": 0.3, "he-torrance.sigma": 0.08, "he-torrance.slope": 0.0526},
    ),
    "wall paint": ("coupled+ggx", {"coupled.albedo": 0.8, "ggx.alpha": 0.5}),
    "blasted iron": (
        "he-torrance",
        {"he-torrance.sigma": 1.5, "he-torrance.slope": 0.2, "he-torrance.n": 2.9, "he-torrance.k": 3.1},
    ),
    "varnished wood": (
        "lambertian+ward+mirror",
        {"lambertian.albedo": 0.15, "ward.rho_s": 0.02, "ward.alpha": 0.15, "mirror.sigma": 0.05},
    ),
}
# brushed 316 steel (n and k at 550 nm), three times as wide across the grain as along it: ours
BRUSHED = (
    "ggx-aniso",
    {"ggx-aniso.alpha_x": 0.3, "ggx-aniso.alpha_y": 0.1, "ggx-aniso.n": 1.612, "ggx-aniso.k": 3.487},
)
ANY_WAY = (0.0, 360.0)
AMPLIFIED, AMPLIFIED_LOOK = 16, 4
SIZE = 120


def pixels_of(where: scene.Scene, size: int):
    """Camera and light of each pixel, in the frame of the surface there; (size², 3) twice, and which pixels show the
    object.
    """
    y, x = np.mgrid[1 : -1 : size * 1j, -1 : 1 : size * 1j].reshape(2, -1)
    light = where.lights[0].directions
    middle = radians(sum(light.theta_deg) / 2)
    if where.shape == "sphere":
        inside = x * x + y * y < 1
        normal = np.stack(
            [np.where(inside, x, 0), np.where(inside, y, 0), np.sqrt(np.where(inside, 1 - x * x - y * y, 1))], axis=1
        )
        to_light = np.array([0.7 * np.sin(middle), 0.714 * np.sin(middle), np.cos(middle)])
        frame = np.stack([*sphere.tangents(normal), normal], axis=1)
        return frame @ np.array([0.0, 0.0, 1.0]), frame @ (to_light / np.linalg.norm(to_light)), inside
    low, high = where.camera.theta_deg
    # corners stay within the camera's angles
    centre, half = ((low + high) / 2, (high - low) / 2) if low > 0 else (0.0, high / np.sqrt(2))
    across, up = np.radians(half * x), np.radians(centre + half * y)
    azimuth = np.radians(sum(light.phi_deg) / 2) if light.phi_deg != (0.0, 360.0) else 0.0
    facing = azimuth + np.pi  # the camera looks across the normal at the light
    forward = np.stack([np.sin(up) * np.cos(across), np.sin(across), np.cos(up) * np.cos(across)], axis=1)
    turn = np.array([[np.cos(facing), -np.sin(facing), 0], [np.sin(facing), np.cos(facing), 0], [0, 0, 1]])
    to_light = sphere.from_angles(np.cos(middle), azimuth)
    camera = forward @ turn.T
    return camera, np.broadcast_to(to_light, camera.shape), camera[:, 2] > 0


def pictures(found: prune.Pruned, size: int):
    """Code values (size, size), 0 to 1, of the whole model and of what is left."""
    camera, light, inside = pixels_of(found.scene, size)
    lights = np.broadcast_to(light[:, None, :], (len(light), len(found.scene.lights), 3))
    view = Quadrature(found.scene, 0, np.full(len(light), 1 / len(light)), camera, lights, 0.05)
    picture = Picture(Features(found.whole), view)
    display = found.scene.display
    for surface in (found.whole, found.surface):
        codes = (display.shown(picture.radiance(surface)[:, 0]) / display.white) ** (1 / display.gamma)
        yield np.where(inside, codes, 0.0).reshape(size, size)


def pruned(surface: Surface, where: scene.Scene) -> prune.Pruned:
    """What a scene needs of a surface by operations, so that the pick is the same everywhere, with measured times."""
    found = prune.prune(surface, where, timing=False)
    seen = radiance.sample(where, found.pixels, found.seed, lobe_width(surface))
    directions = search.cost_directions(Picture(Features(surface), seen))
    laws = search.evaluator(surface), search.evaluator(found.surface)
    if not found.ablation.out:
        alone = cost.times({"": laws[0]}, directions)[""]
        return replace(found, whole_time=alone, time=alone)
    whole, left = cost.compare_times(*laws, directions)
    return replace(found, whole_time=whole, time=left)


def worth_of_a_grain():
    """Of each scene: its name, and the worst error without the grain as it lies and turned any way [JND]."""
    surface = Surface(models.get(BRUSHED[0]), BRUSHED[1])
    for path in NAMES:
        where, worst = scene.read_scene(HERE / f"{path}.yaml"), []
        for turn in (None, ANY_WAY):
            print(f"{where.name}: brushed metal", file=sys.stderr)
            found = prune.prune(surface, replace(where, turn_deg=turn), timing=False)
            [grain] = [each for each in found.singles if each.feature.name == "anisotropy"]
            worst.append(grain.errors.visible)
        yield where.name, *worst


def markdown(rows, look_rows, grains) -> str:
    """The tables, a line for each scene and material."""
    lines = [
        "# What five scenes do not need of six materials",
        "",
        "Made by `python examples/scenes/table.py`; do not edit. Errors are in just noticeable differences of",
        "displayed luminance (mean, 95 % of the picture, worst visible), fresh: worst on other directions of the same",
        "scene. seen: difference in lightness L* on a sphere under lamps all around, beyond the scene",
        "([seen.md](seen.md)). Picks are by operations, as with `--no-timing`, and so the same on every machine; by",
        "times, `recommend --scene` leaves out only what is measured to save. ns per evaluation: one thread, NumPy, in",
        "turns; ± is the standard error of what is saved. Materials and scenes are ours, made up to span the range.",
        "",
        "pick: what is left out, since nobody sees it there. A law by itself is left out as a whole, after a point a",
        "part of it: coupling, what the interface keeps of the body's light; fresnel, the growth of reflection toward",
        "grazing; masking, facets that hide each other; mirror, the image that stands out of the lobe; series, He and",
        "Torrance's sum, for facets with a first correction; waves, that correction too. *instead*: this law, with",
        "numbers fitted over the scene, takes the place of the lobes.",
        "",
        "## No pixel is seen to change, not even in a flicker test: the scenes' own tolerances",
        "",
        *table(rows),
        "",
        "![whole, pruned and amplified difference](scenes.png)",
        "",
        "## It keeps its look side by side: `tolerance: look`",
        "",
        "95 % of the picture within 9 and the worst within 20 (15 and 30 in colour); in a cut or a flicker test the",
        "change shows. Both limits are needed: with 95 % alone a sphere loses its highlight.",
        "",
        *table(look_rows),
        "",
        "![whole, pruned and amplified difference](scenes_look.png)",
        "",
        "## A grain",
        "",
        "None of the six looks different once it is turned in its plane. A brushed metal does (`ggx-aniso`, alpha 0.3",
        "across the grain and 0.1 along it, index of steel). A scene says by `turn_deg` how it lies; where it does",
        "not, the law's `axis` counts from azimuth 0 of the object. Its anisotropy is a part like others: without it",
        "the lobe is round, refitted over the scene. What that costs at worst, in just noticeable differences:",
        "",
        "| scene | as it lies | turned any way |",
        "| --- | --- | --- |",
        *[f"| {name} | {lies:.0f} | {turned:.0f} |" for name, lies, turned in grains],
        "",
        "How the numbers of the specification's worked example become the program's:",
        "[worked_example.md](worked_example.md).",
    ]
    return "\n".join(lines) + "\n"


def table(rows) -> list[str]:
    """One tolerance's lines."""
    lines = [
        "| scene | material | pick | mean | p95 | worst | fresh | seen L* | ns whole | ns pick | saved |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name, found in rows:
        what, saved = "all of it", "-"
        if found.ablation.out:
            instead = f"{found.surface.model.name} instead, " if found.substitute else ""
            what = f"{instead}without {found.ablation}"
            saved = f"{found.saving.ns:.0f} ± {found.saving.stderr:.0f} ({found.whole_time.ns / found.time.ns:.1f}x)"
        e, ns = found.errors, (found.whole_time.ns, found.time.ns)
        lines.append(
            f"| {found.scene.name} | {name} | {what} | {e.mean:.2f} | {e.p95:.2f} | {e.visible:.2f} | "
            f"{found.fresh.visible:.2f} | {found.seen:.1f} | {ns[0]:.0f} | {ns[1]:.0f} | {saved} |"
        )
    return lines


def figure(rows, amplified: int) -> bytes:
    """A strip for each scene and material: whole, pruned, difference amplified about mid grey; under it what was
    gained.
    """
    with style.look():
        fig = style.figure(190, 100)
        axes = fig.subplots(len(MATERIALS), len(NAMES))
        for (name, found), ax in zip(rows, axes.T.ravel(), strict=True):
            whole, left = pictures(found, SIZE)
            gap = np.ones((SIZE, 4))
            strip = np.hstack([whole, gap, left, gap, np.clip(0.5 + amplified * (left - whole), 0, 1)])
            ax.imshow(strip, cmap="gray", vmin=0, vmax=1, interpolation="none", aspect="equal")
            ax.set_xticks([])
            ax.set_yticks([])
            gained = (
                f"{found.whole_time.ns / found.time.ns:.1f}x faster, {found.errors.visible:.1f} JND at worst"
                if found.ablation.out
                else "all of it is needed"
            )
            ax.set_xlabel(gained, fontsize=5.5, labelpad=2)
            for edge in ax.spines.values():
                edge.set_visible(False)
            if ax in axes[0]:
                ax.set_title(found.scene.name.removesuffix(" on a varnished wall"), fontsize=7)
            if ax in axes[:, 0]:
                ax.set_ylabel(name, fontsize=6.5, rotation=0, ha="right", va="center")
        style.origin(
            fig,
            (
                f"each: whole model, what is left of it, difference of code values {amplified} times amplified about "
                f"mid grey"
            ),
        )
        return style.figure_file(fig, "png")


def main(folder: Path) -> None:
    rows, look_rows = [], []
    for path in NAMES:
        where = scene.read_scene(HERE / f"{path}.yaml")
        looser = replace(where, tolerance=scene.Tolerance.keeps_look(where.colour))
        for name, (expression, values) in MATERIALS.items():
            print(f"{where.name}: {name}", file=sys.stderr)
            surface = Surface(models.get(expression), values)
            rows.append((name, pruned(surface, where)))
            look_rows.append((name, pruned(surface, looser)))
    folder.mkdir(exist_ok=True)
    (folder / "scenes.md").write_text(markdown(rows, look_rows, list(worth_of_a_grain())))
    (folder / "scenes.png").write_bytes(figure(rows, AMPLIFIED))
    (folder / "scenes_look.png").write_bytes(figure(look_rows, AMPLIFIED_LOOK))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent.parent / "docs")

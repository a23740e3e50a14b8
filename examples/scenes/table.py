"""Every worked scene with six materials: what can be left out, what that changes and saves; and pictures to look at.

    python examples/scenes/table.py [FOLDER]      writes FOLDER/scenes.md and FOLDER/scenes.png, by default to docs/

Each picture stands three times: the whole model, what is left of it, and the difference of the display's code values,
sixteen times amplified about mid grey. Times are of this machine; picks and errors are not.
"""

import sys
from math import radians
from pathlib import Path

import numpy as np

from brdfguide import draws, models, pruning, scene
from brdfguide.parts import Parts
from brdfguide.picture import Picture
from brdfguide.quadrature import Quadrature
from brdfguide.report import style

HERE = Path(__file__).resolve().parent
NAMES = ("frontal_product_shot", "sphere_with_a_lamp", "road_at_sunset", "gallery_light", "satellite_at_grazing_sun")
# ours: heights [um], slopes and albedos that span matt to mirror-like; indices of plastic, and of iron at 550 nm
MATERIALS = {
    "rough plastic": ("coupled+he-torrance", {"coupled.albedo": 0.5, "he-torrance.sigma": 1.2, "he-torrance.slope": 0.15}),
    "satin black": ("coupled+he-torrance", {"coupled.albedo": 0.02, "he-torrance.sigma": 0.3, "he-torrance.slope": 0.1}),
    "lapped lacquer": ("coupled+he-torrance", {"coupled.albedo": 0.3, "he-torrance.sigma": 0.08, "he-torrance.slope": 0.0526}),
    "wall paint": ("coupled+ggx", {"coupled.albedo": 0.8, "ggx.alpha": 0.5}),
    "blasted iron": ("he-torrance", {"he-torrance.sigma": 1.5, "he-torrance.slope": 0.2, "he-torrance.n": 2.9, "he-torrance.k": 3.1}),
    "varnished wood": ("lambertian+ward+mirror", {"lambertian.albedo": 0.15, "ward.rho_s": 0.02, "ward.alpha": 0.15, "mirror.sigma": 0.05}),
}
AMPLIFIED = 16
SIZE = 120


def pixels_of(where: scene.Scene, size: int):
    """Camera and light of each pixel, in the frame of the surface there; (size², 3) twice, and which pixels show the object."""
    y, x = np.mgrid[1 : -1 : size * 1j, -1 : 1 : size * 1j].reshape(2, -1)
    light = where.lights[0].directions
    middle = radians(sum(light.theta_deg) / 2)
    if where.shape == "sphere":
        inside = x * x + y * y < 1
        normal = np.stack([np.where(inside, x, 0), np.where(inside, y, 0), np.sqrt(np.where(inside, 1 - x * x - y * y, 1))], axis=1)
        to_light = np.array([0.7 * np.sin(middle), 0.714 * np.sin(middle), np.cos(middle)])
        frame = np.stack([*draws.tangents(normal), normal], axis=1)
        return frame @ np.array([0.0, 0.0, 1.0]), frame @ (to_light / np.linalg.norm(to_light)), inside
    low, high = where.camera.theta_deg
    centre, half = ((low + high) / 2, (high - low) / 2) if low > 0 else (0.0, high / np.sqrt(2))  # corners stay within the camera's angles
    across, up = np.radians(half * x), np.radians(centre + half * y)
    azimuth = np.radians(sum(light.phi_deg) / 2) if light.phi_deg != (0.0, 360.0) else 0.0
    facing = azimuth + np.pi  # the camera looks across the normal at the light
    forward = np.stack([np.sin(up) * np.cos(across), np.sin(across), np.cos(up) * np.cos(across)], axis=1)
    turn = np.array([[np.cos(facing), -np.sin(facing), 0], [np.sin(facing), np.cos(facing), 0], [0, 0, 1]])
    to_light = draws.from_angles(np.cos(middle), azimuth)
    camera = forward @ turn.T
    return camera, np.broadcast_to(to_light, camera.shape), camera[:, 2] > 0


def pictures(found: pruning.Pruned, size: int):
    """Code values (size, size), 0 to 1, of the whole model and of what is left."""
    camera, light, inside = pixels_of(found.scene, size)
    lights = np.broadcast_to(light[:, None, :], (len(light), len(found.scene.lights), 3))
    view = Quadrature(found.scene, 0, np.full(len(light), 1 / len(light)), camera, lights, 0.05)
    picture = Picture(Parts(found.whole, found.whole_values, np.array([0.55])), view.at(np.array([0.55])))
    display = found.scene.display
    for sum_, values in ((found.whole, found.whole_values), (found.sum, found.values)):
        codes = (display.shown(picture.radiance(sum_, values)[:, 0]) / display.white) ** (1 / display.gamma)
        yield np.where(inside, codes, 0.0).reshape(size, size)


def markdown(rows) -> str:
    """The table, a line for each scene and material."""
    lines = [
        "# What five scenes do not need of six materials",
        "",
        "Made by `python examples/scenes/table.py`; do not edit. Errors are in just noticeable differences of displayed luminance",
        "(mean, 95 % of the picture, worst visible), fresh: worst on other directions of the same scene. ns per evaluation, one thread,",
        "NumPy, in turns; ± is the standard error of what is saved. Materials and scenes are ours, made up to span the range.",
        "",
        "| scene | material | pick | mean | p95 | worst | fresh | ns whole | ns pick | saved |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    for name, found in rows:
        if found.cut.out:
            what = f"{found.sum.name} instead, without {found.cut}" if found.stand_in else f"without {found.cut}"
            saved = f"{found.saving.ns:.0f} ± {found.saving.stderr:.0f} ({found.whole_time.ns / found.time.ns:.1f}x)"
        else:
            what, saved = "all of it", "-"
        e = found.errors
        lines.append(
            f"| {found.scene.name} | {name} | {what} | {e.mean:.2f} | {e.p95:.2f} | {e.visible:.2f} | {found.fresh.visible:.2f} "
            f"| {found.whole_time.ns:.0f} | {found.time.ns:.0f} | {saved} |"
        )
    lines += ["", "How the numbers of the specification's worked example become the program's: [worked_example.md](worked_example.md)."]
    return "\n".join(lines) + "\n\n![whole, pruned and amplified difference](scenes.png)\n"


def figure(rows) -> bytes:
    """A strip for each scene and material: whole, pruned, difference amplified about mid grey; under it what was gained."""
    with style.look():
        fig = style.figure(190, 100)
        axes = fig.subplots(len(MATERIALS), len(NAMES))
        for (name, found), ax in zip(rows, axes.T.ravel()):
            whole, left = pictures(found, SIZE)
            gap = np.ones((SIZE, 4))
            strip = np.hstack([whole, gap, left, gap, np.clip(0.5 + AMPLIFIED * (left - whole), 0, 1)])
            ax.imshow(strip, cmap="gray", vmin=0, vmax=1, interpolation="none", aspect="equal")
            ax.set_xticks([])
            ax.set_yticks([])
            gained = f"{found.whole_time.ns / found.time.ns:.1f}x faster, {found.errors.visible:.1f} JND at worst" if found.cut.out else "all of it is needed"
            ax.set_xlabel(gained, fontsize=5.5, labelpad=2)
            for edge in ax.spines.values():
                edge.set_visible(False)
            if ax in axes[0]:
                ax.set_title(found.scene.name.removesuffix(" on a varnished wall"), fontsize=7)
            if ax in axes[:, 0]:
                ax.set_ylabel(name, fontsize=6.5, rotation=0, ha="right", va="center")
        style.origin(fig, f"each: whole model, what is left of it, difference of code values {AMPLIFIED} times amplified about mid grey")
        return style.render(fig, "png")


def main(folder: Path) -> None:
    rows = []
    for path in NAMES:
        where = scene.read_scene(HERE / f"{path}.yaml")
        for name, (expression, values) in MATERIALS.items():
            print(f"{where.name}: {name}", file=sys.stderr)
            rows.append((name, pruning.prune(models.get(expression), values, where)))
    folder.mkdir(exist_ok=True)
    (folder / "scenes.md").write_text(markdown(rows))
    (folder / "scenes.png").write_bytes(figure(rows))


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE.parent.parent / "docs")

"""Typed numbers in real programs: spheres by Mitsuba's principled and Blender's Principled, beside our preview.

    python -m tests.exporters.typed_spheres docs/pictures/typed-spheres.png [office-paper copper ...]

The numbers are those of `brdfguide numbers`, typed by this script; the light is the preview's sky, ground and sun.
Needs mitsuba, and for Blender an interpreter with bpy named by BPY_PYTHON.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from brdfguide.exporters import coloured
from brdfguide.exporters.cards import Card, cards
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.face.surfaces import every_described
from brdfguide.report import render

from .sphere import MARGIN, by_preview, rendered_by_mitsuba

MATERIALS = ("office-paper", "rough-plastic", "porcelain", "copper", "sandblasted-aluminium")
PROGRAMS = ("Mitsuba", "Blender")
BLENDER = """
import json, sys
import bpy
import numpy as np
asked = json.load(open(sys.argv[1]))
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device, scene.cycles.samples, scene.cycles.max_bounces = "CPU", asked["samples"], 1
scene.cycles.use_denoising = False
scene.cycles.pixel_filter_type = "BOX"
scene.cycles.sample_clamp_indirect = 0
scene.render.resolution_x = scene.render.resolution_y = asked["size"]
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
rows = np.array(asked["sky"], np.float32)  # from the nadir up; y is up in our scene, z in Blender's
pixels = np.ones((len(rows), 4, 4), np.float32)
pixels[:, :, :3] = rows[:, None, :]
image = bpy.data.images.new("sky", 4, len(rows), float_buffer=True)
image.colorspace_settings.name = "Linear Rec.709"
image.pixels.foreach_set(pixels.ravel())
image.update()
world = bpy.data.worlds.new("world")
scene.world, world.use_nodes = world, True
nodes = world.node_tree.nodes
sky = nodes.new("ShaderNodeTexEnvironment")
sky.image, sky.interpolation = image, "Linear"
world.node_tree.links.new(sky.outputs[0], nodes["Background"].inputs[0])
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.angle = 0.0
sun.data.color, sun.data.energy = asked["sun_colour"], asked["sun_strength"]
sun.rotation_mode = "QUATERNION"
from mathutils import Vector
sun.rotation_quaternion = Vector(asked["sun_from"]).to_track_quat("Z", "Y")
scene.collection.objects.link(sun)
camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale = "ORTHO", 2 * asked["margin"]
camera.location, camera.rotation_euler = (0, -5, 0), (np.pi / 2, 0, 0)
scene.collection.objects.link(camera)
scene.camera = camera
bpy.ops.mesh.primitive_uv_sphere_add(segments=512, ring_count=256, radius=1.0)
ball = bpy.context.object
bpy.ops.object.shade_smooth()
for place, numbers in enumerate(asked["numbers"]):
    material = bpy.data.materials.new(f"typed {place}")
    material.use_nodes = True
    inputs = material.node_tree.nodes["Principled BSDF"].inputs
    for label, value in numbers.items():
        inputs[label].default_value = (*value, 1.0) if isinstance(value, list) else value
    ball.data.materials.clear()
    ball.data.materials.append(material)
    path = f"{asked['folder']}/{place}.exr"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    shown = bpy.data.images.load(path)
    shown.colorspace_settings.name = "Linear Rec.709"
    flat = np.empty(4 * asked["size"] ** 2, np.float32)
    shown.pixels.foreach_get(flat)
    np.save(f"{asked['folder']}/{place}.npy", flat.reshape(asked["size"], asked["size"], 4)[::-1, :, :3])
"""


def card_of(name: str, program: str) -> tuple[ColouredSurface, Card]:
    """The candidate that the program's numbers are of, and the card."""
    surfaces = [coloured(each, name) for each in every_described(name)]
    [card] = [each for each in cards(surfaces) if each.program == program]
    return next(each for each in surfaces if each.model.name == card.model), card


def by_mitsuba(card: Card, size: int, samples: int) -> np.ndarray:
    """Radiance (size, size, 3) of Mitsuba's `principled` with the card's numbers."""
    plugin: dict = {"type": "principled"}
    for label, value in card.numbers.items():
        plugin[label] = {"type": "rgb", "value": list(value)} if isinstance(value, tuple) else value
    if plugin["metallic"]:
        plugin.pop("eta")  # of no meaning for a metal, and Mitsuba takes one alone
    return rendered_by_mitsuba(plugin, size, samples)


def by_blender(found: list[Card], size: int, samples: int) -> list[np.ndarray]:
    """Radiance (size, size, 3) of Blender's Principled BSDF with each card's numbers, by Cycles."""
    height = np.sin(np.pi * ((np.arange(1024) + 0.5) / 1024 - 0.5))
    sun = render.sun_direction("side")
    with tempfile.TemporaryDirectory() as folder:
        asked = {
            "folder": folder,
            "size": size,
            "samples": samples,
            "margin": MARGIN,
            "sky": render.sky(height).tolist(),
            "sun_from": [float(sun[0]), float(-sun[2]), float(sun[1])],
            "sun_colour": (render.SUN / render.SUN.max()).tolist(),
            "sun_strength": float(render.SUN.max()),
            "numbers": [{k: list(v) if isinstance(v, tuple) else v for k, v in each.numbers.items()} for each in found],
        }
        script, job = Path(folder) / "blender.py", Path(folder) / "job.json"
        script.write_text(BLENDER)
        job.write_text(json.dumps(asked))
        words = [os.environ["BPY_PYTHON"], str(script), str(job)]
        run = subprocess.run(words, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr[-2000:]
        return [np.load(Path(folder) / f"{place}.npy") for place in range(len(found))]


def apart(theirs: np.ndarray, ours: np.ndarray, on: np.ndarray) -> tuple[float, float]:
    """Median of |difference| over the mean radiance, and the ratio of the mean radiances, over the sphere's inside."""
    mean = ours[on].mean()
    return float(np.median(np.abs((theirs - ours)[on].mean(axis=-1))) / mean), float(theirs[on].mean() / mean)


def main(path: str, names=MATERIALS, size: int = 120, samples: int = 48) -> None:
    from matplotlib.figure import Figure

    found = {name: {program: card_of(name, program) for program in PROGRAMS} for name in names}
    blender = by_blender([found[name]["Blender"][1] for name in names], size, samples)
    figure = Figure(figsize=(1.75 * len(names), 5.2), layout="constrained", facecolor="white")
    panels = figure.subplots(3, len(names), squeeze=False)
    for column, name in enumerate(names):
        surface, card = found[name]["Mitsuba"]
        ours, on = by_preview(surface, size)
        shown = {
            "our preview": ours,
            "Mitsuba principled": by_mitsuba(card, size, samples),
            "Blender Principled": blender[column],
        }
        for row, (title, image) in enumerate(shown.items()):
            panel = panels[row][column]
            panel.imshow(np.where(on[..., None], render.tone(np.where(on[..., None], image, 0.0)), 1.0))
            panel.set(xticks=[], yticks=[])
            panel.set_frame_on(False)
            if column == 0:
                panel.set_ylabel(title, fontsize=9)
            if row == 0:
                panel.set_title(name, fontsize=9)
            else:
                median, ratio = apart(image, ours, on)
                panel.set_xlabel(f"median {median:.1%} apart\nmean {ratio - 1:+.1%}", fontsize=7)
                off = found[name][title.split()[0]][1].off
                print(f"{name}, {title}: median {median:.2%}, mean {ratio - 1:+.2%}; the card says rms ln {off:.3f}")
    figure.savefig(path, dpi=150, metadata={"Software": None})


if __name__ == "__main__":
    main(sys.argv[1], tuple(sys.argv[2:]) or MATERIALS)

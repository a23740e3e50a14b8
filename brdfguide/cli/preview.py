"""`brdfguide preview SURFACE`: how it looks, on a sphere and a bent sheet, beside others."""

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from ..errors import InputError
from ._options import QuietOption, note, on_terminal

EXAMPLES = (
    'Examples: brdfguide preview "lambertian+ggx ggx.alpha=0.1" -o look.png | '
    'brdfguide preview fit.json --compare fit.json#lambertian+phong --light back -o pair.png'
)


def preview(
    surface: Annotated[str, Argument(metavar="SURFACE", help='A model with its parameters in one word ("ward ward.alpha=0.1"), a fit (FIT.json, FIT.json#MODEL), or a material.')],
    compare: Annotated[list[str] | None, Option("--compare", "-c", help="Another surface to stand beside it; repeatable.")] = None,
    output: Annotated[Path, Option("--output", "-o", help="The picture, .png.")] = Path("preview.png"),
    light: Annotated[str, Option("--light", help="Where the sun stands: front, side or back.")] = "side",
    size: Annotated[int, Option("--size", help="Pixels, for each surface.")] = 512,
    quiet: QuietOption = False,
) -> None:
    """Render a surface on a sphere and a bent sheet under a small sun and a sky with a horizon, in linear light."""
    from .. import preview as renderer
    from ..errors import choices
    from ..outputs import writable
    from ..report import picture, style
    from ._surface import named_surface

    if light not in renderer.LIGHTS_DEG:
        raise choices("place for the sun", light, renderer.LIGHTS_DEG)
    if not 64 <= size <= 2048:
        raise InputError(f"--size {size}: a picture has 64 to 2048 pixels")
    if writable(output).suffix.lower() != ".png":
        raise InputError(f"{output}: a preview is a .png")
    surfaces = [named_surface(words) for words in (surface, *(compare or ()))]
    images = [renderer.render(each, size, light, _progress(each.name, quiet)) for each in surfaces]
    elevation, azimuth = renderer.LIGHTS_DEG[light]
    about = f"sun {elevation:g}° high, {azimuth:g}° to the right of the camera; same exposure; {surfaces[0].colour.how}"
    style.save(picture.sheet([_caption(each) for each in surfaces], images, about), output)
    note(f"{output}: {' | '.join(each.name for each in surfaces)}", quiet)


def _caption(surface) -> tuple[str, str]:
    """Name, and the parameters that shape what is seen."""
    import numpy as np

    short = lambda value: f"{np.mean(value):.3g}" + (" on average" if np.ptp(value) > 0 else "")  # noqa: E731
    shapes = surface.model.parameters
    words = []
    for key, value in surface.values.items():
        if key in shapes and (shapes[key].free or short(value) != "0"):
            turned = shapes[key].unit == "rad"
            words.append(f"{key} {short(np.degrees(value) if turned else value)} {'°' if turned else shapes[key].unit}".strip())
    return surface.name, ", ".join(words)


def _progress(name: str, quiet: bool):
    """A line that fills on a terminal, nothing elsewhere."""
    import sys

    if quiet or not on_terminal(sys.stderr):
        return None

    def show(share: float) -> None:
        print(f"\r{name} {'█' * int(30 * share):<30} {100 * share:3.0f} %", end="\n" if share >= 1 else "", file=sys.stderr, flush=True)

    return show

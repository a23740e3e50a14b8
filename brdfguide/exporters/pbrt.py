"""pbrt-v4: named materials for `Include`; `conductor`, `diffuse` and a `mix` of both.

pbrt's conductor has no factor of its own and its mix weighs two materials, so a body and a lobe must share the light:
a paint is a refit. `remaproughness` would take the square root of the roughness, so it is always false and alpha is
written; below alpha = 1e-3 pbrt makes a mirror, so that is the least here. pbrt is spectral: wavelengths are written as
they are, colours as rgb. Nothing else runs here to check the file with: its grammar is tested, its values are our
law's.
"""

from dataclasses import replace

import numpy as np

from ..physics.fresnel import fresnel
from ..physics.geometry import Geometry
from ..printable import identifier
from . import _grained, _smooth, _target_models
from ._choice import choose, fresnel_index, has_body, has_lobe, what_is_lost
from ._smooth import choose_smooth, is_smooth
from .exporter import ColouredSurface, Export, Exporter, comment_lines, number, numbers, refuse_mirror

WIDE = (360.0, 830.0)  # pbrt's range [nm]


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Text for `Include` and its Statement."""
    name, spectral = identifier(surface.name), not (surface.colour.named or is_smooth(surface))
    lost: tuple[str, ...] = ()
    if is_smooth(surface):
        choice = _polished(surface)
    else:
        lost = refuse_mirror(surface, "pbrt", "rgl-spectral") + what_is_lost(surface)
        choice = choose(surface, geom, _candidates(surface, spectral), spectral=spectral)
    axis = _grained.axis_of(surface)
    notes = () if axis is None else _grained.tangent_note(axis, "dpdu")
    how = "wavelengths as they are" if spectral else ""
    statement = choice.statement("pbrt", surface, lost=lost, notes=notes, colour=how)
    values = choice.values
    lines = [f"# {line}" for line in comment_lines(surface, statement)]
    amount = number(values.get("amount", 1.0 if "n" in values else 0.0), 0.0, 1.0, "amount")
    body = [
        (
            f'    "string type" "diffuse"  '
            f"{_spectrum(surface, spectral, 'reflectance', values.get('albedo', 0.0), 0.0, 1.0)}"
        )
    ]
    widths = f'"float roughness" {values.get("alpha", 0.0):.9g}'
    if "alpha_x" in values:
        widths = f'"float uroughness" {values["alpha_x"]:.9g}  "float vroughness" {values["alpha_y"]:.9g}'
    lobe = [
        f'    "string type" "conductor"  "bool remaproughness" false  {widths}',
        f"    {_spectrum(surface, spectral, 'eta', values.get('n', 1.5), 1e-3, 100.0)}",
        f"    {_spectrum(surface, spectral, 'k', values.get('k', 0.0), 0.0, 100.0)}",
    ]
    if amount == 0:
        lines += [f'MakeNamedMaterial "{name}"', *body]
    elif amount == 1:
        lines += [f'MakeNamedMaterial "{name}"', *lobe]
    else:
        lines += [f'MakeNamedMaterial "{name}_body"', *body, f'MakeNamedMaterial "{name}_lobe"', *lobe]
        lines += [
            f'MakeNamedMaterial "{name}"',
            f'    "string type" "mix"  "string materials" [ "{name}_body" "{name}_lobe" ]  "float amount" {amount:.9g}',
        ]
    return Export("\n".join(lines) + "\n", statement)


def _candidates(surface: ColouredSurface, spectral: bool) -> dict:
    targets = {"body": _target_models.body_alone()} if has_body(surface) else {}
    if not has_lobe(surface):
        return targets
    axis, index = _grained.axis_of(surface), fresnel_index(surface, spectral)
    target = _target_models.mixed() if axis is None else _grained.grained_mix(axis)
    if not has_body(surface):
        targets["fitted n"] = target.with_fixed(albedo=0.0, amount=1.0, k=0.0)
        if index is not None:
            targets["own n, k"] = target.with_fixed(albedo=0.0, amount=1.0, n=index[0], k=index[1])
    else:
        targets["mix, fitted n"] = target.with_fixed(k=0.0)
        if index is not None and np.any(index[1]):
            targets["mix, own n, k"] = target.with_fixed(n=index[0], k=index[1])
    return targets


def _polished(surface: ColouredSurface):
    """A conductor without roughness, with its own n and k where that is all there is to it."""
    targets, of_mirror = _smooth.pbrt(has_body(surface)), surface.values_of(surface.model.term("mirror"))
    index = fresnel_index(surface)
    if not has_body(surface) and index is not None and np.all(of_mirror["sigma"] == 0):
        targets = {"mirror": ((), lambda cos, **_: fresnel(cos, *index), None)}
        choice = choose_smooth(surface, targets)
        return replace(choice, values={"n": index[0], "k": index[1]})
    return choose_smooth(surface, targets)


def _spectrum(surface: ColouredSurface, spectral: bool, name: str, values, low: float, high: float) -> str:
    """A parameter as pbrt's spectrum: constant, by wavelength, or rgb."""
    values = numbers(values, low, high, name)
    if len(set(values)) == 1:
        return f'"spectrum {name}" [ {WIDE[0]:g} {values[0]:.9g} {WIDE[1]:g} {values[0]:.9g} ]'
    if not spectral:
        return f'"rgb {name}" [ {" ".join(f"{value:.9g}" for value in values)} ]'
    nm = 1e3 * surface.wavelengths
    pairs = " ".join(f"{nm[c]:.9g} {values[c]:.9g}" for c in np.argsort(nm))
    return f'"spectrum {name}" [ {pairs} ]'


EXPORTER = Exporter(__name__, ".pbrt", "pbrt-v4 named materials (conductor, diffuse, mix)", export, grained=True)

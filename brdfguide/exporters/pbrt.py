"""pbrt-v4: named materials for `Include`; `conductor`, `diffuse` and a `mix` of both.

pbrt's conductor has no factor of its own and its mix weighs two materials, so a body and a lobe must share the light:
a paint is a refit. `remaproughness` would take the square root of the roughness, so it is always false and alpha is
written; below alpha = 1e-3 pbrt makes a mirror, so that is the least here. pbrt is spectral: wavelengths are written as
they are, colours as rgb. Nothing else runs here to check the file with: its grammar is tested, its values are our law's.
"""

from dataclasses import replace

import numpy as np

from ..geometry import Geometry
from ..optics import fresnel
from . import _laws, _smooth
from ._base import Export, Exporter, Surface, header, identifier, number, numbers, refuse_mirror
from ._choice import choose, fresnel_index, has_body, has_lobe, what_is_lost
from ._smooth import choose_smooth, is_smooth

WIDE = (360.0, 830.0)  # pbrt's range [nm]


def export(surface: Surface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """Text for `Include` and its Statement."""
    name, spectral = identifier(surface.name), not (surface.colour.named or is_smooth(surface))
    if is_smooth(surface):
        choice, lost = _polished(surface), ()
    else:
        lost = refuse_mirror(surface, "pbrt", "rgl-spectral") + what_is_lost(surface)
        choice = choose(surface, geom, _candidates(surface, spectral), spectral=spectral)
    statement = choice.statement("pbrt", surface, lost=lost, colour="wavelengths as they are" if spectral else "")
    values = choice.values
    lines = [f"# {line}" for line in header(surface, statement)]
    amount = number(values.get("amount", 1.0 if "n" in values else 0.0), 0.0, 1.0, "amount")
    body = [f'    "string type" "diffuse"  {_spectrum(surface, spectral, "reflectance", values.get("albedo", 0.0), 0.0, 1.0)}']
    lobe = [f'    "string type" "conductor"  "bool remaproughness" false  "float roughness" {values.get("alpha", 0.0):.9g}',
            f'    {_spectrum(surface, spectral, "eta", values.get("n", 1.5), 1e-3, 100.0)}', f'    {_spectrum(surface, spectral, "k", values.get("k", 0.0), 0.0, 100.0)}']  # fmt: skip
    if amount == 0:
        lines += [f'MakeNamedMaterial "{name}"', *body]
    elif amount == 1:
        lines += [f'MakeNamedMaterial "{name}"', *lobe]
    else:
        lines += [f'MakeNamedMaterial "{name}_body"', *body, f'MakeNamedMaterial "{name}_lobe"', *lobe]
        lines += [f'MakeNamedMaterial "{name}"', f'    "string type" "mix"  "string materials" [ "{name}_body" "{name}_lobe" ]  "float amount" {amount:.9g}']
    return Export("\n".join(lines) + "\n", statement)


def _candidates(surface: Surface, spectral: bool) -> dict:
    laws = {"body": _laws.body_alone()} if has_body(surface) else {}
    if not has_lobe(surface):
        return laws
    law, index = _laws.mixed(), fresnel_index(surface, spectral)
    if not has_body(surface):
        laws["fitted n"] = law.with_fixed(albedo=0.0, amount=1.0, k=0.0)
        if index is not None:
            laws["own n, k"] = law.with_fixed(albedo=0.0, amount=1.0, n=index[0], k=index[1])
    else:
        laws["mix, fitted n"] = law.with_fixed(k=0.0)
        if index is not None and np.any(index[1]):
            laws["mix, own n, k"] = law.with_fixed(n=index[0], k=index[1])
    return laws


def _polished(surface: Surface):
    """A conductor without roughness, with its own n and k where that is all there is to it."""
    laws, own = _smooth.pbrt(has_body(surface)), surface.of("mirror")
    index = fresnel_index(surface)
    if not has_body(surface) and index is not None and np.all(own["sigma"] == 0):
        laws = {"mirror": ((), lambda cos, **_: fresnel(cos, *index), None)}
        choice = choose_smooth(surface, laws)
        return replace(choice, values={"n": index[0], "k": index[1]})
    return choose_smooth(surface, laws)


def _spectrum(surface: Surface, spectral: bool, name: str, values, low: float, high: float) -> str:
    """A parameter as pbrt's spectrum: constant, by wavelength, or rgb."""
    values = numbers(values, low, high, name)
    if len(set(values)) == 1:
        return f'"spectrum {name}" [ {WIDE[0]:g} {values[0]:.9g} {WIDE[1]:g} {values[0]:.9g} ]'
    if not spectral:
        return f'"rgb {name}" [ {" ".join(f"{value:.9g}" for value in values)} ]'
    nm = 1e3 * np.asarray(surface.wavelength)
    pairs = " ".join(f"{nm[c]:.9g} {values[c]:.9g}" for c in np.argsort(nm))
    return f'"spectrum {name}" [ {pairs} ]'


EXPORTER = Exporter(__name__, ".pbrt", "pbrt-v4 named materials (conductor, diffuse, mix)", export)

"""MaterialX: a graph of its elementary nodes, oren_nayar_diffuse_bsdf plus conductor_bsdf with n and k themselves.

conductor_bsdf takes alpha, not its root. It adds the light scattered between facets, which grows with alpha: that is
what keeps a GGX metal from being exact. A dielectric lobe is a conductor with k = 0. For the shaders that production
tools share see the targets openpbr and standard-surface.
"""

import numpy as np

from ..physics.fresnel import fresnel
from ..physics.geometry import Geometry
from ..printable import identifier
from . import _target_models
from ._choice import choose, fresnel_index, has_body, has_lobe, what_is_lost
from ._materialx import colour3, float_value, material, materialx_document
from ._smooth import choose_smooth, is_smooth
from .exporter import ColouredSurface, Export, Exporter, refuse_mirror


def export(surface: ColouredSurface, geom: Geometry | None = None, stem: str = "surface") -> Export:
    """MaterialX text and its Statement."""
    lost: tuple[str, ...] = ()
    if is_smooth(surface):
        choice = choose_smooth(surface, _polished(surface))
    else:
        lost = refuse_mirror(surface, "materialx") + what_is_lost(surface)
        choice = choose(surface, geom, _candidates(surface))
    statement = choice.statement("materialx", surface, lost=lost)
    values, name = choice.values, identifier(surface.name)
    index = dict(zip(("n", "k"), fresnel_index(surface) or (1.5, 0.0), strict=True)) if is_smooth(surface) else values
    body, lobe = np.any(values.get("albedo", 0.0)), "scale" in values
    lines = []
    if body or not lobe:
        lines += _node(
            "oren_nayar_diffuse_bsdf",
            f"{name}_body",
            {
                "color": colour3(values.get("albedo", 0.0), 0.0, 1.0, "color"),
                "roughness": float_value(0.0, 0.0, 1.0, "roughness"),
            },
        )
    if lobe:
        alpha = float_value(values.get("alpha", 0.0), 0.0, 1.0, "roughness")[1]
        lines += _node(
            "conductor_bsdf",
            f"{name}_bare",
            {
                "ior": colour3(index["n"], 1e-3, 100.0, "ior"),
                "extinction": colour3(index.get("k", 0.0), 0.0, 100.0, "extinction"),
                "roughness": ("vector2", f"{alpha}, {alpha}"),
                "distribution": ("string", "ggx"),
            },
        )
        lines += _node(
            "multiply", f"{name}_lobe", {"in1": f"{name}_bare", "in2": colour3(values["scale"], 0.0, 1e3, "in2")}
        )
    last = f"{name}_lobe" if lobe else f"{name}_body"
    if body and lobe:
        last = f"{name}_sum"
        lines += _node("add", last, {"in1": f"{name}_body", "in2": f"{name}_lobe"})
    lines += [
        f'  <surface name="{name}_shader" type="surfaceshader">',
        f'    <input name="bsdf" type="BSDF" nodename="{last}"/>',
        "  </surface>",
    ]
    return Export(materialx_document(surface, statement, lines + material(name)), statement)


def _node(kind: str, name: str, inputs: dict) -> list[str]:
    """A BSDF node; an input is (type, value), or the name of the node it comes from."""
    lines = [f'  <{kind} name="{name}" type="BSDF">']
    for key, value in inputs.items():
        if isinstance(value, str):
            lines.append(f'    <input name="{key}" type="BSDF" nodename="{value}"/>')
        else:
            lines.append(f'    <input name="{key}" type="{value[0]}" value="{value[1]}"/>')
    return [*lines, f"  </{kind}>"]


def _candidates(surface: ColouredSurface) -> dict:
    targets = {"body": _target_models.body_alone()} if has_body(surface) else {}
    if has_lobe(surface):
        target, index = _target_models.conductor_node(), fresnel_index(surface)
        bare = {} if has_body(surface) else {"albedo": 0.0}
        if index is not None:
            targets["own n, k"] = target.with_fixed(n=index[0], k=index[1], **bare)
        if index is None or not np.any(index[1]):
            targets["fitted n"] = target.with_fixed(k=0.0, **bare)
    return targets


def _polished(surface: ColouredSurface) -> dict:
    """The mirror's own n and k with a factor by colour, and the body beside it."""
    n, k = (
        float(each[0]) if np.ptp(each) == 0 else each
        for each in fresnel_index(surface) or (np.full(3, 1.5), np.zeros(3))
    )

    def reflect(cos, *, scale, albedo=0.0):
        return scale * fresnel(cos, n, k)

    def under(geom, *, albedo, scale):
        return np.broadcast_to(albedo / np.pi, (len(geom), np.size(albedo)))

    return {
        "polished": (
            (_target_models.COLOUR, _target_models.SCALE) if has_body(surface) else (_target_models.SCALE,),
            reflect,
            under,
        )
    }


EXPORTER = Exporter(__name__, ".mtlx", "MaterialX nodes: diffuse plus conductor_bsdf with n and k", export)

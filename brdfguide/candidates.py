"""Which sums are worth fitting to a surface, when nothing or only its kind is known."""

from dataclasses import replace

from . import models
from .errors import choices
from .models import Sum

KINDS = ("metal", "dielectric")
BODIES = ("lambertian", "oren-nayar", "coupled")

# One lobe law each, cheapest first; the order has no say in a ranking by error.
LOBES = ("phong", "phong-lewis", "blinn", "ward", "ward-gmd", "lafortune", "lafortune:2", "cook-torrance", "beckmann", "ggx", "he-torrance")
# Laws whose amplitude is Fresnel's: on a metal n and k make it, on a dielectric n alone.
FRESNEL = ("cook-torrance", "beckmann", "ggx", "he-torrance")
METAL_K = 4.0  # F0 = 0.8 with n = 1, between chromium's 0.66 and silver's 0.96 (Westin et al. 2004, Table 1)


def of_kind(kind: str | None = None, names=None) -> tuple[Sum, ...]:
    """The sums worth fitting to a surface of this kind ("metal", "dielectric"; None: not known), or those in `names`.

    A metal has no subsurface term (Westin et al. 2004, section 3.2.3); a surface of unknown kind gets both sorts.
    Raises InputError for an unknown kind or name.
    """
    if kind not in (None, *KINDS):
        raise choices("kind of surface", kind, KINDS)
    if names is not None:
        sums = tuple(models.get(name) for name in names)
        return tuple(as_metal(each) for each in sums) if kind == "metal" else sums
    on_body = [f"lambertian+{lobe}" for lobe in LOBES] + ["oren-nayar+ggx"]
    bare = list(LOBES if kind == "metal" else FRESNEL)
    dielectrics = () if kind == "metal" else tuple(models.get(name) for name in on_body)
    metals = () if kind == "dielectric" else tuple(as_metal(models.get(name)) for name in bare)
    return dielectrics + metals


def as_metal(sum_: Sum) -> Sum:
    """The same sum with Fresnel's factor of a metal: n held at 1, k free in each channel.

    F0 = k²/(4 + k²) then is the amplitude, between 0 and 1, and F rises to 1 at grazing as it must.
    """
    held, freed = {}, []
    for term in sum_.terms:
        if {"n", "k"} <= set(term.model.defaults()):
            held[f"{term.label}.n"] = 1.0
            freed.append(f"{term.label}.k")
    return replace(sum_, fixed={**sum_.fixed, **held}, free=sum_.free + tuple(freed), start={**sum_.start, **{key: METAL_K for key in freed}})

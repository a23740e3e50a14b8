"""Every row of the table of reference values, 17 digits each, of the laws that we have."""

import csv
import json
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from brdfguide import models
from brdfguide.models import ashikhmin_shirley as ashikhmin_shirley_law
from brdfguide.physics.geometry import Geometry

from ..conftest import ROOT

SPEC = Path(os.environ.get("BRDFGUIDE_SPEC", ROOT.parent / "shared" / "spec")) / "laws_reference.csv"
UNDERFLOWN = 1e-290  # below it a value may be 0
RTOL = 1e-9


def low_smooth(fresnel_angle, **values):
    name = {"low": "low-smooth", "half": "low-smooth:half"}[fresnel_angle]
    return models.get(name), prefixed(name.replace(":", "-"), values)


def grained(alpha_x, alpha_y, axis, coat_n, depth, n, k):
    """A grained metal under a coat."""
    values = {"alpha_x": alpha_x, "alpha_y": alpha_y, "axis": np.radians(axis), "n": n, "k": k}
    return models.get("coated:ggx-aniso"), {"coat.n": coat_n, "coat.depth": depth} | prefixed("ggx-aniso", values)


def coated(coat_n, albedo, depth, tilt=None, cover=0.0, flake_r=0.0, flakes="flakes"):
    """Flakes that cover a share of the body, which is then as dark as that share makes it."""
    values = {"coat.n": coat_n, "coat.depth": depth, "lambertian.albedo": (1 - cover) * albedo}
    if tilt is None:
        return models.get("coated:lambertian"), values
    label = flakes.replace(":", "-")
    return models.get(f"coated:lambertian+{flakes}"), values | {
        f"{label}.tilt": tilt,
        f"{label}.flake": cover * flake_r,
    }


def sgd(f0, f1, **values):
    values |= {"f0": f0, "f_normal": f0 - f1, "lam": values.pop("lambda")}
    return models.get("sgd:published"), prefixed("sgd-published", values)


def stam(sigma, tau_x, tau_y, axis, f0):
    """Ours has the shorter length first."""
    if tau_y < tau_x:
        tau_x, tau_y, axis = tau_y, tau_x, (axis + 90) % 180
    values = {"sigma": sigma, "slope": sigma / tau_x, "ratio": tau_y / tau_x, "axis": np.radians(axis), "f0": f0}
    return models.get("stam"), prefixed("stam", values)


def widths(name):
    """A law with two widths and an axis."""

    def ours(axis, **values):
        return models.get(name), prefixed(name, values | {"axis": np.radians(axis)})

    return ours


def ashikhmin_shirley(part):
    """Ours is both together; the table has the lobe and the body apart."""

    def ours(axis, r_s, r_d, **exponents):
        law = models.term("ashikhmin-shirley")
        values = exponents | {"axis": np.radians(axis)}
        brdf = {
            "lobe": lambda geom, **_: module.lobe(geom, **values, r_s=r_s),
            "body": lambda geom, **_: module.body(geom, r_s, r_d),
        }[part]
        return models.made_of([(replace(law, brdf=brdf), 1)]), {}

    module = ashikhmin_shirley_law
    return ours


def lafortune_aniso(c_x, c_y, c_z, ks, exponent, axis):
    """Ours has the greatest value of the lobe for its height."""
    values = {"c_x": c_x, "c_y": c_y, "c_z": c_z, "exponent": exponent, "axis": np.radians(axis)}
    most = max(abs(c_x), abs(c_y), abs(c_z))
    return models.get("lafortune-aniso"), prefixed("lafortune-aniso", values | {"ks": ks * most**exponent})


def gltf(f0, strength, axis, **values):
    values |= {"ior": (1 + f0**0.5) / (1 - f0**0.5), "anisotropy_strength": strength, "axis": np.radians(axis)}
    return models.get("gltf"), prefixed("gltf", values)


def disney(base_color, channel, axis, **values):
    """Colours whose luminance makes the tint."""
    luminance = np.dot(base_color, (0.3, 0.6, 0.1))
    values |= {"base_color": base_color[channel], "tint": base_color[channel] / luminance, "axis": np.radians(axis)}
    return models.get("disney"), prefixed("disney", values)


def alone(name, without):
    """A law without what its text leaves open."""
    law = models.term(name)
    return models.made_of([(replace(law, brdf=law.without[without], mirror=None), 1)])


def openpbr(roughness, anisotropy, axis, **values):
    """A metal without the light between facets, which the text leaves to implementations."""
    values |= {"specular_roughness": roughness, "specular_roughness_anisotropy": anisotropy}
    values |= {"axis": np.radians(axis), "base_metalness": 1.0}
    return alone("openpbr", "multiple"), prefixed("openpbr", values)


def standard_surface(base_color, roughness, anisotropy, axis):
    """A metal with Schlick's curve and without the light between facets."""
    values = {"base_color": base_color, "specular_roughness": roughness, "specular_anisotropy": anisotropy}
    values |= {"axis": np.radians(axis), "metalness": 1.0, "coat": 0.0}
    return alone("standard-surface", "multiple+fresnel"), prefixed("standard-surface", values)


def prefixed(label, values):
    return {f"{label}.{name}": value for name, value in values.items()}


# name in the table -> (our sum, our values) of its parameters
OURS = {
    **{name: widths(name) for name in ("ward-aniso", "ward-duer-aniso", "ward-gmd-aniso")},
    **{name: widths(name) for name in ("ggx-aniso", "beckmann-aniso", "cylinders")},
    "ashikhmin-shirley": ashikhmin_shirley("lobe"),
    "ashikhmin-shirley-body": ashikhmin_shirley("body"),
    "lafortune-aniso": lafortune_aniso,
    "gltf": gltf,
    "disney-2012": disney,
    "openpbr-metal": openpbr,
    "standard-surface-metal": standard_surface,
    "abg": lambda **v: (models.get("abg"), prefixed("abg", v)),
    "harvey-shack": lambda **v: (models.get("harvey-shack"), prefixed("harvey-shack", v)),
    "abc-rayleigh-rice": lambda **v: (models.get("abc"), prefixed("abc", v)),
    "low-smooth": low_smooth,
    "stam": stam,
    "sgd": sgd,
    "coat-ggx-aniso": grained,
    "coat-body": coated,
    "coat-flakes-ggx": coated,
    "coat-flakes-beckmann": lambda **values: coated(flakes="flakes:beckmann", **values),
}


def table():
    return list(csv.DictReader(SPEC.read_text().splitlines())) if SPEC.is_file() else []


@pytest.mark.skipif(not SPEC.is_file(), reason=f"no table of reference values at {SPEC}; set BRDFGUIDE_SPEC")
@pytest.mark.parametrize("name", OURS)
def test_every_row_is_met(name):
    found = [row for row in table() if row["model"].partition(":")[0] == name]
    assert len(found) >= 18
    for row in found:
        values = json.loads(row["parameters"])
        wavelength = values.pop("wavelength_um", 0.55)
        angles = [float(row[column]) for column in ("theta_i_deg", "phi_i_deg", "theta_r_deg", "phi_r_deg")]
        geom = Geometry.from_degrees(*angles, wavelength)
        surface, ours = OURS[name](**values)
        law = surface.mirror if row["model"].endswith(":mirror") else surface
        got, right = float(np.squeeze(law(geom, ours))), row["f"]
        if float(right) < UNDERFLOWN:
            assert 0 <= got < 2 * UNDERFLOWN, row
        else:
            assert got == pytest.approx(float(right), rel=RTOL, abs=0), row

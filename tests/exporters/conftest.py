"""Surfaces to export: one of each law, five described materials, and seeded random ones."""

import json
import subprocess
import sys

import numpy as np
import pytest

from brdfguide import exporters, models
from brdfguide.exporters.exporter import ColouredSurface
from brdfguide.exporters.tables import goniometric
from brdfguide.fitting import saved
from brdfguide.physics.geometry import Geometry, rows

from ..conftest import ROOT

COARSE = {"LEVELS": ((30.0, 60.0, 0.5, 1.5),), "ABOUT_NORMAL": ((30.0, 60.0, 20.0),)}  # of goniometers' tables


@pytest.fixture(autouse=True)
def coarse_tables(request, monkeypatch):
    """Goniometers' tables of a few angles, but where they are what is tested."""
    for name, levels in COARSE.items() if "test_goniometric" not in request.node.nodeid else ():
        monkeypatch.setattr(goniometric, name, levels)


RGB_UM = np.array([0.65, 0.55, 0.45])
BANDS = np.arange(0.40, 0.701, 0.05)
LOBES = (
    "phong",
    "phong-lewis",
    "blinn",
    "ward",
    "ward-duer",
    "ward-gmd",
    "lafortune",
    "cook-torrance",
    "beckmann",
    "ggx",
    "he-torrance",
    "mirror",
)
BODIES = ("lambertian", "coupled", "oren-nayar")


def surface(expression, **values) -> ColouredSurface:
    """Grey, with `ggx__alpha=0.2` for ggx.alpha."""
    return ColouredSurface(models.get(expression), {_key(key): value for key, value in values.items()})


def _key(name: str) -> str:
    law, _, parameter = name.partition("__")
    return f"{law.replace('_', '-')}.{parameter}"


def coloured(expression, **values) -> ColouredSurface:
    """The same in red, green and blue."""
    made = surface(
        expression, **{key: np.array(value) if isinstance(value, list) else value for key, value in values.items()}
    )
    return ColouredSurface(made.model, made.values, ("R", "G", "B"), RGB_UM, "coloured")


EVERY_LAW = {
    "lambertian": coloured("lambertian", lambertian__albedo=[0.1, 0.4, 0.8]),
    "coupled": surface("coupled", coupled__albedo=0.4),
    "oren-nayar": surface("oren-nayar", oren_nayar__albedo=0.6),
    "eon": surface("eon", eon__albedo=0.7, eon__roughness=0.8),
    "phong": surface("lambertian+phong", lambertian__albedo=0.2, phong__exponent=120.0),
    "phong-lewis": surface("lambertian+phong-lewis", lambertian__albedo=0.3, phong_lewis__exponent=40.0),
    "blinn": surface("lambertian+blinn", lambertian__albedo=0.1),
    "ward": coloured("lambertian+ward", lambertian__albedo=[0.5, 0.2, 0.1], ward__rho_s=0.06, ward__alpha=0.15),
    "ward-duer": surface("lambertian+ward-duer", lambertian__albedo=0.2, ward_duer__alpha=0.2),
    "ward-gmd": coloured(
        "lambertian+ward-gmd", lambertian__albedo=[0.5, 0.2, 0.1], ward_gmd__rho_s=0.06, ward_gmd__alpha=0.15
    ),
    "lafortune": surface("lambertian+lafortune", lambertian__albedo=0.2, lafortune__tilt=0.9, lafortune__exponent=30.0),
    "cook-torrance": surface("lambertian+cook-torrance", lambertian__albedo=0.4, cook_torrance__alpha=0.25),
    "beckmann": coloured("beckmann", beckmann__alpha=0.3, beckmann__n=[1.2, 1.4, 1.8], beckmann__k=[6.0, 5.5, 5.0]),
    "ggx": coloured("ggx", ggx__alpha=0.2, ggx__n=[1.2, 1.4, 1.8], ggx__k=[6.0, 5.5, 5.0]),
    "paint": coloured("lambertian+ggx", lambertian__albedo=[0.3, 0.02, 0.01], ggx__alpha=0.08),
    "he-torrance": surface(
        "lambertian+he-torrance", lambertian__albedo=0.1, he_torrance__sigma=0.6, he_torrance__slope=0.1
    ),
    "stam": coloured("stam", stam__sigma=0.12, stam__slope=0.12, stam__f0=[0.9, 0.7, 0.4]),
    "student-t": coloured("student-t", student_t__alpha=0.15, student_t__g=1.8, student_t__n=[1.4, 1.5, 1.7]),
    "ggx-ms": coloured("ggx-ms", ggx_ms__alpha=0.6, ggx_ms__n=[0.2, 0.5, 1.1], ggx_ms__k=[3.9, 2.4, 2.3]),
    "retro": surface("lambertian+retro", lambertian__albedo=0.3, retro__alpha=0.25),
    "flakes": surface("flakes", flakes__tilt=0.15),
    "flakes:beckmann": surface("flakes:beckmann", flakes_beckmann__tilt=0.15),
    "coated:lambertian": coloured("coated:lambertian", lambertian__albedo=[0.1, 0.4, 0.8]),
    "coated:flakes": coloured("coated:lambertian+flakes", flakes__flake=[0.2, 0.3, 0.5], lambertian__albedo=0.1),
    "ggx+coated:lambertian": surface("ggx+coated:lambertian", lambertian__albedo=0.5, ggx__alpha=0.3, coat__depth=0.1),
    "gtr": surface("lambertian+gtr", lambertian__albedo=0.1, gtr__gamma=1.2),
    "sgd": surface("lambertian+sgd", lambertian__albedo=0.3, sgd__p=0.8),
    "sgd:published": surface("sgd:published"),
    "abg": surface("lambertian+abg", lambertian__albedo=0.01, abg__a=0.002, abg__g=1.6),
    "harvey-shack": coloured("harvey-shack", harvey_shack__b0=[3.0, 4.0, 6.0], harvey_shack__l=0.03),
    "abc": coloured("abc", abc__a=1e-4, abc__f0=[0.6, 0.7, 0.9]),
    "low-smooth": surface("lambertian+low-smooth", lambertian__albedo=0.2, low_smooth__b=2e3, low_smooth__c=0.8),
    "low-smooth:half": surface("low-smooth:half", low_smooth_half__c=1.5, low_smooth_half__k=2.0),
    "low-facet": surface("lambertian+low-facet", lambertian__albedo=0.1, low_facet__a=2.0, low_facet__c=1.2),
    "mirror": coloured("mirror", mirror__n=[1.2, 1.4, 1.8], mirror__k=[6.0, 5.5, 5.0]),
    "polish": surface("lambertian+mirror", lambertian__albedo=0.3, mirror__sigma=0.03),
}
MATERIALS = ("porcelain", "brass", "rough-plastic", "satin-chrome", "matt-wall-paint")
# Without the mirror's scan for stray light: lobes of a thousandth of a radian are not those of a renderer in float32.
EXAMPLES = tuple(sorted({path.stem for path in (ROOT / "examples").glob("*.csv")} - {"polished_mirror"}))
# laws that shaders hold as text
WRITTEN = {name: case for name, case in EVERY_LAW.items() if all(each.model.formula for each in case.model.terms)}
NAMES = (*WRITTEN, *MATERIALS, *EXAMPLES)  # what the readers load


@pytest.fixture(params=EVERY_LAW)
def each(request) -> ColouredSurface:
    return EVERY_LAW[request.param]


def random_surface(seed: int) -> ColouredSurface:
    """A body, a lobe or both, every parameter anywhere within its bounds, in one, three or seven channels."""
    rng = np.random.default_rng(seed)
    lobe, body = rng.choice(LOBES), rng.choice(BODIES)
    model = models.get(str(rng.choice([lobe, body, f"{body}+{lobe}", f"lambertian+{lobe}"])))
    count = int(rng.choice([1, 1, 3, 7]))
    channels = {1: ("brdf",), 3: ("R", "G", "B"), 7: tuple(f"{1e3 * each:.0f}nm" for each in BANDS)}[count]
    wavelength = {1: np.array([0.55]), 3: RGB_UM, 7: BANDS}[count]
    values = {}
    for key, p in model.parameters.items():
        size = count if p.per_channel and count > 1 else None
        high = min(p.high, 10.0) if p.name in ("ks", "scale") else p.high
        if p.log:
            values[key] = p.origin + np.exp(rng.uniform(np.log(p.low - p.origin), np.log(high - p.origin), size))
        else:
            values[key] = rng.uniform(p.low, high, size)
        values[key] = np.clip(values[key], p.low, p.high)
    return ColouredSurface(model, values, channels, wavelength, f"random {seed}")


def directions(count: int = 1000, seed: int = 1, most: float = 80.0) -> Geometry:
    """Half of them anywhere, half about the mirror direction."""
    rng = np.random.default_rng(seed)
    theta_i, theta_r, phi = rng.uniform(0, most, count), rng.uniform(0, most, count), rng.uniform(0, 360, count)
    near = slice(0, count // 2)
    theta_r[near] = np.clip(np.abs(theta_i[near] + rng.normal(0, 6, count // 2)), 0, most)
    phi[near] = 180 + rng.normal(0, 6, count // 2)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def vectors(geom: Geometry) -> tuple[np.ndarray, np.ndarray]:
    """Unit vectors toward light and detector, (samples, 3)."""
    phi = np.radians(geom.phi_deg[:, 0])
    light = np.stack((geom.sin_i[:, 0], np.zeros(len(geom)), geom.cos_i[:, 0]), axis=-1)
    view = np.stack((geom.sin_r[:, 0] * np.cos(phi), geom.sin_r[:, 0] * np.sin(phi), geom.cos_r[:, 0]), axis=-1)
    return light, view


def all_surfaces() -> dict[str, ColouredSurface]:
    """One of each law, and the first candidate of five described materials."""
    from brdfguide.face.surfaces import described

    return EVERY_LAW | {name: exporters.coloured(described(name), name) for name in MATERIALS}


@pytest.fixture(scope="session")
def surfaces() -> dict[str, ColouredSurface]:
    return all_surfaces()


@pytest.fixture(scope="session")
def of(surfaces, tmp_path_factory):
    """The surfaces that a name of NAMES stands for: itself, or every model that `fit` ranks on that example, as `export
    FIT.json --model` reads it.
    """
    fitted = {}

    def surfaces_of(name: str) -> list[ColouredSurface]:
        if name not in EXAMPLES:
            return [surfaces[name]]
        if name not in fitted:
            path = tmp_path_factory.mktemp("fits") / f"{name}.json"
            words = [sys.executable, "-m", "brdfguide", "fit", f"examples/{name}.csv", "--json", "--no-timing"]
            words.append("--anyway")  # no law describes the smooth steel, yet each becomes a file
            path.write_text(subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout)
            ranked = [row["model"] for row in json.loads(path.read_text())["ranking"]]
            fitted[name] = [exporters.coloured(saved.read_fit(path, model), f"{name}: {model}") for model in ranked]
            assert len(fitted[name]) >= 8
        return fitted[name]

    return surfaces_of

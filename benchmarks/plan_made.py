"""Made tables for plans to be found and judged by: printed fits of MERL's materials where given tables have directions.

Bagher's, Low's (two laws) and He-Torrance's fits by Ngan take turns from material to material. Each is laid out as one
of the given tables, narrow lobes as those that follow a narrow lobe, with 2 % of noise.
"""

import json
import re

import numpy as np

from benchmarks.given_tables import DATA, JUDGED, at_most
from brdfguide import models
from brdfguide.data.measurement import Measurement
from brdfguide.physics.geometry import Geometry

NOISE = 0.02
NUMBER = r"([-+.e\d]+)"
NARROW_DEG = 4.0  # tilt at which a lobe has half its height
NARROW = ("red plastic", "yellow chrome", "bronze", "colour change", "garnet red", "sunflower vinyl")
WIDE = ("red plastic", "white paper", "cayman", "bronze", "PTFE", "garnet red")
NGAN = np.array([1.0, 1.15, 1.66])  # MERL's channel factors, which his colours lack
LAWS = ("sgd", "low-smooth", "sgd", "low-facet", "sgd", "he-torrance")


def made_tables(given: list, half: int | None = None):
    """(name, Measurement to choose from, Measurement to judge by), one of each material, or of every other one."""
    printed = {law: _printed(law) for law in set(LAWS)}
    names = sorted(printed["sgd"])
    used = {True: 0, False: 0}
    for number, name in enumerate(names):
        order = [LAWS[(number + step) % len(LAWS)] for step in range(len(LAWS))]
        law = next(each for each in order if name in printed[each])
        model, values = printed[law][name]
        narrow = _half_height_deg(model, values) < NARROW_DEG
        kinds = NARROW if narrow else WIDE
        lie_as = kinds[used[narrow] % len(kinds)]
        used[narrow] += 1
        if half is not None and number % 2 != half:
            continue
        table = next((each[1] for each in given if each[0].startswith(lie_as)), None)
        if table is not None:
            made = _made(model, values, table.geom, number)
            yield f"{name} ({law}, as {lie_as})", made, at_most(made, JUDGED)


def _made(model, values, geom: Geometry, seed: int) -> Measurement:
    truth = np.broadcast_to(model(geom, values), (len(geom), 3))
    noisy = truth * np.exp(NOISE * np.random.default_rng(seed).standard_normal(truth.shape))
    return Measurement(geom, np.maximum(noisy, 1e-12), ("r", "g", "b"), name="made")


def _half_height_deg(model, values) -> float:
    tilt = np.r_[0.0, np.geomspace(0.1, 30, 60)][:, None]
    lobe = model(Geometry.from_degrees(30.0 + tilt, 0.0, np.abs(30.0 - tilt), np.where(tilt > 30, 0.0, 180.0)), values)
    lobe = np.broadcast_to(lobe, (len(tilt), 3)).mean(axis=1)
    lobe = lobe - np.median(lobe[-10:])
    return float(tilt[np.argmax(lobe < lobe[0] / 2), 0])


def _printed(law: str) -> dict:
    """Material -> (model, values)."""
    file = {
        "sgd": "bagher_sgd",
        "low-smooth": "low_lowsmooth_E2",
        "low-facet": "low_lowmicrofacet_E2",
        "he-torrance": "ngan_he",
    }[law]
    found = {}
    for line in (DATA / "merl_fits" / f"{file}.fit").read_text().splitlines():
        name, _, rest = line.partition(" = ")
        if line.startswith("#") or not rest:
            continue
        found[name] = READ[law](rest)
    return found


def _lists(text: str, name: str) -> np.ndarray:
    """The numbers behind `name =`, of the last such name."""
    return np.array(json.loads(re.findall(rf"\b{name} = (\[[^=]*\]|{NUMBER})[,)]", text)[-1][0]))


def _body(text: str) -> np.ndarray:
    return np.maximum(np.array(json.loads(re.search(r"Lambertian\(albedo = (\[[^\]]*\])", text)[1])), 1e-5)


def _sgd(text: str):
    model = models.get("lambertian+sgd:published")
    f0, f1 = _lists(text, "eta")
    lobe = {"rho_s": _lists(text, "albedo"), "f0": f0, "f_normal": f0 - f1}
    names = {"alpha": "alpha", "p": "p", "c": "c", "k": "k", "theta0": "theta0", "lam": "Lambda"}
    lobe |= {key: _lists(text, name) for key, name in names.items()}
    return model, {"lambertian.albedo": _body(text)} | {f"sgd-published.{key}": each for key, each in lobe.items()}


def _low(law: str):
    def read(text: str):
        lobe = {key: _lists(text, name) for key, name in (("a", "A"), ("b", "B"), ("c", "C"), ("n", "eta"))}
        lobe["n"] = np.maximum(lobe["n"], 1.01)
        values = {"lambertian.albedo": _body(text)} | {f"{law}.{key}": each for key, each in lobe.items()}
        return models.get(f"lambertian+{law}"), values

    return read


def _he(text: str):
    sigma, tau, n = (float(_lists(text, name)) for name in ("roughness", "autocorrelation", "eta"))
    lobe = {"sigma": sigma, "slope": sigma / tau, "n": np.full(3, max(n, 1.0005)), "k": 0.0}
    lobe["scale"] = NGAN * _lists(text, "albedo")
    values = {"lambertian.albedo": NGAN * _body(text)} | {f"he-torrance.{key}": each for key, each in lobe.items()}
    return models.get("lambertian+he-torrance"), values


READ = {"sgd": _sgd, "low-smooth": _low("low-smooth"), "low-facet": _low("low-facet"), "he-torrance": _he}

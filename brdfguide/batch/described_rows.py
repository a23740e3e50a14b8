"""What an answer is as a row of a table: its recommended surface's numbers, and how it looks."""

import json
from functools import cache
from typing import Any

import numpy as np

from ..fitting import saved
from ..fitting.appearance import lobe_width_deg
from ..models.looks import instrument_reading, mixture, turns
from ..models.surface import Surface
from ..physics import fresnel, gloss, seen
from ..physics.aperture import Instrument
from ..physics.directions import FIELDS, Directions
from ..physics.geometry import Geometry
from .collected import each_of

LOOKS = 12, 5, 5  # of `seen.sphere`: orders pairs as the full one does, see tests/batch/test_searching.py


def described_row(document: dict) -> tuple[dict[str, Any], np.ndarray]:
    """A row of `fit` for an answer, and how it looks: (directions, colours) [L*], float32.

    Raises InputError, KeyError where the document is damaged.
    """
    best = next(each for each in document["ranking"] if each["candidate"] == document["recommended"])
    small = _recommended_alone(document, best)
    surface = saved.surface_in(json.dumps(small).encode(), "answer")
    shown, doubt = _shown_with_doubt(surface, best)
    albedo = _albedo(best, surface)
    kind, stored, nan = document.get("kind") or {}, document.get("stored") or {}, [None] * 3
    glosses = _glosses(surface)
    row = {
        "sha256": (stored.get("data") or {}).get("sha256"),
        "fingerprint": stored.get("fingerprint"),
        "recommended": best["candidate"],
        "tied": sum(bool(each["tied"]) for each in document["ranking"]),
        "kind": kind.get("verdict"),
        "rms_ln": best["rms_ln"],
        "held_out": best["held_out_rms_ln"],
        "behind": best["behind"],
        "seen": best["seen"],
        "flags": ",".join(each["code"] for each in best["flags"]),
        "no_answer": document.get("no_answer"),
        "samples": document["data"]["samples"],
        "f0": _f0(best),
        "albedo": None if albedo is None else float(np.mean(albedo)),
        "alpha_equivalent": _alpha(best, surface),
        "doubt": doubt,
        "turns": int(turns(surface)),
        "surface": json.dumps(small),
    }
    row |= dict(zip(("albedo_r", "albedo_g", "albedo_b"), nan if albedo is None else albedo, strict=True))
    return row | {f"gloss{angle}": units for angle, units in zip(gloss.ANGLES, glosses, strict=True)}, shown


@cache
def _receptors() -> tuple[Geometry, list[int]]:
    """Directions of all glossmeters one behind the other, and where each but the first begins."""
    each = [gloss.receptor_directions(angle, *gloss.QUICK)[0].directions for angle in gloss.ANGLES]
    joined = {name: np.concatenate([getattr(part, name) for part in each]) for name in FIELDS}
    return Geometry(Directions(**joined)), np.cumsum([len(part) for part in each[:-1]]).tolist()


def _glosses(surface: Surface) -> list[float | None]:
    """Units at each of the angles, the mean over channels, from one call of the model."""
    geom, ends = _receptors()
    parts = zip(gloss.ANGLES, np.split(surface.brdf(geom), ends), strict=True)
    return [_finite(np.mean(gloss.units(lambda _, part=part: part, angle, quick=True))) for angle, part in parts]


def _recommended_alone(document: dict, best: dict) -> dict:
    """A fit's JSON that `export`, `evaluate` and `preview` take, with one row."""
    data = {name: document["data"][name] for name in ("channels", "wavelength_nm", "solid_angle_sr")}
    known = {name: {"value": value["value"]} for name, value in best["parameters"].items()}
    row = {name: best[name] for name in ("model", "candidate", "freed")} | {"parameters": known}
    return {"schema": "brdfguide/fit/1", "data": data, "ranking": [row], "recommended": best["candidate"]}


def look_vector(surface: Surface) -> np.ndarray:
    """How a surface looks at the directions of LOOKS: (directions, colours) [L*], float32."""
    return _look_vectors([surface])[0]


def _look_vectors(surfaces: list[Surface]) -> np.ndarray:
    """The same of surfaces with one model and channels, from one call of it: (surfaces, directions, colours)."""
    first, there = surfaces[0], Instrument(seen.sphere(LOOKS).geom)
    reading = instrument_reading(_side_by_side(surfaces), there)
    each = reading.reshape(len(reading), len(surfaces), len(first.channels)).transpose(1, 0, 2)
    return seen.lightness(each @ mixture(first), there.geom.cos_i).astype(np.float32)


def _side_by_side(surfaces: list[Surface]) -> Surface:
    """One surface with the channels of all; what is the same number in all stays one."""
    if len(surfaces) == 1:
        return surfaces[0]
    first, count = surfaces[0], len(surfaces)

    def joined(key: str):
        values = [each.values[key] for each in surfaces]
        if np.ndim(values[0]) == 0 and all(value == values[0] for value in values):
            return values[0]
        return np.concatenate([np.full(len(first.channels), value) for value in values])

    values = {key: joined(key) for key in first.values}
    return Surface(first.model, values, first.channels * count, np.tile(first.wavelengths, count))


def _shown_with_doubt(surface: Surface, best: dict) -> tuple[np.ndarray, float | None]:
    """How it looks, and how far that moves with one standard error of each parameter, taken as independent [L*]."""
    moved = []
    for name, value in best["parameters"].items():
        if value["stderr"] is None or name not in surface.model.parameters:
            continue
        parameter = surface.model.parameters[name]
        errors = np.array([each or 0.0 for each in each_of(value["stderr"])], float)
        low, high = parameter.outside(parameter.least), parameter.outside(parameter.high)
        there = parameter.inside(np.clip(np.array(each_of(value["value"]), float) + errors, low, high))
        moved.append(surface.with_value(name, there if np.size(there) > 1 else float(np.ravel(there)[0])))
    shown, *changed = _look_vectors([surface, *moved])
    weights = seen.sphere(LOOKS).weights
    return shown, _finite(np.sqrt(sum(seen.apart(each, shown, weights) ** 2 for each in changed)))


def _albedo(best: dict, surface: Surface) -> list[float] | None:
    """The body's, as red, green and blue."""
    found = [value["value"] for name, value in best["parameters"].items() if name.rpartition(".")[2] == "albedo"]
    if not found:
        return None
    each = np.broadcast_to(np.array(each_of(found[0]), float), (len(surface.channels),))
    mixed = each @ seen.colours(surface.channels, surface.wavelengths)
    return [float(value) for value in np.broadcast_to(mixed, (3,))]


def _f0(best: dict) -> float | None:
    """Reflectance of the lobe's surface at normal incidence, the mean over channels."""
    values = {name.rpartition(".")[2].lower(): value["value"] for name, value in best["parameters"].items()}
    if "f0" in values:
        return _finite(np.mean(each_of(values["f0"])))
    if "n" not in values:
        return None
    n, k = (np.array(each_of(values.get(name, 0.0)), float) for name in "nk")
    return _finite(np.mean(fresnel.f0(n, k)))


def _alpha(best: dict, surface: Surface) -> float | None:
    """exp(-tan²θh/α²) has its half at tan θh = α √ln 2, and θr moves by 2 θh on either side."""
    own = [value["value"] for name, value in best["parameters"].items() if name.rpartition(".")[2] == "alpha"]
    if len(own) == 1:
        return _finite(np.mean(own[0]))
    width = lobe_width_deg(surface)
    return None if width is None else float(np.tan(np.radians(width / 4)) / np.sqrt(np.log(2)))


def _finite(value) -> float | None:
    return float(value) if np.isfinite(value) else None

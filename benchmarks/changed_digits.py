"""Honest answers and answers of which one digit was changed: what `verify` says of each.

    python benchmarks/changed_digits.py [--honest 100] [--changed 1000] [--seed 26]

An honest answer is a fit to a made surface with noise, of three laws and a shader, with what another shader can do and
files of the recommended law for three programs beside it. A changed one has one digit of one number replaced by
another: any digit of any number for the digest; for the derivation alone, as if the digest had been renewed, one of the
first eight digits of a parameter or of a number that follows from them.
"""

import argparse
import json
import os
import random
import re
import sys
from contextlib import suppress
from copy import deepcopy
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

os.environ.setdefault("OMP_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

import numpy as np

from brdfguide import exporters, models
from brdfguide.audit import verification
from brdfguide.errors import NoAnswer
from brdfguide.face.beyond import fitted_as
from brdfguide.face.functions import fit
from brdfguide.fitting.layout import Layout
from brdfguide.report.documents.digest import digest_holds, with_digest
from brdfguide.report.documents.plain import plain
from tests import synthetic

MODELS = ("lambertian+ggx", "lambertian+ward", "lambertian+beckmann", "lambertian+student-t", "lambertian+he-torrance")
SHADERS = ("gltf", "openpbr", "standard-surface", "disney")
TARGETS = ("glsl", "gltf", "gltf-pbr", "openpbr", "standard-surface", "mitsuba", "pbrt", "materialx", "usd", "radiance")
FIRST = 8  # digits
FEWER = 4  # of a shader's standard error: its slopes are differences


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--honest", type=int, default=100)
    parser.add_argument("--changed", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=26)
    asked = parser.parse_args()
    rng, held, seconds = random.Random(asked.seed), 0, []
    answers = []
    for number in range(asked.honest):
        measurement, document = answer(np.random.default_rng([asked.seed, number]))
        began = process_time()
        found = verification.verify(document, verification.readings_of(measurement, document))
        seconds.append(process_time() - began)
        held += not found.wrong and digest_holds(document) is True
        for each in found.wrong:
            print("honest, and yet:", number, each)
        answers.append((measurement, document, found))
    print(f"honest: {held} of {asked.honest} hold; {np.median(seconds):.2f} s of processor time each (median)")
    by_digest = sum(_sealed(*rng.choice(answers)[:2], rng) for _ in range(asked.changed))
    print(f"one digit of any number changed: the digest finds {by_digest} of {asked.changed}")
    by_derivation = sum(_derived(*rng.choice(answers), rng) for _ in range(asked.changed))
    print(f"one of the first {FIRST} digits, digest renewed: the derivation finds {by_derivation} of {asked.changed}")


def answer(rng):
    """A made measurement of 40 to 80 directions as it was fitted, and its answer's document."""
    model = models.get(MODELS[rng.integers(len(MODELS))])
    geom = synthetic.scan(theta_i=(15, 45, 70), step=float(rng.choice([6.0, 8.0, 10.0])))
    values = synthetic.random_values(Layout(model, 1), rng)
    data = synthetic.surface(model, geom, values, noise=0.03, seed=int(rng.integers(2**31)))
    picked = [MODELS[place] for place in rng.permutation(len(MODELS))[:3]]
    found = fit(data, [*picked, str(rng.choice(SHADERS))], timing=False, anyway=True)
    shown, _ = fitted_as(str(rng.choice(SHADERS)), found.ranking, found.measurement, None)
    more = {"as": shown, "exports": _files(found, rng.permutation(TARGETS)[:3])}
    return found.measurement, json.loads(json.dumps(with_digest(found.document | more)))


def _files(found, targets) -> list[dict]:
    """What an answer says of files that were written beside it."""
    surface, data, told = exporters.coloured(found.ranking.recommended.fit.surface), found.measurement, []
    with TemporaryDirectory() as folder:
        for target in targets:
            with suppress(NoAnswer):  # of a mirror that it has no place for
                told.append(
                    exporters.export_to(f"{target}:{folder}/{target}", surface, data.geom, measured=data.brdf)[1]
                )
    return plain(told)


def _numbers(document, path=()):
    if isinstance(document, dict):
        for key, value in document.items():
            yield from _numbers(value, (*path, key))
    elif isinstance(document, list):
        for place, value in enumerate(document):
            yield from _numbers(value, (*path, place))
    elif isinstance(document, (int, float)) and not isinstance(document, bool):
        yield path


def _changed(document, path, rng, most: int):
    """The document with one of the first `most` printed digits of a number replaced by another; None without effect."""
    changed = deepcopy(document)
    target = changed
    for step in path[:-1]:
        target = target[step]
    text = json.dumps(target[path[-1]])
    mantissa = text.partition("e")[0]
    digits = [place for place, each in enumerate(mantissa) if each.isdigit()]
    first = next((n for n, place in enumerate(digits) if text[place] != "0"), 0)
    place = rng.choice(digits[first : first + most])
    new = rng.choice([each for each in "0123456789" if each != text[place]])
    written = text[:place] + new + text[place + 1 :]
    target[path[-1]] = float(written) if "." in text or "e" in text else int(written)
    return changed if target[path[-1]] != json.loads(text) else None


def _written(path) -> str:
    """A number's place as `verify` names it; those of a flag by its code, which only one has that is derived."""
    words = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path).lstrip(".")
    return re.sub(r"flags\[\d+\]\.numbers", "flags.discrepancy", words)


def _sealed(measurement, document, rng) -> bool:
    changed = None
    while changed is None:
        changed = _changed(document, rng.choice(list(_numbers(document))), rng, 99)
    return digest_holds(changed) is False


def _is_parameter(document, path) -> bool:
    """Whether it is a parameter on which a row depends: what a shader holds of layers that are not there is none."""
    if path[0] != "ranking" or path[2] != "parameters" or path[4] != "value":
        return False
    return document["ranking"][path[1]]["parameters"][path[3]]["fitted"] or not path[3].startswith(SHADERS)


def _derived(measurement, document, before, rng) -> bool:
    known = {each.place for each in before.derived}
    changed = None
    while changed is None:
        path = rng.choice(list(_numbers(document)))
        if _is_parameter(document, path) or _written(path) in known:
            by_differences = "stderr" in path and path[3].startswith(SHADERS)
            changed = _changed(document, path, rng, FEWER if by_differences else FIRST)
    found = verification.verify(changed, verification.readings_of(measurement, changed))
    if not found.wrong:
        print("not found:", path)
    return bool(found.wrong)


if __name__ == "__main__":
    main()

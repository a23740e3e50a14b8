"""What must hold of every answer to a description, whatever it says.

No observation is both a reason and without effect; leaving out one that has no effect changes not a word; no sentence
says that something is contradicted by itself; each candidate has a reason of its own; a retro-reflector's lobe points
to the light; a colour that was not observed is grey, and it is said.
"""

import re
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import fields
from types import MappingProxyType

import numpy as np

from brdfguide.advice import material, recommend
from brdfguide.physics.geometry import in_plane
from brdfguide.report.documents.recommendation import document

COLOURED = ("f0", "index", "diffuse_reflectance", "composition", "base_color")  # what may bring a colour


class _Unasked(recommend.Recommendation):
    """An answer of which nobody asks what leaving out each observation changes."""

    effects: Mapping = MappingProxyType({})
    rests_on: Mapping = MappingProxyType({})


def faults(made: material.Material) -> Iterator[str]:
    """What does not hold of the answer to one description, in words."""
    found = recommend.recommend(made, anyway=True)
    said = document(found, timing=False)
    reasons = {key for each in said["advice"] for key in each["rests_on"]}
    for key in found.unused:
        if key in reasons:
            yield f"{key}: reason and without effect"
    for key, effect in found.effects.items():
        if effect == "none":
            rest = recommend.recommend(
                material.from_values(recommend.without_key(made.given, key), made.name), anyway=True
            )
            other = document(_Unasked(**{each.name: getattr(rest, each.name) for each in fields(rest)}), timing=False)
            for part in ("candidates", "advice", "verdict", "domain"):
                ours, theirs = (_bare(each[part]) for each in (said, other))
                if ours != theirs:
                    yield f"{key}: called without effect, and {part} differs"
    for each in said["advice"]:
        match = re.search(r"said to be ([\w ]+), yet .* is ([\w ]+)$", each["says"])
        if match and match[1] == match[2]:
            yield f"contradicted by itself: {each['says']}"
    reasons_given = Counter(each["why"] for each in said["candidates"])
    if reasons_given and max(reasons_given.values()) > 1:
        yield f"one reason for several candidates: {reasons_given.most_common(1)}"
    if made.retroreflective and found.candidates and "retro" in found.candidates[0].model.name:
        values = found.candidates[0].surface.brdf(in_plane([[40.0]] * 179, np.arange(-89.0, 90.0)[:, None]))[:, 0]
        if np.arange(-89, 90)[values.argmax()] != -40:
            yield "a retro-reflector that does not shine toward the light"
    if not set(COLOURED) & set(made.given):
        for each in found.candidates:
            if any(np.size(value) > 1 for value in each.start.values()):
                yield f"{each.model.name}: a colour that nothing told"
        told = {each.rule for each in found.advice}
        if found.material.subsurface in ("lambertian", "lobe") and "grey_by_assumption" not in told:
            yield "a body is grey, and it is not said"


def _bare(part):
    """Without the lists of what each sentence rests on."""
    return [{key: each[key] for key in each if key != "rests_on"} for each in part] if isinstance(part, list) else part

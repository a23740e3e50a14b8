"""LightTools `.bsdf`: Zemax's keywords for the lists, then blocks that each say what they are.

Symmetry, SpectralContent, counts with lists ScatterAzimuth and ScatterRadial, `DataBegin`; blocks of AOI, POI, Side,
Wavelength [nm], ScatterType, TristimulusValue and `TIS x` with a table azimuth times radial, `DataEnd`. Other than
Zemax's, the angles stand about the normal; the light comes from azimuth 90, so that the mirror direction is at 270.
Only reflection from the front is used.

Source: the layout as the reader of libbsdf follows it; no measured file was at hand, and the tests write their own.
"""

import re

import numpy as np

from ...errors import InputError
from ...finding import Finding
from ...physics.colour import CHANNEL_UM
from .. import stated_total
from ..measurement import Measurement
from ._product_grid import product_grid
from ._sides import azimuths_on_their_side
from ._writing import about, angle, only_channel, value
from .format import Format, Options, Source, check_zenith, measurement, nominal_colours

LIGHT_AZIMUTH = 90.0
MOST_ANGLES = 100_000
KEYS = ("AOI", "POI", "Side", "Wavelength", "ScatterType", "TristimulusValue")


def recognises(head: bytes) -> bool:
    text = head.decode("latin-1")
    return all(re.search(rf"^[ \t]*{key}\b", text, re.MULTILINE) for key in ("ScatterAzimuth", "ScatterRadial", "AOI"))


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError for a block without its numbers, and where no block is a reflection from the front."""
    words = [(word, line) for line, text in enumerate(source.lines, 1) for word in text.partition("#")[0].split()]
    lists, at = {}, 0
    while at < len(words) and words[at][0] != "DataBegin":
        word, line = words[at]
        at += 1
        if word in ("ScatterAzimuth", "ScatterRadial"):
            promised = _numbers(source, words, at, 1, word)[0]
            if not 0 < promised <= MOST_ANGLES:
                raise source.error(f"{word} promises {promised:g} angles", line)
            count = int(promised)
            lists[word] = _numbers(source, words, at + 1, count, word)
            at += 1 + count
    if len(lists) < 2 or at == len(words):
        raise source.error("no ScatterAzimuth, ScatterRadial and DataBegin")
    check_zenith(source, "ScatterRadial", lists["ScatterRadial"])
    blocks, skipped = _blocks(source, words, at + 1, len(lists["ScatterAzimuth"]) * len(lists["ScatterRadial"]))
    if not blocks:
        raise source.error(f"none of its {skipped} blocks is a reflection (BRDF) from the front side")
    return _measured(source, options, lists, blocks, skipped)


def _measured(source, options, lists, blocks, skipped):
    channels = sorted({block["channel"] for block in blocks})
    incidences = sorted({block["AOI"] for block in blocks})
    if len(planes := {block["POI"] for block in blocks}) > 1:
        text = f"its blocks have {len(planes)} planes of incidence (POI), and how these count is published nowhere"
        raise source.error(f"{text}; save it for one of them, or as a Zemax .bsdf")
    azimuth, radial = (
        a.reshape(-1) for a in np.meshgrid(lists["ScatterAzimuth"], lists["ScatterRadial"], indexing="ij")
    )
    brdf = np.full((len(incidences), len(azimuth), len(channels)), np.nan)
    for block in blocks:
        brdf[incidences.index(block["AOI"]), :, channels.index(block["channel"])] = block["values"]
    check_zenith(source, "AOI", np.array(incidences))
    notes = (
        [Finding("blocks-skipped", f"{skipped} blocks of transmission or of the back side were skipped")]
        if skipped
        else []
    )
    names = [name for name, _ in channels]
    um = np.array([wave for _, wave in channels]) if all(wave for _, wave in channels) else None
    if names[0] in CHANNEL_UM:
        um, notes = np.array([CHANNEL_UM[name] for name in names]), [*notes, nominal_colours(names)]
    first = [block for block in blocks if block["channel"] == channels[0]]
    notes.append(stated_total.total_note([block["AOI"] for block in first], [block["total"] for block in first]))
    theta_i = np.repeat(incidences, len(azimuth))
    theta_r, phi_r = (np.tile(a, len(incidences)) for a in (radial, azimuth))
    parts = (theta_i, LIGHT_AZIMUTH, theta_r, phi_r, brdf.reshape(-1, len(channels)))
    return azimuths_on_their_side(
        measurement(source, "LightTools .bsdf", *parts, channels=names, wavelength=um, findings=notes), options
    )


def _blocks(source, words, at, size):
    """The reflection blocks of the front side as dicts, and how many others there were."""
    found, skipped, block = [], 0, {}
    while at < len(words) and words[at][0] != "DataEnd":
        word, line = words[at]
        if word in KEYS:
            block[word] = words[at + 1][0] if at + 1 < len(words) else ""
            at += 2
        elif word == "TIS":
            block["total"] = _numbers(source, words, at + 1, 1, "TIS")[0]
            block["values"] = _numbers(source, words, at + 2, size, "a table")
            at += 2 + size
            if block.get("Side", "Front") == "Front" and block.get("ScatterType", "BRDF") == "BRDF":
                found.append(_named(source, block, line))
            else:
                skipped += 1
            block = {}
        else:
            raise source.error(f"found '{word[:40]}', wanted one of {', '.join(KEYS)}, TIS or DataEnd", line)
    if at >= len(words):
        raise source.error("truncated: no DataEnd")
    return found, skipped


def _named(source, block, line):
    """The block with its incidence and plane as numbers and its channel as (name, wavelength in µm)."""
    aoi = source.numbers([block.get("AOI", "0")], line)[0]
    nm = source.numbers([block.get("Wavelength", "0")], line)[0]
    tris = block.get("TristimulusValue", "")
    channel = f"{nm:g}nm" if nm > 0 else "brdf", nm / 1000
    if tris in ("TrisX", "TrisY", "TrisZ"):
        channel = tris.removeprefix("Tris"), 0.0
    poi = source.numbers([block.get("POI", "0")], line)[0]
    return {**block, "AOI": aoi, "POI": poi, "channel": channel}


def _numbers(source, words, at, count, what):
    cells = words[at : at + count]
    if len(cells) < count:
        raise source.error(f"truncated: {what} has {len(cells)} of {count} numbers")
    return np.array([source.numbers([cell], line)[0] for cell, line in cells])


def write(measurement: Measurement) -> tuple[str, list[str]]:
    """The measurement as a LightTools `.bsdf`, and sentences on what was made of it.

    Raises InputError for several channels or rotations, and where the directions lie on no grid about the normal.
    """
    nm = only_channel(measurement, "LightTools")
    grid = product_grid(measurement, about_mirror=False, what="LightTools")
    if len(grid.rotations) > 1:
        text = f"a LightTools file holds one rotation of the sample, there are {len(grid.rotations)}"
        raise InputError(f"{measurement.name}: {text}; convert to zemax or speos-anisotropic")
    azimuth, places = grid.whole_turn(LIGHT_AZIMUTH)
    totals = grid.totals()[0, :, 0]
    notes = about(measurement, "light from azimuth 90, mirror direction at 270", *grid.sentences)
    lines = [*(f"# {text}" for text in notes), "Symmetry Asymmetric", "SpectralContent Monochrome"]
    for key, nodes in (("ScatterAzimuth", azimuth), ("ScatterRadial", grid.polar)):
        lines += [f"{key} {len(nodes)}", "\t".join(map(angle, nodes))]
    lines.append("DataBegin")
    for incidence, theta_i in enumerate(grid.theta_i):
        block = {"AOI": angle(theta_i), "POI": "0", "Side": "Front", "Wavelength": f"{nm:.9g}", "ScatterType": "BRDF"}
        lines += [f"{key} {said}" for key, said in block.items()]
        lines.append(f"TIS {totals[incidence]:.6g}")
        lines += ["\t".join(map(value, row)) for row in grid.values[0, incidence, places, :, 0]]
    lines.append("DataEnd")
    return "\n".join(lines) + "\n", list(grid.sentences)


FORMAT = Format("lighttools-bsdf", (".bsdf",), recognises, read, own_side=False, write=write)

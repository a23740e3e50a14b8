"""Cornell Program of Computer Graphics and pbrt `.brdf`: one stream of numbers in which line breaks mean nothing.

A count N, then N wavelengths [nm], then records of theta_i, phi_i, theta_r, phi_r [rad] and N values [1/sr].
Text after `#` is a comment. The mirror direction is phi_r - phi_i = 180 degrees. An exact 0 means missing.
"""

import re
from itertools import pairwise

import numpy as np

from ..measurement import Measurement
from .format import Format, Options, Source, check_zenith, degrees, measurement

NUMBER = re.compile(r"[-+]?(\d+(\.\d*)?|\.\d+)([eE][-+]?\d+)?")
CHANNELS = range(1, 4096)


def recognises(head: bytes) -> bool:
    """Nothing but comments and numbers, and the numbers begin with a count and as many wavelengths in nm, in order."""
    if b"\0" in head:
        return False
    cut = len(head) == 65536
    words = re.sub(rb"#[^\r\n]*", b"", head).decode("latin-1").split()[: -1 if cut else None]
    if len(words) < 2 or not re.fullmatch(r"[0-9]{1,4}", words[0]) or int(words[0]) not in CHANNELS:
        return False
    start = words[1 : 1 + min(int(words[0]), 8)]
    if not all(NUMBER.fullmatch(word) for word in start):
        return False
    wavelengths = [float(word) for word in start]
    steps = [b - a for a, b in pairwise(wavelengths)]
    return min(wavelengths) >= 100 and (all(step > 0 for step in steps) or all(step < 0 for step in steps))


def read(source: Source, options: Options) -> Measurement:
    """Raises InputError where the count, the wavelengths or the records do not agree."""
    text = re.sub(r"#[^\r\n]*", "", source.text)
    words = text.split()
    count = int(words[0])
    width = count + 4
    if len(words) < 1 + count + width:
        raise source.error(
            f"truncated: {count} wavelengths promised, and one record of {width} numbers; found {len(words) - 1} "
            f"numbers"
        )
    try:
        numbers = np.array(words[1:], float)
    except ValueError:
        raise _not_a_number(source) from None
    um, records = numbers[:count] / 1000, numbers[count:]
    if np.any(~(um > 0)) or not (np.all(np.diff(um) > 0) or np.all(np.diff(um) < 0)):
        raise source.error("the wavelengths do not stand in order")
    if len(records) % width:
        raise source.error(
            f"truncated: the last record has {len(records) % width} of {width} numbers (4 angles and {count} values)"
        )
    records = records.reshape(-1, width)
    angles = degrees(records[:, :4])
    if not np.all(np.isfinite(angles)):
        raise source.error(
            f"record {int(np.flatnonzero(~np.all(np.isfinite(angles), axis=1))[0]) + 1}: an angle is not finite"
        )
    for name, column in (("theta_i", 0), ("theta_r", 2)):
        check_zenith(source, name, angles[:, column])
    channels = [f"{each * 1000:g}nm" for each in um]
    theta_i, phi_i, theta_r, phi_r = angles.T
    values = records[:, 4:]
    return measurement(
        source, "Cornell .brdf", theta_i, phi_i, theta_r, phi_r, values, channels=channels, wavelength=um
    )


def _not_a_number(source: Source):
    for line, text in enumerate(source.lines, 1):
        for word in text.partition("#")[0].split():
            if not NUMBER.fullmatch(word):
                return source.error(f"found '{word[:40]}', wanted a number", line)
    return source.error("holds something that is no number")


FORMAT = Format("cornell", (".brdf",), recognises, read)

"""Measured-data formats, one per file. What a file contains decides which reads it, never its suffix.

read("steel.csv") -> Measurement
"""

import os
import re
from dataclasses import replace
from functools import lru_cache, partial
from pathlib import Path

import numpy as np

from ... import catalog
from ...errors import InputError, NothingLeft, choices
from ...finding import Finding
from ...flags import Effect
from ...opening import Held, is_plain
from .. import conventions
from ..measurement import Measurement
from . import _open, _options, _parts, _rows, _unread
from .format import TEXT_LIMIT, Format, Options, Source, beyond_arithmetic, check_wavelength

HEAD = 65536  # bytes that the readers look at
WRITTEN_AS = {  # what is typed -> the format
    "zemax": "zemax",
    "fred": "fred",
    "lighttools": "lighttools-bsdf",
    "astm": "astm",
    "speos": "speos-brdf",
    "speos-anisotropic": "speos",
    "tracepro": "tracepro",
    "csv": "table",
}
NO_TEXT = re.compile(rb"[\0-\x08\x0e-\x1a\x1c-\x1f]")  # control characters that no text has
OWN_DOCUMENT = re.compile(rb'\s*\{\s*"schema":\s*"brdfguide/')
ONE_NUMBER = re.compile(rb"(?<![^\s,;|])[-+]?(?:\d+(?:[.,]\d*)?|\.\d+)(?:[eEdD][-+]?\d+)?(?![^\s,;|])")  # a cell alone
LARGEST_TABLE = TEXT_LIMIT  # bytes of a file beyond which a table is read block by block
FARTHEST_CHANNEL = 0.1  # of a wavelength: a channel farther away is not the one that was asked for


def names() -> list[str]:
    return catalog.names("data.formats")


def members() -> list[Format]:
    return [catalog.load("data.formats", name).FORMAT for name in names()]


def read(path, *, wavelength=None, in_plane: bool = False, theta_max: float | None = None, **options) -> Measurement:
    """The measurement in a file, with every row dropped and every convention assumed among its findings.

    `path` may be `-` for standard input. `options` are those of `format.Options`: columns, unit, quantity, mirror_side,
    average_phi_i, rotation_sense, wavelength_nm, select, scale. `wavelength` [nm] keeps the nearest channels of a list,
    or those within a (low, high) tuple; `in_plane` keeps the plane of incidence; `theta_max` [deg] drops what is closer
    to grazing.
    Raises InputError with what was found and what was wanted, and for an option without effect.
    """
    asked = _options.checked(Options(**options))
    format, source = opened(path)
    return _read(format, source, asked, wavelength=wavelength, in_plane=in_plane, theta_max=theta_max)


def _read(format: Format, source: Source, asked: Options, **selection) -> Measurement:
    """A file's content as its format and the user say. Raises InputError."""
    _options.heeded(asked, format, source.name)
    with beyond_arithmetic():
        measurement = format.read(source, asked).noting(*source.findings)
    del source
    _options.without_effect(asked, measurement)
    return user_selection(finished(measurement, format, asked), **selection)


def in_blocks(path, *, wavelength=None, in_plane: bool = False, theta_max: float | None = None, **options):
    """A table too large to be held, as `data.blocks.Blocks`; None for any other file. Options as of `read`.

    Raises InputError for what is no row of numbers, and while it is read as `read` does.
    """
    if isinstance(path, Held) or not is_plain(path):
        return None
    asked = _options.checked(Options(**options))
    selection = {"wavelength": wavelength, "in_plane": in_plane, "theta_max": theta_max}
    with _open.stream(path, str(path)) as stream:
        head = stream.read(HEAD)
        known = next((each for each in members() if each.parts and each.recognises(head)), None)
        if known is not None:
            return _in_parts(known, _open.source_of(path, stream, head, known, str(path)), asked, selection)
    if os.path.getsize(path) <= LARGEST_TABLE:
        return None
    format = recognised(head, str(path))
    if format.name != "table":
        return None
    return _rows.blocks(path, lambda source: _read(format, source, asked, **selection))


def _in_parts(format: Format, source: Source, asked: Options, selection: dict):
    """The same of a format that gives its tables in parts."""
    assert format.is_large and format.parts
    if not format.is_large(source):
        return None
    _options.heeded(asked, format, source.name)

    def selected(part: Measurement) -> Measurement:
        _options.without_effect(asked, part)
        return user_selection(finished(part.noting(*source.findings), format, asked), **selection)

    return _parts.in_parts(source.name, partial(format.parts, source, asked), selected)


def writers() -> tuple[str, ...]:
    """What can be written of samples, as typed by users."""
    return tuple(WRITTEN_AS)


def write(target: str, measurement: Measurement) -> tuple[str, list[str]]:
    """A measurement as the text of a format, and sentences on what was lost or interpolated.

    Raises InputError for an unknown target, and for what the format cannot hold.
    """
    if target not in WRITTEN_AS:
        raise choices("format to write", target, writers())
    format = catalog.load("data.formats", WRITTEN_AS[target]).FORMAT
    return format.write(measurement)


def groups(path, column: str, **options) -> tuple[str, ...]:
    """The values of a table's column, in the order in which they come: each is a measurement by itself.

    Raises InputError for what is no table, and for a column that does not group its rows.
    """
    asked = _options.checked(Options(**options))
    format, source = opened(path)
    if format.groups is None:
        raise InputError(
            f"{source.name}: --group has no effect on {format.name} files: they have no columns to group by"
        )
    return format.groups(source, asked, column)


def opened(path) -> tuple[Format, Source]:
    """The format that claims a file, and its content.

    Raises InputError where there is none or the file cannot be read.
    """
    name = "standard input" if str(path) == "-" else str(path)
    with _open.stream(path, name) as stream:
        head = stream.read(HEAD)
        if (known := _of_its_size(stream, head)) is not None:
            format, data = known
            return format, Source(name, data, _open.left_behind(stream))
        format = recognised(head, name)
        return format, _open.source_of(path, stream, head, format, name)


def _of_its_size(stream, head: bytes) -> tuple[Format, bytearray] | None:
    """The format of a binary file that none claims by its first bytes, and its content, where its size is one's own."""
    if not NO_TEXT.search(head):
        return None
    every, plain = members(), _open.plain_head(head)
    if _claims(plain) or _unread.what_instead(plain):
        return None
    most = max(each.exact_bytes or 0 for each in every)
    data = bytearray(head)
    while len(data) <= most and (piece := stream.read(_open.PIECE)):
        data += piece
    found = next((each for each in every if each.exact_bytes == len(data)), None)
    return None if found is None else (found, data)


def is_readable(path) -> bool:
    """Whether a format claims a file, by its first bytes or, of a binary one without a header, by its size.

    Any text might be a table; one of measured values has a line of three numbers near its beginning. JSON might be
    measured too, but what this program printed is not.
    """
    try:
        with _open.stream(path, str(path)) as stream:
            head = stream.read(HEAD)
            if _of_its_size(stream, head) is not None:
                return True
            if OWN_DOCUMENT.match(head):
                return False
            return recognised(head, str(path)).name != "table" or _has_numbers(_open.plain_head(head))
    except InputError:
        return False


def _has_numbers(head: bytes) -> bool:
    return any(len(ONE_NUMBER.findall(line)) >= 3 for line in head.splitlines())


def named_in(path) -> list[Path]:
    """Further files of which a measurement consists, such as photographs; none for one that cannot be read."""
    name = str(path)
    try:
        with _open.stream(path, name) as stream:
            head = stream.read(HEAD)
            plain = _open.plain_head(head)
            format = next((each for each in members() if each.beside and each.recognises(plain)), None)
            if format is None or format.beside is None:
                return []
            return format.beside(Source(name, _open.whole_content(stream, head, format.limit, name)))
    except InputError:
        return []


def function(path, **options):
    """The BRDF that a dense table is, as a function of geometry (samples, 1), and the names of its channels.

    Raises InputError for scattered samples: between them there is nothing but a fit.
    """
    format, source = opened(path)
    if format.function is None:
        known = ", ".join(each.name for each in members() if each.function)
        raise InputError(
            f"{source.name}: scattered samples ({format.name}) have no values between them; fit them and convert "
            f"the fit, "
            f"or start from a dense table ({known})"
        )
    asked = _options.checked(Options(**options))
    _options.heeded(asked, format, source.name)
    return format.function(source, asked)


def is_described(path) -> bool:
    """Whether a YAML file describes a measurement, such as photographs, and not a material."""
    if not str(path).endswith((".yaml", ".yml")) or not is_plain(path):
        return False
    with _open.stream(path, str(path)) as stream:
        head = _open.plain_head(stream.read(HEAD))
    return any(each.recognises(head) for each in members() if ".yaml" in each.suffixes)


def recognised(head: bytes, name: str) -> Format:
    """The one format that claims these first bytes. Raises InputError for none or for two."""
    if not head.strip():
        raise InputError(f"{name}: the file is empty")
    every, head = members(), _open.plain_head(head)
    claims = _claims(head)
    if len(claims) > 1:
        raise InputError(
            f"{name}: two readers claim this file: {' and '.join(each.name for each in claims)}; it follows "
            f"neither format strictly"
        )
    if not claims and (sentence := _unread.what_instead(head)):
        raise InputError(f"{name}: {sentence}")
    table = next(each for each in every if each.name == "table")
    if not claims and not table.recognises(head):
        raise InputError(
            f"{name}: it is binary, and no reader knows it; wanted text with a header row, or a known table format"
        )
    return claims[0] if claims else table


@lru_cache(maxsize=1)  # a file is asked for its size, its format and what lies beside it, one after the other
def _claims(head: bytes) -> tuple[Format, ...]:
    """The formats that claim these first bytes, but for the table that any text might be."""
    return tuple(each for each in members() if each.name != "table" and each.recognises(head))


def finished(measurement: Measurement, format: Format, options: Options) -> Measurement:
    """What holds for every format: the options obeyed, marks for "no data" taken out."""
    if format.own_side and options.mirror_side:
        turn = options.mirror_side in ("negative", "phi=0")
        how = "every reflected direction turned by 180 degrees about the normal" if turn else "as the format has it"
        if turn:
            measurement = replace(measurement, geom=conventions.turned_180(measurement.geom))
        text = f"--mirror-side {options.mirror_side}: {how}"
        measurement = measurement.noting(Finding("mirror-side-by-option", text, settles=("side",)))
    if options.scale is not None:
        measurement = conventions.scaled(measurement, options.scale)
    if options.wavelength_nm is not None:
        measurement = _at_wavelength(measurement, options.wavelength_nm)
    else:
        check_wavelength(Source(measurement.name, b""), measurement.geom.wavelength)
    if options.quantity:
        measurement = conventions.as_brdf(measurement, options.quantity)
        text = f"values taken as {options.quantity}, as --quantity says"
        measurement = measurement.noting(Finding("quantity-by-option", text, settles=("cosine", "scale")))
    return measurement if format.whole_table else conventions.without_marks(measurement)


def _at_wavelength(measurement: Measurement, nm: float) -> Measurement:
    """With the wavelength of --wavelength-nm, where the file says none or that one. Raises InputError for another."""
    stated = np.atleast_1d(measurement.geom.wavelength) * 1000
    effects = {finding.effect for finding in measurement.findings}
    name = measurement.name
    if Effect.NAMES_COLOURS in effects:
        channels = ", ".join(measurement.channels)
        raise InputError(f"{name}: --wavelength-nm {nm:g} has no effect: its channels are colours ({channels})")
    assumed = Effect.ASSUMES_WAVELENGTH in effects
    if not assumed and len(set(stated.tolist())) > 1:
        text = (
            f"its channels state theirs, {stated.min():g} to {stated.max():g} nm; --wavelength {nm:g} picks the nearest"
        )
        raise InputError(f"{name}: --wavelength-nm {nm:g} has no effect: {text}")
    if not assumed and abs(stated[0] - nm) > 1e-6 * nm:
        raise InputError(
            f"{name}: --wavelength-nm {nm:g} contradicts the file, whose values are those of {stated[0]:g} nm"
        )
    kept = tuple(each for each in measurement.findings if each.effect is not Effect.ASSUMES_WAVELENGTH)
    text = f"wavelength {nm:g} nm, as --wavelength-nm says"
    geom = measurement.geom.at(np.full(len(measurement.channels), nm / 1000))
    return replace(measurement, geom=geom, findings=kept).noting(Finding("wavelength-by-option", text))


def user_selection(measurement: Measurement, *, wavelength=None, in_plane=False, theta_max=None) -> Measurement:
    """The channels and directions that the user asked for. Raises InputError where none are left."""
    if wavelength is not None:
        measurement = _channels(measurement, wavelength)
    if in_plane:
        measurement = _kept(
            measurement, measurement.geom.off_plane_deg[:, 0] < 0.1, "in-plane", "in the plane of incidence"
        )
    if theta_max is not None:
        if not 0 < theta_max <= 90:
            raise InputError(f"--theta-max {theta_max:g}: wanted an angle in 0..90 degrees")
        steepest = np.maximum(measurement.geom.theta_i_deg, measurement.geom.theta_r_deg)[:, 0]
        measurement = _kept(
            measurement, steepest <= theta_max + 1e-6, "theta-max", f"within {theta_max:g} degrees of the normal"
        )
        measurement = _with_grazing_decided(measurement)
    return measurement


def _with_grazing_decided(measurement: Measurement) -> Measurement:
    """With the note that a table was extrapolated near grazing as one that the user has answered."""
    findings = tuple(
        replace(each, settles=("grazing",)) if each.effect is Effect.EXTRAPOLATED else each
        for each in measurement.findings
    )
    return replace(measurement, findings=findings)


def _kept(measurement: Measurement, mask, code: str, what: str) -> Measurement:
    count = int(np.count_nonzero(mask))
    if not count:
        raise NothingLeft(f"{measurement.name}: no direction {what}")
    if count == len(mask):
        return measurement
    text = f"{count} of {len(mask)} directions kept: those {what}"
    return measurement[mask].noting(
        Finding(code, text, option=f"--{code}", numbers=(("kept", count), ("of", len(mask))))
    )


def _channels(measurement: Measurement, wavelength) -> Measurement:
    nm = np.broadcast_to(np.asarray(measurement.geom.wavelength, float), (len(measurement.channels),)) * 1000
    if isinstance(wavelength, tuple) and len(wavelength) == 2:
        picked = np.flatnonzero((nm >= wavelength[0] - 1e-6) & (nm <= wavelength[1] + 1e-6))
    else:
        asked = np.atleast_1d(np.asarray(wavelength, float))
        picked = np.unique([_nearest_channel(measurement, nm, each) for each in asked])
    if not len(picked):
        raise InputError(
            f"{measurement.name}: no channel within {wavelength[0]:g}..{wavelength[1]:g} nm; there are "
            f"{nm.min():g}..{nm.max():g} nm"
        )
    if len(picked) == len(nm):
        return measurement
    chosen = tuple(measurement.channels[k] for k in picked)
    geom = measurement.geom.at(nm[picked] / 1000)
    stderr = None if measurement.stderr is None else measurement.stderr[:, picked]
    text = f"channels kept: {', '.join(chosen)} of {len(nm)}"
    return replace(measurement, geom=geom, brdf=measurement.brdf[:, picked], channels=chosen, stderr=stderr).noting(
        Finding("wavelength", text, option="--wavelength", numbers=(("kept", len(picked)), ("of", len(nm))))
    )


def _nearest_channel(measurement: Measurement, nm, asked: float) -> int:
    """The channel whose wavelength is nearest. Raises InputError where even that is a tenth away."""
    nearest = int(np.argmin(np.abs(nm - asked)))
    if abs(nm[nearest] - asked) > FARTHEST_CHANNEL * asked:
        there = f"{nm[0]:g} nm" if len(nm) == 1 else f"{nm.min():g} to {nm.max():g} nm"
        assumed = any(each.effect is Effect.ASSUMES_WAVELENGTH for each in measurement.findings)
        hint = f"; --wavelength-nm {asked:g} says that it is {asked:g}" if assumed else ""
        taken = " (taken, since the file does not say it)" if assumed else ""
        raise InputError(f"{measurement.name}: no channel near {asked:g} nm; there is {there}{taken}{hint}")
    return nearest

"""Measured-data formats, one per file. What a file contains decides which reads it, never its suffix.

    read("steel.csv") -> Measurement
"""

from dataclasses import replace

import numpy as np

from .. import catalog, conventions
from ..errors import InputError, choices
from ..measurement import Finding, Measurement
from . import _open
from ._base import Format, Options, Source

HEAD = 65536  # bytes that the readers look at
QUANTITIES = ("brdf", "brdf-cos", "brdf-cos-i", "reflectance-factor")


def names() -> list[str]:
    return catalog.names("formats")


def members() -> list[Format]:
    return [catalog.load("formats", name).FORMAT for name in names()]


def read(path, *, wavelength=None, in_plane: bool = False, theta_max: float | None = None, **options) -> Measurement:
    """The measurement in a file, with every row dropped and every convention assumed among its findings.

    `path` may be `-` for standard input. `options` are those of `_base.Options` (columns, unit, quantity,
    mirror_side, average_phi_i). `wavelength` [nm] keeps the nearest channels of a list, or those within a
    (low, high) tuple; `in_plane` keeps the plane of incidence; `theta_max` [deg] drops what is closer to grazing.
    Raises InputError with what was found and what was wanted.
    """
    options = _checked(Options(**options))
    format, source = opened(path)
    measurement = format.read(source, options)
    del source
    return selected(finished(measurement, format, options), wavelength=wavelength, in_plane=in_plane, theta_max=theta_max)


def opened(path) -> tuple[Format, Source]:
    """The format that claims a file, and its content. Raises InputError where there is none or the file cannot be read."""
    name = "standard input" if str(path) == "-" else str(path)
    with _open.stream(path, name) as stream:
        head = stream.read(HEAD)
        format = recognised(head, name)
        return format, Source(name, _open.whole(stream, head, format.limit, name, swells=format.whole_table))


def function(path, **options):
    """The BRDF that a dense table is, as a function of geometry (samples, 1), and the names of its channels.

    Raises InputError for scattered samples: between them there is nothing but a fit.
    """
    format, source = opened(path)
    if format.function is None:
        known = ", ".join(each.name for each in members() if each.function)
        raise InputError(
            f"{source.name}: scattered samples ({format.name}) have no values between them; fit them and convert the fit, "
            f"or start from a dense table ({known})"
        )
    return format.function(source, _checked(Options(**options)))


def recognised(head: bytes, name: str) -> Format:
    """The one format that claims these first bytes. Raises InputError for none or for two."""
    if not head.strip():
        raise InputError(f"{name}: the file is empty")
    every, head = members(), _open.plain_head(head)
    claims = [each for each in every if each.name != "table" and each.recognises(head)]
    if len(claims) > 1:
        raise InputError(f"{name}: two readers claim this file: {' and '.join(each.name for each in claims)}; it follows neither format strictly")
    table = next(each for each in every if each.name == "table")
    if not claims and not table.recognises(head):
        raise InputError(f"{name}: it is binary, and no reader knows it; wanted text with a header row, or a known table format")
    return claims[0] if claims else table


def finished(measurement: Measurement, format: Format, options: Options) -> Measurement:
    """What holds for every format: the options obeyed, marks for "no data" taken out."""
    if format.own_side and options.mirror_side in ("negative", "phi=0"):
        text = f"--mirror-side {options.mirror_side}: every reflected direction turned by 180 degrees about the normal"
        measurement = replace(measurement, geom=conventions.turned(measurement.geom)).noting(Finding("mirror-side-by-option", text))
    if options.quantity:
        measurement = conventions.as_brdf(measurement, options.quantity)
        text = f"values taken as {options.quantity}, as --quantity says"
        measurement = measurement.noting(Finding("quantity-by-option", text))
    return measurement if format.whole_table else conventions.without_marks(measurement)


def selected(measurement: Measurement, *, wavelength=None, in_plane=False, theta_max=None) -> Measurement:
    """The channels and directions that the user asked for. Raises InputError where none are left."""
    if wavelength is not None:
        measurement = _channels(measurement, wavelength)
    if in_plane:
        measurement = _kept(measurement, measurement.geom.off_plane_deg[:, 0] < 0.1, "in-plane", "in the plane of incidence")
    if theta_max is not None:
        if not 0 < theta_max <= 90:
            raise InputError(f"--theta-max {theta_max:g}: wanted an angle in 0..90 degrees")
        steepest = np.maximum(measurement.geom.theta_i_deg, measurement.geom.theta_r_deg)[:, 0]
        measurement = _kept(measurement, steepest <= theta_max + 1e-6, "theta-max", f"within {theta_max:g} degrees of the normal")
    return measurement


def _kept(measurement: Measurement, mask, code: str, what: str) -> Measurement:
    count = int(np.count_nonzero(mask))
    if not count:
        raise InputError(f"{measurement.name}: no direction {what}")
    if count == len(mask):
        return measurement
    text = f"{count} of {len(mask)} directions kept: those {what}"
    return measurement[mask].noting(Finding(code, text, option=f"--{code}", numbers=(("kept", count), ("of", len(mask)))))


def _channels(measurement: Measurement, wavelength) -> Measurement:
    nm = np.broadcast_to(np.asarray(measurement.geom.wavelength, float), (len(measurement.channels),)) * 1000
    if isinstance(wavelength, tuple) and len(wavelength) == 2:
        picked = np.flatnonzero((nm >= wavelength[0] - 1e-6) & (nm <= wavelength[1] + 1e-6))
    else:
        asked = np.atleast_1d(np.asarray(wavelength, float))
        picked = np.unique([int(np.argmin(np.abs(nm - each))) for each in asked])
    if not len(picked):
        raise InputError(f"{measurement.name}: no channel within {wavelength[0]:g}..{wavelength[1]:g} nm; there are {nm.min():g}..{nm.max():g} nm")
    if len(picked) == len(nm):
        return measurement
    chosen = tuple(measurement.channels[k] for k in picked)
    geom = measurement.geom.at(nm[picked] / 1000)
    stderr = None if measurement.stderr is None else measurement.stderr[:, picked]
    text = f"channels kept: {', '.join(chosen)} of {len(nm)}"
    return replace(measurement, geom=geom, brdf=measurement.brdf[:, picked], channels=chosen, stderr=stderr).noting(
        Finding("wavelength", text, option="--wavelength", numbers=(("kept", len(picked)), ("of", len(nm))))
    )


def _checked(options: Options) -> Options:
    """Raises InputError for a word that no option takes."""
    for word, kind, known in (
        (options.unit, "unit", ("deg", "rad")),
        (options.quantity, "quantity", QUANTITIES),
        (options.mirror_side, "mirror side", conventions.SIDES),
    ):
        if word is not None and word not in known:
            raise choices(kind, word, known)
    return replace(options, columns=_roles(options.columns)) if isinstance(options.columns, str) else options


def _roles(text: str):
    """`theta_i=AOI,brdf=value` as a mapping, `theta_i,theta_r,brdf` as the names of a table without header."""
    parts = [part.strip() for part in text.split(",")]
    if not any("=" in part for part in parts):
        return tuple(parts)
    pairs = [part.partition("=")[::2] for part in parts]
    if not all(role.strip() and name.strip() for role, name in pairs):
        raise InputError(f"--columns {text}: wanted role=column, such as theta_i=AOI,brdf=value, or names in order for a table without header")
    return {role.strip(): name.strip() for role, name in pairs}

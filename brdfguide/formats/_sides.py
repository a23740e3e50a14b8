"""The side of the mirror direction, where a file leaves it open."""

from dataclasses import replace

from .. import conventions
from ..measurement import Finding, Measurement
from ._base import Options


def on_its_side(result: Measurement, azimuths: bool, options: Options, stated: bool = False) -> Measurement:
    """Turns the directions by 180 degrees where the values say so; notes what was decided, and from what."""
    if options.mirror_side:
        text = f"mirror side {options.mirror_side}, as --mirror-side says"
        return result.noting(Finding("mirror-side-by-option", text))
    if stated:
        return result.noting(Finding("mirror-side", "mirror direction at phi_r - phi_i = 180, as the header states", option="--mirror-side phi=0"))
    side = conventions.side_of(result.geom, result.brdf)
    numbers = (("ln_ahead_over_behind", side.contrast), ("largest", side.largest), ("growth", side.growth))
    turn = side.verdict == "turned" and (side.certain or not azimuths)
    if turn:
        result = replace(result, geom=conventions.turned(result.geom))
        where, option = ("phi_r - phi_i = 0", "--mirror-side phi=180") if azimuths else ("negative theta_r", "--mirror-side positive")
    else:
        where, option = ("phi_r - phi_i = 180", "--mirror-side phi=0") if azimuths else ("positive theta_r", "--mirror-side negative")
    doubtful = side.verdict in ("retro", "untold") and not azimuths or side.verdict == "turned" and not side.certain
    code = "mirror-side-turned" if turn else "mirror-side"
    severity = "warning" if doubtful else "note"
    return result.noting(Finding(code, f"mirror direction at {where}: {side.text}", severity, option=option, numbers=numbers))

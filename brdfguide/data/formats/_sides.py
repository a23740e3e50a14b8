"""The side of the mirror direction, where a file leaves it open."""

from dataclasses import replace

from ...finding import Finding
from .. import conventions
from ..measurement import Measurement
from .format import Options


def azimuths_on_their_side(result: Measurement, options: Options, doubtful: bool = False) -> Measurement:
    """The same of a format with azimuths that leaves the side open: --mirror-side turns them, else the values say.

    `doubtful`: files of the format differ in it, so that values that are not certain decide as well.
    """
    if options.mirror_side in ("negative", "phi=0"):
        result = replace(result, geom=conventions.turned_180(result.geom))
    return on_its_side(result, True, options, doubtful=doubtful)


def on_its_side(
    result: Measurement, azimuths: bool, options: Options, stated: bool = False, doubtful: bool = False
) -> Measurement:
    """Turns the directions by 180 degrees where the values say so; notes what was decided, and from what."""
    if options.mirror_side:
        text = f"mirror side {options.mirror_side}, as --mirror-side says"
        return result.noting(Finding("mirror-side-by-option", text, settles=("side",)))
    if stated:
        return result.noting(
            Finding(
                "mirror-side",
                "mirror direction at phi_r - phi_i = 180, as the header states",
                option="--mirror-side phi=0",
                settles=("side",),
            )
        )
    judged = conventions.as_brdf(result, options.quantity) if options.quantity else result
    side = conventions.side_of(result.geom, judged.brdf)
    numbers = (("ln_ahead_over_behind", side.contrast), ("largest", side.largest), ("growth", side.growth))
    turn = side.verdict == "turned" and (side.certain or doubtful or not azimuths)
    if turn:
        result = replace(result, geom=conventions.turned_180(result.geom))
        where, option = (
            ("phi_r - phi_i = 0", "--mirror-side phi=180")
            if azimuths
            else ("negative theta_r", "--mirror-side positive")
        )
    else:
        where, option = (
            ("phi_r - phi_i = 180", "--mirror-side phi=0")
            if azimuths
            else ("positive theta_r", "--mirror-side negative")
        )
    doubtful = side.verdict in ("retro", "untold") and not azimuths or side.verdict == "turned" and not side.certain
    code = "mirror-side-turned" if turn else "mirror-side"
    severity = "warning" if doubtful else "note"
    return result.noting(
        Finding(
            code,
            f"mirror direction at {where}: {side.text}",
            severity,
            option=option,
            numbers=numbers,
            settles=("side",),
        )
    )

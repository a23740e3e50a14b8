"""What a measurement is and is not: coverage, quantity, conventions, reciprocity, energy, missing zones, spikes, noise.

Each finding has a stable code, a sentence, the numbers behind it, what it changes in an answer, and the option that
overrides it. `corrected` undoes what is certain, and refuses what contradicts itself.
"""

from dataclasses import replace

import numpy as np

from ..errors import InputError, NoAnswer
from ..finding import Finding
from ..flags import Effect
from . import (
    conventions,
    dark_level,
    grazing,
    height_against_width,
    quantity,
    reciprocity,
    reflectance,
    repeats,
    retroreflection,
    rotation,
    scans,
    stated_total,
    subsample,
)
from . import noise as smoothness
from .measurement import Measurement
from .noise import dark_edges, noise, spikes

__all__ = ["corrected", "examine", "noise", "outside", "prepared", "spikes"]
LARGE = 60_000  # directions beyond which a stratified subset is examined


def examine(measurement: Measurement) -> tuple[Finding, ...]:
    """Everything noticed, in the order in which one would ask; nothing is changed."""
    if not np.any(measurement.usable):
        text = "no value is positive: there is nothing to fit"
        return (Finding("no-usable-values", text, "error", numbers=(("values", measurement.brdf.size),)),)
    looked_at = measurement if len(measurement.geom) <= LARGE else subsample.subset(measurement, LARGE // 4)
    spiky = spikes(measurement)
    level = reflectance.measured_reflectance(measurement, spiky)
    found = [
        _coverage(measurement),
        *_angular_range(looked_at),
        *repeats.repeat_findings(measurement),
        *_side(looked_at),
        *_quantity(measurement, quantity.quantity_findings(looked_at, level)),
        *stated_total.total_findings(measurement, level),
    ]
    found += [
        *scans.scan_findings(looked_at),
        *_retro(looked_at),
        *rotation.rotation_findings(looked_at),
        *height_against_width.height_findings(looked_at),
        *_gaps(measurement),
        *_marks(measurement),
        *_spikes(spiky),
        *_edges(measurement),
        *smoothness.noise_findings(measurement),
    ]
    return tuple(found)


def corrected(measurement: Measurement, *, anyway: bool = False) -> Measurement:
    """The measurement with what is certain undone and noted.

    Raises InputError where the values contradict themselves, unless `anyway`.
    """
    return _settled(measurement, anyway)[0]


def prepared(measurement: Measurement, *, anyway: bool = False) -> Measurement:
    """What a fit should see: `corrected`, spikes left out, every doubt among the findings.

    Raises InputError where the values contradict themselves and NoAnswer for a surface outside the guide, unless
    `anyway`.
    """
    measurement = grazing.as_measured(measurement)  # of a large table nothing else is held from here on
    measurement, found = _settled(measurement, anyway)
    false = np.zeros(len(measurement.geom), bool) if anyway else _false(measurement)
    measurement = replace(measurement, noise=smoothness.estimated_noise(measurement).weighing(measurement.brdf))
    beyond = outside((*measurement.findings, *found))
    if beyond and not anyway:
        raise NoAnswer(
            f"{measurement.name or 'measurement'}: {beyond[0].text}; {beyond[0].consequence}; {beyond[0].option} "
            f"answers all the same"
        )
    if np.any(false):
        measurement = replace(measurement, brdf=np.where(false[:, None], np.nan, measurement.brdf))
    return measurement.noting(*(finding for finding in found if finding.severity != "note"))


def as_corrected(block: Measurement, example: Measurement) -> Measurement:
    """A block of a table with all that was undone of a sample of it, and the sample's noise and detector.

    Raises InputError where that cannot be done block by block.
    """
    block = grazing.as_measured(block)
    for finding in example.findings:
        if finding.undo in ("dark-level", "copies"):
            raise InputError(
                f"{example.name}: {finding.text}; of a table that is read block by block it cannot be taken off: "
                f"--anyway leaves it"
            )
        if finding.undo:
            block = _undone(block, finding)
    return replace(block, noise=example.noise, solid_angle=example.solid_angle, findings=())


def _false(measurement: Measurement) -> np.ndarray:
    """(samples,) mask of values that are no surface's: edges, and spikes where no aperture is known, through which a
    mirror's beam could be compared with them."""
    return dark_edges(measurement) | spikes(measurement) if measurement.solid_angle is None else dark_edges(measurement)


def _settled(measurement: Measurement, anyway: bool):
    """`corrected`, and what is found afterwards."""
    for _ in range(4):  # the side first, then a cosine, then the factor pi
        findings = examine(measurement)
        certain = next((finding for finding in findings if finding.undo), None)
        if certain is None:
            break
        measurement = _undone(measurement, certain)
    for finding in (*measurement.findings, *findings):
        if finding.severity == "error" and not anyway:
            hint = f"; {finding.option} overrides this" if finding.option else ""
            raise InputError(f"{measurement.name or 'measurement'}: {finding.text}{hint}")
    return measurement, findings


def changes(measurement: Measurement, found: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """What a fit would change or leave out, of a measurement in which this was `found`."""
    undone = corrected(measurement, anyway=True).findings[len(measurement.findings) :]
    grazes = grazing.extrapolated_finding(measurement)
    return (*undone, *(each for each in (grazes, *found) if each and each.leaves_out))


def plotted(measurement: Measurement):
    """What the picture of an inspection shows: the directions, their spikes, exchanged pairs, reflectance."""
    looked_at = measurement if len(measurement.geom) <= LARGE else subsample.subset(measurement, LARGE // 4)
    spiky = spikes(measurement)
    shown = spiky if looked_at is measurement else np.zeros(len(looked_at.geom), bool)
    return (
        looked_at,
        shown,
        reciprocity.exchanged_pairs(looked_at),
        reflectance.measured_reflectance(measurement, spiky),
    )


def outside(findings) -> tuple[Finding, ...]:
    """Those that put the surface outside the guide: `fit` and `recommend` answer only with --anyway."""
    return tuple(finding for finding in findings if finding.severity == "outside")


def _undone(measurement: Measurement, finding: Finding) -> Measurement:
    """The measurement without what the finding says is wrong with it, and a note of that."""
    if finding.undo == "turn":
        note = replace(finding, code="mirror-side-turned", severity="note", settles=("side",))
        return replace(measurement, geom=conventions.turned_180(measurement.geom)).noting(note)
    if finding.undo == "arm-zero":
        note = replace(finding, text=f"{finding.text}: taken off", severity="note")
        return scans.without_zero(measurement, finding).noting(note)
    if finding.undo == "copies":
        return scans.without_copies(measurement).noting(replace(finding, text=f"{finding.text}: left out"))
    note = replace(finding, text=f"{finding.text}: {conventions.UNDONE[finding.undo]}", severity="note")
    if finding.undo == "dark-level":
        model = smoothness.estimated_noise(measurement)
        return replace(measurement, brdf=dark_level.without_dark_level(measurement), noise=model).noting(note)
    return conventions.as_brdf(measurement, finding.undo).noting(note)


# --- where was measured -----------------------------------------------------------------------------------


def _coverage(m: Measurement) -> Finding:
    incidences = m.theta_i_groups
    theta_i, theta_r = m.geom.theta_i_deg, m.geom.theta_r_deg
    where = "in the plane of incidence" if m.in_plane else "over the hemisphere"
    text = (
        f"{len(m.geom)} directions {where}, {len(incidences)} incidence angles {_span(theta_i)}, reflected "
        f"{_span(theta_r)} degrees"
    )
    numbers = (
        ("directions", len(m.geom)),
        ("incidences", len(incidences)),
        ("theta_i_from_deg", float(theta_i.min())),
        ("theta_i_to_deg", float(theta_i.max())),
        ("theta_r_from_deg", float(theta_r.min())),
        ("theta_r_to_deg", float(theta_r.max())),
        ("missing", m.censored),
        ("values", m.brdf.size),
    )
    return Finding("coverage", text, numbers=numbers)


def _span(angles) -> str:
    low, high = float(np.min(angles)), float(np.max(angles))
    return f"{low:.3g}" if low == high else f"{low:.3g}..{high:.3g}"


def _angular_range(m: Measurement):
    """Where models will differ because nobody looked."""
    usable = m.has_value
    if not np.any(usable):
        return
    for name, code, angles in (
        ("theta_i", "no-data-beyond-theta-i", m.geom.theta_i_deg[usable]),
        ("theta_r", "no-data-beyond-theta-r", m.geom.theta_r_deg[usable]),
    ):
        largest = float(angles.max())
        if largest < 75:
            text = f"no data beyond {name} = {largest:.3g} degrees: models will differ where you have none"
            yield Finding(
                code,
                text,
                "warning",
                "the growth toward grazing is not tested",
                numbers=(("largest_deg", largest),),
            )
    if len(m.theta_i_groups) == 1:
        text = "one incidence angle: how the surface changes with it is not tested"
        yield Finding(
            "one-incidence",
            text,
            "warning",
            "index and roughness cannot be told apart by angle; reciprocity cannot be tested",
        )
    if m.in_plane and np.all(m.geom.signed_theta_r_deg[usable & (m.geom.theta_i_deg[:, 0] > 1)] >= 0):
        text = "only the mirror side of the plane of incidence was measured"
        yield Finding("one-sided", text, consequence="the diffuse level rests on the flank of the lobe")


# --- what the numbers are ---------------------------------------------------------------------------------


def _side(m: Measurement):
    if m.settled("side"):
        return
    side = conventions.side_of(m.geom, m.brdf)
    numbers = (("ln_ahead_over_behind", side.contrast), ("largest", side.largest), ("growth", side.growth))
    if side.verdict == "turned":
        text = f"the values put the mirror direction on the side of the light: {side.text}"
        severity = "warning" if side.certain else "note"
        yield Finding(
            "mirror-side-contradicted",
            text,
            severity,
            "every lobe would be fitted on the wrong side",
            "--mirror-side",
            numbers,
            undo="turn" if side.certain else "",
        )
    else:
        yield Finding("mirror-side", f"mirror direction at phi_r - phi_i = 180: {side.text}", numbers=numbers)


def _quantity(m: Measurement, found):
    """What is `found` about reciprocity and energy; a dark level in place of the dim values that it explains."""
    found = tuple(found)
    dark = None if any(each.undo for each in found) else dark_level.dark_level_finding(m)
    if dark is None:
        return found
    return (dark, *(each for each in found if each.effect is not Effect.OF_DIM_VALUES))


# --- what the surface is ----------------------------------------------------------------------------------


def _retro(m: Measurement):
    found = retroreflection.lobe(m)
    if found is None or found.lobe < 1.5:
        return
    numbers = (
        ("lobe_over_surroundings", found.lobe),
        ("over_mirror_side", found.over_mirror),
        ("incidences", found.incidences),
    )
    text = (
        f"a lobe toward the source, {found.lobe:.3g} times its surroundings and {found.over_mirror:.3g} times the "
        f"mirror side"
    )
    if found.lobe > 3 and found.over_mirror > 0.3:
        yield Finding(
            "retro-reflector",
            f"{text}: a retro-reflector",
            "outside",
            "no model of the guide has such a lobe",
            "--anyway",
            numbers,
        )
    else:
        yield Finding("retro-peak", text, "warning", "only a retro-reflecting lobe could follow it", numbers=numbers)


# --- what is wrong with single values ---------------------------------------------------------------------


def _gaps(m: Measurement):
    """Zones where every value is missing."""
    missing = ~m.has_value
    count = int(np.count_nonzero(missing))
    if count:
        steepest = np.maximum(m.geom.theta_i_deg, m.geom.theta_r_deg)[missing]
        text = f"{count} of {len(missing)} directions have no usable value in any channel"
        yield Finding(
            "missing-zone",
            text,
            consequence="no model is tested there",
            numbers=(("directions", count), ("from_theta_deg", float(steepest.min()))),
        )
    absent = ~m.usable_beside(smoothness.estimated_noise(m))[~missing]
    partly = int(np.count_nonzero(absent))
    if partly > 0.02 * m.brdf.size:
        worst = int(np.argmax(np.count_nonzero(absent, axis=0)))
        text = f"{partly} further values are missing or not positive, most in channel {m.channels[worst]}"
        yield Finding(
            "missing-values",
            text,
            "warning",
            "dim channels are fitted by their brighter directions only",
            numbers=(("values", partly),),
        )


def _marks(m: Measurement):
    """Saturation: the highest value again and again."""
    top = np.max(m.brdf, where=m.usable, initial=0.0)
    high = m.usable & (m.brdf > 0.999 * top)
    nearly = m.brdf[high] < top
    count = int(np.count_nonzero(~nearly))
    rows = np.unique(np.nonzero(high)[0][~nearly])
    # a lobe that is even all round repeats its top at one distance
    places = np.unique(np.round(m.geom.mirror_distance2[rows, 0], 4))
    if (
        count >= 4
        and count < 0.2 * np.count_nonzero(m.usable)
        and len(places) > 2
        and count > 3 * np.count_nonzero(nearly)
    ):
        text = f"the highest value, {top:g}/sr, stands {count} times: the detector's limit"
        yield Finding(
            "saturated",
            text,
            "warning",
            "peaks are higher than measured",
            numbers=(("values", count), ("limit_per_sr", float(top))),
        )
    negative = int(np.count_nonzero(m.brdf < 0))
    if negative:
        colours = smoothness.outside_srgb(m)
        why = ": noise about zero" + (", or a colour outside sRGB" if set(m.channels) == set("RGB") else "")
        if colours:
            why = f", most of channel {' and '.join(colours)}: a colour outside sRGB"
        part = "upper limits" if any(smoothness.estimated_noise(m).absolute) else "they take no part in a fit"
        text = f"{negative} values are negative{why}; {part}"
        yield Finding(
            "negative-values",
            text,
            "warning" if negative > 0.02 * m.brdf.size else "note",
            numbers=(("values", negative),),
        )


def _spikes(spiky):
    count = int(np.count_nonzero(spiky))
    if count:
        text = (
            f"{count} samples at the mirror direction stand alone above their surroundings: an ideal mirror seen "
            f"through the instrument"
        )
        yield Finding(
            "spikes",
            text,
            "warning",
            "their height is the aperture's, not the surface's: left out of fits",
            "--anyway",
            (("samples", count),),
            leaves_out=True,
        )


def _edges(m: Measurement):
    count = int(np.count_nonzero(dark_edges(m)))
    if count:
        text = (
            f"{count} outermost samples of their scans fall below a tenth of their neighbours: cut off by the "
            f"horizon or the holder"
        )
        numbers = (("samples", count),)
        yield Finding("dark-edge", text, "warning", "left out of fits", "--anyway", numbers, leaves_out=True)

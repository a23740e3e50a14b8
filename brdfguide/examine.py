"""What a measurement is and is not: coverage, quantity, conventions, reciprocity, energy, missing zones, spikes, noise.

Each finding has a stable code, a sentence, the numbers behind it, what it changes in an answer, and the option that overrides it.
`corrected` undoes what is certain, and refuses what contradicts itself.
"""

from dataclasses import replace

import numpy as np

from . import conventions, quantity, reciprocity, reflectance, retro, sampling
from .errors import InputError, NoAnswer
from .measurement import Finding, Measurement
from .smoothness import dark_edges, noise, spikes

__all__ = ["corrected", "examine", "noise", "outside", "prepared", "spikes"]
LARGE = 60_000  # directions beyond which a stratified subset is examined
SIDE_KNOWN = {"mirror-side", "mirror-side-turned", "mirror-side-by-option"}


def examine(measurement: Measurement) -> tuple[Finding, ...]:
    """Everything noticed, in the order in which one would ask; nothing is changed."""
    if not np.any(measurement.usable):
        text = "no value is positive: there is nothing to fit"
        return (Finding("no-usable-values", text, "error", numbers=(("values", measurement.brdf.size),)),)
    looked_at = measurement if len(measurement.geom) <= LARGE else sampling.subset(measurement, LARGE // 4)
    spiky = spikes(measurement)
    found = [_coverage(measurement), *_reach(looked_at), *_side(looked_at), *quantity.findings(looked_at, reflectance.measured(measurement, spiky))]
    found += [*_retro(looked_at), *_rotation(looked_at), *_gaps(measurement), *_marks(measurement), *_spikes(spiky), *_edges(measurement), *_noise(measurement)]
    return tuple(found)


def corrected(measurement: Measurement, *, anyway: bool = False) -> Measurement:
    """The measurement with what is certain undone and noted. Raises InputError where the values contradict themselves, unless `anyway`."""
    return _settled(measurement, anyway)[0]


def prepared(measurement: Measurement, *, anyway: bool = False) -> Measurement:
    """What a fit should see: `corrected`, spikes left out, every doubt among the findings.

    Raises InputError where the values contradict themselves and NoAnswer for a surface outside the guide, unless `anyway`.
    """
    measurement, found = _settled(measurement, anyway)
    beyond = outside((*measurement.findings, *found))
    if beyond and not anyway:
        raise NoAnswer(f"{measurement.name or 'measurement'}: {beyond[0].text}; {beyond[0].consequence}; {beyond[0].option} answers all the same")
    if not anyway:
        false = dark_edges(measurement)
        if measurement.solid_angle is None:  # with it, a mirror term can be compared with a spike
            false = false | spikes(measurement)
        if np.any(false):
            measurement = replace(measurement, brdf=np.where(false[:, None], np.nan, measurement.brdf))
    return measurement.noting(*(finding for finding in found if finding.severity != "note"))


def _settled(measurement: Measurement, anyway: bool):
    """`corrected`, and what is found afterwards."""
    for _ in range(4):  # the side first, then a cosine, then the factor pi
        findings = examine(measurement)
        found = {finding.code: finding for finding in findings}
        if "mirror-side-contradicted" in found and found["mirror-side-contradicted"].severity == "warning":
            note = replace(found["mirror-side-contradicted"], code="mirror-side-turned", severity="note")
            measurement = replace(measurement, geom=conventions.turned(measurement.geom)).noting(note)
        elif "cosine-weighted" in found:
            measurement = conventions.as_brdf(measurement, "brdf-cos").noting(_undone(found["cosine-weighted"], "divided by cos theta_r"))
        elif "cosine-i-weighted" in found:
            measurement = conventions.as_brdf(measurement, "brdf-cos-i").noting(_undone(found["cosine-i-weighted"], "divided by cos theta_i"))
        elif "reflectance-factor" in found:
            measurement = conventions.as_brdf(measurement, "reflectance-factor").noting(_undone(found["reflectance-factor"], "divided by pi"))
        else:
            break
    for finding in findings:
        if finding.severity == "error" and not anyway:
            hint = f"; {finding.option} overrides this" if finding.option else ""
            raise InputError(f"{measurement.name or 'measurement'}: {finding.text}{hint}")
    return measurement, findings


def drawn(measurement: Measurement):
    """What the picture of an inspection shows: the directions, their spikes, exchanged pairs, reflectance."""
    looked_at = measurement if len(measurement.geom) <= LARGE else sampling.subset(measurement, LARGE // 4)
    spiky = spikes(measurement)
    shown = spiky if looked_at is measurement else np.zeros(len(looked_at.geom), bool)
    return looked_at, shown, reciprocity.pairs(looked_at), reflectance.measured(measurement, spiky)


def outside(findings) -> tuple[Finding, ...]:
    """Those that put the surface outside the guide: `fit` and `recommend` answer only with --anyway."""
    return tuple(finding for finding in findings if finding.severity == "outside")


def _undone(finding: Finding, how: str) -> Finding:
    return replace(finding, text=f"{finding.text}: {how}", severity="note")


# --- where was measured -----------------------------------------------------------------------------------


def _coverage(m: Measurement) -> Finding:
    incidences = m.theta_i_groups
    theta_i, theta_r = m.geom.theta_i_deg, m.geom.theta_r_deg
    where = "in the plane of incidence" if m.in_plane else "over the hemisphere"
    text = f"{len(m.geom)} directions {where}, {len(incidences)} incidence angles {_span(theta_i)}, reflected {_span(theta_r)} degrees"
    numbers = (
        ("directions", len(m.geom)), ("incidences", len(incidences)), ("theta_i_from_deg", float(theta_i.min())), ("theta_i_to_deg", float(theta_i.max())),
        ("theta_r_from_deg", float(theta_r.min())), ("theta_r_to_deg", float(theta_r.max())), ("missing", m.censored), ("values", m.brdf.size),
    )  # fmt: skip
    return Finding("coverage", text, numbers=numbers)


def _span(angles) -> str:
    low, high = float(np.min(angles)), float(np.max(angles))
    return f"{low:.3g}" if low == high else f"{low:.3g}..{high:.3g}"


def _reach(m: Measurement):
    """Where models will differ because nobody looked."""
    usable = m.seen
    for name, angles in (("theta_i", m.geom.theta_i_deg[usable]), ("theta_r", m.geom.theta_r_deg[usable])):
        largest = float(angles.max())
        if largest < 75:
            text = f"no data beyond {name} = {largest:.3g} degrees: models will differ where you have none"
            yield Finding(f"no-data-beyond-{name.replace('_', '-')}", text, "warning", "the growth toward grazing is not tested", numbers=(("largest_deg", largest),))
    if len(m.theta_i_groups) == 1:
        text = "one incidence angle: how the surface changes with it is not tested"
        yield Finding("one-incidence", text, "warning", "index and roughness cannot be told apart by angle; reciprocity cannot be tested")
    if m.in_plane and np.all(m.geom.signed_theta_r_deg[usable & (m.geom.theta_i_deg[:, 0] > 1)] >= 0):
        text = "only the mirror side of the plane of incidence was measured"
        yield Finding("one-sided", text, consequence="the diffuse level rests on the flank of the lobe")


# --- what the numbers are ---------------------------------------------------------------------------------


def _side(m: Measurement):
    if SIDE_KNOWN & {finding.code for finding in m.findings}:
        return
    side = conventions.side_of(m.geom, m.brdf)
    numbers = (("ln_ahead_over_behind", side.contrast), ("largest", side.largest), ("growth", side.growth))
    if side.verdict == "turned":
        text = f"the values put the mirror direction on the side of the light: {side.text}"
        severity = "warning" if side.certain else "note"
        yield Finding("mirror-side-contradicted", text, severity, "every lobe would be fitted on the wrong side", "--mirror-side", numbers)
    else:
        yield Finding("mirror-side", f"mirror direction at phi_r - phi_i = 180: {side.text}", numbers=numbers)


# --- what the surface is ----------------------------------------------------------------------------------


def _retro(m: Measurement):
    found = retro.lobe(m)
    if found is None or found.lobe < 1.5:
        return
    numbers = (("lobe_over_surroundings", found.lobe), ("over_mirror_side", found.over_mirror), ("incidences", found.incidences))
    text = f"a lobe toward the source, {found.lobe:.3g} times its surroundings and {found.over_mirror:.3g} times the mirror side"
    if found.lobe > 3 and found.over_mirror > 0.3:
        yield Finding("retro-reflector", f"{text}: a retro-reflector", "outside", "no model of the guide has such a lobe", "--anyway", numbers)
    else:
        yield Finding("retro-peak", text, "warning", "only a retro-reflecting lobe could follow it", numbers=numbers)


def _rotation(m: Measurement):
    """Does the value depend on how the sample is turned?"""
    geom = m.geom
    if {"anisotropic", "averaged-over-rotation", "isotropic"} & {finding.code for finding in m.findings}:
        return  # the reader saw the rotations, which the measurement no longer has
    if len(np.unique(np.round(geom.phi_i_deg[geom.theta_i_deg > 1], 0))) > 1:
        phi = np.abs(np.remainder(geom.phi_deg[:, 0] + 180.0, 360.0) - 180.0)
        keys = np.round(np.stack([geom.theta_i_deg[:, 0], geom.theta_r_deg[:, 0], phi], axis=1), 1)
        _, group = np.unique(keys, axis=0, return_inverse=True)
        usable = np.all(m.usable, axis=1)
        level = np.mean(np.log(np.where(m.usable, m.brdf, 1.0)), axis=1)
        spread = _spread_within(group.reshape(-1)[usable], level[usable])
        if spread is not None:
            numbers, scatter = (("rms_ln_over_rotation", spread),), noise(m) or 0.02
            if spread > max(0.2, 5 * scatter):
                text = f"anisotropic: turning the sample changes values by {np.expm1(spread):.0%} (rms)"
                yield Finding("anisotropic", text, "outside", "the guide's models are isotropic", "--anyway", numbers)
            else:
                yield Finding("isotropic", f"isotropic: turning the sample changes values by {np.expm1(spread):.1%} (rms)", numbers=numbers)
            return
    text = "one rotation of the sample: whether it is isotropic cannot be told" + (" from the plane of incidence" if m.in_plane else "")
    yield Finding("rotation-untold", text, consequence="a brushed surface would be fitted for one direction of brushing only")


def _spread_within(group, level) -> float | None:
    """rms departure from the mean of those that differ in rotation only; None where less than ten do."""
    counts = np.bincount(group)
    mean = np.bincount(group, level) / np.maximum(counts, 1)
    repeated = counts[group] > 1
    if np.count_nonzero(repeated) < 10:
        return None
    freedom = np.count_nonzero(repeated) - np.count_nonzero(counts > 1)
    return float(np.sqrt(np.sum((level - mean[group])[repeated] ** 2) / freedom))


# --- what is wrong with single values ---------------------------------------------------------------------


def _gaps(m: Measurement):
    """Zones where every value is missing."""
    missing = ~m.seen
    count = int(np.count_nonzero(missing))
    if count:
        steepest = np.maximum(m.geom.theta_i_deg, m.geom.theta_r_deg)[missing]
        text = f"{count} of {len(missing)} directions have no usable value in any channel"
        yield Finding("missing-zone", text, consequence="no model is tested there", numbers=(("directions", count), ("from_theta_deg", float(steepest.min()))))
    partly = m.censored - count * len(m.channels)
    if partly > 0.02 * m.brdf.size:
        worst = int(np.argmin(np.count_nonzero(m.usable, axis=0)))
        text = f"{partly} further values are missing or not positive, most in channel {m.channels[worst]}"
        yield Finding("missing-values", text, "warning", "dim channels are fitted by their brighter directions only", numbers=(("values", partly),))


def _marks(m: Measurement):
    """Saturation: the highest value again and again."""
    values = m.brdf[m.usable]
    top = values.max()
    count = int(np.count_nonzero(values == top))
    rows = np.any(m.usable & (m.brdf == top), axis=1)
    places = np.unique(np.round(m.geom.mirror_distance2[rows, 0], 4))  # a lobe that is even all round repeats its top at one distance
    if count >= 4 and count < 0.2 * values.size and len(places) > 2 and count > 3 * np.count_nonzero((values < top) & (values > 0.999 * top)):
        text = f"the highest value, {top:g}/sr, stands {count} times: the detector's limit"
        yield Finding("saturated", text, "warning", "peaks are higher than measured", numbers=(("values", count), ("limit_per_sr", float(top))))
    negative = int(np.count_nonzero(m.brdf < 0))
    if negative:
        why = "noise about zero" + (", or a colour outside sRGB" if set(m.channels) == set("RGB") else "")
        text = f"{negative} values are negative: {why}; they take no part in a fit"
        yield Finding("negative-values", text, "warning" if negative > 0.02 * m.brdf.size else "note", numbers=(("values", negative),))


def _spikes(spiky):
    count = int(np.count_nonzero(spiky))
    if count:
        text = f"{count} samples at the mirror direction stand alone above their surroundings: an ideal mirror seen through the instrument"
        yield Finding("spikes", text, "warning", "their height is the aperture's, not the surface's: left out of fits", "--anyway", (("samples", count),))


def _edges(m: Measurement):
    count = int(np.count_nonzero(dark_edges(m)))
    if count:
        text = f"{count} outermost samples of their scans fall below a tenth of their neighbours: cut off by the horizon or the holder"
        yield Finding("dark-edge", text, "warning", "left out of fits", "--anyway", (("samples", count),))


def _noise(m: Measurement):
    level = noise(m)
    if level is None:
        return
    severity = "warning" if level > 0.15 else "note"
    yield Finding("noise", f"single values scatter by {level:.2g} (relative, from their neighbours)", severity, numbers=(("relative", level),))

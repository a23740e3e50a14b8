"""What is done to a file of measured data, the same on every road: alone, among many, in another process."""

from dataclasses import replace
from typing import Any

import numpy as np

from ..data import examine, formats, height_against_width, joined, lobe_ellipse, metal_or_dielectric
from ..data.blocks import Blocks
from ..data.measurement import Measurement
from ..data.metal_or_dielectric import Verdict
from ..data.power_law import power_law
from ..data.turning import turn_of_each
from ..finding import Finding
from ..models import Composite, candidates
from ..physics.aperture import solid_angle_of
from ..records import dataclass
from .fit import FitOptions


@dataclass(frozen=True)
class Job:
    """How a file is read, which models are tried, how they are fitted and what is told about it."""

    reading: tuple[tuple[str, Any], ...] = ()  # keyword arguments of formats.read
    turned: tuple[float, ...] = ()  # [deg] of the sample: the files are scans of one
    aperture_deg: float | None = None  # half angle of the detector's cone
    anyway: bool = False  # also outside the guide, and against contradictions
    kind: str | None = None  # None: what the data say
    models: tuple[str, ...] | None = None
    options: FitOptions = FitOptions()
    timing: bool = True  # whether the answer holds times, which differ from run to run


PLAINLY = Job()


@dataclass(frozen=True, eq=False)
class Case:
    """A measurement as a fit should see it, whether it is a metal, and the models worth trying on it."""

    measurement: Measurement
    judged: Verdict
    candidates: tuple[Composite, ...]
    kind: str | None  # what it was told or the data say
    grows: bool  # whether candidates grow from the best of them; not where they were named
    blocks: Blocks | None = None  # of a table too large to be held, of which the measurement is a sample


def case(file, job: Job) -> Case:
    """The case that a file is, or several that are scans of one sample; a table too large to be held is read block by
    block.

    Raises InputError and NoAnswer as `read_for_fit`, and for an unknown model or kind.
    """
    blocks = None if job.turned else formats.in_blocks(file, **dict(job.reading))
    return case_of(read_for_fit(file, job), job) if blocks is None else case_of_blocks(blocks, job)


def case_of_blocks(blocks: Blocks, job: Job) -> Case:
    """The same of a measurement that comes in blocks: a sample of it is fitted."""
    sample = examine.prepared(_behind_aperture(blocks.sample(), job), anyway=job.anyway)
    return replace(case_of(sample, job), blocks=blocks)


def case_of(measurement: Measurement, job: Job) -> Case:
    """The same of a measurement that was examined. Raises InputError for an unknown model or kind."""
    judged = metal_or_dielectric.verdict(measurement)
    kind = job.kind or judged.known
    tried = candidates.of_kind(
        kind, job.models, **_polish(measurement) if job.models is None else {}, grain=_grain(measurement)
    )
    if job.kind and judged.known and job.kind != judged.known:
        text = f"--kind {job.kind}, and the data say {judged.known}: {'; '.join(judged.evidence)}"
        measurement = measurement.noting(Finding("kind-contradicted", text, "warning", option="--kind"))
    return Case(measurement, judged, tried, kind, job.models is None)


def _polish(measurement: Measurement) -> dict[str, bool]:
    """Whether laws of polished optics are worth trying, and whether the detector saw the mirror beam."""
    return {"polished": power_law(measurement) is not None, "beam": bool(np.any(measurement.instrument.beam > 0))}


def _grain(measurement: Measurement) -> candidates.Grained | None:
    """What the data tell of a grain; None where the sample was not turned and its lobe looks round."""
    two = lobe_ellipse.two_azimuths(measurement)
    if two:
        ellipse = lobe_ellipse.lobe_ellipse(measurement)
        return candidates.Grained(ellipse.axis if ellipse else two[0])
    if turn_of_each(measurement.geom) is not None or lobe_ellipse.looks_grained(measurement):
        return candidates.Grained()
    if height_against_width.is_too_high(measurement):
        return candidates.Grained(axis=0.0, one_scan=True)
    return None


def read_for_fit(file, job: Job = PLAINLY) -> Measurement:
    """The measurement in a file, or in files of one sample under several turns, with the detector's aperture, what is
    certainly wrong undone, spikes left out and every doubt noted.

    Raises InputError for what cannot be read or contradicts itself, NoAnswer for a surface outside the guide.
    """
    if job.turned:
        files = file if isinstance(file, (list, tuple)) else [file]
        turned = joined.read_turned(files, job.turned, anyway=job.anyway, **dict(job.reading))
        return examine.prepared(_behind_aperture(turned, job), anyway=job.anyway)
    # no name for what was read: of a large table it is gone once its parts are taken
    return examine.prepared(_behind_aperture(formats.read(file, **dict(job.reading)), job), anyway=job.anyway)


def _behind_aperture(measurement: Measurement, job: Job) -> Measurement:
    """With the detector that was told."""
    if job.aperture_deg is None:
        return measurement
    return replace(measurement, solid_angle=solid_angle_of(job.aperture_deg))

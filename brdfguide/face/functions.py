"""read, fit, recommend, evaluate, export, compare, preview: what a notebook calls, and the command line too."""

from collections.abc import Callable, Iterable, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..data.blocks import Blocks
from ..data.measurement import Measurement
from ..errors import InputError
from .answers import CompareAnswer, FitAnswer, Preview, RecommendAnswer
from .surfaces import surface_from

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ..exporters.exporter import Export
    from ..fitting.job import Case, Job

Path_ = str | PathLike[str]
Tell = Callable[[str], None]


def read(
    path: Path_,
    *,
    aperture_deg: float | None = None,
    wavelength: Iterable[float] | tuple[float, float] | None = None,
    in_plane: bool = False,
    theta_max: float | None = None,
    **meaning: Any,
) -> Measurement:
    """The measurement in a file, of any format that `brdfguide inspect` reads, with what was assumed and dropped.

    Takes  aperture_deg, half angle of the detector's cone; wavelength [nm], a list of channels or a (low, high) range;
    in_plane and theta_max [deg] to keep some directions; and what the file means where it does not say so: columns,
    unit, quantity, mirror_side, wavelength_nm, select, average_phi_i, as the options of `fit`.
    Gives  a Measurement: `brdf` (samples, channels) [1/sr], NaN where there is no value, `geom` with angles of shape
    (samples, 1).    Raises InputError with the line of what is wrong, and for an option without effect.
    """
    from dataclasses import replace

    from ..data import formats
    from ..physics.aperture import solid_angle_of

    found = formats.read(Path(path), wavelength=wavelength, in_plane=in_plane, theta_max=theta_max, **meaning)
    return found if aperture_deg is None else replace(found, solid_angle=solid_angle_of(aperture_deg))


def fit(
    data: Measurement | Blocks | Path_,
    models: Iterable[str] | None = None,
    *,
    kind: str | None = None,
    metric: str = "ln",
    close: str = "look",
    weights: str = "auto",
    robust: bool = False,
    shape_per_channel: bool = False,
    fixed: Mapping[str, float] | None = None,
    start: Mapping[str, float] | None = None,
    anyway: bool = False,
    timing: bool = True,
    progress: Tell = lambda what: None,
) -> FitAnswer:
    """The candidate models fitted to a measurement, in order of error, with the one to use.

    Takes  data, a file, a Measurement, or `data.blocks.Blocks` of one too large to be held, of which a sample is
    fitted and errors in ln are over all; models, expressions such as "lambertian+ggx", else the guide's candidates
    for a metal or dielectric (`kind`; None: as the data say); metric ln, cube-root, relative, cosine or seen; close,
    what may be taken in place of the best: look, none or 1%; weights auto, none, stderr or sampling; fixed and start,
    values by parameter, angles in degrees; anyway, also against contradictions and outside the guide.
    Gives  a FitAnswer; its `no_answer` says why where no model should be trusted.    Raises InputError for data that
    contradict themselves, NoAnswer for a surface outside the guide's domain and where nothing converged.
    Source: every model's own file; how, README's "What a fit is".
    """
    from ..data import examine
    from ..fitting.fit import FitOptions
    from ..fitting.job import Job, case, case_of, case_of_blocks

    options = FitOptions(
        metric=metric,
        close=close,
        weights=weights,
        robust=robust,
        shape_per_channel=shape_per_channel,
        fixed=fixed or {},
        start=start or {},
    )
    models = (models,) if isinstance(models, str) else models
    names = None if models is None else tuple(models)
    job = Job(anyway=anyway, kind=kind, models=names, options=options, timing=timing)
    if isinstance(data, Blocks):
        return answered(case_of_blocks(data, job), job, progress)
    if isinstance(data, Measurement):
        return answered(case_of(examine.prepared(data, anyway=anyway), job), job, progress)
    return answered(case(Path(data), job), job, progress)


def answered(found: "Case", job: "Job", progress: Tell = lambda what: None) -> FitAnswer:
    """The answer to a case; `no_answer` says where none of its models should be trusted. Raises NoAnswer where no model
    converged."""
    from ..fitting.compare import compare
    from ..fitting.over_blocks import with_errors_over
    from ..fitting.trust import distrusted

    ranked = compare(
        found.measurement,
        found.candidates,
        job.options,
        progress,
        grows=found.grows,
        kind=found.kind,
        timed=job.timing,
    )
    if found.blocks is not None:
        ranked = with_errors_over(ranked, found.blocks, found.measurement, progress)
    asked = job.anyway or job.models is not None  # models that were named are answered for, with the doubt
    return FitAnswer(distrusted(ranked, anyway=asked), found.measurement, found.judged, job.timing, dict(job.reading))


def recommend(
    description: Path_ | Mapping[str, Any] | None = None,
    *,
    models: Iterable[str] | None = None,
    anyway: bool = False,
    **observations: Any,
) -> RecommendAnswer:
    """Models with values to begin with, for a surface that is described and not measured.

    Takes  a name of `brdfguide materials`, a YAML file, or observations by the keys that such a file has, as a mapping
    or as keywords: recommend(finish="satin", composition="plastic"); models in place of the guide's choice; anyway,
    also outside its domain.
    Gives  a RecommendAnswer, without candidates outside the domain.    Raises InputError with every mistake at once.
    Source: Westin, Li and Torrance 2004, by the rules of advice/guidelines.
    """
    from ..advice import library, material
    from ..advice import recommend as advisor

    if (description is None) == (not observations):
        raise InputError("wanted a description or observations, and not both")
    if isinstance(description, (str, PathLike)):
        text = str(description)
        described = material.read_material(text if text.endswith((".yaml", ".yml")) else library.path(text))
    else:
        described = material.observed(observations if description is None else description)
    return RecommendAnswer(advisor.recommend(described, anyway, None if models is None else list(models)))


def evaluate(
    surface: Any,
    theta_i: "ArrayLike | Measurement",
    theta_r: "ArrayLike | None" = None,
    phi: "ArrayLike" = 180.0,
    *,
    wavelength_nm: float | None = None,
    **values: Any,
) -> np.ndarray:
    """The finite part of the BRDF [1/sr].

    Takes  a Surface, an answer, or words such as "ggx", with `values` by name, angles in degrees; theta_i, theta_r and
    phi = phi_r - phi_i [deg], 180 in the mirror direction, which broadcast, a negative theta_r half a turn away; or a
    Measurement in place of theta_i: its directions, channels and aperture; wavelength_nm in place of the surface's own.
    Gives  (..., channels): the angles' common shape and the surface's channels, or (samples, channels) for a
    Measurement.    Raises InputError for angles beyond the horizon and for values where the law does not hold.
    """
    from ..fitting.reading import reading
    from ..physics.aperture import Instrument
    from ..physics.geometry import rows, signed

    found = surface_from(surface, values)
    if wavelength_nm is not None:
        found = found.at(wavelength_nm / 1000)
    if isinstance(theta_i, Measurement):
        if theta_r is not None:
            raise InputError("a measurement brings its directions along; theta_r has no effect beside it")
        return reading(
            found.in_channels(theta_i.channels, theta_i.geom.wavelength, theta_i.name or "the measurement"),
            theta_i.instrument,
        )
    if theta_r is None:
        raise InputError("theta_r is missing: degrees, positive on the mirror side of the normal")
    geom = signed(theta_i, theta_r, phi)
    return reading(found, Instrument(rows(geom))).reshape(*geom.shape, len(found.channels))


def export(
    surface: Any,
    target: str,
    path: Path_ | None = None,
    *,
    name: str | None = None,
    most_rms_ln: float | None = None,
    data: Measurement | None = None,
    **values: Any,
) -> "Export":
    """A surface as a file for a renderer, and what that costs: exact, refit or lossy.

    Takes  a Surface, an answer or words, with `values` as in `evaluate`; a target of `brdfguide export`; a path to
    write, with files that must lie beside it, else nothing is written; most_rms_ln, the error from which it is refused;
    data, whose directions it is judged over.
    Gives  an Export: `content`, text or bytes; `statement`; `beside`, further files by name.    Raises InputError for
    an unknown target, NoAnswer where the target cannot express the surface or errs by more.
    """
    from .. import exporters
    from ..files import write_whole

    stem = Path(path).stem if path is not None else name or "surface"
    found = exporters.coloured(surface_from(surface, values), name or stem)
    geom = None if data is None else data.geom
    made = exporters.export(target, found, geom, most=most_rms_ln, stem=stem)
    if path is not None:
        for file, content in exporters.files_of(made, Path(path)).items():
            write_whole(file, content)
    return made


def compare(one: Any, other: Any, *, aperture_deg: float | None = None) -> CompareAnswer:
    """How different two surfaces look side by side: S, the rms difference in lightness L* of two spheres.

    Takes  for each a Surface, an answer, a Measurement, or words: a model with its values, a fit's JSON, a material, a
    file of data; aperture_deg, half angle of the detector's cone that models are read through.
    Gives  a CompareAnswer.    Raises InputError for two measurements of different directions.
    Source: docs/seen.md.
    """
    from ..fitting.side_by_side import pair
    from ..physics.aperture import solid_angle_of
    from .sides import compared_side

    solid_angle = None if aperture_deg is None else solid_angle_of(aperture_deg)
    return CompareAnswer(pair(compared_side(one), compared_side(other), solid_angle))


def preview(
    surface: Any,
    *others: Any,
    size: int = 512,
    light: str | None = None,
    around: str = "studio",
    objects: str | None = None,
    progress=None,
    **values: Any,
) -> Preview:
    """How surfaces look: on objects that stand on a chequered floor among lights.

    Takes  Surfaces, answers or words; `values` are those of the first, as in `evaluate`; size, 64 to 2048 pixels;
    around, `studio`, `overcast`, `room` or an equirectangular .exr; or `sky`, a sphere and a bent sheet under a small
    sun and a sky with a horizon; light from the front, side or back (of an .exr there is no such choice); objects,
    `pair` (sphere and knob, or disc where there is a grain), `sphere`, `sheet`, `disc`, `knob`;
    progress(name) gives a function of the share that is done, or None.
    Gives  a Preview: `pixels` (surfaces, size, size, 3) for displays, `radiance` in linear sRGB; a notebook shows it.
    Raises InputError for another size, light, object or surroundings.
    """
    from .. import exporters
    from ..errors import InputError
    from ..exporters.exporter import ColouredSurface
    from .staging import pictures_among

    if not 64 <= size <= 2048:
        raise InputError(f"size {size}: a picture has 64 to 2048 pixels")
    found = [surface_from(surface, values), *map(surface_from, others)]
    made = [each if isinstance(each, ColouredSurface) else exporters.coloured(each, each.model.name) for each in found]
    seen, about = pictures_among(made, size, around, light, objects, progress)
    return Preview(tuple(made), np.stack(seen), about)

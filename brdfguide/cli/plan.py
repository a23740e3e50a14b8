"""`brdfguide plan [DESCRIPTION]`: which directions or scans to measure, before any data or after some."""

from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

from typer import Argument, Context, Option

from ..errors import InputError, NoAnswer, choices
from ..records import dataclass
from ._data import ApertureOption
from ._options import ForceOption, JsonOption, QuietOption, answer, output_file, picture_file, progress, remark
from ._request import refuse
from ._scene import SceneOption

EXAMPLES = (
    "Examples: brdfguide plan --budget 16 -o plan.csv --plot plan.png | "
    "brdfguide plan --after measured.csv --budget 8 | brdfguide plan porcelain --scans --budget 3 --in-plane"
)
INSTRUMENT = "Instrument"
MOST = 512
THETA_MAX_DEG = 80.0


@dataclass(frozen=True, eq=False, kw_only=True)
class PlanRequest:
    """Everything that `plan` is asked."""

    context: Context
    description: Annotated[
        str | None,
        Argument(metavar="[DESCRIPTION]", help="What is known of the surface: a YAML, or a name of `materials`."),
    ] = None
    budget: Annotated[int, Option("--budget", help="How many directions, or scans, to measure.")] = 16
    scans: Annotated[bool, Option("--scans", help="Whole scans of the detector in place of single directions.")] = False
    after: Annotated[
        Path | None, Option("--after", help="Data that were measured already, as a file that `fit` reads.")
    ] = None
    purpose: Annotated[
        str,
        Option("--purpose", help="error everywhere; tell tied models apart, or pin the loosest parameter (--after)."),
    ] = "error"
    scene: SceneOption = None
    theta_max: Annotated[
        float, Option("--theta-max", help="Greatest angle of light and detector [deg].", rich_help_panel=INSTRUMENT)
    ] = THETA_MAX_DEG
    in_plane: Annotated[
        bool, Option("--in-plane", help="It stays in the plane of incidence.", rich_help_panel=INSTRUMENT)
    ] = False
    step_deg: Annotated[
        float, Option("--step-deg", help="Between the readings of a scan.", rich_help_panel=INSTRUMENT)
    ] = 5.0
    among: Annotated[
        Path | None,
        Option("--among", help="Data whose directions are all that can be chosen.", rich_help_panel=INSTRUMENT),
    ] = None
    aperture_deg: ApertureOption = None
    value_s: Annotated[float, Option("--value-s", help="Time for a value [s].", rich_help_panel=INSTRUMENT)] = 0.0
    move_s: Annotated[
        float,
        Option("--move-s", help="Time for another incidence or plane [s].", rich_help_panel=INSTRUMENT),
    ] = 0.0
    out: Annotated[
        Path | None, Option("--output", "-o", callback=output_file, help="Write the directions as CSV to fill in.")
    ] = None
    plot: Annotated[Path | None, Option("--plot", callback=picture_file, help="Draw the plan (png, svg or pdf).")] = (
        None
    )
    force: ForceOption = False
    json: JsonOption = False
    quiet: QuietOption = False


def plan(request: PlanRequest) -> None:
    """Say which directions to measure, what error that leaves, and in which order; then measure, and plan again.

    Before any data every law of the catalogue may be right, or those of a description; after some, those that they
    leave. Error is that over all directions of light and detector, against a fit to all of them.
    """
    from ..files import write_whole
    from ..report.documents.plan import plan_document, plan_table
    from ..report.text.plan import plan_text

    _check(request)
    with progress(2, request.quiet) as tell:
        tell("fitting" if request.after else "planning")
        found = _planned(request)
    result = plan_document(found, timed=request.value_s > 0 or request.move_s > 0)
    if request.out:
        write_whole(request.out, plan_table(result), force=request.force)
        remark(f"wrote {request.out}", request.quiet)
    if request.plot:
        from ..report.figures import style
        from ..report.figures.plan import plan_figure

        with style.look():
            style.save(plan_figure(result), request.plot)
        remark(f"wrote {request.plot}", request.quiet)
    answer(result, request.json, plan_text)


def _check(request: PlanRequest) -> None:
    """Raises InputError for what does not go together."""
    from ..fitting.planning import PURPOSES

    context = request.context
    if request.purpose not in PURPOSES:
        raise choices("purpose", request.purpose, PURPOSES)
    if not 1 <= request.budget <= MOST:
        raise InputError(f"--budget {request.budget}: wanted 1 to {MOST}")
    if request.after is None and request.purpose != "error":
        raise InputError(f"--purpose {request.purpose}: without --after no model is tied and no parameter loose")
    if request.after is not None:
        refuse(context, "description", because="the data of --after say more about the surface")
        refuse(context, "aperture_deg", because="the data of --after have their detector's size")
    if request.purpose != "error":
        refuse(context, "scans", "among", "scene", because="they are for --purpose error")
    if request.among is not None:
        refuse(context, "scans", because="--among offers single directions")
    if not request.scans:
        refuse(context, "step_deg", because="it is the step of --scans")
    if request.out is None:
        refuse(context, "force", because="without --output nothing is written")


def _planned(request: PlanRequest):
    """The plan. Raises InputError and NoAnswer as a fit of the data does."""
    from ..fitting import goniometer, hypotheses, learnt_design, planning
    from ..physics.aperture import solid_angle_of

    solid_angle = None if request.aperture_deg is None else solid_angle_of(request.aperture_deg)
    times = request.value_s, request.move_s
    reach = goniometer.Goniometer(request.theta_max, request.in_plane, request.step_deg, solid_angle, *times)
    there = None
    if request.after is not None:
        measured, ranked = _ranked(request.after)
        reach = replace(reach, solid_angle=measured.solid_angle)
        if request.purpose == "tell":
            return planning.plan_to_tell(ranked, measured, reach, request.budget)
        if request.purpose == "pin":
            return planning.plan_to_pin(ranked, measured, reach, request.budget)
        known, there = hypotheses.after(ranked), planning.measured_part(measured)
    else:
        known = hypotheses.unknown() if request.description is None else _described(request.description)
    among = None if request.among is None else _directions(request.among)
    target = _target(request.scene, request.theta_max, among)
    learnt = None
    if _plain(request):
        learnt = learnt_design.learnt_directions(request.budget, request.in_plane, there)
    if learnt is not None:
        found = planning.plan_of(learnt, target, reach, known, there)
    else:
        found = planning.plan_everywhere(
            target, reach, known, request.budget, scans=request.scans, among=among, measured=there
        )
    return found if there is None else replace(found, measured=int(measured.has_value.sum()))


def _plain(request: PlanRequest) -> bool:
    """Whether nothing is described of the surface and nothing asked of the instrument but, maybe, its plane."""
    known = request.description, request.scene, request.among, request.aperture_deg
    return all(each is None for each in known) and not request.scans and request.theta_max == THETA_MAX_DEG


def _ranked(file: Path):
    """The data and what a fit makes of them."""
    from ..fitting.compare import compare
    from ..fitting.job import Job, case

    try:
        found = case(file, Job())
    except (InputError, NoAnswer):  # of what contradicts itself or lies outside the guide as well
        found = case(file, Job(anyway=True))
    return found.measurement, compare(found.measurement, found.candidates, grows=False, kind=found.kind)


def _described(words: str):
    """The surfaces that the guide proposes for a description. Raises InputError outside its domain."""
    from ..advice import library, material
    from ..advice import recommend as advisor
    from ..fitting.hypotheses import Hypothesis

    described = material.read_material(words if words.endswith((".yaml", ".yml")) else library.path(words))
    proposed = advisor.recommend(described, True, None).candidates
    if not proposed:
        raise InputError(f"{words}: outside the guide's domain; plan without a description")
    return tuple(Hypothesis.of(each.surface) for each in proposed)


def _directions(file: Path):
    """The directions in a file, some of a large table."""
    from ..data import formats
    from ..fitting.planning import some_directions

    return some_directions(formats.read(file))


def _target(scene: Any, theta_max: float, among):
    """The directions at which the error counts, with their weights."""
    from ..fitting import goniometer, planning

    if scene is not None:
        from ..scene.directions_seen import directions_seen

        return directions_seen(scene, theta_max)
    return goniometer.hemisphere(theta_max) if among is None else planning.evenly(among, theta_max)

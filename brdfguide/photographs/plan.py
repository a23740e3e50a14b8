"""The description of a set of photographs: a YAML file with the key `photographs`, checked."""

from pathlib import Path

import numpy as np

from .. import yaml_schema
from ..errors import InputError
from ..physics import colorchecker
from ..physics.colour import CHANNEL_UM
from ..records import dataclass
from ..yaml_schema import Field
from .lamp import position_of
from .outline import Outline
from .picture import TRANSFERS, Exposure
from .solids import FAR

SOLIDS = ("sphere", "cylinder", "flat")
THETA_MAX_DEG = 78.0  # beyond, an outline that is a pixel off decides the value
FARTHEST = 1e7  # radii or mm
MOST_PX = 1e5
FAR_LAMP = 1e6  # radii: a lamp whose distance is not said
LAMP = (
    Field(
        "lamp",
        "numbers",
        "radii",
        low=-FARTHEST,
        high=FARTHEST,
        counts=(3,),
        choices=("reference",),
        meaning="where the lamp is",
    ),
    Field("phase_deg", "number", "deg", low=0.0, high=180.0, meaning="angle lamp - sample - camera"),
    Field("roll_deg", "number", "deg", low=-360.0, high=360.0, meaning="of the lamp about the camera's axis"),
    Field("lamp_distance", "number", "radii", above=1.0, high=FARTHEST, meaning="from the sample's centre"),
)
EXPOSURE = (
    Field("seconds", "number", "s", above=0.0, high=1e6),
    Field("iso", "number", above=0.0, high=1e8),
    Field("f_number", "number", above=0.0, high=1e4),
)
FIELDS = (
    Field("photographs", "word", choices=SOLIDS, required=True, meaning=" or ".join(SOLIDS)),
    Field("name", "text"),
    Field(
        "camera",
        "group",
        choices=("far",),
        required=True,
        meaning="{distance: in radii}, {distance_mm, radius_mm} or far",
        fields=(
            Field("distance", "number", "radii", above=1.0, high=FARTHEST),
            Field("distance_mm", "number", "mm", above=0.0, high=FARTHEST),
            Field("radius_mm", "number", "mm", above=0.0, high=FARTHEST),
            Field("angle_deg", "number", "deg", low=-89.0, high=89.0),
            Field("width_mm", "number", "mm", above=0.0, high=FARTHEST),
        ),
    ),
    Field("reference_albedo", "numbers", low=0.01, high=1.0, counts=(1, 3), choices=colorchecker.PATCHES),
    Field("chart_albedo", "numbers", low=0.01, high=1.0, counts=(1, 3), choices=colorchecker.PATCHES),
    Field("lamp_half_deg", "number", "deg", low=0.0, high=30.0),
    Field("theta_max_deg", "number", "deg", above=0.0, high=89.0),
    Field("transfer", "word", choices=TRANSFERS),
    Field("wavelengths_nm", "numbers", "nm", low=300.0, high=1100.0, counts=(3,)),
    Field(
        "outline",
        "group",
        choices=("found",),
        fields=(
            Field(
                "centre_px", "numbers", "px", low=-MOST_PX, high=MOST_PX, counts=(2,), required=True, meaning="[x, y]"
            ),
            Field(
                "radius_px",
                "number",
                "px",
                above=4.0,
                high=MOST_PX,
                required=True,
                meaning="of the sphere's or rod's outline",
            ),
            Field("rows_px", "numbers", "px", low=0.0, high=MOST_PX, counts=(2,)),
        ),
    ),
    Field("patch_px", "numbers", "px", low=0.0, high=MOST_PX, counts=(4,)),
    Field(
        "shots",
        "groups",
        required=True,
        meaning="a list of {file, reference, lamp}",
        fields=(
            Field("file", "text", required=True, meaning="the picture of the sample"),
            Field("reference", "text", meaning="the picture of the reference in its place"),
            Field("chart_px", "numbers", "px", low=0.0, high=MOST_PX, counts=(4,), meaning="[x, y, width, height]"),
            *LAMP,
            *EXPOSURE,
            *(
                Field(f"reference_{each.name}", each.kind, each.unit, above=each.above, high=each.high)
                for each in EXPOSURE
            ),
        ),
    ),
)


@dataclass(frozen=True, eq=False)
class Shot:
    """One picture of the sample, and that of the reference in its place; `lamp` None: found from its shading."""

    file: Path
    reference: Path | None
    lamp: np.ndarray | None
    exposure: Exposure
    reference_exposure: Exposure
    chart_px: tuple[float, ...] | None  # a patch beside the sample that faces the lamp, as far from it as the sample


@dataclass(frozen=True, eq=False)
class Plan:
    """What is photographed, how, and which pictures there are. Lengths in radii, of a plate in mm."""

    name: str
    solid: str
    distance: float
    shots: tuple[Shot, ...]
    reference_albedo: np.ndarray | None  # (3,)
    chart_albedo: np.ndarray | None  # (3,)
    outline: Outline | None  # None: found
    rows_px: tuple[float, float] | None
    theta_max_deg: float
    transfer: str | None
    wavelength_um: np.ndarray  # (3,)
    lamp_half_deg: float | None
    camera_angle_deg: float  # of a plate
    width_mm: float | None
    patch_px: tuple[float, ...] | None


def planned(text: str, name: str) -> Plan:
    """The plan that a description is; paths count from its folder. Raises InputError with all that is wrong."""
    document = yaml_schema.parse(text, FIELDS, (_camera_rules, _solid_rules, _shot_rules, _chart_rules), name)
    values = document.values
    folder = Path(name).parent
    outline = values.get("outline", "found")
    nm = values.get("wavelengths_nm")
    camera = values["camera"]
    return Plan(
        name=name,
        solid=values["photographs"],
        distance=_distance(camera),
        shots=tuple(_shot(each, folder, values["photographs"]) for each in values["shots"]),
        reference_albedo=_albedo(values.get("reference_albedo")),
        chart_albedo=_albedo(values.get("chart_albedo")),
        outline=None if outline == "found" else Outline(*map(float, (*outline["centre_px"], outline["radius_px"]))),
        rows_px=None if outline == "found" or "rows_px" not in outline else tuple(outline["rows_px"]),
        theta_max_deg=values.get("theta_max_deg", THETA_MAX_DEG),
        transfer=values.get("transfer"),
        wavelength_um=np.array([CHANNEL_UM[each] for each in "RGB"]) if nm is None else np.array(nm) / 1000,
        lamp_half_deg=values.get("lamp_half_deg"),
        camera_angle_deg=0.0 if camera == "far" else camera.get("angle_deg", 0.0),
        width_mm=None if camera == "far" else camera.get("width_mm"),
        patch_px=tuple(values["patch_px"]) if "patch_px" in values else None,
    )


def _camera_rules(document):
    camera = document.values.get("camera")
    if not isinstance(camera, dict):
        return
    flat = document.values.get("photographs") == "flat"
    if flat:
        if not {"distance_mm", "width_mm"} <= set(camera):
            yield (
                "camera",
                "of a flat sample, 'camera' needs distance_mm, width_mm (of what the picture shows) and angle_deg",
            )
        for key in {"distance", "radius_mm"} & set(camera):
            yield f"camera.{key}", f"'{key}' has no effect: a flat sample has no radius"
        return
    for key in {"angle_deg", "width_mm"} & set(camera):
        yield f"camera.{key}", f"'{key}' has no effect: it is of a flat sample"
    if ("distance" in camera) == ("distance_mm" in camera):
        yield "camera", "'camera' needs distance, in radii, or distance_mm with radius_mm"
    elif ("distance_mm" in camera) != ("radius_mm" in camera):
        yield "camera", "'distance_mm' and 'radius_mm' go together"
    elif "distance_mm" in camera and camera["distance_mm"] <= camera["radius_mm"]:
        yield "camera.distance_mm", "'distance_mm' is within the sample: it counts from the sample's middle"


def _solid_rules(document):
    values = document.values
    solid, outline = values.get("photographs"), values.get("outline", "found")
    if solid == "flat":
        if "outline" in values:
            yield "outline", "'outline' has no effect: a flat sample has none"
        if values.get("camera") == "far":
            yield "camera", "'camera' is 'far'; of a flat sample its distance_mm and width_mm are needed"
        if "patch_px" not in values:
            yield (
                "",
                "of a flat sample the file needs patch_px: [x, y, width, height], the sample's place in the pictures",
            )
    elif "patch_px" in values:
        yield "patch_px", "'patch_px' has no effect: it is of a flat sample"
    unseen = not any("reference" in shot for shot in values.get("shots") or ())
    if solid == "cylinder" and outline == "found" and unseen:
        yield (
            "outline",
            "without a reference, whose shading tells it, the outline of a rod is not found: give outline: "
            "{centre_px: [x, y], radius_px: r}",
        )
    if solid == "sphere" and outline != "found" and "rows_px" in outline:
        yield "outline.rows_px", "'rows_px' has no effect: it is of a rod"
    for number, shot in enumerate(values.get("shots") or ()):
        if solid == "flat" and "lamp" not in shot and "phase_deg" in shot:
            yield f"shots.{number}", "of a flat sample the lamp is given as lamp: [x, y, z] in mm"
        if solid == "flat" and shot.get("lamp") == "reference":
            yield f"shots.{number}.lamp", "a flat reference has no shading to find the lamp from: give [x, y, z] in mm"


def _shot_rules(document):
    referenced = False
    for number, shot in enumerate(document.values.get("shots") or ()):
        where = f"shots.{number}"
        referenced = referenced or "reference" in shot
        if ("lamp" in shot) == ("phase_deg" in shot):
            yield where, "a shot needs lamp: reference, lamp: [x, y, z] or phase_deg"
        for key in {"roll_deg", "lamp_distance"} & set(shot):
            if "phase_deg" not in shot:
                yield f"{where}.{key}", f"'{key}' has no effect without phase_deg"
        if shot.get("lamp") == "reference" and "reference" not in shot:
            yield f"{where}.lamp", "'lamp: reference' needs a reference whose shading shows the lamp"
        if "reference" not in shot:
            for key in [key for key in shot if key.startswith("reference_")]:
                yield f"{where}.{key}", f"'{key}' has no effect without a reference"
    if referenced and "reference_albedo" not in document.values:
        yield "", "the file needs 'reference_albedo': a number, [R, G, B] or the name of a ColorChecker's neutral patch"
    if not referenced and "reference_albedo" in document.values:
        yield "reference_albedo", "'reference_albedo' has no effect: no shot has a reference"
    with_one = sum("reference" in shot for shot in document.values.get("shots") or ())
    if referenced and with_one < len(document.values["shots"]):
        yield "shots", "some shots have a reference and some have none; their levels could not be compared"
    if document.values.get("shots") == []:
        yield "shots", "'shots' is empty; wanted at least one picture"


def _chart_rules(document):
    shots, stated = document.values.get("shots") or (), "chart_albedo" in document.values
    for number, shot in enumerate(shots):
        if "chart_px" in shot and "reference" in shot:
            yield f"shots.{number}.chart_px", "'chart_px' has no effect: the reference tells the level"
    charted = ["chart_px" in shot for shot in shots]
    if any(charted) and not all(charted):
        yield "shots", "some shots have a chart_px and some have none; their levels could not be compared"
    if any(charted) and not stated:
        yield "", "the file needs 'chart_albedo': a number, [R, G, B] or the name of a ColorChecker's neutral patch"
    if stated and not any(charted):
        yield "chart_albedo", "'chart_albedo' has no effect: no shot has a chart_px"


def _distance(camera) -> float:
    if camera == "far":
        return FAR
    if "distance" in camera:
        return float(camera["distance"])
    return float(camera["distance_mm"] / camera.get("radius_mm", 1.0))


def _albedo(given) -> np.ndarray | None:
    if given is None:
        return None
    if isinstance(given, str):
        return np.full(3, colorchecker.patch(given))
    return np.broadcast_to(np.asarray(given, float), (3,))


def _shot(values, folder: Path, solid: str) -> Shot:
    lamp = values.get("lamp")
    position: np.ndarray | None = None
    if lamp is None:
        position = position_of(values["phase_deg"], values.get("roll_deg", 0.0), values.get("lamp_distance", FAR_LAMP))
    elif lamp != "reference":
        position = np.array(lamp, float)
    if position is not None and not np.any(position):
        raise InputError(f"{values['file']}: lamp: [0, 0, 0] is inside the sample")
    reference = values.get("reference")
    return Shot(
        file=folder / values["file"],
        reference=None if reference is None else folder / reference,
        lamp=position,
        exposure=Exposure(*(values.get(each.name) for each in EXPOSURE)),
        reference_exposure=Exposure(*(values.get(f"reference_{each.name}") for each in EXPOSURE)),
        chart_px=tuple(values["chart_px"]) if "chart_px" in values else None,
    )

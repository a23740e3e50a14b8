"""What will be seen: shape, camera, lights, display and tolerance, each unknown unless said.

Directions of camera and lights are given in the frame of the object: zenith angles from its axis, which is the normal
of a plane, the axis of a cylinder and an edge of a box; azimuths are measured in that frame, so camera and light 180°
apart face each other across the normal. `directions.sample` turns a scene into samples.
"""

from dataclasses import field, replace
from math import pi, sqrt

from .. import yaml_schema
from ..physics.display import Display
from ..records import dataclass
from ..yaml_schema import Field
from .surroundings import KINDS, Surroundings, sensible_surroundings, surroundings_from_yaml

SHAPES = ("plane", "sphere", "cylinder", "box", "arbitrary")
COLOURS = ("grey", "rgb", "spectral")
SUN_RADIUS_DEG = 0.2665  # mean angular radius of the Sun: 15.99 arc minutes
MOST_LIGHTS = 8


@dataclass(frozen=True)
class DirectionRange:
    """A range of directions, even in solid angle; bounds in degrees, equal bounds for a single one."""

    theta_deg: tuple[float, float] = (0.0, 90.0)
    phi_deg: tuple[float, float] = (0.0, 360.0)

    def scaled(self, factor: float) -> "DirectionRange":
        """The same with its zenith angles multiplied, at most 89.9° where it was above the horizon."""
        top = 89.9 if max(self.theta_deg) <= 90 else 180.0
        low, high = self.theta_deg
        return replace(self, theta_deg=(min(low * factor, top), min(high * factor, top)))


@dataclass(frozen=True)
class Light:
    """A disc of light; `irradiance` is what falls on a surface that faces it, relative to the other lights."""

    directions: DirectionRange = DirectionRange()
    radius_deg: float = SUN_RADIUS_DEG
    irradiance: float = 1.0


@dataclass(frozen=True)
class DirectionPair:
    """One pair of directions that counts `weight` times."""

    theta_i_deg: float
    theta_r_deg: float
    phi_deg: float = 180.0
    weight: float = 1.0


@dataclass(frozen=True)
class Tolerance:
    """What may differ, in just noticeable differences (ΔE_ITP in colour).

    The default is safe in a flicker test: no pixel is seen to change. `look` keeps the look side by side, and both of
    its limits are needed: with 95 % of the picture alone a sphere loses its highlight.
    """

    worst: float = 1.0
    p95: float = 1.0
    look: bool = False  # whether the two are those of `keeps_look`

    @classmethod
    def keeps_look(cls, colour: str) -> "Tolerance":
        """Below what any of 166 pictures differed by that people called clearly different: 34 and 16.8 in colour, 22
        and 9.8 in grey, by the product's own display formulas (docs/seen.md).
        """
        return cls(20.0, 9.0, True) if colour == "grey" else cls(30.0, 15.0, True)

    def describe(self) -> str:
        """Both limits, and what they are for."""
        limits = f"tolerance {self.worst:g} at worst and {self.p95:g} for 95 % of the picture"
        return limits + (", which keeps its look side by side but not in a cut or a flicker test" if self.look else "")


@dataclass(frozen=True)
class Scene:
    """All that is known of a picture to be made; the defaults assume the worst."""

    name: str = "any view, any light"
    shape: str = "arbitrary"
    camera: DirectionRange = DirectionRange()
    lights: tuple[Light, ...] = (Light(),)
    environment: float = 0.0  # irradiance from all around, even, on the scale of the lights
    surroundings: Surroundings | None = None  # in its place: light from all around with a form
    pairs: tuple[DirectionPair, ...] = ()  # in place of shape, camera and directions of lights
    pixels: float = 1e6  # that the object covers
    pixel_normal_deg: float | None = None  # rms turn of the normal within a pixel; None: from shape and pixels
    display: Display = Display()
    tolerance: Tolerance = Tolerance()
    turn_deg: tuple[float, float] | None = None  # by which a surface with a grain is turned in its plane
    in_plane: bool = False
    colour: str = "spectral"
    camera_moves: bool = False
    budget_ns: float | None = None
    source: str = field(default="", compare=False)

    @property
    def total_irradiance(self) -> float:
        """What a surface that faces every light receives; the radiance of a perfect white one is this over π."""
        return sum(light.irradiance for light in self.lights) + (self.around.irradiance if self.around else 0.0)

    @property
    def around(self) -> Surroundings | None:
        """What lights it from all around."""
        if self.surroundings is None and self.environment:
            return Surroundings("uniform", self.environment)
        return self.surroundings

    @property
    def turns_deg(self) -> tuple[float, float]:
        """By which a surface with a grain is turned in its plane: where that is not said, any way for directions that
        leave it open, and not at all for an object."""
        if self.turn_deg is not None:
            return self.turn_deg
        return (0.0, 360.0) if self.pairs or self.in_plane else (0.0, 0.0)

    @property
    def pixel_normal(self) -> float:
        """Rms turn of the normal within a pixel [rad], about each axis.

        Seen far away, a sphere covers a disc of D = √(4 pixels/π); its normal turns by 2/D from pixel to pixel at the
        centre, and an even spread over a pixel has an rms of 1/√12 of that.
        """
        if self.pixel_normal_deg is not None:
            return self.pixel_normal_deg * pi / 180
        return (
            2 / sqrt(4 * self.pixels / pi) / sqrt(12)
            if self.shape in ("sphere", "cylinder") and not self.pairs
            else 0.0
        )

    def scaled(self, factor: float) -> "Scene":
        """The same with every zenith angle of camera and lights multiplied: a camera that strays."""
        pairs = tuple(
            replace(p, theta_i_deg=min(p.theta_i_deg * factor, 89.9), theta_r_deg=min(p.theta_r_deg * factor, 89.9))
            for p in self.pairs
        )
        lights = tuple(replace(light, directions=light.directions.scaled(factor)) for light in self.lights)
        return replace(self, camera=self.camera.scaled(factor), lights=lights, pairs=pairs)

    def describe(self) -> str:
        """One sentence: the assumptions behind every number."""
        views = f"{len(self.pairs)} listed directions" if self.pairs else f"{self.shape}, camera {_range(self.camera)}"
        lights = ", ".join(
            f"{'' if self.pairs else _range(light.directions) + ' '}radius {light.radius_deg:g}°"
            for light in self.lights
        )
        around = f"; around it {self.around.describe()}" if self.around else ""
        lights = f"; light {lights}" if lights else ""
        turned = "" if self.turn_deg is None else f"; turned {_spelt(self.turn_deg)} in its plane"
        size = "" if self.pairs else f"{self.pixels:.0f} pixels; "
        d = self.display
        return (
            f"{self.name}: {views}{lights}{around}{turned}; {size}{self.colour}; "
            f"exposure {d.exposure:g}, white {d.white:g}, floor {d.floor:g}, Weber fraction {d.weber:g}; "
            f"{self.tolerance.describe()}"
        )


DEFAULT = Scene()  # every pair of directions above the surface, a sun, full colour, 1 JND: nothing is assumed away

_ANGLES = (
    Field("theta_deg", "numbers", "deg", low=0, high=180, counts=(1, 2), meaning="zenith angle, or its two bounds"),
    Field("phi_deg", "numbers", "deg", low=-360, high=360, counts=(1, 2), meaning="azimuth, or its two bounds"),
)
FIELDS = (
    Field("name", "text", meaning="a title"),
    Field(
        "shape",
        "word",
        choices=SHAPES,
        meaning="what the object is like; arbitrary: angles are those at the surface itself",
    ),
    Field("camera", "group", fields=_ANGLES, meaning="where it is seen from"),
    Field(
        "lights",
        "groups",
        fields=(
            *_ANGLES,
            Field("radius_deg", "number", "deg", low=0, high=60, meaning="angular radius; the Sun's is 0.27"),
            Field("irradiance", "number", above=0, meaning="on a surface facing it, relative to the other lights"),
        ),
        meaning="where it is lit from",
    ),
    Field("environment", "number", low=0, meaning="irradiance from all around, even, relative to the lights"),
    Field(
        "surroundings",
        "group",
        choices=KINDS,
        fields=(
            Field("kind", "word", choices=KINDS, required=True, meaning="what stands around: " + ", ".join(KINDS)),
            Field(
                "irradiance", "number", above=0, meaning="on a surface facing the brightest side, relative to lights"
            ),
            Field(
                "up", "group", fields=_ANGLES, meaning="where upward is in the object's frame; a wall's is theta_deg 90"
            ),
            Field("turn_deg", "number", "deg", low=-360, high=360, meaning="turned about upward"),
        ),
        meaning="what is reflected; without `lights`, all there is of light",
    ),
    Field(
        "directions",
        "groups",
        fields=(
            Field(
                "theta_i_deg", "number", "deg", low=0, high=89.999, required=True, meaning="zenith angle of the light"
            ),
            Field(
                "theta_r_deg", "number", "deg", low=0, high=89.999, required=True, meaning="zenith angle of the camera"
            ),
            Field(
                "phi_deg", "number", "deg", low=-360, high=360, meaning="azimuth between them; 180 is the mirror side"
            ),
            Field("weight", "number", above=0, meaning="how much of the picture"),
        ),
        meaning="pairs of directions, in place of shape and camera",
    ),
    Field("pixels", "number", low=1, high=1e9, meaning="that the object covers"),
    Field("pixel_normal_deg", "number", "deg", low=0, high=45, meaning="rms turn of the normal within a pixel"),
    Field(
        "display",
        "group",
        fields=(
            Field("exposure", "number", above=0, meaning="value that a perfect white facing the lights gets"),
            Field("white", "number", above=0, meaning="where it clips"),
            Field("floor", "number", above=0, high=1, meaning="black level with flare"),
            Field("weber", "number", above=0, high=1, meaning="just noticeable fraction"),
            Field("bits", "number", low=1, high=32, meaning="per channel"),
            Field("gamma", "number", low=1, high=5, meaning="of the display"),
            Field("peak_cd_m2", "number", above=0, high=10000, meaning="luminance of the value 1"),
        ),
        meaning="exposure and screen",
    ),
    Field(
        "tolerance",
        "group",
        fields=(
            Field("worst_jnd", "number", low=0, meaning="largest difference in any visible pixel"),
            Field("p95_jnd", "number", low=0, meaning="difference that 95 % of the picture keeps"),
        ),
        choices=("look",),
        meaning="what may differ; look: what keeps its look side by side",
    ),
    Field(
        "turn_deg",
        "numbers",
        "deg",
        low=-360,
        high=360,
        counts=(1, 2),
        meaning="by which a surface with a grain is turned in its plane, or its two bounds; 0: `axis` counts from the "
        "object's azimuth 0, on curved objects from the direction of its axis",
    ),
    Field("in_plane", "flag", meaning="camera, light and normal in one plane"),
    Field("colour", "word", choices=COLOURS, meaning="what is looked at"),
    Field("camera_moves", "flag", meaning="hold the tolerance on angles 10 % larger and smaller as well"),
    Field("budget_ns", "number", "ns", above=0, meaning="most time per evaluation"),
)


def read_scene(path) -> Scene:
    """The scene in the YAML file at `path`. Raises InputError with every mistake, each with line and column."""
    return _scene(yaml_schema.read(path, FIELDS, (_sensible,)))


def parse_scene(text: str, name: str = "<text>") -> Scene:
    """The same from text."""
    return _scene(yaml_schema.parse(text, FIELDS, (_sensible,), name))


def _sensible(document):
    """What no single field can say."""
    values = document.values
    if values.get("directions") is not None:
        for key in ("shape", "camera"):
            if key in values:
                yield key, f"'{key}' and 'directions' exclude each other: the list says it all"
        if len(values.get("lights", ())) > 1:
            yield "lights", "a list of directions goes with one light; its directions come from the list"
    shape = values.get("shape", DEFAULT.shape)
    for key in ("lights", "directions"):
        if values.get(key) == []:
            yield key, f"'{key}' is empty; give one, or remove the line"
    if len(values.get("lights", ())) > MOST_LIGHTS:
        yield (
            "lights",
            (
                f"{len(values['lights'])} lights; at most {MOST_LIGHTS} are followed one by one, the rest belong to "
                f"the environment"
            ),
        )
    low, high = _both(values.get("turn_deg", (0.0,)))
    if not low <= high <= low + 360:
        yield "turn_deg", f"'turn_deg' runs from {low:g} to {high:g}; the smaller comes first, at most 360 apart"
    yield from sensible_surroundings(values)
    if values.get("in_plane") and shape not in ("plane", "arbitrary"):
        yield "in_plane", f"a {shape} shows normals in every plane; in_plane goes with shape plane or arbitrary"
    places = {
        "camera": values.get("camera", {}),
        **{f"lights.{i}": light for i, light in enumerate(values.get("lights", ()))},
    }
    for place, group in places.items():
        low, high = _both(group.get("theta_deg", (0.0, 90.0)))
        if low > high:
            yield (
                f"{place}.theta_deg",
                f"'{place}.theta_deg' runs from {low:g} down to {high:g}; the smaller comes first",
            )
        if high > 90 and shape in ("plane", "arbitrary"):
            yield (
                f"{place}.theta_deg",
                f"'{place}.theta_deg' reaches {high:g}; a surface of shape {shape} is seen and lit from above, 0 to 90",
            )
        low, high = _both(group.get("phi_deg", (0.0, 360.0)))
        if not low <= high <= low + 360:
            yield (
                f"{place}.phi_deg",
                f"'{place}.phi_deg' runs from {low:g} to {high:g}; the smaller comes first, at most 360 apart",
            )


def _scene(document) -> Scene:
    """The checked values as a Scene; what is not said keeps its default."""
    values = dict(document.values)
    given = {
        key: values[key]
        for key in (
            "name",
            "shape",
            "environment",
            "pixels",
            "pixel_normal_deg",
            "in_plane",
            "colour",
            "camera_moves",
            "budget_ns",
        )
        if key in values
    }
    every_way = (0.0, 180.0) if given.get("shape") in ("sphere", "cylinder", "box") else (0.0, 90.0)
    if "camera" in values:
        given["camera"] = _directions(values["camera"], every_way)
    if "lights" in values:
        given["lights"] = tuple(
            Light(
                _directions(light, every_way),
                **{key: light[key] for key in ("radius_deg", "irradiance") if key in light},
            )
            for light in values["lights"]
        )
    if "surroundings" in values:
        given["surroundings"] = surroundings_from_yaml(values["surroundings"])
        if "directions" not in values:
            given.setdefault("lights", ())
    if "turn_deg" in values:
        given["turn_deg"] = _both(values["turn_deg"])
    if "directions" in values:
        given["pairs"] = tuple(DirectionPair(**pair) for pair in values["directions"])
    if "display" in values:
        given["display"] = Display(**values["display"])
    if values.get("tolerance") == "look":
        given["tolerance"] = Tolerance.keeps_look(given.get("colour", DEFAULT.colour))
    elif "tolerance" in values:
        given["tolerance"] = Tolerance(
            **{key.removesuffix("_jnd"): value for key, value in values["tolerance"].items()}
        )
    given.setdefault("name", document.name.rpartition("/")[2].removesuffix(".yaml"))
    return Scene(**given, source=document.name)


def _directions(group, every_way) -> DirectionRange:
    return DirectionRange(_both(group.get("theta_deg", every_way)), _both(group.get("phi_deg", (0.0, 360.0))))


def _both(numbers) -> tuple[float, float]:
    """The bounds of a range; one number is both."""
    return float(numbers[0]), float(numbers[-1])


def _range(directions: DirectionRange) -> str:
    return _spelt(directions.theta_deg)


def _spelt(bounds_deg: tuple[float, float]) -> str:
    low, high = bounds_deg
    return f"{low:g}°" if low == high else f"{low:g}..{high:g}°"

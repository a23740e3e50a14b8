"""What an answer of `fit` must hold to be derived again."""

from ..errors import InputError
from ..records import dataclass

Number = float | None
OF_CHANNELS = ("absolute_per_sr", "dark_level_per_sr", "dark_level_stderr_per_sr", "told_from_per_sr")  # of `noise`
OF_FLAGS = {  # whose numbers others follow from
    "discrepancy": ("percent", "systematic_rms_ln", "correlation", "z", "chance"),
    "instrument": ("gains_rms", "zero_deg"),
    "rough-regime": ("sigma_um_above", "slope"),
}


@dataclass(frozen=True)
class PrintedValue:
    """One parameter, or what follows from parameters."""

    value: float | tuple[Number, ...] | None
    stderr: float | tuple[Number, ...] | None = None
    fitted: bool = False
    derived: bool = False
    known_to: Number = None
    above: Number = None
    in_place_of: str | None = None


@dataclass(frozen=True)
class PrintedFlag:
    """A doubt, with the numbers that its sentence tells."""

    code: str
    numbers: dict[str, Number] | None = None


@dataclass(frozen=True)
class PrintedGrowth:
    """R-mirror and R-max between two incidences."""

    theta_i_deg: tuple[float, ...]
    r_mirror: Number
    r_max: Number
    r_mirror_data: Number
    r_max_data: Number


@dataclass(frozen=True)
class PrintedHighest:
    """The steepest incidences, as they were foretold."""

    theta_i_deg: Number
    rms_ln: Number


@dataclass(frozen=True)
class PrintedFold:
    """The numbers that were found without the incidences between two, or without some turns of the sample."""

    theta_i_deg: tuple[float, float]
    values: dict[str, float | tuple[float, ...]]
    turns_deg: tuple[float, ...] = ()


@dataclass(frozen=True)
class PrintedLookedAt:
    """The directions and channels that fits without a group looked at."""

    rows: tuple[int, ...]
    channels: tuple[str, ...]


@dataclass(frozen=True)
class PrintedInstrument:
    """What an instrument did, as it was fitted beside a model."""

    zero_deg: float
    theta_i_deg: tuple[float, ...]
    ln_gains: tuple[float, ...]


@dataclass(frozen=True)
class PrintedRow:
    """One candidate."""

    model: str
    candidate: str
    rank: int
    tied: bool
    off_percent: Number
    rms_ln: Number
    seen: Number
    seen_from_best: Number
    rms_ln_by_theta_i: dict[str, Number]
    errors: dict[str, Number]
    behind: Number
    behind_se: Number
    free_parameters: int
    parameters: dict[str, PrintedValue]
    flags: tuple[PrintedFlag, ...]
    growth: PrintedGrowth | None = None
    typed: dict[str, float | tuple[Number, ...] | None] | None = None
    held_out_rms_ln: Number = None
    held_out_highest: PrintedHighest | None = None
    held_out_fits: tuple[PrintedFold, ...] | None = None
    instrument: PrintedInstrument | None = None


@dataclass(frozen=True)
class PrintedData:
    """What was fitted."""

    file: str
    samples: int
    values: int
    missing: int
    channels: tuple[str, ...]
    wavelength_nm: tuple[float, ...]
    theta_i_deg: tuple[float, float]
    theta_r_deg: tuple[float, float]
    findings: tuple[PrintedFlag, ...]
    solid_angle_sr: Number = None
    read_with: dict[str, str | float | bool | tuple[str | float, ...]] | None = None


@dataclass(frozen=True)
class PrintedNoise:
    """What single values are worth, and from which on errors are told."""

    relative: Number = None
    absolute_per_sr: tuple[float, ...] | None = None
    dark_level_per_sr: tuple[float, ...] | None = None
    dark_level_stderr_per_sr: tuple[float, ...] | None = None
    told_from_per_sr: tuple[float, ...] | None = None
    missed: Number = None
    values_told: int | None = None


@dataclass(frozen=True)
class PrintedEntry:
    """A candidate in an order."""

    candidate: str
    error: Number = None
    seen: Number = None


@dataclass(frozen=True)
class PrintedScale:
    """The order on one scale."""

    order: tuple[PrintedEntry, ...]


@dataclass(frozen=True)
class PrintedFloor:
    """The best model beside the floor."""

    candidate: str
    model: Number
    smooth: Number = None
    factored: Number = None
    noise: Number = None
    coefficients: Number = None
    gcv: Number = None
    residual: Number = None
    reducible: Number = None
    by_form: Number = None
    beyond_form: Number = None
    directions: int | None = None


@dataclass(frozen=True)
class PrintedPlace:
    """A direction where a rival parts from the recommended law."""

    theta_i_deg: float
    theta_r_deg: float
    phi_deg: float
    ln_ratio: Number


@dataclass(frozen=True)
class PrintedRival:
    """A law that ties in the plane of incidence and parts outside it."""

    candidate: str
    rms_ln: float
    then_percent: Number
    at: tuple[PrintedPlace, ...]


@dataclass(frozen=True)
class PrintedIfRight:
    """How probable a law is, and the recommended one's error outside if it is right."""

    candidate: str
    probability: float
    rms_ln: float
    grazing_rms_ln: Number


@dataclass(frozen=True)
class PrintedGrazing:
    """The error that is expected toward grazing."""

    rms_ln: Number
    expected_percent: Number


@dataclass(frozen=True)
class PrintedPrice:
    """The error that is expected out of the plane of incidence."""

    rms_ln: Number
    in_plane_rms_ln: Number
    probability: Number
    if_right: tuple[PrintedIfRight, ...]
    expected_percent: Number
    toward_grazing: PrintedGrazing | None
    apart: tuple[PrintedRival, ...]


@dataclass(frozen=True)
class PrintedCard:
    """What to type into one program."""

    numbers: dict[str, float | tuple[float, ...]]
    hex: dict[str, str]
    rms_ln: Number = None
    off_percent: Number = None
    measured_rms_ln: Number = None
    measured_off_percent: Number = None


@dataclass(frozen=True)
class PrintedInterval:
    """A number and both ends of 95 %."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class PrintedTable:
    """What a program of optics wants of a law."""

    numbers: dict[str, float]


@dataclass(frozen=True)
class PrintedBeside:
    """A law of physics in the same ranking."""

    law: str
    rms_ln: float
    sigma_um: Number = None


@dataclass(frozen=True)
class PrintedStrayLight:
    """What a fit of polished optics says beyond its parameters."""

    law: str
    wavelength_nm: float
    intervals_95: dict[str, PrintedInterval]
    beta: tuple[float, float]
    band_per_um: tuple[float, float]
    sigma_um: float
    phase: float
    first_order_from_nm: float
    highest_theta_i_deg: float
    numbers: tuple[PrintedTable, ...]
    beside: tuple[PrintedBeside, ...]


@dataclass(frozen=True)
class PrintedExport:
    """A file that was written beside the answer; what stands in it is read as its target has it."""

    target: str
    model: str
    status: str
    written: dict[str, float | tuple[float, ...] | str | None] | None = None
    rms_ln: Number = None
    measured_rms_ln: Number = None
    seen: Number = None
    directions: int | None = None


@dataclass(frozen=True)
class PrintedKind:
    """What decides between metal and dielectric."""

    numbers: dict[str, Number]


@dataclass(frozen=True)
class PrintedStep:
    """How the best candidate so far was given one thing more: what was tried, and what was taken."""

    of: str
    tried: tuple[PrintedEntry, ...]
    taken: str | None
    rms_ln: Number
    held_out_rms_ln: Number


@dataclass(frozen=True)
class PrintedSetting:
    """How far a law or a shader's setting is from the data."""

    candidate: str
    rms_ln: Number
    off_percent: Number
    seen: Number


@dataclass(frozen=True)
class PrintedShader:
    """The best that one shader can do."""

    target: str
    rms_ln: float
    off_percent: Number
    parameters: dict[str, PrintedValue]
    best_law: PrintedSetting
    settings: tuple[PrintedSetting, ...]


@dataclass(frozen=True)
class PrintedFit:
    """`fit --json`."""

    data: PrintedData
    ranking: tuple[PrintedRow, ...]
    noise: PrintedNoise
    recommended: str
    metric: str
    scales: dict[str, PrintedScale]
    seen_order: tuple[PrintedEntry, ...]
    seen_weights: str
    held_out_on: PrintedLookedAt | None = None
    floor: PrintedFloor | None = None
    stray_light: tuple[PrintedStrayLight, ...] = ()
    warnings: tuple[PrintedFlag, ...] = ()
    off_plane: PrintedPrice | None = None
    numbers: tuple[PrintedCard, ...] | None = None
    exports: tuple[PrintedExport, ...] = ()
    kind: PrintedKind | None = None
    grown: tuple[PrintedStep, ...] = ()
    as_: PrintedShader | None = None


def refuse_gaps(answer: dict) -> None:
    """What the shapes above leave open. Raises InputError where `noise` tells of other channels than the data, and for
    a number that a flag of this code has and this one has not."""
    channels = len(answer["data"]["channels"])
    for key in OF_CHANNELS:
        told = answer["noise"].get(key)
        if told is not None and len(told) != channels:
            raise InputError(f"the answer: noise.{key}: found {len(told)} numbers; wanted {channels}")
    for place, row in enumerate(answer["ranking"]):
        for rank, flag in enumerate(row["flags"]):
            numbers, where = flag.get("numbers") or {}, f"ranking[{place}].flags[{rank}].numbers"
            names = (*OF_FLAGS.get(flag["code"].partition(":")[0], ()), *(each for each in numbers if "gain" in each))
            for each in names:
                if numbers.get(each) is None:
                    raise InputError(f"the answer: {where}: there is no '{each}'; wanted a number")
    for rank, finding in enumerate(answer["data"]["findings"]):
        if finding["code"] == "floor" and (finding.get("numbers") or {}).get("floor_per_sr") is None:
            where = f"data.findings[{rank}].numbers"
            raise InputError(f"the answer: {where}: there is no 'floor_per_sr'; wanted a number")

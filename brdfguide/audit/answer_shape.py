"""What an answer of `fit` must hold to be derived again."""

from dataclasses import dataclass

Number = float | None


@dataclass(frozen=True)
class PrintedValue:
    """One parameter, or what follows from parameters."""

    value: float | tuple[Number, ...] | None
    stderr: float | tuple[Number, ...] | None = None
    fitted: bool = False
    derived: bool = False
    known_to: Number = None


@dataclass(frozen=True)
class PrintedFlag:
    """A doubt, with the numbers that its sentence tells."""

    code: str
    numbers: dict[str, Number] | None = None


@dataclass(frozen=True)
class PrintedRow:
    """One candidate."""

    model: str
    candidate: str
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


@dataclass(frozen=True)
class PrintedData:
    """What was fitted."""

    file: str
    samples: int
    values: int
    channels: tuple[str, ...]
    wavelength_nm: tuple[float, ...]
    theta_i_deg: tuple[float, ...]
    theta_r_deg: tuple[float, ...]
    findings: tuple[PrintedFlag, ...]
    solid_angle_sr: Number = None
    read_with: dict[str, str | float | bool | tuple[str | float, ...]] | None = None


@dataclass(frozen=True)
class PrintedNoise:
    """From which value on errors are told."""

    told_from_per_sr: tuple[float, ...] | None = None


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


@dataclass(frozen=True)
class PrintedFit:
    """`fit --json`."""

    data: PrintedData
    ranking: tuple[PrintedRow, ...]
    noise: PrintedNoise
    recommended: str
    scales: dict[str, PrintedScale]
    seen_order: tuple[PrintedEntry, ...]
    seen_weights: str
    floor: PrintedFloor | None = None

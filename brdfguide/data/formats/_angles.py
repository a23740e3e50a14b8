"""Directions of light and detector out of columns of angles, in every convention that tables have."""

from dataclasses import field, replace

import numpy as np

from ...finding import Finding
from ...records import dataclass
from ..columns import prose
from ..columns.facts import Column
from ..columns.grammar import understood
from . import _half_difference, _phase
from ._angle_units import OF_DIRECTIONS, in_degrees
from ._azimuths import brightness, counter_clockwise, role_of_the_azimuth
from ._roles import Assigned, missing
from ._rotations import light_for
from ._sheet import Sheet
from .format import MARGIN_DEG, Options, Source, check_angle, check_zenith, degrees

OF_COSINES = ("beta_i", "beta_r", "alpha_r", "beta_from_mirror", "x_i", "y_i", "z_i", "x_r", "y_r", "z_r")


@dataclass
class Angles:
    """Angles [deg] by role while directions are made of them; `used` are the roles that were."""

    source: Source
    table: Sheet
    raw: dict[str, np.ndarray]
    notes: list[Finding]
    constant: frozenset[str]  # roles that one number for the whole table has
    sense: tuple[str, str] | None = None  # of the sample's rotation, cw or ccw, and what says so
    used: set[str] = field(default_factory=set)

    def has(self, *roles: str) -> bool:
        return all(role in self.raw for role in roles)

    def take(self, role: str) -> np.ndarray:
        self.used.add(role)
        return self.raw[role]

    def note(self, code: str, text: str, **more) -> None:
        self.notes.append(Finding(code, text, **more))


@dataclass(frozen=True)
class RowDirections:
    degrees: np.ndarray  # theta_i, phi_i, theta_r, phi_r (4, rows)
    rows: np.ndarray  # which rows of the table have them
    azimuths: bool  # whether the table gives them
    used: set[str]
    unit: str
    azimuth: str  # role of the column that its name calls an azimuth


def row_directions(
    source: Source, table: Sheet, given: Assigned, options: Options, unit: str | None, notes
) -> RowDirections:
    """theta_i, phi_i, theta_r, phi_r of every row that has them. Raises InputError where a column is missing."""
    named = ((role, given.one(role)) for role in (*OF_DIRECTIONS, *OF_COSINES))
    columns = {role: column for role, column in named if column is not None}
    _no_text(source, table, columns.values())
    raw, said = in_degrees(source, table, columns, options, unit, notes)
    constant = {role: value for role, value in given.constants.items() if role in (*OF_DIRECTIONS, "phi_d")}
    constant = {"dphi" if role == "phi_d" else role: value for role, value in constant.items()}
    constant = {role: value for role, value in constant.items() if role not in raw}
    raw |= {role: np.full(len(table.values), value) for role, value in constant.items()}
    counter_clockwise(columns, raw, notes)
    azimuth = role_of_the_azimuth(columns, raw, lambda: brightness(table, given), options, notes)
    if azimuth != "dphi":
        raw[azimuth] = raw.pop("dphi")
    angles = Angles(source, table, raw, notes, frozenset(constant), _sense(table, columns))
    found, azimuths = _made(angles, options)
    found = np.stack(np.broadcast_arrays(*found))
    for role, each in zip(("theta_i", "phi_i", "theta_r", "phi_r"), found, strict=True):
        check_angle(source, role, each, table.lines)
    whole = np.all(np.isfinite(found), axis=0)
    if not np.any(whole):
        raise source.error("no row has all its angles")
    if lost := int(np.count_nonzero(~whole)):
        text = f"{lost} rows without all angles were dropped"
        notes.append(Finding("rows-without-angles", text, numbers=(("rows", lost),)))
    if np.any(found[0, whole] < 0):
        text = "theta_i is negative: the light comes from the azimuth opposite to phi_i"
        notes.append(Finding("negative-theta-i", text, option="--mirror-side"))
    signed = _with_signs(found[:, whole], not azimuths, options)
    return RowDirections(signed, whole, azimuths, angles.used, said, azimuth)


def _no_text(source: Source, table: Sheet, columns) -> None:
    """Raises InputError for the first cell of a column of angles that is no number."""
    found = ((column.name, table.bad_cell(column.place)) for column in columns)
    bad = [(cell[1], name, cell[0]) for name, cell in found if cell]
    if bad:
        line, name, text = min(bad)
        raise source.error(f"column '{name[:60]}': found '{text[:40]}', wanted a number", line)


# --- conventions ------------------------------------------------------------------------------------------


def _made(angles: Angles, options: Options):
    """theta_i, phi_i, theta_r, phi_r [deg], and whether the table gives azimuths; the sample's rotation undone."""
    if angles.has("theta_h", "theta_d") and not angles.has("theta_i", "theta_r"):
        found, azimuths = _of_half_and_difference(angles), True
    elif angles.has("x_i", "y_i", "x_r", "y_r") and not angles.has("theta_i", "theta_r"):
        found, azimuths = _of_vectors(angles), True
    else:
        theta_i = _incidence(angles)
        theta_r = _reflected(angles, theta_i)
        if "alpha_r" in angles.used:
            return _turned(angles, (theta_i, 0 * theta_i, *theta_r), options), True
        found, azimuths = _with_azimuths(angles, theta_i, theta_r)
    return _turned(angles, found, options), azimuths


def _incidence(angles: Angles) -> np.ndarray:
    if angles.has("theta_i"):
        if "theta_i" in angles.constant:
            angles.note("theta-i-constant", f"theta_i = {angles.raw['theta_i'][0]:g} degrees for the whole file")
        return angles.take("theta_i")
    if angles.has("beta_i"):
        return _arcsine(angles, "beta_i", angles.take("beta_i"))
    raise missing("theta_i", angles.table, angles.source)


def _reflected(angles: Angles, theta_i):
    """theta_r [deg], or theta_r and phi_r where two direction cosines are given."""
    if angles.has("theta_r"):
        return angles.take("theta_r")
    if angles.has("from_mirror"):
        toward = _toward_grazing(angles, "from_mirror", theta_i, 90.0, "")
        return _with_sign(angles, "from_mirror", _above(theta_i + toward))
    if angles.has("beta_from_mirror"):
        sines = np.sin(np.radians(theta_i))
        theta_r = _arcsine(angles, "", sines + _toward_grazing(angles, "beta_from_mirror", sines, 1.0, " as sines"))
        return _with_sign(angles, "beta_from_mirror", theta_r)
    if angles.has("beta_r", "alpha_r"):
        along, across = angles.take("beta_r"), angles.take("alpha_r")
        angles.note("direction-cosines", "beta points to the mirror side of the plane of incidence, alpha out of it")
        theta_r = _arcsine(angles, "", np.hypot(along, across))
        return theta_r, 180.0 - np.degrees(np.arctan2(across, along))
    if angles.has("beta_r"):
        return _arcsine(angles, "beta_r", angles.take("beta_r"))
    raise missing("theta_r", angles.table, angles.source)


def _toward_grazing(angles: Angles, role: str, mirror, horizon: float, how: str) -> np.ndarray:
    """Angles or sines from the mirror direction, positive toward grazing; noted. The other way round where they would
    lead beyond the horizon and so do not.

    Raises InputError where azimuths turn about it.
    """
    azimuths = [each for each in ("dphi", "phi_r") if angles.has(each)]
    for each in azimuths:
        if np.nanmax(np.abs(angles.take(each)), initial=0.0) > 1e-6:
            raise angles.source.error(
                "angles from the mirror direction beside azimuths: whether these turn about the mirror direction or "
                "the normal is not said; give theta_r and phi_r about the normal"
            )
        del angles.raw[each]
    given, limit = angles.take(role), horizon * (1 + 1e-6)
    with np.errstate(invalid="ignore"):
        beyond = int(np.count_nonzero(np.abs(mirror + given) > limit))
        turned = beyond > 0 and np.any(given < 0) and not np.any(np.abs(mirror - given) > limit)
    sense = "positive toward grazing"
    if turned:
        sense = f"positive toward the normal: the other way {beyond} would lie beyond the horizon"
    text = f"angles count from the mirror direction: added to theta_i{how}, {sense}"
    angles.note("angle-from-mirror", text, option="--columns")
    return 0.0 - given if turned else given


def _with_sign(angles: Angles, role: str, theta_r) -> np.ndarray:
    """The angles [deg]. Raises InputError where they are made of sizes without a sign, as |beta - beta0|, of
    which some would lie beyond the horizon."""
    names = [name for name in angles.table.names if understood(name).role == role and "|" in name]
    beyond = np.flatnonzero(np.isnan(theta_r) & np.isfinite(angles.raw[role]))
    if names and len(beyond):
        raise angles.source.error(
            f"column '{names[0][:40]}': found {angles.raw[role][beyond[0]]:g}, toward grazing beyond the horizon: on "
            f"which side of the mirror direction a size lies is not said; wanted a sign, or theta_r",
            int(angles.table.lines[beyond[0]]),
        )
    return theta_r


def _arcsine(angles: Angles, role: str, sines) -> np.ndarray:
    """Degrees of sines; NaN beyond 1, where no direction is."""
    if role:
        angles.note("direction-cosines", f"{role} is the sine of an angle in the plane of incidence")
    with np.errstate(invalid="ignore"):
        return degrees(np.arcsin(np.where(np.abs(sines) <= 1 + 1e-9, np.clip(sines, -1, 1), np.nan)))


def _above(theta) -> np.ndarray:
    """Angles [deg], NaN below the horizon."""
    return np.where(np.abs(theta) > 90, np.nan, np.round(theta, 9))


def _with_azimuths(angles: Angles, theta_i, theta_r):
    """The four angles out of zeniths and whatever is said of azimuths, and whether anything is."""
    raw = angles.raw
    theta_i, theta_r = _unswapped(angles, theta_i, theta_r)
    theta_i, theta_r = _of_a_circle(angles, "theta_i", theta_i), _of_a_circle(angles, "theta_r", theta_r)
    for name, theta in (("theta_i", theta_i), ("theta_r", theta_r)):
        check_zenith(angles.source, name, np.where(np.isfinite(theta), theta, 0.0), angles.table.lines)
    phi_i = angles.take("phi_i") if "phi_i" in raw else np.zeros_like(theta_i)
    if "phi_r" in raw:
        return _by_phase(angles, (theta_i, phi_i, theta_r, angles.take("phi_r"))), True
    if "dphi" in raw:
        return _by_phase(angles, (theta_i, phi_i, theta_r, phi_i + angles.take("dphi"))), True
    if "phase" in raw:
        return (theta_i, phi_i, np.abs(theta_r), phi_i + _azimuth_of_phase(angles, theta_i, theta_r)), True
    one = not any(angles.has(role) for role in ("phi_i", "rotation"))
    missed = "no azimuth column: taken as a scan" if one else "no azimuth of the detector: taken as scans"
    text = f"{missed} in the plane of incidence"
    angles.note("in-plane-assumed", text, option="--columns")
    return (theta_i, phi_i, theta_r, phi_i + 180.0), False


def _unswapped(angles: Angles, theta_i, theta_r):
    """Laboratories that call the zenith phi and the azimuth theta: told by zeniths beyond 90 degrees, or at rest."""
    raw = angles.raw
    if not angles.has("phi_i", "phi_r"):
        return theta_i, theta_r
    phis = np.concatenate([raw["phi_i"], raw["phi_r"]])
    thetas = np.concatenate([theta_i, theta_r])
    phis, thetas = phis[np.isfinite(phis)], thetas[np.isfinite(thetas)]
    if not np.any(phis) or np.abs(phis).max() > 90.005:
        return theta_i, theta_r
    still = all(len(np.unique(each[np.isfinite(each)])) == 1 for each in (theta_i, theta_r))
    if np.abs(thetas).max(initial=0.0) <= 90.005 and not (still and len(np.unique(phis)) > 3):
        return theta_i, theta_r
    text = "the columns named phi hold the zenith angles and those named theta the azimuths: exchanged"
    consequence = "read as named, no direction would be possible"
    angles.note("phi-is-zenith", text, consequence=consequence, option="--columns")
    zeniths = raw["phi_i"], raw["phi_r"]
    raw["phi_i"], raw["phi_r"] = theta_i, theta_r
    return zeniths


def _of_a_circle(angles: Angles, role: str, theta) -> np.ndarray:
    """Zenith angles [deg] of an arm that counts from 0 to 360, with a sign: 350 is -10."""
    with np.errstate(invalid="ignore"):
        far = theta >= 270 - MARGIN_DEG
        if not np.any(far) or np.any((np.abs(theta) > 90 + MARGIN_DEG) & ~far | (theta > 360)):
            return theta
    angles.note(
        "columns-read", f"{role} goes round a circle: {np.nanmax(theta):g} is {np.nanmax(theta) - 360:g} degrees"
    )
    return np.where(far, theta - 360.0, theta)


def _azimuth_of_phase(angles: Angles, theta_i, theta_r) -> np.ndarray:
    """Azimuth [deg] from light to detector out of the angle between them.

    Raises InputError for a phase angle that no azimuth gives.
    """
    phase = angles.take("phase")
    found, bad = _phase.azimuth(theta_i, theta_r, phase)
    if bad is not None:
        row, least, most = bad
        text = (
            f"phase angle {phase[row]:g} degrees: beside incidence {theta_i[row]:g} and emission {theta_r[row]:g} it "
            f"lies within {least:g}..{most:g}"
        )
        raise angles.source.error(text, int(angles.table.lines[row]))
    angles.note("azimuth-from-phase", "azimuths from the phase angle, the angle between light and detector")
    return found


def _by_phase(angles: Angles, found):
    """Azimuths beside a phase angle, which bears them out, or says that they count from the mirror direction."""
    if "phase" not in angles.raw:
        return found
    theta_i, phi_i, theta_r, phi_r = found
    phase = angles.take("phase")
    off = [_phase.disagreement_deg(theta_i, theta_r, phi_r - phi_i + turn, phase) for turn in (0.0, 180.0)]
    if off[0] <= _phase.SLACK_DEG:
        angles.note("phase-agrees", "the phase angle agrees with the azimuths")
        return found
    if off[1] <= _phase.SLACK_DEG:
        text = "the phase angle says that azimuths count from the mirror direction: turned by 180 degrees"
        angles.note("azimuth-turned", text, option="--columns")
        return theta_i, phi_i, theta_r, phi_r + 180.0
    text = f"the phase angle differs from that of the other angles by {min(off):.3g} degrees (median)"
    angles.note("phase-contradicts", text, severity="warning", consequence="the azimuths were believed")
    return found


# --- other frames -----------------------------------------------------------------------------------------


def _of_half_and_difference(angles: Angles):
    """From half and difference angles; the azimuth of the difference is the one azimuth of the table, or phi_r's."""
    azimuth = next((role for role in ("dphi", "phi_r") if angles.has(role)), None)
    if azimuth is None:
        raise missing("phi_d", angles.table, angles.source)
    phi_h = angles.take("phi_h") if angles.has("phi_h") else 0.0 * angles.raw["theta_h"]
    parts = (angles.take("theta_h"), phi_h, angles.take("theta_d"), angles.take(azimuth))
    for name, each in (("theta_h", parts[0]), ("theta_d", parts[2])):
        check_zenith(angles.source, name, np.where(np.isfinite(each), each, 0.0), angles.table.lines)
    angles.note("half-difference-angles", "directions from the angles of half vector and difference")
    found = _half_difference.light_and_view(*(np.radians(each) for each in parts))
    return tuple(np.round(np.degrees(each), 9) for each in found)


def _of_vectors(angles: Angles):
    """From components of both directions, of any length; the third from the other two where it is not given."""
    found = []
    for side in ("i", "r"):
        x, y = angles.take(f"x_{side}"), angles.take(f"y_{side}")
        with np.errstate(invalid="ignore"):
            z = angles.take(f"z_{side}") if angles.has(f"z_{side}") else np.sqrt(1 - x**2 - y**2)
        if np.any(z < 0) and np.all(z[np.isfinite(z)] <= 0):
            x, y, z = -x, -y, -z
            text = f"the vectors of {'light' if side == 'i' else 'detector'} point into the surface: reversed"
            angles.note("vectors-reversed", text)
        theta, phi = np.degrees(np.arctan2(np.hypot(x, y), z)), np.degrees(np.arctan2(y, x))
        found += [np.where(theta > 90, 90.0, np.round(theta, 7)), np.round(phi, 7)]
    return tuple(found)


def _turned(angles: Angles, found, options: Options):
    """With the rotation of the sample as the light's azimuth: turned by +psi, the light stands at -psi of it."""
    theta_i, phi_i, theta_r, phi_r = found
    if not angles.has("rotation"):
        return found
    psi = angles.take("rotation")
    sign, how = light_for(options, angles.sense)
    if np.nanmax(psi, initial=-np.inf) > np.nanmin(psi, initial=np.inf) or np.any(psi):
        angles.note(how.code, f"{how.text}, the detector with it", option=how.option)
    return theta_i, phi_i + sign * psi, theta_r, phi_r + sign * psi


def _sense(table: Sheet, columns: dict[str, Column]) -> tuple[str, str] | None:
    """The sense of the sample's rotation, and what says so: the name of its column or a comment."""
    column = columns.get("rotation")
    if column is not None and column.sense:
        return column.sense, f"'{column.name[:40]}'"
    commented = prose.sense_in(table.comments) if column is not None else None
    return (commented, "a comment") if commented else None


def _with_signs(found, signed: bool, options: Options) -> np.ndarray:
    """Negative incidence: the light comes from the other side, so the mirror direction has the other sign as well."""
    theta_i, phi_i, theta_r, phi_r = found
    if options.mirror_side:
        theta_i = np.abs(theta_i)
        if options.mirror_side in ("negative", "phi=0"):
            phi_r = phi_r + 180.0
    elif signed and np.all(theta_i <= 0):  # in one plane and always negative: theta_r > 0 is the mirror side
        theta_i = np.abs(theta_i)
    return np.stack([theta_i, phi_i, theta_r, phi_r])


def used_columns(given: Assigned, found: RowDirections) -> Assigned:
    """The columns with the role that the azimuth has, and those of angles that no direction was made of as ignored."""
    renamed = (replace(each, role=found.azimuth) if each.role == "dphi" else each for each in given.columns)
    given = replace(given, columns=tuple(renamed))
    for role in (*OF_DIRECTIONS, *OF_COSINES):
        if role not in found.used and given.one(role) is not None:
            given = given.without(role, "the other angles tell the directions already")
    return given

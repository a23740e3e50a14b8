"""Columns of angles as sheets give them: names, units and conventions, with the directions that they mean."""

from dataclasses import dataclass, field

import numpy as np

from brdfguide.physics.geometry import Geometry, rows


@dataclass
class Making:
    """A sheet while it is made: columns with their names, and the random choices."""

    draw: np.random.Generator
    columns: list[tuple[str, np.ndarray]] = field(default_factory=list)
    said: dict[str, str] = field(default_factory=dict)

    def one_of(self, what: str, choices):
        """A random choice, remembered."""
        picked = choices[int(self.draw.integers(len(choices)))]
        self.said[what] = picked if isinstance(picked, str) else str(picked)
        return picked

    def chance(self, share: float) -> bool:
        return bool(self.draw.uniform() < share)

    def add(self, name: str, values) -> None:
        self.columns.append((name, np.asarray(values, float)))


# --- names and units ----------------------------------------------------------------------------------------

NAMES = {
    "theta_i": (
        "theta_i", "Theta_i", "thetaI", "theta_in", "theta_inc", "AOI", "Angle of incidence", "incidence angle",
        "Incident Angle", "incidence", "θi", "θ_i", "th_i", "theta_source", "source zenith", "SZA",
        "illumination angle", "inc. angle", "polar_i", "ti", "theta_sun", "sunZenith", "Illumination Zenith Angle",
        "ang_i", "light_theta",
        "incident polar angle", "Incident theta",
    ),
    "theta_r": (
        "theta_r", "Theta_r", "thetaR", "theta_out", "theta_s", "theta_o", "Scatter angle", "scattering angle",
        "Detector angle", "viewing angle", "reflection angle", "θr", "θ_r", "th_r", "theta_detector", "view zenith",
        "VZA", "emission", "polar_o", "tr", "theta_view", "satZenith", "Sensor Zenith Angle", "ang_r", "camera_theta",
        "exitant polar angle", "Scattered theta",
    ),
    "dphi": (
        "dphi", "delta_phi", "phi", "relative azimuth", "RAA", "azimuth", "rel. azimuth", "Δφ", "azimuth difference",
        "phi_rel", "relAz", "raz", "azm",
    ),
    "phi_i": ("phi_i", "phiI", "azimuth_i", "source azimuth", "SAA", "φ_i", "phi_in", "phi_sun", "light azimuth"),
    "phi_r": ("phi_r", "phiR", "azimuth_r", "detector azimuth", "VAA", "φ_r", "phi_out", "phi_view", "Sensor Azimuth"),
}  # fmt: skip
UNITS = {"deg": 1.0, "rad": np.pi / 180, "gon": 1 / 0.9, "mrad": 1000 * np.pi / 180}
WRITTEN = {
    "deg": ("deg", "°", "degrees", "degree"),
    "rad": ("rad", "radians"),
    "gon": ("gon", "grad"),
    "mrad": ("mrad",),
}
FORMS = ("{} [{}]", "{} ({})", "{}_{}", "{} / {}", "{} {}", "{}, {}")


def angle_name(making: Making, role: str, unit: str, bare: bool) -> str:
    name = making.one_of(role, NAMES[role])
    if bare:
        return name
    written = making.one_of("unit word", WRITTEN[unit])
    return making.one_of("unit form", FORMS[:-1] if "," in name else FORMS).format(name, written)


# --- directions ---------------------------------------------------------------------------------------------


def plane(making: Making):
    """theta_i, signed theta_r [deg] of scans in the plane of incidence."""
    theta_i = np.array(
        making.one_of("incidences", ((15.0, 35.0, 55.0, 70.0), (10.0, 30.0, 50.0, 75.0), (20.0, 45.0, 65.0)))
    )
    theta_r = np.arange(-75.0, 76.0, making.one_of("step", (2.5, 5.0)))
    return [each.ravel() for each in np.meshgrid(theta_i, theta_r, indexing="ij")]


def dome(making: Making):
    """theta_i, theta_r, azimuth from light to detector [deg] over the hemisphere."""
    theta_i = np.array(making.one_of("incidences", ((15.0, 40.0, 65.0), (10.0, 30.0, 50.0, 70.0))))
    grid = np.meshgrid(theta_i, np.r_[0.0:76.0:7.5], np.r_[0.0:181.0:20.0], indexing="ij")
    return [each.ravel() for each in grid]


def signed(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r = plane(making)
    flipped = making.chance(0.3)
    making.said["mirror side"] = "negative" if flipped else "positive"
    making.add(angle_name(making, "theta_i", unit, bare), theta_i * UNITS[unit])
    making.add(angle_name(making, "theta_r", unit, bare), (-theta_r if flipped else theta_r) * UNITS[unit])
    return in_plane(theta_i, theta_r)


def in_plane(theta_i, theta_r) -> Geometry:
    return rows(Geometry.from_degrees(theta_i, 0.0, np.abs(theta_r), np.where(theta_r < 0, 0.0, 180.0)))


def azimuths(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    shift = making.one_of("mirror azimuth", (0.0, 180.0))  # some count azimuths from the mirror direction
    making.add(angle_name(making, "theta_i", unit, bare), theta_i * UNITS[unit])
    making.add(angle_name(making, "theta_r", unit, bare), theta_r * UNITS[unit])
    if making.chance(0.5):
        making.add(angle_name(making, "dphi", unit, bare), np.mod(phi + shift, 360) * UNITS[unit])
    else:
        light = making.one_of("light azimuth", (0.0, 30.0, 180.0))
        making.add(angle_name(making, "phi_i", unit, bare), np.full_like(phi, light) * UNITS[unit])
        making.add(angle_name(making, "phi_r", unit, bare), np.mod(phi + shift + light, 360) * UNITS[unit])
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def phase(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))
    cosine = (geom.dot_xy + geom.cos_i * geom.cos_r)[:, 0]
    names = making.one_of(
        "names", (("incidence", "emission", "phase"), ("i", "e", "g"), ("Incidence", "Emission", "Phase angle"))
    )
    values = theta_i, theta_r, np.round(np.degrees(np.arccos(np.clip(cosine, -1, 1))), 2)
    for each, angle in zip(names, values, strict=True):
        making.add(each if bare else f"{each} ({making.one_of('unit word', WRITTEN[unit])})", angle * UNITS[unit])
    return geom


def elevation(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    unit_word = "" if bare else f" ({making.one_of('unit word', WRITTEN[unit])})"
    making.add(
        making.one_of("names", ("sun elevation", "Source Elevation", "light elevation")) + unit_word,
        (90 - theta_i) * UNITS[unit],
    )
    making.add(
        making.one_of("view", ("view elevation", "detector elevation angle")) + unit_word, (90 - theta_r) * UNITS[unit]
    )
    making.add("relative azimuth" + unit_word, phi * UNITS[unit])
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def from_mirror(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r = plane(making)
    making.add(angle_name(making, "theta_i", "deg", False), theta_i)
    kind = making.one_of("from mirror", ("angle from specular", "beta", "difference", "cosines"))
    sines = np.sin(np.radians(theta_i)), np.sin(np.radians(theta_r))
    if kind == "angle from specular":
        making.add(
            making.one_of("name", ("angle from specular (deg)", "aspecular angle [deg]", "theta from specular (deg)")),
            theta_r - theta_i,
        )
    elif kind == "beta":
        making.add(making.one_of("name", ("beta-beta0", "β-β0", "beta - beta_0")), sines[1] - sines[0])
    elif kind == "difference":
        making.add("theta_s - theta_i (deg)", theta_r - theta_i)
    else:
        making.columns.pop()
        making.add("beta_0", sines[0])
        making.add("beta_s", sines[1])
    return in_plane(theta_i, theta_r)


def half_difference(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    keep = (theta_r > 0) & (phi > 0) & (phi < 180)
    geom = rows(Geometry.from_degrees(theta_i[keep], 0.0, theta_r[keep], phi[keep]))
    i, r, p = (np.radians(each[keep]) for each in (theta_i, theta_r, phi))
    light = np.stack([np.sin(i), 0 * i, np.cos(i)])
    half = light + np.stack([np.sin(r) * np.cos(p), np.sin(r) * np.sin(p), np.cos(r)])
    half /= np.linalg.norm(half, axis=0)
    theta_h, phi_h = np.arccos(half[2]), np.arctan2(half[1], half[0])
    x, y = np.cos(phi_h) * light[0] + np.sin(phi_h) * light[1], np.cos(phi_h) * light[1] - np.sin(phi_h) * light[0]
    x, z = np.cos(theta_h) * x - np.sin(theta_h) * light[2], np.sin(theta_h) * x + np.cos(theta_h) * light[2]
    names = making.one_of(
        "names",
        (("theta_h", "theta_d", "phi_d"), ("theta_half", "theta_diff", "phi_diff"), ("thetaH", "thetaD", "phiD")),
    )
    values = theta_h, np.arctan2(np.hypot(x, y), z), np.mod(np.arctan2(y, x), 2 * np.pi)
    unit = making.one_of("unit", ("rad", "deg"))
    for each, angle in zip(names, values, strict=True):
        making.add(each if bare else f"{each} [{unit}]", np.degrees(angle) * UNITS[unit])
    return geom


def vectors(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    i, r, p = np.radians(theta_i), np.radians(theta_r), np.radians(phi)
    names = making.one_of("names", (("wi", "wo"), ("in", "out"), ("light", "view")))
    parts = ([np.sin(i), 0 * i, np.cos(i)], [np.sin(r) * np.cos(p), np.sin(r) * np.sin(p), np.cos(r)])
    for each, vector in zip(names, parts, strict=True):
        for axis, component in zip("xyz", vector, strict=True):
            making.add(f"{each}_{axis}", component)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


def cosines(making: Making, unit: str, bare: bool) -> Geometry:
    theta_i, theta_r, phi = dome(making)
    names = making.one_of("names", (("mu0", "mu"), ("cos_theta_i", "cos_theta_r"), ("cos(theta_i)", "cos(theta_s)")))
    for each, angle in zip(names, (theta_i, theta_r), strict=True):
        making.add(each, np.cos(np.radians(angle)))
    making.add(making.one_of("dphi", ("dphi (deg)", "relative azimuth [°]")), phi)
    return rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi))


WAYS = (signed, signed, signed, azimuths, azimuths, phase, elevation, from_mirror, half_difference, vectors, cosines)

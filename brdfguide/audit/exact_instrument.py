"""An instrument that drifted, as an answer tells it: a gain of each scan, and the zero of its arm."""

from dataclasses import replace

from mpmath import exp, fsum, mpf, sqrt

from .exact_errors import Readings
from .rederived import EXACT, Comparisons

GAIN = "ln_gain_"  # and the incidence [deg], in a flag
NORMAL_DEG = 1e-7  # up to which a direction is the normal
FARTHEST_DEG = 89.9  # where the arm stands at most


def undrifted(data: Readings, found: dict) -> Readings:
    """The values without the gains of their scans, the directions with the arm's zero, as `instrument` of a row or its
    flag tells them."""
    gains, at_plane = _gains(found), all(_off_plane_deg(each) < 0.1 for each in data.angles)
    angles, values = [], []
    for (theta_i, phi_i, theta_r, phi_r), signed, row in zip(
        data.angles, data.signed_theta_r, data.values, strict=True
    ):
        before = signed if at_plane else theta_r
        after = min(max(before + found["zero_deg"], -FARTHEST_DEG), FARTHEST_DEG)
        turn = 180.0 if (after < 0) != (before < 0) else 0.0
        angles.append((theta_i, phi_i, abs(after), phi_r + turn))
        gain = gains[min(gains, key=lambda theta: abs(theta - theta_i))]
        values.append(tuple(float(mpf(value) / exp(mpf(gain))) for value in row))
    return replace(data, angles=tuple(angles), values=tuple(values), beyond=())


def compare_instrument(row: dict, place: str, found: Comparisons) -> None:
    """What the flag `instrument` tells of the instrument beside a row."""
    numbers = next((each["numbers"] for each in row["flags"] if each["code"] == "instrument"), None)
    if numbers is None:
        return
    place = f"{place}.flags.instrument"
    found.check(f"{place}.gains_rms", numbers["gains_rms"], _spread_of_gains(numbers))
    if (told := row.get("instrument")) is None:
        return
    found.check(f"{place}.zero_deg", numbers["zero_deg"], told["zero_deg"], EXACT)
    for theta, gain in zip(told["theta_i_deg"], told["ln_gains"], strict=False):
        found.check(f"{place}.{GAIN}{theta:g}", numbers.get(f"{GAIN}{theta:g}"), gain, EXACT)


def _gains(found: dict) -> dict[float, float]:
    """ln of each scan's gain by its incidence [deg]."""
    if "ln_gains" in found:
        return dict(zip(found["theta_i_deg"], found["ln_gains"], strict=False))
    return {
        float(name.removeprefix(GAIN)): gain for name, gain in found.items() if name.removeprefix(GAIN)[0].isdigit()
    }


def _spread_of_gains(found: dict):
    """rms of ln about their mean."""
    gains = list(map(mpf, _gains(found).values()))
    mean = fsum(gains) / len(gains)
    return sqrt(fsum((each - mean) ** 2 for each in gains) / len(gains))


def _off_plane_deg(angles: tuple[float, float, float, float]) -> float:
    """Azimuth away from the plane of incidence; 0 at the normal, which lies in every plane."""
    theta_i, phi_i, theta_r, phi_r = angles
    off = (phi_r - phi_i) % 180
    return min(off, 180 - off) if min(theta_i, theta_r) > NORMAL_DEG else 0.0

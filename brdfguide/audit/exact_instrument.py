"""An instrument that drifted, as an answer tells it: a gain of each scan, and the zero of its arm."""

from dataclasses import replace

from mpmath import exp, fsum, mpf, sqrt

from .exact_errors import Readings

GAIN = "ln_gain_"  # and the incidence [deg]
NORMAL_DEG = 1e-7  # up to which a direction is the normal
FARTHEST_DEG = 89.9  # where the arm stands at most


def undrifted(data: Readings, found: dict) -> Readings:
    """The values without the gains of their scans, the directions with the arm's zero, as a flag `instrument` tells."""
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


def _gains(found: dict) -> dict[float, float]:
    """ln of each scan's gain by its incidence [deg]."""
    return {
        float(name.removeprefix(GAIN)): gain for name, gain in found.items() if name.removeprefix(GAIN)[0].isdigit()
    }


def spread_of_gains(found: dict):
    """rms of ln about their mean."""
    gains = list(map(mpf, _gains(found).values()))
    mean = fsum(gains) / len(gains)
    return sqrt(fsum((each - mean) ** 2 for each in gains) / len(gains))


def _off_plane_deg(angles: tuple[float, float, float, float]) -> float:
    """Azimuth away from the plane of incidence; 0 at the normal, which lies in every plane."""
    theta_i, phi_i, theta_r, phi_r = angles
    off = (phi_r - phi_i) % 180
    return min(off, 180 - off) if min(theta_i, theta_r) > NORMAL_DEG else 0.0

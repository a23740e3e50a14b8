"""The angle between light and detector, of planetary work: cos g = cos i cos e + sin i sin e cos azimuth."""

import numpy as np

ROUNDED = 0.6  # of the last digit: how far a rounded phase angle may stand beyond the possible ones
SLACK_DEG = 1.0  # beyond which a phase angle contradicts the others


def azimuth(theta_i, theta_r, phase):
    """Azimuth [deg] from light to detector, 0..180, NaN where a phase angle is missing; 180 along the normal.

    What rounding put beyond the plane of incidence lies in it. Gives the azimuths, and the first row whose phase angle
    no azimuth has, with the angles that are possible there, or None.
    """
    theta_i, theta_r = np.abs(theta_i), np.abs(theta_r)
    rounding = ROUNDED * _last_digit(phase) + 1e-9
    least, most = np.abs(theta_i - theta_r), theta_i + theta_r
    with np.errstate(invalid="ignore"):
        bad = np.flatnonzero((phase < least - rounding - SLACK_DEG) | (phase > most + rounding + SLACK_DEG))
    if len(bad):
        return None, (int(bad[0]), float(least[bad[0]]), float(most[bad[0]]))
    i, r, g = (np.radians(each) for each in (theta_i, theta_r, phase))
    sines = np.sin(i) * np.sin(r)
    lit = sines > 1e-9
    cosine = np.divide(np.cos(g) - np.cos(i) * np.cos(r), sines, out=np.full_like(sines, -1.0), where=lit)
    found = np.round(np.degrees(np.arccos(np.clip(cosine, -1, 1))), 6)
    with np.errstate(invalid="ignore"):
        found = np.where(phase >= most - rounding, 180.0, np.where(phase <= least + rounding, 0.0, found))
    return np.where(np.isfinite(phase), np.where(lit, found, 180.0), np.nan), None


def disagreement_deg(theta_i, theta_r, dphi, phase) -> float:
    """Median difference [deg] of phase angles from those of the other angles."""
    i, r = np.radians(theta_i), np.radians(theta_r)
    cosine = np.cos(i) * np.cos(r) + np.sin(i) * np.sin(r) * np.cos(np.radians(dphi))
    apart = np.abs(np.degrees(np.arccos(np.clip(cosine, -1, 1))) - np.abs(phase))
    return float(np.median(apart[np.isfinite(apart)])) if np.any(np.isfinite(apart)) else 0.0


def _last_digit(values) -> float:
    """The step of the last decimal that values are given to, at most four."""
    known = values[np.isfinite(values)]
    return next((10.0**-digits for digits in range(4) if np.allclose(known, np.round(known, digits), atol=1e-9)), 1e-4)

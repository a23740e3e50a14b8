"""Directions of light and detector from the angles of their half vector and of their difference."""

import numpy as np


def light_and_view(theta_h, phi_h, theta_d, phi_d):
    """theta_i, phi_i, theta_r, phi_r [rad]; pi/2 for both zeniths where one direction lies below the horizon.

    Exchanging light and detector changes nothing but phi_d, by pi.
    """
    along, across, up = np.sin(theta_d) * np.cos(phi_d), np.sin(theta_d) * np.sin(phi_d), np.cos(theta_d)
    found = []
    for sign in (1, -1):
        x = np.cos(theta_h) * sign * along + np.sin(theta_h) * up
        z = np.cos(theta_h) * up - np.sin(theta_h) * sign * along
        found += [np.arctan2(np.hypot(x, across), z), np.arctan2(sign * across, x) + phi_h]
    below = (found[0] > np.pi / 2) | (found[2] > np.pi / 2)
    return np.where(below, np.pi / 2, found[0]), found[1], np.where(below, np.pi / 2, found[2]), found[3]

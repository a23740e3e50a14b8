"""Integrals of a table over the hemisphere, exact for what is linear in both angles between its nodes."""

import numpy as np

FULL_TURN_DEG = 360.0
MOST_GAP = 1.5  # a last step to the full turn may be this many times the widest other


def theta_weights(theta_deg, cosines: int) -> np.ndarray:
    """Weights w (nodes,) with sum w v = ∫ v cos^cosines θ sin θ dθ from 0 to the last node, v linear between nodes.

    Below the first node the value is that of the first. Takes  theta_deg (nodes,) ascending [deg], cosines 0 or 1.
    """
    given = np.radians(np.asarray(theta_deg, float))
    nodes = np.concatenate(([0.0], given)) if given[0] > 0 else given
    if cosines == 0:
        zeroth, first = -np.cos(nodes), np.sin(nodes) - nodes * np.cos(nodes)
    else:
        zeroth = -np.cos(2 * nodes) / 4
        first = (np.sin(2 * nodes) / 2 - nodes * np.cos(2 * nodes)) / 4
    step = np.diff(nodes)
    area, moment = np.diff(zeroth), np.diff(first)
    rising = (moment - nodes[:-1] * area) / step  # of what grows from 0 to 1 over each step
    weights = np.zeros(len(nodes))
    weights[1:] += rising
    weights[:-1] += area - rising
    if len(nodes) > len(given):
        weights = np.concatenate(([weights[0] + weights[1]], weights[2:]))
    return weights


def phi_weights(phi_deg) -> np.ndarray:
    """Weights w (nodes,) with sum w v = ∫ v dφ over a full turn, v linear between nodes.

    Nodes that span half a turn stand for both halves, as a plane of symmetry has it; those that leave out the last step
    of a turn go on from the first.
    """
    phi = np.asarray(phi_deg, float)
    if len(phi) == 1:
        return np.array([2 * np.pi])
    span, step = phi[-1] - phi[0], np.diff(phi)
    weights = np.zeros(len(phi))
    weights[1:] += step / 2
    weights[:-1] += step / 2
    left = FULL_TURN_DEG - span
    if 1e-6 < left <= MOST_GAP * step.max():
        weights[0] += left / 2
        weights[-1] += left / 2
    return weights * (2 * np.pi / weights.sum())


def total(theta_deg, phi_deg, values, cosines: int = 1) -> np.ndarray:
    """∫ values cos^cosines θ sin θ dθ dφ over the hemisphere; values (..., thetas, phis)."""
    return np.einsum("...tp,t,p->...", values, theta_weights(theta_deg, cosines), phi_weights(phi_deg))

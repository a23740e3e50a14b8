"""Covariances from the normal equations of many channels that share a shape.

The residuals of a channel depend on the shared parameters and on its own; the normal equations are then an arrow, and
eliminating each channel's own block (Schur complement) makes 31 channels cost little more than one.
"""

from functools import cached_property

import numpy as np

from ..records import dataclass


@dataclass(frozen=True)
class Normal:
    """JᵀJ of an arrow-shaped problem: shared (p, p), between (channels, p, q), per_channel (channels, q, q)."""

    shared: np.ndarray
    between: np.ndarray
    per_channel: np.ndarray

    def covariance(self) -> tuple[np.ndarray, np.ndarray]:
        """(JᵀJ)⁻¹ of the shared (p, p) and of each channel's own (channels, q, q) parameters.

        A direction that the residuals do not depend on gets an enormous variance, never an arbitrary one.
        """
        shared, inverse_per_channel, coupling = self._inverses
        return shared, inverse_per_channel + coupling @ shared @ np.swapaxes(coupling, 1, 2)

    def variances(self, variance: float) -> tuple[np.ndarray, np.ndarray]:
        """Of the shared (p,) and of each channel's own (channels, q) parameters, where every residual has this
        `variance`.
        """
        shared, per_channel = self.covariance()
        return variance * shared.diagonal(), variance * per_channel.diagonal(0, 1, 2)

    def scatter(self, spread, j_shared, j_per_channel) -> tuple[np.ndarray, np.ndarray]:
        """The same where each residual has a standard deviation of its own, `spread` (samples, channels): a
        sandwich.
        """
        moved, per_channel_moved, coupling = self._moved(spread, j_shared, j_per_channel)
        by_channel = np.swapaxes(moved, 1, 2) @ moved
        of_others = coupling @ (by_channel.sum(0) - by_channel) @ np.swapaxes(coupling, 1, 2)
        per_channel = np.sum((per_channel_moved - moved @ np.swapaxes(coupling, 1, 2)) ** 2, axis=1)
        return by_channel.sum(0).diagonal(), per_channel + of_others.diagonal(0, 1, 2)

    def influence(self, r, j_shared, j_per_channel) -> tuple[np.ndarray, np.ndarray]:
        """(JᵀJ)⁻¹ Jᵀr sample by sample: how far each moves the shared (samples, p) and each channel's own (channels,
        samples, q) parameters.
        """
        moved, per_channel_moved, coupling = self._moved(r, j_shared, j_per_channel)
        moved = moved.sum(0)
        return moved, per_channel_moved - moved @ np.swapaxes(coupling, 1, 2)

    def _moved(self, r, j_shared, j_per_channel):
        """How far residuals move the shared parameters, channel by channel, and each channel's where shared ones stay;
        and what each channel's follow shared ones by."""
        shared, inverse_per_channel, coupling = self._inverses
        pull, per_channel_pull = j_shared * r.T[:, :, None], j_per_channel * r.T[:, :, None]
        return (pull - per_channel_pull @ coupling) @ shared, per_channel_pull @ inverse_per_channel, coupling

    @cached_property
    def _inverses(self):
        """Inverse of the shared block, others eliminated; of each channel's; and what they follow shared ones by."""
        inverse_per_channel = covariance_of(self.per_channel, self.per_channel.diagonal(0, 1, 2))
        coupling = inverse_per_channel @ np.swapaxes(self.between, 1, 2)
        reduced = self.shared - np.einsum("cpq,cqs->ps", self.between, coupling)
        return covariance_of(reduced, np.diag(self.shared)), inverse_per_channel, coupling


def covariance_of(matrix, diagonal):
    """Inverse for a covariance, scaled by this diagonal: eigenvalues that rounding could have made count as 1e-15 of
    the scaled matrix.
    """
    if matrix.shape[-1] == 0:
        return matrix
    scale = 1 / np.sqrt(np.where(diagonal > 1e-200, diagonal, 1.0))
    outer = scale[..., :, None] * scale[..., None, :]
    values, vectors = np.linalg.eigh(matrix * outer)
    return np.einsum("...ij,...j,...kj->...ik", vectors, 1 / np.maximum(values, 1e-15), vectors) * outer

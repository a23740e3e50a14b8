"""The numbers that workshops have of a surface, and what they mean for light; nothing but `math` is needed.

    Rq = √(π/2) Ra = 1.2533 Ra                          heights are Gaussian
    Rdq = 2π Rq/RSm                                     and so is their correlation, or a single period dominates
    tau = √2 Rq/Rdq = RSm/(√2 π)                        of a Gaussian correlation exp(-r²/tau²)
    Sdq = √2 Rdq,   alpha = Sdq                         no direction; facets with a Gaussian slope

Each holds for waves between the cut-offs of the instrument alone.

Source: ISO 21920-2 and ISO 25178-2 (definitions); Rice 1945 (crossings of a Gaussian process); Beckmann 1963 (alpha).
"""

from math import pi, sqrt

GAUSSIAN = "heights are Gaussian"
CORRELATED = "their correlation is Gaussian"
RQ_OF_RA = sqrt(pi / 2)


def rq_from_ra(ra: float) -> float:
    """Rms height of Gaussian heights from their mean absolute one, in its unit."""
    return RQ_OF_RA * ra


def ra_from_rq(rq: float) -> float:
    return rq / RQ_OF_RA


def rdq_from_spacing(rq: float, rsm: float) -> float:
    """Rms slope of a profile from rms height and mean spacing, in one unit: 2π Rq/RSm (Rice's rate of crossings)."""
    return 2 * pi * rq / rsm


def tau_from_slope(rq: float, rdq: float) -> float:
    """Correlation length √2 Rq/Rdq, in the unit of Rq."""
    return sqrt(2) * rq / rdq


def tau_from_spacing(rsm: float) -> float:
    """Correlation length RSm/(√2 π), in its unit."""
    return rsm / (sqrt(2) * pi)


def alpha_from_slope(rdq: float) -> float:
    """Width of a lobe of facets from the rms slope of a profile: √2 Rdq, which is Sdq."""
    return sqrt(2) * rdq

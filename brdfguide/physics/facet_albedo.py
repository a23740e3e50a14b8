"""What GGX facets lose because light that meets a second facet is not followed: 1 - E, E the albedo of their lobe for
F = 1 and correlated heights.

    1 - E = y Σ_j c_j(alpha) T_j(2y - 1),   y² = asinh(μ/alpha)/asinh(1/alpha),   μ the cosine of incidence

The coefficients are series in a share of the width themselves, printed by benchmarks/facet_albedo.py: right to
1.3e-5 for alpha from 0.01, where no more than 2e-4 is lost at the normal, to 1.5.

Source: the integral by quadrature over the hemisphere, ours; at the normal and alpha 1 it is ln 2.
"""

from functools import cached_property, lru_cache

import numpy as np

from ..numerics import chebyshev
from ..records import dataclass

NARROWEST = 0.01  # alpha, the least in the table
WIDEST = 1.5  # alpha, the greatest
CORE = 0.05  # widths are even in ln(alpha + CORE)
NODES = 48  # of Gauss's rule in y for the mean over directions


def width_share(alpha):
    """Where a width stands between the narrowest and the widest, 0..1."""
    return np.log((alpha + CORE) / (NARROWEST + CORE)) / np.log((WIDEST + CORE) / (NARROWEST + CORE))


def angle_share(mu, alpha):
    """y, 0 at grazing and 1 at the normal."""
    return np.sqrt(np.arcsinh(mu / alpha) / np.arcsinh(1 / alpha))


def lost(mu, alpha) -> np.ndarray:
    """1 - E. Takes  μ (...) in 0..1 and alpha, a number or one for each channel, in NARROWEST..WIDEST."""
    return chebyshev.by_value(_loss, mu, 1, alpha)[0]


def lost_by_share(x, alpha) -> np.ndarray:
    """(1 - E)/y for y = (x + 1)/2, at one alpha."""
    return _loss(float(alpha)).series(x, 1)[0]


def lost_and_slope(mu, alpha) -> list[np.ndarray]:
    """The same and its derivative by alpha."""
    return chebyshev.by_value(_loss, mu, 2, alpha)


def mean_lost(alpha) -> np.ndarray:
    """2 ∫ (1 - E) μ dμ."""
    return chebyshev.by_value(_mean, 0.0, 1, alpha)[0]


def mean_lost_and_slope(alpha) -> list[np.ndarray]:
    """The same and its derivative by alpha."""
    return chebyshev.by_value(_mean, 0.0, 2, alpha)


@dataclass(frozen=True, eq=False)
class _Loss:
    """1 - E and its derivative by alpha, as functions of μ, for one alpha."""

    alpha: float
    series: chebyshev.Series  # c, dc/dy and dc/dalpha, in 2y - 1

    def __call__(self, mu, count: int) -> list[np.ndarray]:
        alpha, end = self.alpha, np.arcsinh(1 / self.alpha)
        y = angle_share(mu, alpha)
        c, *slopes = self.series(2 * y - 1, 1 if count == 1 else 3)
        if count == 1:
            return [y * c]
        by_y, by_alpha = slopes
        # y² = asinh(μ/alpha)/asinh(1/alpha)
        y2_by_alpha = (y * y / np.hypot(alpha, 1.0) - mu / np.hypot(alpha, mu)) / (alpha * end)
        return [y * c, y * by_alpha + (c + y * by_y) * y2_by_alpha / (2 * y)]

    @cached_property
    def means(self) -> list[np.ndarray]:
        """Both averaged over directions, with μ dμ through y."""
        x, weight = np.polynomial.legendre.leggauss(NODES)
        y, end = 0.5 * (x + 1), np.arcsinh(1 / self.alpha)
        mu = self.alpha * np.sinh(y * y * end)
        weight = weight * mu * np.hypot(self.alpha, mu) * 2 * y * end
        return [np.sum(weight * each) for each in self(mu, 2)]


@lru_cache(maxsize=256)
def _loss(alpha: float) -> _Loss:
    share = width_share(alpha)
    table = np.array(TABLE.split(), float).reshape(ORDERS)
    polynomials = np.polynomial.chebyshev
    c = polynomials.chebval(2 * share - 1, table)
    by_share = polynomials.chebval(2 * share - 1, 2 * polynomials.chebder(table))
    by_alpha = by_share / ((alpha + CORE) * np.log((WIDEST + CORE) / (NARROWEST + CORE)))
    by_y = np.append(2 * polynomials.chebder(c), 0.0)
    return _Loss(alpha, chebyshev.Series(np.stack([c, by_y, by_alpha])))


def _mean(alpha: float):
    return lambda mu, count: _loss(alpha).means[:count]


ORDERS = (15, 19)  # of the share of the width, of y
TABLE = """
    0.3061372 0.0784669 -0.1443787 0.0576091 -0.0062473 0.0018841 -0.0057783 0.0032873 -0.0006750 0.0006669
    -0.0008525 0.0004410 -0.0001855 0.0001842 -0.0001446 0.0000644 -0.0000324 0.0000250 -0.0000105
    0.3401132 0.1708006 -0.0767518 0.0209234 -0.0329774 0.0196260 -0.0021789 0.0009384 -0.0033268 0.0018822
    -0.0004144 0.0004919 -0.0005497 0.0002396 -0.0000905 0.0000961 -0.0000586 0.0000067 0.0000038
    0.1457095 0.0337070 -0.0436654 0.0473874 -0.0115939 -0.0034398 -0.0035134 0.0040172 -0.0002229 -0.0000143
    -0.0008060 0.0004307 -0.0000442 0.0001212 -0.0001454 0.0000491 -0.0000164 0.0000261 -0.0000143
    0.0221988 -0.0086080 -0.0236988 0.0023865 0.0035804 0.0056830 -0.0019096 -0.0016458 -0.0003346 0.0008356
    0.0001193 -0.0001261 -0.0001573 0.0000539 0.0000425 0.0000033 -0.0000171 -0.0000080 0.0000093
    -0.0087765 -0.0152273 -0.0051894 -0.0017583 -0.0037986 -0.0003323 0.0016773 0.0010719 -0.0004244 -0.0005125
    -0.0000510 0.0002112 0.0000586 -0.0000422 -0.0000484 0.0000135 0.0000125 0.0000055 -0.0000087
    -0.0055512 -0.0047621 0.0002453 -0.0005484 -0.0000877 -0.0006593 -0.0009334 -0.0001284 0.0004615 0.0002806
    -0.0001010 -0.0001517 -0.0000184 0.0000585 0.0000231 -0.0000128 -0.0000144 0.0000013 0.0000061
    -0.0003664 0.0001422 0.0016290 0.0012166 0.0000836 0.0000130 0.0001480 -0.0001556 -0.0002540 -0.0000679
    0.0001340 0.0000737 -0.0000126 -0.0000540 -0.0000008 0.0000103 0.0000132 -0.0000066 -0.0000030
    0.0006326 0.0011207 0.0004983 0.0003378 0.0004620 0.0002370 -0.0000420 0.0000616 0.0000532 -0.0000090
    -0.0000941 -0.0000088 0.0000183 0.0000387 -0.0000145 -0.0000048 -0.0000105 0.0000095 0.0000001
    0.0002925 0.0002173 0.0000639 -0.0000236 -0.0001107 -0.0000061 0.0001236 0.0000118 0.0000021 -0.0000020
    0.0000441 -0.0000175 -0.0000088 -0.0000218 0.0000186 -0.0000006 0.0000070 -0.0000094 0.0000019
    -0.0000257 -0.0000179 -0.0001636 -0.0001327 -0.0000414 -0.0000326 -0.0000784 0.0000102 0.0000102 0.0000171
    -0.0000205 0.0000154 -0.0000009 0.0000106 -0.0000147 0.0000035 -0.0000039 0.0000070 -0.0000025
    -0.0000346 -0.0000951 -0.0000208 -0.0000249 -0.0000441 -0.0000244 0.0000182 -0.0000221 -0.0000118 -0.0000102
    0.0000142 -0.0000065 0.0000030 -0.0000052 0.0000082 -0.0000034 0.0000018 -0.0000040 0.0000021
    -0.0000157 0.0000015 -0.0000077 0.0000059 0.0000236 0.0000090 -0.0000124 0.0000074 0.0000033 0.0000005
    -0.0000092 0.0000022 -0.0000006 0.0000026 -0.0000034 0.0000018 -0.0000006 0.0000017 -0.0000013
    0.0000042 0.0000008 0.0000159 0.0000144 -0.0000010 0.0000054 0.0000114 -0.0000000 -0.0000014 0.0000012
    0.0000037 -0.0000013 -0.0000011 -0.0000009 0.0000013 -0.0000004 0.0000000 -0.0000005 0.0000006
    0.0000018 0.0000070 -0.0000002 -0.0000013 0.0000065 -0.0000002 -0.0000036 0.0000014 0.0000026 -0.0000002
    -0.0000010 0.0000007 0.0000010 0.0000000 -0.0000006 -0.0000000 0.0000002 0.0000001 -0.0000002
    0.0000007 -0.0000015 0.0000007 0.0000004 -0.0000046 -0.0000006 0.0000014 -0.0000012 -0.0000016 0.0000003
    0.0000007 -0.0000002 -0.0000004 0.0000001 0.0000004 0.0000000 -0.0000002 -0.0000001 0.0000001
"""

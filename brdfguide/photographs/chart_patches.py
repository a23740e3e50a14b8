"""The 24 patches of a ColorChecker Classic in linear sRGB, and where they lie on it.

Computed from the spectra in colour-science 0.4.7 (BSD-3-Clause) under D65 for the CIE 1931 2 degree observer, by its
`sd_to_XYZ` and `XYZ_to_RGB`: "average" is BabelColor's mean of 30 charts, "iso17321" Ohta's of ISO 17321-1.
A value below 0 is a colour outside sRGB.
"""

import numpy as np

COLUMNS, ROWS = 6, 4
PITCH = 0.15625  # between patches, of the chart's width
MARGIN = 0.03125  # from the frame to the first patch
HEIGHT = 2 * MARGIN + ROWS * PITCH  # of the frame, of its width
# row by row from the upper left, dark skin, to the lower right, black
_RGB = {
    "average": (
        (0.1725, 0.0838, 0.0576), (0.5481, 0.2985, 0.2170), (0.1103, 0.1968, 0.3359),
        (0.1038, 0.1502, 0.0521), (0.2244, 0.2177, 0.4302), (0.1232, 0.5190, 0.4044),
        (0.7168, 0.1990, 0.0271), (0.0650, 0.1063, 0.3924), (0.5417, 0.0884, 0.1203),
        (0.1042, 0.0438, 0.1396), (0.3547, 0.5078, 0.0482), (0.7805, 0.3541, 0.0215),
        (0.0234, 0.0492, 0.2916), (0.0653, 0.3019, 0.0645), (0.4294, 0.0319, 0.0402),
        (0.8568, 0.5754, 0.0079), (0.5032, 0.0889, 0.3055), (-0.0286, 0.2490, 0.3830),
        (0.9163, 0.9155, 0.8705), (0.5819, 0.5911, 0.5839), (0.3552, 0.3610, 0.3590),
        (0.1876, 0.1924, 0.1917), (0.0871, 0.0901, 0.0908), (0.0321, 0.0319, 0.0326),
    ),
    "iso17321": (
        (0.1762, 0.0782, 0.0503), (0.5594, 0.3088, 0.2229), (0.1132, 0.1992, 0.3362),
        (0.0946, 0.1484, 0.0499), (0.2363, 0.2259, 0.4438), (0.1338, 0.5170, 0.4029),
        (0.7014, 0.1992, 0.0229), (0.0684, 0.1060, 0.3771), (0.5581, 0.0906, 0.1220),
        (0.1078, 0.0443, 0.1468), (0.3489, 0.5020, 0.0478), (0.7917, 0.3650, 0.0268),
        (0.0272, 0.0478, 0.3092), (0.0601, 0.3056, 0.0606), (0.4461, 0.0285, 0.0421),
        (0.8519, 0.5796, 0.0105), (0.5061, 0.0890, 0.2972), (-0.0334, 0.2488, 0.3854),
        (0.8869, 0.8887, 0.8746), (0.5864, 0.5833, 0.5822), (0.3583, 0.3581, 0.3588),
        (0.2032, 0.2030, 0.2036), (0.0911, 0.0929, 0.0943), (0.0327, 0.0336, 0.0353),
    ),
}  # fmt: skip


def patches_rgb(data_set: str) -> np.ndarray:
    """Reflectances (24, 3) in linear sRGB."""
    return np.array(_RGB[data_set])


def middles() -> np.ndarray:
    """Middles of the patches (24, 2): x to the right, y down, from the chart's middle, of its width."""
    column, row = np.meshgrid(np.arange(COLUMNS), np.arange(ROWS))
    x, y = (column - (COLUMNS - 1) / 2) * PITCH, (row - (ROWS - 1) / 2) * PITCH
    return np.stack([x.ravel(), y.ravel()], -1)

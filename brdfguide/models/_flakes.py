"""The parameters that every distribution of flakes has, and the text of GGX's shape for shaders."""

from .model import Parameter

FLAKE = Parameter(
    "flake",
    0.4,
    0.0,
    1.0,
    linear=True,
    per_channel=True,
    meaning="reflectance of the flakes times the share they cover",
)
TILT = Parameter(
    "tilt",
    0.1,
    1e-3,
    1.0,
    log=True,
    meaning="slope of the flakes, as alpha of facets; a coat makes it look n times wider",
    starts=(0.02, 0.05, 0.1, 0.2, 0.35, 0.6),
)
SHAPE = (
    "ggx_shape",
    "ci, cr, q, a",
    "a * a / (2.0 * PI * sq(cos2h(ci, cr, q) * a * a + sin2h(ci, cr, q)))"
    " / (cr * sqrt(a * a + (1.0 - a * a) * ci * ci) + ci * sqrt(a * a + (1.0 - a * a) * cr * cr))",
)

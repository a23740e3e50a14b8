"""Values at points where straightforward double precision fails, for `check`; computed at 400 digits.

QUANTITIES says which of our functions each value belongs to, as quantity(geometry, values).
"""

from dataclasses import dataclass

from . import optics
from .geometry import Geometry
from .models import beckmann, ggx, lafortune, oren_nayar, term


@dataclass(frozen=True)
class Reference:
    """One value: of what, where [deg], with which parameters."""

    model: str
    quantity: str
    angles: tuple[float, float, float, float]  # theta_i, phi_i, theta_r, phi_r
    values: dict[str, float]
    right: float
    why: str

    @property
    def geom(self) -> Geometry:
        return Geometry.from_degrees(*self.angles)


RTOL = 1e-12  # ours come within 1e-14

QUANTITIES = {
    "fresnel": lambda geom, v: optics.fresnel(geom.cos_i, **v),
    "one_minus_fresnel": lambda geom, v: optics.one_minus_fresnel(geom.cos_i, **v),
    "index_from_f0": lambda geom, v: optics.index_from_f0(**v),
    "index_minus_one": lambda geom, v: optics.index_minus_one(**v),
    "davies_ln": lambda geom, v: optics.davies_ln(1.0, geom.cos_i, **v),
    "davies_scattered": lambda geom, v: optics.davies_scattered(1.0, geom.cos_i, **v),
    "lafortune_lobe": lambda geom, v: lafortune.lobe(geom, **v),
    "lafortune_lobe_ln": lambda geom, v: lafortune.lobe_ln(geom, **v),
    "oren_nayar_qualitative": lambda geom, v: oren_nayar.qualitative(geom, **v),
    "ggx_distribution": lambda geom, v: ggx.distribution(geom, **v),
    "beckmann_distribution": lambda geom, v: beckmann.distribution(geom, **v),
}


def evaluate(reference: Reference, model=None) -> float:
    """Our value there; of `model` where the quantity is a BRDF."""
    of_quantity = QUANTITIES.get(reference.quantity)
    if of_quantity is not None:
        return float(of_quantity(reference.geom, reference.values))
    return float((model or term(reference.model))(reference.geom, **reference.values))


# printed by `python -m tests.models.stiff`
REFERENCES = (
    Reference("fresnel", "fresnel", (29.52292, 0.0, 29.52292, 180.0), {"n": 1.000000814588, "k": 0.0}, 1.8294924742620119e-13, "index near 1"),
    Reference("fresnel", "fresnel", (28.90331, 0.0, 28.90331, 180.0), {"n": 1.0000000331011, "k": 0.0}, 2.9937209569335532e-16, "index near 1"),
    Reference("fresnel", "fresnel", (89.99999877178, 0.0, 89.99999877178, 180.0), {"n": 1.0000000000546505, "k": 0.0}, 0.99183189373985528, "index near 1, at grazing"),
    Reference("fresnel", "fresnel", (89.99999999883809, 0.0, 89.99999999883809, 180.0), {"n": 1.000000000040667, "k": 0.0}, 0.99999100562665175, "index near 1, at grazing"),
    Reference("fresnel", "fresnel", (13.02152, 0.0, 13.02152, 180.0), {"n": 1.0, "k": 8.23876e-08}, 1.7017831010724682e-15, "n = 1 with a weak absorption"),
    Reference("fresnel", "fresnel", (23.10141, 0.0, 23.10141, 180.0), {"n": 1.0, "k": 1.06802e-08}, 2.9460817148434636e-17, "n = 1 with a weak absorption"),
    Reference("fresnel", "fresnel", (18.85487, 0.0, 18.85487, 180.0), {"n": 1.775458, "k": 4.56374e+177}, 1.0, "k whose square overflows"),
    Reference("fresnel", "fresnel", (36.72381, 0.0, 36.72381, 180.0), {"n": 2.023682, "k": 8.09734e+150}, 1.0, "k whose square overflows"),
    Reference("fresnel", "fresnel", (83.45981, 0.0, 83.45981, 180.0), {"n": 0.6528006, "k": 0.000293859}, 0.9997379955645788, "beyond the critical angle of n < 1"),
    Reference("fresnel", "fresnel", (77.10289, 0.0, 77.10289, 180.0), {"n": 0.459971, "k": 5.1018e-08}, 0.99999995675398574, "beyond the critical angle of n < 1"),
    Reference("fresnel", "fresnel", (6.258654, 0.0, 6.258654, 180.0), {"n": 0.2043208, "k": 3.76268}, 0.94763669391060045, "a metal with n < 1"),
    Reference("fresnel", "fresnel", (34.4983, 0.0, 34.4983, 180.0), {"n": 0.5742188, "k": 4.165866}, 0.88278238438228047, "a metal with n < 1"),
    Reference("fresnel", "one_minus_fresnel", (50.5498, 0.0, 50.5498, 180.0), {"n": 1.89224, "k": 46766.6}, 3.8226967403218019e-9, "absorptance of a near-perfect metal"),
    Reference("fresnel", "one_minus_fresnel", (29.6967, 0.0, 29.6967, 180.0), {"n": 1.384434, "k": 674838.0}, 1.2280728032593772e-11, "absorptance of a near-perfect metal"),
    Reference("fresnel", "one_minus_fresnel", (89.99999999833561, 0.0, 89.99999999833561, 180.0), {"n": 2.466078, "k": 0.0}, 1.8251240413432013e-10, "transmittance at grazing"),
    Reference("fresnel", "one_minus_fresnel", (89.99999882733, 0.0, 89.99999882733, 180.0), {"n": 1.198488, "k": 0.0}, 1.5097249423055686e-7, "transmittance at grazing"),
    Reference("fresnel", "index_from_f0", (0.0, 0.0, 0.0, 180.0), {"f0": 0.9999999999396775}, 66310221865.76157, "F0 next to 1"),
    Reference("fresnel", "index_from_f0", (0.0, 0.0, 0.0, 180.0), {"f0": 0.9999999999960143}, 1003587660693.3752, "F0 next to 1"),
    Reference("fresnel", "index_minus_one", (0.0, 0.0, 0.0, 180.0), {"f0": 4.97608e-34}, 4.4614257810704419e-17, "F0 so small that n rounds to 1"),
    Reference("fresnel", "index_minus_one", (0.0, 0.0, 0.0, 180.0), {"f0": 1.61058e-57}, 8.026406418815334e-29, "F0 so small that n rounds to 1"),
    Reference("mirror", "davies_scattered", (33.12663, 0.0, 33.12663, 180.0), {"sigma": 1.02098e-08, "wavelength": 0.55}, 3.8164708631862191e-14, "very smooth"),
    Reference("mirror", "davies_scattered", (61.04176, 0.0, 61.04176, 180.0), {"sigma": 1.75438e-09, "wavelength": 0.55}, 3.7665268755993286e-16, "very smooth"),
    Reference("mirror", "davies_ln", (38.74282, 0.0, 38.74282, 180.0), {"sigma": 67.3718, "wavelength": 0.55}, -1441446.5971397916, "far rougher than the wavelength"),
    Reference("mirror", "davies_ln", (38.68739, 0.0, 38.68739, 180.0), {"sigma": 338.783, "wavelength": 0.55}, -36505562.881942736, "far rougher than the wavelength"),
    Reference("phong", "phong", (41.72682, 0.0, 41.7268200256083, 180.0), {"ks": 0.3, "exponent": 3045370000000.0}, 0.40196860911859425, "huge exponent"),
    Reference("phong", "phong", (45.98188, 0.0, 45.981880001514575, 180.0), {"ks": 0.3, "exponent": 16675700000000.0}, 0.43172559503968066, "huge exponent"),
    Reference("phong", "phong", (66.06632, 0.0, 54.7199, -19.46442), {"ks": 0.3, "exponent": 3.81645}, 0.0, "behind the lobe"),
    Reference("phong", "phong", (63.03127, 0.0, 64.13229, -0.8974081), {"ks": 0.3, "exponent": 3.956007}, 0.0, "behind the lobe"),
    Reference("phong", "phong", (89.999999897722, 0.0, 89.999999897722, 180.0), {"ks": 0.2, "exponent": 22.54135}, 112039310.17968809, "1/cos at grazing"),
    Reference("phong", "phong", (89.99999999990611, 0.0, 89.99999999990611, 180.0), {"ks": 0.2, "exponent": 54.0251}, 122047284728.80073, "1/cos at grazing"),
    Reference("phong", "phong", (57.69387, 32.35392, 57.69387, 212.35392000000002), {"ks": 0.2, "exponent": 3.99128e+17}, 0.37422153982814395, "azimuths whose difference rounds"),
    Reference("phong", "phong", (17.06914, 11.86465, 17.06914, 191.86465), {"ks": 0.2, "exponent": 1.64512e+17}, 0.20921568986950995, "azimuths whose difference rounds"),
    Reference("ward", "ward", (27.14448, 0.0, 27.1444800147931, 180.0), {"rho_s": 0.2, "alpha": 3.00458e-09}, 1977560198376164.0, "tiny alpha"),
    Reference("ward", "ward", (67.87897, 0.0, 67.87897005490039, 180.0), {"rho_s": 0.2, "alpha": 2.04617e-09}, 9556266391466528.5, "tiny alpha"),
    Reference("ward", "ward", (89.9999999998603, 0.0, 89.9999999998603, 180.0), {"rho_s": 0.2, "alpha": 0.3346341}, 58288714766.604108, "at grazing"),
    Reference("ward", "ward", (89.99999337149, 0.0, 89.99999337149, 180.0), {"rho_s": 0.2, "alpha": 0.2843406}, 1701567.1698175155, "at grazing"),
    Reference("ward-duer", "ward_duer", (89.9999999999374, 0.0, 89.9999999999374, 180.0), {"rho_s": 0.2, "alpha": 0.2348215}, 2.4180064566847542e+23, "at grazing"),
    Reference("ward-duer", "ward_duer", (89.9999999999873, 0.0, 89.9999999999873, 180.0), {"rho_s": 0.2, "alpha": 0.2302621}, 6.1052722874398579e+24, "at grazing"),
    Reference("ward-gmd", "ward_gmd", (89.99999829049, 0.0, 89.99999829049, 180.0), {"rho_s": 0.2, "alpha": 0.1608038}, 691400181639805.61, "at grazing"),
    Reference("ward-gmd", "ward_gmd", (89.99999999876371, 0.0, 89.99999999876371, 180.0), {"rho_s": 0.2, "alpha": 0.2896715}, 4.0739424703428117e+20, "at grazing"),
    Reference("lafortune", "lafortune_lobe", (66.63624, 0.0, 66.6362400181478, 180.0), {"c_xy": -1.0, "c_z": 1.0, "exponent": 769362000000.0}, 0.99999996140744755, "mirror lobe, huge exponent"),
    Reference("lafortune", "lafortune_lobe", (47.46545, 0.0, 47.46545000388362, 180.0), {"c_xy": -1.0, "c_z": 1.0, "exponent": 157795000000.0}, 0.99999999963751374, "mirror lobe, huge exponent"),
    Reference("lafortune", "lafortune_lobe", (79.13375, 0.0, 66.332, 34.14161), {"c_xy": -0.7375637, "c_z": 0.0137797, "exponent": 42.16026}, 0.0, "negative base"),
    Reference("lafortune", "lafortune_lobe", (74.9624, 0.0, 84.63922, 11.0256), {"c_xy": -0.7184096, "c_z": 0.1719823, "exponent": 32.12399}, 0.0, "negative base"),
    Reference("lafortune", "lafortune_lobe_ln", (18.86453, 0.0, 18.86453, 180.0), {"c_xy": -1.17287, "c_z": 1.157152, "exponent": 4140000.0}, 610156.74208843665, "base above 1 overflows"),
    Reference("lafortune", "lafortune_lobe_ln", (50.76593, 0.0, 50.76593, 180.0), {"c_xy": -1.154646, "c_z": 1.152996, "exponent": 321862.0}, 46097.710982001252, "base above 1 overflows"),
    Reference("lafortune", "lafortune_lobe_ln", (46.98731, 0.0, 46.98731, 180.0), {"c_xy": -0.8490071, "c_z": 0.5109468, "exponent": 21540.4}, -7940.0664756476507, "base below 1 underflows"),
    Reference("lafortune", "lafortune_lobe_ln", (6.647378, 0.0, 6.647378, 180.0), {"c_xy": -0.5316031, "c_z": 0.53065, "exponent": 10950.9}, -6938.8027925655791, "base below 1 underflows"),
    Reference("oren-nayar", "oren_nayar_qualitative", (0.0, 0.0, 55.89131, 260.6723), {"albedo": 0.6, "spread": 0.941289}, 0.12140746531943218, "at the normal, without an azimuth"),
    Reference("oren-nayar", "oren_nayar_qualitative", (0.0, 0.0, 60.71717, 153.619), {"albedo": 0.6, "spread": 0.7988829}, 0.12804019444337873, "at the normal, without an azimuth"),
    Reference("oren-nayar", "oren_nayar_qualitative", (3.86381e-168, 0.0, 4.5278e-175, 3.110343), {"albedo": 0.6, "spread": 0.274541}, 0.17323049977146649, "sines underflow"),
    Reference("oren-nayar", "oren_nayar_qualitative", (3.07258e-166, 0.0, 6.43908e-172, 65.61409), {"albedo": 0.6, "spread": 0.4281361}, 0.15688522535378554, "sines underflow"),
    Reference("oren-nayar", "oren_nayar_qualitative", (89.9999999602585, 0.0, 89.9999442151, 16.59961), {"albedo": 0.6, "spread": 0.5639494}, 65934.405768400707, "both at grazing"),
    Reference("oren-nayar", "oren_nayar_qualitative", (89.99999939892, 0.0, 89.99957873, 19.62403), {"albedo": 0.6, "spread": 0.3983585}, 7025.6919782888386, "both at grazing"),
    Reference("oren-nayar", "oren_nayar", (5.88792e-173, 0.0, 2.94742e-169, 56.66599), {"albedo": 0.6, "spread": 0.4834225}, 0.16391394206051639, "sines underflow"),
    Reference("oren-nayar", "oren_nayar", (3.27797e-174, 0.0, 3.09519e-173, 79.90213), {"albedo": 0.6, "spread": 0.3757097}, 0.1725175424969464, "sines underflow"),
    Reference("oren-nayar", "oren_nayar", (89.99999999786657, 0.0, 89.999893288, 20.67155), {"albedo": 0.6, "spread": 0.2356159}, 17100.992183296157, "both at grazing"),
    Reference("oren-nayar", "oren_nayar", (89.999999851186, 0.0, 89.9999036575, 37.96108), {"albedo": 0.6, "spread": 0.9156343}, 41808.189553817564, "both at grazing"),
    Reference("ggx", "ggx_distribution", (25.0469, 0.0, 25.0469, 180.0), {"alpha": 1.14117e-10}, 2.4442714507177462e+19, "tiny alpha on the peak"),
    Reference("ggx", "ggx_distribution", (57.17815, 0.0, 57.17815, 180.0), {"alpha": 1.92489e-12}, 8.5908926989339903e+22, "tiny alpha on the peak"),
    Reference("ggx", "ggx_distribution", (10.03236, 0.0, 10.032711323000001, 180.0), {"alpha": 1.86994e-06}, 6692355344.0741506, "tiny alpha beside the peak"),
    Reference("ggx", "ggx_distribution", (17.71578, 0.0, 17.716334911999997, 180.0), {"alpha": 1.26379e-05}, 1515331850.5439219, "tiny alpha beside the peak"),
    Reference("beckmann", "beckmann_distribution", (63.136, 0.0, 63.136000770605, 180.0), {"alpha": 2.88255e-07}, 3828776897105.8126, "tiny alpha beside the peak"),
    Reference("beckmann", "beckmann_distribution", (10.61295, 0.0, 10.612950330998, 180.0), {"alpha": 3.24488e-08}, 299924170872073.63, "tiny alpha beside the peak"),
    Reference("cook-torrance", "cook_torrance", (17.69655, 0.0, 17.69655, 180.0), {"n": 1.0000000199555, "k": 0.0, "alpha": 0.2607407}, 1.2972452249063186e-16, "weak interface"),
    Reference("cook-torrance", "cook_torrance", (75.84792, 0.0, 75.84792, 180.0), {"n": 1.0000000339293, "k": 0.0, "alpha": 0.2015934}, 2.3415495598240249e-12, "weak interface"),
    Reference("cook-torrance", "cook_torrance", (89.99999857794, 0.0, 89.99999857794, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.1952987}, 3386887684971678.6, "at grazing"),
    Reference("cook-torrance", "cook_torrance", (89.999999334951, 0.0, 89.999999334951, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.1743078}, 19439918411442480.0, "at grazing"),
    Reference("beckmann", "beckmann", (89.99999377141, 0.0, 89.99999377141, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.2265445}, 111593042.27657303, "at grazing"),
    Reference("beckmann", "beckmann", (89.99999999848454, 0.0, 89.99999999848454, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.09048864}, 7197159264490.9527, "at grazing"),
    Reference("beckmann", "beckmann", (86.45753, 0.0, 86.45753, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.1774261}, 257.68460193333769, "where the masking turns on"),
    Reference("beckmann", "beckmann", (71.0315, 0.0, 71.0315, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.122324}, 9.3046347904289668, "where the masking turns on"),
    Reference("ggx", "ggx", (89.999999260481, 0.0, 89.999999260481, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.2299329}, 507177585.07090094, "at grazing"),
    Reference("ggx", "ggx", (89.99999999999741, 0.0, 89.99999999999741, 180.0), {"n": 1.5, "k": 0.0, "alpha": 0.06455491}, 6552896989833351.6, "at grazing"),
    Reference("ggx", "ggx", (17.48881, 0.0, 17.48881, 180.0), {"n": 0.7230795, "k": 4.766515, "alpha": 1.74367e-07}, 2552983266248.5837, "narrow and metallic"),
    Reference("ggx", "ggx", (77.07354, 0.0, 77.07354, 180.0), {"n": 0.6865259, "k": 5.364715, "alpha": 3.04623e-07}, 15010622611606.832, "narrow and metallic"),
)  # fmt: skip

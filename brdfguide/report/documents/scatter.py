"""Scatter of polished surfaces as documents: heights and total scatter, spectra, and one scatter in every law."""

import numpy as np

from ...data.measurement import Measurement
from ...errors import InputError
from ...fitting import scatter_laws
from ...fitting.stray_light import scattered_shares
from ...fitting.three_ways import Profile, Total, agreement
from ...models.surface import Surface
from ...physics import hemisphere, profile_numbers, rough_scatter, smooth_scatter
from ...physics.fresnel import fresnel
from ...physics.geometry import Geometry
from ...physics.height_spectrum import (
    KCorrelation,
    Spectrum,
    TabulatedSpectrum,
    profile_height,
    profile_slope,
    surface_height,
)
from ...records import dataclass
from .plain import plain

SCHEMA = "brdfguide/scatter/1"
LOW_BETA = 1e-3


@dataclass(frozen=True)
class Incident:
    """What arrives, and what the smooth surface would send back."""

    wavelength: float  # [µm]
    theta_i_deg: float = 0.0
    reflectance: float = 1.0  # of the smooth surface, where n is not known
    n: float | None = None
    k: float = 0.0
    elsewhere: float | None = None  # another wavelength to scale to [µm]

    @property
    def cos_i(self) -> float:
        return float(np.cos(np.radians(self.theta_i_deg)))

    @property
    def mirror(self) -> float:
        """Reflectance of the smooth surface in the mirror direction."""
        return self.reflectance if self.n is None else float(fresnel(self.cos_i, self.n, self.k))

    def q(self, geom: Geometry):
        """Rayleigh and Rice's Q in every direction."""
        return self.reflectance if self.n is None else smooth_scatter.polarisation_factor(geom, self.n, self.k)


def of_height(rq: float, light: Incident, *, said: str, band, spacing=None, slope=None, assumes=()) -> dict:
    """What a surface of this rms height [µm] scatters; `said` how the height is known, `band` (low, high) [1/µm]."""
    shape, more = _of_shape(rq, spacing, slope)
    return _answer(light, said, heights=_heights(rq, light, band), shape=shape, assumes=[*assumes, *more])


def of_total(tis: float, light: Incident) -> dict:
    """The rms height that scatters this share of what is reflected."""
    sigma = smooth_scatter.height_from_scatter(tis, light.wavelength, light.cos_i)
    text = "the light was gathered from the whole hemisphere but for the mirror beam"
    band = 0.0, (1 + np.sqrt(1 - light.cos_i**2)) / light.wavelength
    return _answer(light, "TIS", heights=_heights(sigma, light, band), assumes=[text])


def of_haze(haze: float, light: Incident) -> dict:
    """The rms height of the waves that scatter this share beyond 2.5° from the mirror direction."""
    sigma = smooth_scatter.height_from_scatter(haze, light.wavelength, light.cos_i)
    text = (
        "haze is said of reflection as ASTM D1003 says it of transmission: the share of what is reflected that leaves "
        f"by more than {smooth_scatter.HAZE_DEG:g} degrees from the mirror direction; longer waves do not count"
    )
    band = smooth_scatter.haze_band(light.wavelength)
    return _answer(light, "haze", heights=_heights(sigma, light, band), assumes=[text])


def of_law(surface: Surface, law: str, light: Incident, reach: tuple[float, float], band=None) -> dict:
    """A law with its values in all laws, with its total scatter and the height that would scatter as much."""
    geom = scatter_laws.directions(light.theta_i_deg, *reach, light.wavelength)
    brdf = surface.model(geom, surface.values)
    if law == "abc":
        spectrum = KCorrelation(*(float(surface.values[f"abc.{name}"]) for name in "abc"))
        return _of_known(spectrum, light, "abc", brdf, geom, band)
    tis = float(np.ravel(hemisphere.dhr(lambda g: surface.model(g, surface.values), (light.theta_i_deg,)))[0])
    share = tis / light.mirror
    heights = {"tis": share, "scattered": tis, "sigma_um": None}
    if share < 1:
        sigma = smooth_scatter.height_from_scatter(share, light.wavelength, light.cos_i)
        heights = {**_heights(sigma, light, None), "scattered": tis}
    assumes = [
        f"the law goes on to the horizon and to the mirror direction; {light.mirror:.3g} is reflected by the smooth "
        "surface",
        f"{law} is a fit: it holds at this wavelength and near these angles; scaling to another wavelength takes its "
        "spectrum, as `abc` has it",
    ]
    return _answer(light, law, heights=heights, assumes=assumes, **_curve_and_laws(geom, brdf, light, law))


def of_spectrum(spectrum: TabulatedSpectrum, light: Incident, reach, band) -> dict:
    """What a measured spectrum scatters, in its frequencies alone."""
    low, high = (each * light.wavelength for each in spectrum.ends)
    low, high = max(low, reach[0]), min(high, reach[1])
    if not low < 0.9 * high:
        raise InputError(
            f"the spectrum's frequencies, {spectrum.ends[0]:g} to {spectrum.ends[1]:g} 1/um, scatter at "
            f"|beta - beta0| of {spectrum.ends[0] * light.wavelength:.3g} to {spectrum.ends[1] * light.wavelength:.3g} "
            f"at {1000 * light.wavelength:g} nm; wanted some between {reach[0]:.3g} and {reach[1]:.3g}"
        )
    geom = scatter_laws.directions(light.theta_i_deg, low, high, light.wavelength)
    return _of_known(spectrum, light, "psd", None, geom, band)


def of_scan(
    measurement: Measurement,
    light: Incident,
    reach: tuple[float, float],
    profile: Profile | None = None,
    total: Total | None = None,
) -> dict:
    """A scatterometer's scan in all laws, the spectrum that it shows where the surface is smooth, and whether a profile
    and a total scatter agree with it."""
    part = scatter_laws.beyond_mirror(measurement, *reach)
    if len(part.brdf) < 6:
        raise InputError(
            f"{measurement.name}: {len(part.brdf)} directions with |beta - beta0| from {reach[0]:g} to {reach[1]:g}; "
            "wanted six or more"
        )
    spectrum, frequency = _shown_spectrum(part, light)
    band = float(frequency[0]), float(frequency[-1])
    sigma = surface_height(spectrum)
    fits = scatter_laws.in_laws(part, light.mirror)
    return _answer(
        light,
        "scan",
        heights={**_heights(sigma, light, band), "summed": _summed(fits, part, light)},
        assumes=[
            "the height is that of the waves within the scan's frequencies, the same in all directions",
            "directions that see the mirror beam have to be left out [--beta]",
        ],
        curve=_curve(part.geom, part.brdf[:, 0], light),
        laws=_laws(part, fits, "scan"),
        theory=_theory(sigma, light),
        three_ways=_three_ways(spectrum, light, sigma, profile, total),
    )


def _summed(fits: tuple[scatter_laws.Told, ...], part: Measurement, light: Incident) -> dict:
    """What the scan itself scatters within its |β - β0|, added up by the law that follows it best."""
    best = min(fits, key=lambda each: each.fit.rms_ln)
    x = np.sqrt(part.geom.vxy2[:, 0])
    beta = float(x[x > 0].min()), float(x.max())
    (found,) = scattered_shares(best.fit.surface, (light.theta_i_deg,), *beta)
    return {"law": best.law, "scattered": found.measured, "beta": list(beta)}


def _three_ways(spectrum: TabulatedSpectrum, light: Incident, sigma: float, profile, total) -> dict:
    """What profile and TIS say beside the scan; nothing where there is neither."""
    if profile is None and total is None:
        return {}
    phase = float(smooth_scatter.phase(sigma, light.wavelength, light.cos_i))
    found = agreement(spectrum, phase, profile, total)
    return {
        "agree": found.agree,
        "fails": found.fails or None,
        "because": found.because,
        "compared": [
            {
                "what": each.what,
                "read": each.read,
                "expected_by_scan": each.expected,
                "ratio": each.ratio,
                "agrees": each.agrees,
                "band_per_um": list(each.band),
                "share_in_scan": each.shared,
            }
            for each in found.compared
        ],
    }


def _of_known(spectrum: Spectrum, light: Incident, said: str, brdf, geom: Geometry, band) -> dict:
    """What a known spectrum scatters; `brdf` where a law gives it, else by the theory that holds."""
    whole = isinstance(spectrum, KCorrelation)
    seen = _seen_band(spectrum, light)
    sigma = surface_height(spectrum, *seen)
    smooth = smooth_scatter.first_order_holds(sigma, light.wavelength, light.cos_i)
    q = light.q(geom)
    if brdf is None and smooth:
        brdf = smooth_scatter.rayleigh_rice(geom, spectrum.of_surface(smooth_scatter.frequency(geom)), q)
    elif brdf is None or not smooth:
        brdf = rough_scatter.scattered(geom, spectrum, q)
    heights = _heights(sigma, light, None if whole else seen)
    heights["sigma_total_um"] = spectrum.height if isinstance(spectrum, KCorrelation) else surface_height(spectrum)
    shape = _in_band(spectrum, band) if band or not whole else {}
    if isinstance(spectrum, KCorrelation):
        shape["length_um"] = spectrum.length
    assumes = ["heights are Gaussian and the same in all directions", "waves beyond 1/wavelength scatter nowhere"]
    return _answer(
        light, said, heights=heights, shape=shape, assumes=assumes, theory=_theory(sigma, light),
        **_curve_and_laws(geom, brdf, light, said),
    )  # fmt: skip


def _seen_band(spectrum: Spectrum, light: Incident) -> tuple[float, float]:
    """Spatial frequencies [1/µm] of a spectrum that scatter at all, up to the horizon behind the light."""
    highest = (1 + np.sin(np.radians(light.theta_i_deg))) / light.wavelength
    low, high = spectrum.ends
    return (min(low, 1e-4 * highest), highest) if isinstance(spectrum, KCorrelation) else (low, min(high, highest))


def _in_band(spectrum: Spectrum, band) -> dict:
    """Heights and slope of the waves between two cut-offs [1/µm]; None: of all that are known."""
    low, high = band or spectrum.ends
    return {
        "rq_in_band_um": profile_height(spectrum, low, high),
        "rdq_in_band": profile_slope(spectrum, low, high),
        "sigma_in_band_um": surface_height(spectrum, low, high),
        "band_per_um": [low, high],
    }


def _of_shape(rq: float, spacing, slope) -> tuple[dict, list[str]]:
    """Slope, correlation length and width of a lobe, from RSm [µm] or Rdq."""
    if spacing is None and slope is None:
        return {}, []
    rdq = profile_numbers.rdq_from_spacing(rq, spacing) if slope is None else slope
    tau = profile_numbers.tau_from_slope(rq, rdq)
    shape = {"rdq": rdq, "tau_um": tau, "slope": rq / tau, "alpha": profile_numbers.alpha_from_slope(rdq)}
    return shape, [f"{profile_numbers.CORRELATED}: tau, slope and alpha follow from height and {_by(slope)}"]


def _by(slope) -> str:
    return "spacing, whose 2 pi Rq/RSm is the rms slope" if slope is None else "rms slope"


def _heights(sigma: float, light: Incident, band) -> dict:
    """Rms height and total scatter, each as the other says it, and whether the first order holds."""
    phase = float(smooth_scatter.phase(sigma, light.wavelength, light.cos_i))
    heights: dict = {
        "sigma_um": sigma,
        "ra_um": profile_numbers.ra_from_rq(sigma),
        "tis": smooth_scatter.total_scatter(sigma, light.wavelength, light.cos_i),
        "phase": phase,
        "smooth": bool(phase < smooth_scatter.SMOOTH),
    }
    if band is not None:
        heights["band_per_um"] = [float(each) for each in band]
        heights["band_deg"] = [smooth_scatter.angle_of(each, light.wavelength) for each in band]
    if light.elsewhere is not None:
        heights["elsewhere"] = {
            "wavelength_nm": 1000 * light.elsewhere,
            "tis": smooth_scatter.total_scatter(sigma, light.elsewhere, light.cos_i),
            "smooth": smooth_scatter.first_order_holds(sigma, light.elsewhere, light.cos_i),
        }
    return heights


def _theory(sigma: float, light: Incident) -> str:
    smooth = smooth_scatter.first_order_holds(sigma, light.wavelength, light.cos_i)
    return "rayleigh-rice" if smooth else "correlation in the exponent"


def _curve_and_laws(geom: Geometry, brdf, light: Incident, said: str) -> dict:
    measured = scatter_laws.as_measurement(geom, np.reshape(brdf, (-1, 1)))
    return {
        "curve": _curve(geom, np.ravel(brdf), light),
        "laws": _laws(measured, scatter_laws.in_laws(measured, light.mirror), said),
    }


def _curve(geom: Geometry, brdf, light: Incident) -> dict:
    """Values against |β - β0|, with the spectrum that Rayleigh and Rice's theory sees in them."""
    geom = geom.at(np.atleast_1d(geom.wavelength)[:1])
    nu = smooth_scatter.frequency(geom)[:, 0]
    density = smooth_scatter.density_from(geom, np.reshape(brdf, (-1, 1)), light.q(geom))[:, 0]
    order = np.argsort(nu, kind="stable")
    columns = {
        "beta": nu * light.wavelength,
        "theta_r_deg": geom.signed_theta_r_deg[:, 0],
        "brdf_per_sr": np.ravel(brdf),
        "frequency_per_um": nu,
        "psd_um4": density,
    }
    return {name: values[order] for name, values in columns.items()}


def _shown_spectrum(part: Measurement, light: Incident) -> tuple[TabulatedSpectrum, np.ndarray]:
    """S2 by frequency as a scan shows it, the median of what lies within a tenth in frequency."""
    one = part.of_channels([0])
    nu = smooth_scatter.frequency(one.geom)[:, 0]
    density = smooth_scatter.density_from(one.geom, one.brdf, light.q(one.geom))[:, 0]
    known = one.usable[:, 0] & (nu > 0)
    cell = np.round(np.log(nu[known]) / 0.1).astype(int)
    cells = np.unique(cell)
    nu, density = (
        np.array([np.exp(np.median(np.log(each[known][cell == one_cell]))) for one_cell in cells])
        for each in (nu, density)
    )
    return TabulatedSpectrum(nu, density, False), nu


def _laws(measurement: Measurement, fits: tuple[scatter_laws.Told, ...], said: str) -> list[dict]:
    """The scatter in every law, the given one as it is."""
    x = np.sqrt(measurement.geom.vxy2[:, 0])
    told = []
    for each in fits:
        parameters = {
            name: {"value": each.fit.values[key], "stderr": each.fit.stderr.get(key) if said == "scan" else None}
            for name, key in each.fit.model.terms[0].keys.items()
            if name != "f0"
        }
        told.append({
            "law": each.law,
            "by": "as given" if each.law == said else "fitted",
            "parameters": parameters,
            "off_percent": 100 * float(np.expm1(each.fit.rms_ln)),
            "rms_ln": each.fit.rms_ln,
            "worst_percent": 100 * float(np.expm1(min(each.worst, 50.0))),
            "over_beta": [float(x.min()), float(x.max())],
            "flags": sorted({warning.code for warning in each.fit.warnings}) if said == "scan" else [],
        })  # fmt: skip
    return told


def _answer(light: Incident, said: str, **parts) -> dict:
    document = {
        "schema": SCHEMA,
        "from": said,
        "wavelength_nm": 1000 * light.wavelength,
        "theta_i_deg": light.theta_i_deg,
        "reflectance": light.mirror,
    }
    return plain({**document, **{name: part for name, part in parts.items() if part}})

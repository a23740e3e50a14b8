"""Every guideline: one material where it speaks, one where it is silent, and no observation that it overwrites."""

import pytest

from brdfguide.advice import guidelines
from brdfguide.advice.guidelines import interface
from brdfguide.advice.material import parse_material

# rule -> (a material on which it speaks, words it says, a material on which it is silent)
RULES = {
    "opaque": ("light_bleed_mm: 5\npixel_mm: 1", "no BRDF can show that", "finish: satin"),
    "transparent_body": ("composition: water\nappearance: clear", "needs refraction", "composition: water"),
    "height_field": ("structure: velvet", "velvet: not one surface with bumps", "structure: surface"),
    "random_roughness": ("texture: grating", "rough in a regular way", "texture: random"),
    "isotropic": ("changes_when_turned: true", "anisotropic", "finish: satin"),
    "moderate_slopes": ("steep: true", "bumps too steep", "steep: false"),
    "known_subsurface": ("appearance: pearlescent", "pearlescent light", "appearance: black"),
    "metal_or_dielectric": ("kind: semiconductor", "semiconductors are left out", "kind: metal"),
    "no_retroreflection": ("retroreflective: true", "back to where the light comes from", "retroreflective: false"),
    "in_plane_evidence": ("off_plane: true", "in one plane only", "off_plane: false"),
    "evidence_disagrees": (
        "composition: brass\nappearance: solid colour",
        "one of them is wrong",
        "composition: brass\nappearance: metal",
    ),
    "kind_from_evidence": ("composition: brass", "metal", "composition: unobtainium"),
    "kind_cannot_be_told": ("finish: satin", "cannot tell from this", "kind: metal"),
    "bright_dielectric": ("kind: dielectric\nf0: 0.3", "diamond has 0.172", "kind: dielectric\nf0: 0.04"),
    "coloured_dielectric_highlight": (
        "kind: dielectric\nf0: [0.1, 0.05, 0.04]",
        "more than a dielectric's can",
        "kind: dielectric\nf0: [0.04, 0.04, 0.04]",
    ),
    "index_observed": ("index: {n: 1.6, wavelength_nm: 589}", "n = 1.6 at 589 nm", "kind: dielectric"),
    "index_from_f0": ("kind: dielectric\nf0: 0.0625", "n = 1.667", "kind: metal\nf0: 0.9"),
    "index_from_mirror_ratio": (
        "kind: dielectric\nphotometer: {ratio: 0.04, reference: 1, of: mirror}",
        "n = 1.500",
        "kind: dielectric\nphotometer: {ratio: 0.4, reference: 1}",
    ),
    "equivalent_metal_index": ("kind: metal\nf0: 0.8", "n = 1, k = 4", "kind: dielectric\nf0: 0.04"),
    "index_of_composition": ("composition: gold", "n = 0.156, 0.424, 1.383", "composition: linoleum"),
    "liquid_index": ("composition: beer", "n = 1.34", "composition: paper"),
    "usual_dielectric_index": ("kind: dielectric", "n = 1.5, the usual value: plastics", "kind: dielectric\nf0: 0.05"),
    "usual_metal_index": ("kind: metal", "chromium", "composition: copper"),
    "constant_reflectance": (
        "composition: nickel",
        "wrong by at most 1.6% up to 75° from the normal, 11.4% up to 85°",
        "composition: water",
    ),
    "one_index_over_the_spectrum": (
        "composition: copper",
        "one index for all would lose its colour",
        "composition: silver",
    ),
    "index_at_another_wavelength": (
        "composition: water\nwavelength_nm: 3850",
        "3850 nm is wanted",
        "composition: water\nwavelength_nm: 560",
    ),
    "none_in_metal": ("kind: metal", "no subsurface term", "kind: dielectric"),
    "body_seen_on_metal": ("kind: metal\ndiffuse_reflectance: 0.3", "not used as an albedo", "kind: metal"),
    "none_below_black": ("appearance: black", "no subsurface term", "appearance: solid colour"),
    "none_in_clear": ("appearance: clear", "no subsurface term", "appearance: clear\ndiffuse_reflectance: 0.2"),
    "flakes_make_a_lobe": ("appearance: metallic flake", "a lobe for the flakes", "appearance: solid colour"),
    "lambertian_body": ("appearance: solid colour", "Lambertian body", "appearance: black\nkind: dielectric"),
    "albedo_observed": ("kind: dielectric\ndiffuse_reflectance: 0.4", "albedo 0.4", "kind: dielectric"),
    "albedo_by_comparison": (
        "kind: dielectric\ncolorchecker: {patch: neutral 5}",
        "albedo 0.191 (L* = 50.8)",
        "kind: dielectric",
    ),
    "comparisons_disagree": (
        "kind: dielectric\ndiffuse_reflectance: 0.6\ncolorchecker: {patch: black}",
        "nothing is averaged",
        "kind: dielectric\ndiffuse_reflectance: 0.2\ncolorchecker: {patch: neutral 5}",
    ),
    "albedo_guess": ("kind: dielectric", "medium grey", "kind: dielectric\ndiffuse_reflectance: 0.4"),
    "grey_by_assumption": (
        "kind: dielectric\ndiffuse_reflectance: 0.4",
        "grey, 0.4 in red, green and blue",
        "kind: dielectric\nbase_color: '#c83232'",
    ),
    "base_colour_of_metal": ("metallic: 1\nbase_color: 0.9", "F0 = 0.9", "metallic: 0\nbase_color: 0.9"),
    "base_colour_of_body": (
        "kind: dielectric\nbase_color: '#c83232'",
        "base colour #c83232",
        "kind: metal\nbase_color: '#c83232'",
    ),
    "base_colour_of_flakes": (
        "appearance: metallic flake\nbase_color: '#c83232'",
        "the flakes send back",
        "appearance: solid colour\nbase_color: '#c83232'",
    ),
    "roughness_as_typed": ("roughness: 0.4\nin: gltf", "roughness 0.4 in gltf is alpha = 0.16", "finish: satin"),
    "energy_of_body_and_surface": (
        "kind: dielectric\ndiffuse_reflectance: 0.8",
        "take `coupled` in place of",
        "kind: dielectric\ndiffuse_reflectance: 0.2",
    ),
    "roughness_of_all_readings": (
        "emergence_angle_deg: 75\nstylus: {sigma_um: 0.499}",
        "sigma 0.499 µm",
        "finish: satin",
    ),
    "reading_set_aside": (
        "stylus: {sigma_um: 2, tau_um: 20}\nemergence_angle_deg: 30",
        "the others make 85° probable",
        "stylus: {sigma_um: 0.5, tau_um: 5}\nemergence_angle_deg: 75",
    ),
    "no_law_gives_all_readings": (
        "kind: dielectric\nindex: {n: 1.5}\ngloss: {20: 5, 60: 90}",
        "no law here gives all readings",
        "kind: dielectric\ngloss: {60: 15, 85: 25}",
    ),
    "law_that_gives_the_readings": (
        "kind: dielectric\ndiffuse_reflectance: 0.8\ngloss: {60: 15, 85: 25}",
        "He-Torrance",
        "kind: dielectric\ngloss: {60: 15}",
    ),
    "numbers_of_a_workshop": (
        "stylus: {ra_um: 0.8, rsm_um: 80}",
        "rms height 1.003 µm: 1.2533 Ra, heights being Gaussian; correlation length 18 µm",
        "stylus: {sigma_um: 0.5, tau_um: 5}",
    ),
    "cut_offs": (
        "stylus: {sigma_um: 0.5, tau_um: 10, cutoff_um: 800}",
        "keep 96% of the variance of a Gaussian correlation of 10 µm",
        "stylus: {sigma_um: 0.5, tau_um: 10}",
    ),
    "slopes_of_stylus": (
        "stylus: {sigma_um: 0.5, tau_um: 5}",
        "an rms slope of 0.141 (Rdq) or 0.2 (Sdq), and shaders as alpha = 0.2",
        "stylus: {sigma_um: 0.5}",
    ),
    "gloss_of_metal": ("kind: metal\ngloss: {60: 500}", "outside ISO 2813", "kind: dielectric\ngloss: {60: 50}"),
    "formula_beside_criterion": (
        "emergence_angle_deg: 80",
        "sigma 0.857 µm, tau 8.57 µm: +10%",
        "emergence_angle_deg: 88",
    ),
    "never_a_mirror_image": ("emergence_angle_deg: never", "sigma above 2 µm", "emergence_angle_deg: 80"),
    "emergence_on_matt": (
        "emergence_angle_deg: 30\nfinish: matt",
        "yet said to be matt",
        "emergence_angle_deg: 80\nfinish: matt",
    ),
    "mirror_that_never_shows": (
        "emergence_angle_deg: never\nfinish: mirror",
        "yet it is never seen",
        "emergence_angle_deg: 0\nfinish: mirror",
    ),
    "finish_against_width": (
        "kind: dielectric\nfinish: high gloss\ngloss: {60: 3}",
        "yet alpha",
        "kind: dielectric\nfinish: high gloss\ngloss: {60: 85}",
    ),
    "width_from_finish": ("finish: satin", "alpha = 0.065", "finish: satin\nhighlight_width_deg: 10"),
    "width_from_slope": ("finish: satin", "sigma/tau = 0.0325", "finish: mirror"),
    "usual_width": ("kind: metal", "alpha = 0.15", "kind: metal\nfinish: matt"),
    "smooth_limit": ("stylus: {sigma_um: 0.01}", "0.02 µm, takes 18.8%", "stylus: {sigma_um: 0.5}"),
    "only_slope_matters": (
        "stylus: {sigma_um: 5, tau_um: 50}",
        "only its slope, sigma/tau, shows",
        "stylus: {sigma_um: 0.05, tau_um: 5}",
    ),
    "slope_beyond_theory": (
        "stylus: {sigma_um: 2, tau_um: 4}",
        "rms slope of 35°",
        "stylus: {sigma_um: 1, tau_um: 10}",
    ),
    "emergence_has_a_colour": (
        "emergence_angle_deg: 75",
        "72.1° in red light (650 nm), 77.7° in blue",
        "emergence_angle_deg: never",
    ),
    "index_of_alloy": (
        "composition: 18k gold",
        "gold stands in for '18k gold'",
        "composition: gold",
    ),
    "steep_with_highlight": (
        "composition: leather\nsteep: true\ngloss: {60: 12}",
        "Oren-Nayar's body for the steep bumps, and a lobe above it",
        "composition: leather\nsteep: true\nfinish: matt",
    ),
    "grained": ("composition: brass\ntexture: brushed", "GGX with a grain", "composition: brass"),
    "water_over_it": (
        "composition: stone\nwet: true\ndiffuse_reflectance: 0.4",
        "an albedo of 0.4 dry looks like 0.2",
        "composition: stone\nwet: false\ndiffuse_reflectance: 0.4",
    ),
    "seen_through_rough_glass": (
        "composition: glass\nappearance: clear\nfinish: low gloss",
        "transmission 1, index 1.51, roughness 0.39",
        "composition: glass\nappearance: clear\nfinish: mirror",
    ),
    "flake_paint": ("appearance: metallic flake", "flakes under a clear coat", "appearance: solid colour"),
    "coated": ("kind: dielectric\ncoat: clear", "coat's mirror image over the body", "kind: dielectric\ncoat: none"),
    "mirror_finish": ("kind: metal\nfinish: mirror", "or a constant on this metal", "kind: metal\nfinish: satin"),
    "nearly_smooth_metal": (
        "kind: metal\nfinish: mirror\nstylus: {sigma_um: 0.05}",
        "loses the sun's highlight",
        "kind: metal\nfinish: mirror",
    ),
    "high_gloss": ("kind: metal\nfinish: high gloss", "Stam's is as good on metals", "kind: metal\nfinish: matt"),
    "low_gloss_metal": ("kind: metal\nfinish: low gloss", "Ward", "kind: dielectric\nfinish: low gloss"),
    "low_gloss_dielectric": (
        "kind: dielectric\nfinish: low gloss",
        "brightens toward grazing as the index says",
        "kind: metal\nfinish: low gloss",
    ),
    "kind_open": ("finish: satin", "do not mix them", "kind: metal"),
    "nearest_sample": ("kind: metal", "rough aluminium", "finish: satin"),
    "nearest_is_far": (
        "composition: glass\nappearance: clear",
        "none of the five surfaces",
        "composition: paper\nfinish: matt",
    ),
}


def spoken(text: str) -> dict:
    return {each.rule: each for each in guidelines.consult(parse_material(text)).advice}


def test_every_rule_is_tried():
    assert {rule.__name__ for rule in guidelines.rules()} == set(RULES)


@pytest.mark.parametrize("rule", RULES)
def test_it_speaks(rule):
    text, words, _ = RULES[rule]
    said = spoken(text)
    assert rule in said, f"silent; spoke: {list(said)}"
    assert words in said[rule].says + said[rule].because
    assert said[rule].section


@pytest.mark.parametrize("rule", RULES)
def test_it_is_silent(rule):
    assert rule not in spoken(RULES[rule][2])


EVERYTHING = """
kind: dielectric
f0: 0.05
index: {n: 1.7, k: 0.01, wavelength_nm: 589}
appearance: solid colour
coat: none
diffuse_reflectance: 0.33
stylus: {sigma_um: 0.4, tau_um: 7}
finish: satin
"""


@pytest.mark.parametrize("rule", RULES)
def test_it_never_overwrites_an_observation(rule):
    speaks = RULES[rule][0]
    keys = {line.partition(":")[0] for line in speaks.splitlines()}
    rest = "\n".join(line for line in EVERYTHING.strip().splitlines() if line.partition(":")[0] not in keys)
    observed = parse_material(f"{speaks}\n{rest}")
    filled = guidelines.consult(observed).material
    for name, value in vars(observed).items():
        if value is not None and name not in ("filled_by", "given"):
            assert getattr(filled, name) == value, f"{name} was observed"
            assert name not in filled.filled_by


def test_observations_win_over_guesses():
    filled = guidelines.consult(parse_material(EVERYTHING)).material
    assert (filled.n, filled.k, filled.albedo, filled.sigma, filled.tau) == ((1.7,), (0.01,), (0.33,), 0.4, 7.0)


def test_a_measured_f0_wins_over_a_named_substance_and_both_over_the_usual_index():
    assert guidelines.consult(parse_material("composition: acrylic\nf0: 0.0625")).material.n == pytest.approx((5 / 3,))
    assert guidelines.consult(parse_material("composition: acrylic")).material.n == (1.48,)
    assert guidelines.consult(parse_material("composition: linoleum")).material.n == (1.5,)


def test_an_index_with_one_n_and_three_k_is_judged_in_every_channel():
    one = parse_material("index: {n: [1.5], k: [0.0, 3.0, 3.0]}")
    assert interface.evidence(one) == []  # clear in red alone: no dielectric
    assert interface.evidence(parse_material("index: {n: [1.5], k: [3.0, 3.0, 3.0]}"))[0][0] == "metal"


def test_black_is_no_metals_look():
    assert guidelines.consult(parse_material("appearance: black")).material.kind == "dielectric"
    said = spoken("composition: anodised aluminium\nappearance: black\nfinish: matt")
    assert said["evidence_disagrees"].conflict

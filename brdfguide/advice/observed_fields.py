"""What may stand in a description: the observations that people make of a surface, with their units and bounds."""

from ..physics.roughness_senses import SENSES
from ..yaml_schema import Field

KINDS = ("metal", "dielectric", "semiconductor")
APPEARANCES = ("solid colour", "metallic flake", "black", "metal", "clear", "pearlescent", "fluorescent")
FINISHES = ("mirror", "high gloss", "satin", "low gloss", "matt")  # smoothest first
FINISHES_MEANT = {
    **dict.fromkeys(("polished", "specular"), "mirror"),
    **dict.fromkeys(("glossy", "gloss", "shiny", "smooth"), "high gloss"),
    **dict.fromkeys(("semi gloss", "semigloss", "silk", "brushed"), "satin"),
    **dict.fromkeys(("eggshell", "semi matt", "semi matte"), "low gloss"),
    **dict.fromkeys(("matte", "flat", "dull", "rough", "diffuse"), "matt"),
}
PATCHES = ("white", "neutral 8", "neutral 6.5", "neutral 5", "neutral 3.5", "black")

DOUBTS = (
    Field("gloss_gu", "number", unit="GU", above=0, high=100, meaning="of a gloss reading; left out: 1, or 1.5 %"),
    Field("highlight_width_deg", "number", unit="°", above=0, high=90, meaning="left out: a tenth of the width"),
    Field("roughness", "number", above=0, high=1, meaning="of the alpha that it means, as a share; left out: 0.01"),
    Field("haze", "number", above=0, high=1, meaning="left out: 0.02"),
    Field("emergence_angle_deg", "number", unit="°", above=0, high=45, meaning="left out: 2"),
    Field("dimming", "number", above=0, high=1, meaning="left out: 0.03"),
    Field("sigma_um", "number", unit="µm", above=0, high=1000, meaning="left out: a tenth of it"),
    Field("tau_um", "number", unit="µm", above=0, high=10000, meaning="left out: a fifth of it"),
    Field("diffuse_reflectance", "number", above=0, high=0.5, meaning="left out: 0.01"),
    Field("f0", "number", above=0, high=0.5, meaning="left out: 3 % of it"),
)

OBSERVATIONS = (
    Field("kind", "word", choices=KINDS, meaning="what the surface is made of, if you know it"),
    Field("composition", "text", meaning="the substance by name, such as brass or acrylic"),
    Field("appearance", "word", choices=APPEARANCES, meaning="what the body looks like below the highlight"),
    Field("finish", "word", choices=FINISHES, meant=FINISHES_MEANT, meaning="how sharp its reflections look"),
    Field(
        "highlight_colour",
        "word",
        choices=("white", "tinted"),
        meaning="white: the highlight has the lamp's colour; tinted: the surface's",
    ),
    Field("coat", "word", choices=("clear", "none"), meaning="a transparent layer over what is seen"),
    Field(
        "wet", "flag", meaning="a film of water over it, and in its pores; diffuse_reflectance is that of the dry one"
    ),
    Field(
        "f0",
        "numbers",
        low=0,
        high=0.9999,
        counts=(1, 3),
        meaning="mirror reflectance of a smooth sample near normal incidence; one, or red green blue",
    ),
    Field(
        "index",
        "group",
        meaning="index of refraction n + ik",
        fields=(
            Field(
                "n",
                "numbers",
                low=0.001,
                high=20,
                counts=(1, 3),
                required=True,
                meaning="real part; one, or red green blue",
            ),
            Field("k", "numbers", low=0, high=20, counts=(1, 3), meaning="imaginary part; left out: 0"),
            Field(
                "wavelength_nm",
                "numbers",
                unit="nm",
                low=100,
                high=20000,
                counts=(1, 3),
                meaning="where it was measured",
            ),
        ),
    ),
    Field(
        "diffuse_reflectance",
        "numbers",
        low=0,
        high=1,
        counts=(1, 3),
        meaning="from a reflectometer; one, or red green blue",
    ),
    Field(
        "base_color",
        "colour",
        low=0,
        high=1,
        counts=(1, 3),
        meaning="as typed into a shader: '#rrggbb' of a colour picker, or linear red green blue",
    ),
    Field("metallic", "number", low=0, high=1, meaning="1: a metal, whose base colour is its reflectance; 0: none"),
    Field("roughness", "number", low=0, high=1e6, meaning="a shader's number for the width of its highlight"),
    Field("in", "word", choices=tuple(SENSES), meaning="whose roughness; left out: squared to alpha, as most do"),
    Field("ior", "number", low=1, high=5, meaning="index as typed into a shader; of no meaning for a metal"),
    Field(
        "colorchecker",
        "group",
        meaning="comparison by eye with the neutral patches",
        fields=(
            Field("patch", "word", choices=PATCHES, meaning="the patch that looks as light"),
            Field("between", "texts", meaning="the two patches that it lies between"),
            Field("position", "number", low=0, high=1, meaning="0 at the first of the two, 1 at the second"),
            Field(
                "data_set",
                "word",
                choices=("average", "iso17321"),
                meaning="whose reflectances of the chart; left out: average",
            ),
        ),
    ),
    Field(
        "photometer",
        "group",
        meaning="signal on the surface against a reference in the same light",
        fields=(
            Field("ratio", "number", low=0, high=10, required=True, meaning="surface over reference"),
            Field("reference", "number", low=1e-4, high=1, required=True, meaning="reflectance of the reference"),
            Field("of", "word", choices=("diffuse", "mirror"), meaning="what was compared; left out: diffuse"),
        ),
    ),
    Field(
        "gloss",
        "group",
        meaning="glossmeter readings",
        fields=tuple(
            Field(angle, "number", unit="GU", low=0, high=2000, meaning=f"gloss units at {angle}°")
            for angle in ("20", "60", "85")
        ),
    ),
    Field(
        "highlight_width_deg",
        "number",
        unit="°",
        low=0.001,
        high=180,
        meaning="full width at half height of a small lamp's highlight, near normal",
    ),
    Field(
        "flake_highlight_width_deg",
        "number",
        unit="°",
        low=0.1,
        high=120,
        meaning="full width at half height of the soft highlight of flakes under a coat, near normal",
    ),
    Field(
        "haze",
        "number",
        low=0,
        high=1,
        meaning="share of the reflected light more than 2.5° from the mirror direction, near normal",
    ),
    Field(
        "emergence_angle_deg",
        "number",
        unit="°",
        low=0,
        high=89.9,
        choices=("never",),
        meaning="where a mirror image first appears, from the normal",
    ),
    Field(
        "dimming",
        "group",
        meaning="the mirror image of a bright edge beside that in black glass",
        fields=(
            Field("angles_deg", "numbers", unit="°", low=0, high=89.5, required=True, meaning="from the normal"),
            Field(
                "ratio",
                "numbers",
                low=0,
                high=1.5,
                required=True,
                meaning="step at the edge over that in black glass, each over its Fresnel reflectance",
            ),
        ),
    ),
    Field(
        "stylus",
        "group",
        meaning="roughness from a stylus or profilometer",
        fields=(
            Field("sigma_um", "number", unit="µm", low=1e-5, high=1000, meaning="rms height"),
            Field("rq_um", "number", unit="µm", low=1e-5, high=1000, meaning="Rq, the rms height of a profile"),
            Field("sq_um", "number", unit="µm", low=1e-5, high=1000, meaning="Sq, the rms height of an area"),
            Field("ra_um", "number", unit="µm", low=1e-5, high=1000, meaning="Ra, the mean absolute height"),
            Field("sa_um", "number", unit="µm", low=1e-5, high=1000, meaning="Sa, the same of an area"),
            Field("tau_um", "number", unit="µm", low=1e-3, high=10000, meaning="correlation length"),
            Field("rsm_um", "number", unit="µm", low=1e-3, high=100000, meaning="RSm, the mean spacing of a profile"),
            Field("rdq", "number", above=0, high=10, meaning="Rdq, the rms slope of a profile"),
            Field("sdq", "number", above=0, high=14, meaning="Sdq, the rms gradient of an area"),
            Field("cutoff_um", "number", unit="µm", low=1e-3, high=100000, meaning="longest wavelength kept"),
            Field("shortest_um", "number", unit="µm", low=1e-3, high=100000, meaning="shortest wavelength kept"),
            Field("spectrum", "text", meaning="file of the profile's or the area's spectrum, two columns, f and S"),
        ),
    ),
    Field(
        "tis",
        "group",
        meaning="total scatter, as a share of the reflected light",
        fields=(
            Field("share", "number", above=0, high=0.999, required=True, meaning="4 % is 0.04"),
            Field("theta_i_deg", "number", unit="°", low=0, high=85, meaning="incidence; left out: 0"),
            Field("wavelength_nm", "number", unit="nm", low=100, high=20000, meaning="left out: 550, or the scan's"),
            Field("stop_deg", "number", unit="°", low=0.01, high=45, meaning="gathered from here on; left out: 2"),
        ),
    ),
    Field("changes_when_turned", "flag", meaning="the highlight changes as the sample turns in its plane"),
    Field("turned_90_brighter", "flag", meaning="a spot beside the lamp's image is brighter once turned by 90°"),
    Field(
        "grain_deg",
        "number",
        unit="°",
        low=0,
        high=180,
        meaning="direction of the grooves, counter-clockwise from the texture's first axis",
    ),
    Field(
        "highlight_aspect",
        "number",
        low=1,
        high=100,
        meaning="length over width of a small lamp's streak, near normal; highlight_width_deg is then the short one",
    ),
    Field(
        "streak",
        "word",
        choices=("across the grain", "along the grain", "none"),
        meaning="where the highlight is drawn out to",
    ),
    Field(
        "light_bleed_mm",
        "number",
        unit="mm",
        low=0,
        high=1000,
        meaning="how far light spreads sideways below the surface",
    ),
    Field("pixel_mm", "number", unit="mm", low=1e-6, high=1e6, meaning="what one pixel covers on the surface"),
    Field("retroreflective", "flag", meaning="brightest when lit from behind the viewer's head"),
    Field(
        "structure",
        "word",
        choices=("surface", "hair", "fur", "velvet", "cloth", "foam", "foliage", "granular"),
        meaning="whether there is one well-defined surface",
    ),
    Field(
        "texture",
        "word",
        choices=("random", "brushed", "machined", "grating", "woven", "printed"),
        meaning="order in the roughness",
    ),
    Field("steep", "flag", meaning="slopes like sandpaper, unglazed ceramic or flat house paint"),
    Field("off_plane", "flag", meaning="it will be seen out of the plane of incidence"),
    Field("wavelength_nm", "number", unit="nm", low=300, high=20000, meaning="the light that matters; left out: 550"),
    Field(
        "viewing",
        "group",
        meaning="the eye that looked for the mirror image",
        fields=(
            Field("pupil_mm", "number", unit="mm", low=0.1, high=100, meaning="left out: 3"),
            Field("distance_mm", "number", unit="mm", low=1, high=1e6, meaning="left out: 600"),
        ),
    ),
)
FIELDS = (
    Field("name", "text", meaning="what to call it"),
    Field("about", "text", meaning="a sentence for people; never read for meaning"),
    *OBSERVATIONS,
    Field("doubts", "group", meaning="one standard deviation of what was observed", fields=DOUBTS),
    Field("measurements", "texts", meaning="files of measured data, relative to this one"),
    Field(
        "sources",
        "group",
        meaning="where each observation comes from",
        fields=tuple(Field(f.name, "text", meaning=f.meaning) for f in OBSERVATIONS),
    ),
)

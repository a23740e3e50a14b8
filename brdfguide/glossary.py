"""The words that answers use, each in a sentence for who has not read the report, and what its sections are about.

`docs/glossary.md` is written from this list, and a report page links the sections that its rules come from to it.
"""

WORDS = {
    "How far off": {
        "off": "how far a model typically is from the values: 7 % off means a factor of 1.07 up or down",
        "rms ln": "the same as the root mean square of ln(model/value), in which every ratio counts alike",
        "seen L*": (
            "how different two spheres look: the rms difference in lightness under lamps all around; below 3.5 they "
            "look alike side by side"
        ),
        "held-out": "the error at incidence angles that the fit did not see: small means that the model foretells",
        "behind best": "how much more a model is off than the best one, with its standard error",
        "noise": "what single values scatter by; no model should come nearer than that",
        "floor": "what some smooth law would leave at best: the difference to it could be removed by a better model",
        "free": "how many numbers were fitted",
        "ns/sample, fit s": "what the model costs here: nanoseconds a direction, seconds to fit",
        "doubts": "flags: what the numbers cannot be relied on for; `flags.md` explains each",
        "rank 1=": "models that these data cannot tell apart",
    },
    "The surface": {
        "BRDF": "how much light goes from one direction into another, per steradian [1/sr]",
        "body": "light that enters, is scattered below the surface and comes back with the body's colour",
        "lobe": "light that the surface itself reflects about the mirror direction: the highlight",
        "mirror": "an image as sharp as in a mirror, beside or in place of the lobe",
        "albedo": "the share of light that a body sends back in all directions together",
        "F0": "what a smooth piece reflects of light straight from above; 0.04 for plastic, 0.5 to 0.97 for metals",
        "n, k": "index of refraction and absorption index: they give F0 and how reflection rises toward grazing",
        "sigma": "rms height of the roughness [µm]",
        "tau": "correlation length of the roughness: how far apart hills lie [µm]",
        "slope": "sigma over tau; √2 of it is the rms slope along a line, twice it is alpha",
        "alpha": "width of a lobe: its facets' slopes spread by about so much; shaders' roughness squared",
        "coat": "a clear layer over it, with a mirror of its own",
        "flakes": "small mirrors tilted in a paint, under its coat",
        "grain": "a direction in the surface, as of brushed steel: the highlight changes as the sample turns",
    },
    "What is seen and read": {
        "theta_i, theta_r": "angles of the light and of the view from the normal; 0 is straight down",
        "grazing": "light or view almost along the surface, near 90°",
        "reciprocal": "the same with light and detector exchanged, as it is for every real surface",
        "hemispherical reflectance": "the share of the light from one direction that goes out again in all together",
        "JND": "a just noticeable difference: what is barely seen where one picture takes the other's place",
        "growth 10 to 75 deg": "how much brighter the mirror direction is at 75° than at 10°: tells laws apart",
        "75 over 10 deg": "the same of a recommended model: x6 means six times as bright; `image` is its mirror image",
        "domain": "what the report's rules are made for: opaque surfaces with random bumps, the same from all sides",
        "emergence": "the angle from which on a mirror image appears on a rough surface",
        "criterion": "He and Torrance's: an image emerges where mirror and highlight are equally bright to the eye",
        "Eq. 3": "the report's short formula for it, sigma = C/(tau^0.7 + 6), with C from its Table 2",
        "gloss": "a glossmeter's units at 20, 60 or 85°: the mirror beam beside that of black glass, which has 100",
        "haze": "the share of the reflected light just outside the mirror direction",
        "for the eye": "the change of a number from which on the surface looks different",
    },
    "What an export says": {
        "exact": "the program evaluates the very same law",
        "refit": "the program's own law was fitted, and the error is stated",
        "lossy": "the program lacks something that this surface has; what, is said",
    },
}
REPORT = 'S. H. Westin, H. Li, K. E. Torrance, "A Field Guide to BRDF Models", Cornell University PCG-04-1, 2004'
SECTIONS = {
    "3.1": "what a BRDF can describe at all: opaque, well-defined surfaces",
    "3.2.1": "metals and dielectrics, and how to tell them apart",
    "3.2.2": "smooth and rough: what roughness does to a reflection",
    "3.2.3": "light from below the surface",
    "4": "the five measured samples",
    "4.1": "the rough aluminium",
    "4.2": "the rough plastic",
    "4.3": "white paper",
    "4.4": "the nearly smooth steel",
    "4.5": "the metallic paint",
    "5": "guidelines: use whatever is known, measured before guessed",
    "5.1": "the index of refraction: measured, named or usual",
    "5.2": "roughness and albedo by eye and instrument, and which model to take",
    "6.1": "what the guide leaves open",
    "Eq. 1": "how much of a mirror image a rough surface keeps",
    "Eq. 2": "the index from the reflectance at normal incidence",
    "Table 1": "indices of common metals",
    "Table 2": "roughness from the angle of emergence",
    "Figure 14": "roughness from the angle of emergence, by the full criterion",
}


def anchor(section: str) -> str:
    """What a link to a section ends with."""
    return "section-" + section.lower().replace(". ", "-").replace(".", "-").replace(" ", "-")


def glossary_page() -> str:
    """`docs/glossary.md`."""
    lines = [
        "# Words",
        "",
        "The words that answers use. This page is written by `python -m brdfguide.glossary`; flags have a page of",
        "their own, [`flags.md`](flags.md).",
    ]
    for title, words in WORDS.items():
        lines += ["", f"## {title}", "", *(f"- **{word}**: {meaning}." for word, meaning in words.items())]
    lines += ["", "## Sections of the report", "", f"In square brackets behind a rule: {REPORT}.", ""]
    lines += [f'- <a id="{anchor(section)}"></a>**{section}**: {about}.' for section, about in SECTIONS.items()]
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(glossary_page(), end="")

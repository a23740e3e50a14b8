"""Every flag that an answer can carry: its code, what it means in plain words, how grave it is, what overrides it.

The one list: a Finding whose code, severity or option is not in it cannot be made, and `docs/flags.md` is written from
it. A code with a subject is printed as `code:subject`, such as `at-bound:ggx.alpha`.
"""

from enum import Enum

from .records import dataclass

SEVERITIES = {
    "note": "worth knowing",
    "warning": "a doubt: read the sentence before you rely on the number",
    "outside": "no model should be trusted here: status 1, unless overridden",
    "error": "the values contradict themselves: status 2, unless overridden",
}


class Effect(Enum):
    """What the program does for a flag besides showing it."""

    NONE = "nothing"
    ASSUMES_WAVELENGTH = "--wavelength-nm may say another wavelength"
    NAMES_COLOURS = "--wavelength-nm is refused"
    FORBIDS = "no model that has it is recommended, unless every one has such a flag"
    UNREFINED = "the model is not fitted again to learn its held-out error"
    LOOSENS = "the value of its parameter says nothing by itself; a flag that bounds it takes its place"
    KEEPS_VALUES = "the user has said what the values are: nothing is taken out of them"
    OF_DIM_VALUES = "left out where a dark level explains it"
    STATES_FLOOR = "its numbers say what the instrument cannot tell from nothing"
    STATES_TOTAL = "its numbers are compared with the integral of the values"
    AT_BOUND = "the same, and the JSON says which end"
    BOUNDS = "its numbers bound the parameter, and stand beside the value"
    DENIES = "as a warning it ends `check` with status 1"
    OF_MISFIT = "a misfit of the model, unless the instrument explains it"
    EXTRAPOLATED = "a fit leaves out what lies beyond 80 degrees, unless --theta-max says another angle"
    OF_REPEATS = "no answer is trusted where noise does not explain it, unless --columns ignores what tells them apart"
    PHOTOGRAPHED = "the page shows the pictures, and --next names a phase"
    OF_LOOKS = "it is found anew whenever more is known of the ranking"


@dataclass(frozen=True)
class Flag:
    """What a code means, and what a Finding with it may say."""

    meaning: str  # a sentence in plain words
    severities: tuple[str, ...] = ("note",)
    option: str = ""  # what overrides it, or makes it go away
    subject: str = ""  # what stands behind the colon; "" where nothing does
    effect: Effect = Effect.NONE


NOTE = ("note",)
WARNING = ("warning",)
EITHER = ("note", "warning")

READING = {
    "angle-from-mirror": Flag("The detector's angle is counted from the mirror direction.", option="--columns"),
    "angle-function": Flag("A column holds the cosine or sine of an angle."),
    "angle-unit": Flag("Degrees or radians, and why this was taken.", option="--unit"),
    "azimuth-clockwise": Flag("Azimuths count clockwise, as a name says: read with the opposite sign."),
    "azimuth-from-phase": Flag("Azimuths follow from the angle between light and detector."),
    "azimuth-of-detector": Flag("Zeniths with a sign: the azimuth is the detector's plane.", option="--columns"),
    "azimuth-of-sample": Flag("Zeniths with a sign: the azimuth is the sample's.", option="--rotation-sense"),
    "azimuth-turned": Flag("The phase angle says that azimuths count from the mirror direction.", option="--columns"),
    "below-horizon": Flag("Directions at or below the horizon were dropped."),
    "blocked-retro-zone": Flag("Zeros around the source: the lamp stood in the detector's way."),
    "blocks-skipped": Flag("Blocks of transmission or of the back side were skipped."),
    "absent-chunks": Flag("Chunks of a zarr array that are not there were read as its fill value.", WARNING),
    "bytes-behind": Flag("Bytes behind the last member of a compressed file were left out.", WARNING),
    "calibrated-mirror-side": Flag("The header's calibration says on which side the mirror direction lies."),
    "column-unnamed": Flag("The rows hold one column more than the header names.", option="--columns"),
    "columns-ignored": Flag("Columns whose meaning is not known were left out.", option="--columns"),
    "columns-read": Flag("What was made of each column, and the unit of the angles."),
    "decibels": Flag("Decibels were taken as powers of ten of a tenth."),
    "direction-cosines": Flag("Angles follow from direction cosines."),
    "elevation": Flag("A column holds an elevation: the zenith angle is 90 degrees minus it."),
    "extrapolated-grazing": Flag(
        "Such tables were extrapolated near grazing when they were made.",
        option="--theta-max 80",
        effect=Effect.EXTRAPOLATED,
    ),
    "floor": Flag("The lowest value is repeated: the instrument's floor, taken as none.", effect=Effect.STATES_FLOOR),
    "half-difference-angles": Flag("Directions follow from the angles of half vector and difference."),
    "in-plane": Flag("Only directions in the plane of incidence were kept, as asked.", option="--in-plane"),
    "in-plane-assumed": Flag("No azimuth: taken as a scan in the plane of incidence.", option="--columns"),
    "incidence-columns": Flag("The columns are angles of incidence.", option="--columns"),
    "infinite-values": Flag("Infinite values were taken as missing.", WARNING),
    "invalid-cells": Flag("Cells that the file marks as invalid were dropped."),
    "lines-skipped": Flag("Lines that hold no row of the table were skipped."),
    "logarithms": Flag("Logarithms were taken as powers of ten, or of e."),
    "mirror-azimuth": Flag("From where azimuths about the mirror direction count, and why this was taken."),
    "kind-contradicted": Flag("--kind says one kind and the data another.", WARNING, "--kind"),
    "marks-missing": Flag("Values that no BRDF can have, such as -999, were taken as marks for missing ones."),
    "mirror-side": Flag("On which side the mirror direction lies, and from what.", EITHER, "--mirror-side"),
    "mirror-side-by-option": Flag("The mirror side is the one that was asked for."),
    "mirror-side-turned": Flag("The directions were turned by 180°: the values say so.", EITHER, "--mirror-side"),
    "near-grazing": Flag("The values nearest to grazing are uncertain in such files.", option="--theta-max 80"),
    "negative-theta-i": Flag("A negative incidence: light from the opposite azimuth.", option="--mirror-side"),
    "nominal-wavelengths": Flag("Channels are colours: one wavelength stands for each.", effect=Effect.NAMES_COLOURS),
    "part-of-a-turn": Flag("The light stood in part of the azimuths; the rest follows by half a turn."),
    "percent": Flag("Values given in percent were divided by 100."),
    "phase-agrees": Flag("The phase angle agrees with the other angles."),
    "phase-contradicts": Flag("The phase angle differs from that of the other angles.", WARNING),
    "phi-is-zenith": Flag("Theta and phi are exchanged: read as named, no direction is possible.", option="--columns"),
    "power-of-ten": Flag("Values stand in units of a power of ten."),
    "quantity-assumed": Flag("What the values are is hinted at or not said: taken as the BRDF.", option="--quantity"),
    "patches": Flag("Values are means over patches of the hemisphere, taken at their middles."),
    "quantity-by-option": Flag("The quantity is the one that was asked for.", effect=Effect.KEEPS_VALUES),
    "quantity-stated": Flag("The file states its quantity, which was converted to BRDF.", EITHER, "--quantity"),
    "quantity-unclear": Flag("Title or comment name another quantity than the column.", WARNING, "--quantity"),
    "radians-inferred": Flag("No angle is large: taken as radians.", option="--unit deg"),
    "reflected-columns": Flag("The columns are angles of the detector.", option="--columns"),
    "repeated-rows": Flag("Rows that repeat a direction and wavelength were kept as measurements of their own."),
    "repeats-differ": Flag(
        "Rows of one direction have different values: something tells them apart.", WARNING, effect=Effect.OF_REPEATS
    ),
    "receiver-solid-angle": Flag("The detector's solid angle, as the file states it.", option="--aperture-deg"),
    "relative-scale": Flag("The level of the values is relative: they are not 1/sr.", WARNING, "--scale"),
    "rows-beyond-count": Flag("More rows than the header counts were taken.", WARNING),
    "rows-copied": Flag("Rows that repeat others digit for digit in every cell count once.", WARNING),
    "rows-selected": Flag("Only the rows that were asked for were kept.", option="--select"),
    "rows-without-angles": Flag("Rows that lack an angle were dropped."),
    "sample-rotation": Flag("The sample was turned: the light's azimuth follows.", option="--rotation-sense"),
    "scans-joined": Flag("Scans under several turns of one sample were joined, as asked.", option="--turned"),
    "axis-assumed": Flag("Two turns do not tell an axis: one is taken across the grain.", option="--fix"),
    "scale-by-option": Flag("The values were multiplied by the factor that was asked for."),
    "scale-stated": Flag("The values were multiplied by the factor that a comment states.", option="--scale"),
    "scaled-to-total": Flag("Values that count only in relation were scaled to the total that the file states."),
    "skylight": Flag("Reflectance factors under the whole sky, not under the sun alone.", WARNING, "--quantity"),
    "specular-azimuth": Flag("Blocks name their mirror direction: the light comes from the opposite azimuth."),
    "stderr-read": Flag("How a column of doubts was made standard errors.", option="--columns"),
    "subset": Flag("A stratified part of a large file was taken, the same one each time."),
    "table": Flag("A dense table: its cells are the samples."),
    "theta-i-constant": Flag("One angle of incidence for the whole file."),
    "theta-max": Flag("Directions beyond the angle that was asked for were left out.", option="--theta-max"),
    "tis": Flag("Total integrated scatter, as the file states it.", effect=Effect.STATES_TOTAL),
    "vectors-reversed": Flag("Vectors that point into the surface were reversed."),
    "wavelength": Flag("Only the channels that were asked for were kept.", option="--wavelength"),
    "wavelength-assumed": Flag(
        "The file does not say its wavelength: taken as 550 nm.",
        option="--wavelength-nm",
        effect=Effect.ASSUMES_WAVELENGTH,
    ),
    "wavelength-by-option": Flag("The wavelength is the one that was asked for."),
    "wavelength-overruled": Flag("A comment names another wavelength than was asked for.", WARNING, "--wavelength-nm"),
    "wavelength-from-comment": Flag("The wavelength stands in a comment.", option="--wavelength-nm"),
    "wavelength-unit": Flag("Wavelengths without a unit: taken by their size.", option="a unit in the column's name"),
    "wavenumbers": Flag("Wavenumbers, frequencies or photon energies stand in place of wavelengths."),
    "zeros-missing": Flag("Exact zeros were taken as missing, not as black."),
}

PHOTOGRAPHED = {
    "bad-pixels": Flag("Pixels that hold no light were left out.", WARNING),
    "broad-band": Flag("A camera's channels are broad: each is taken at one wavelength.", effect=Effect.PHOTOGRAPHED),
    "camera-far": Flag("The camera is taken as infinitely far away, as the description says.", WARNING),
    "clipped": Flag("Pixels at the file's white were left out.", EITHER),
    "curvature": Flag("The highlight is too narrow for the ball's pixels: alpha is an upper bound.", WARNING),
    "exposure": Flag("Sample and reference were exposed differently, or one of them does not say.", EITHER),
    "gamma": Flag("The matt reference is not shaded like light: codes of a display.", ("error",), "--anyway"),
    "hot-pixels": Flag("Lone bright pixels were left out."),
    "interreflection": Flag("Light from below: the table shines on the ball.", WARNING),
    "lamp-disagrees": Flag("The lamp is not where it is said to be: so the reference's shading says.", WARNING),
    "lamp-found": Flag("Where the lamp is, from the reference's shading."),
    "lamp-point": Flag("Nobody says how large the lamp is: it is taken as a point."),
    "lamp-size": Flag("The lamp is wide for so narrow a highlight: alpha is too large.", WARNING, "--aperture-deg"),
    "level-unknown": Flag("No reference: shapes hold, levels do not.", WARNING),
    "one-difference-angle": Flag("One phase is one difference angle: it cannot tell laws apart.", WARNING),
    "outline-differs": Flag("The ball is not where its outline is said to be.", WARNING),
    "outline-found": Flag("Where the ball stands in the pictures."),
    "second-lamp": Flag("The reference is lit unevenly, or by more than one lamp.", WARNING),
    "sparkle": Flag("Neighbouring pixels scatter: flakes, texture or noise.", WARNING),
    "stray": Flag("The reference's dark side is not dark.", WARNING),
    "unseen-faults": Flag("Faults that are too small to be noticed, and that are counted in every doubt."),
    "turned-upright": Flag("The picture was turned as its EXIF says."),
}

EXAMINED = {
    "anisotropic": Flag("The values change as the sample is turned.", WARNING, "--average-phi-i"),
    "grain": Flag("How much wider the lobe is across the grain than along it, and where the grain lies."),
    "grain-one-way": Flag("Half a turn of the sample changes the values: facets lean to one side.", WARNING),
    "grain-period": Flag("The values come back after a quarter of a turn: woven or crossed, not one grain.", WARNING),
    "height-against-width": Flag(
        "The peak is higher than any surface of its width could be: brushed, or the scale is wrong.", WARNING, "--scale"
    ),
    "averaged-over-rotation": Flag("The mean over a sample's rotations was taken.", WARNING, "--average-phi-i"),
    "cosine-i-weighted": Flag(
        "Values are BRDF times cos θi: they were not divided by the irradiance. Undone.", EITHER, "--quantity brdf"
    ),
    "cosine-weighted": Flag("Values are BRDF times cos θr. Undone.", EITHER, "--quantity brdf"),
    "arm-zero": Flag("Every peak lies off by one angle: the detector's arm. Undone.", EITHER, "--anyway"),
    "copied-scans": Flag("Scans repeat another digit for digit: left out.", WARNING),
    "beyond-80-left-out": Flag("Directions that were extrapolated. Left out.", option="--theta-max 90"),
    "coverage": Flag("Which directions were measured."),
    "equal-directions-differ": Flag("Equal directions differ by far more than noise.", ("outside",), "--anyway"),
    "dark-edge": Flag(
        "The outermost samples of scans are cut off by the horizon or the holder. Left out.", WARNING, "--anyway"
    ),
    "below-dark-level": Flag("Values too dim for this instrument: upper limits, over which no error is told."),
    "dark-level": Flag(
        "A signal without light was left in, or too much taken off: dim values do not exchange. Undone.",
        EITHER,
        "--quantity brdf",
    ),
    "dim-values-off": Flag(
        "Reciprocal where bright, but not where dim: a wrong dark level or background light.",
        WARNING,
        "--metric cube-root",
        effect=Effect.OF_DIM_VALUES,
    ),
    "energy-untold": Flag("The coverage does not tell how much light comes back.", option="--quantity"),
    "isotropic": Flag("Turning the sample hardly changes the values."),
    "mirror-side-contradicted": Flag(
        "The values put the mirror direction on the side of the light. Turned where certain.", EITHER, "--mirror-side"
    ),
    "missing-values": Flag("Many single values are missing or not positive.", WARNING),
    "missing-zone": Flag("Directions without a value in any channel."),
    "negative-values": Flag("Values below zero: noise about zero or a colour outside sRGB, upper limits.", EITHER),
    "no-data-beyond-theta-i": Flag("No incidence beyond this angle: models differ there.", WARNING),
    "no-data-beyond-theta-r": Flag("No reflection beyond this angle: models differ there.", WARNING),
    "no-usable-values": Flag("No value is positive: there is nothing to fit.", ("error",)),
    "noise": Flag("How much single values scatter about their neighbours.", EITHER),
    "not-reciprocal": Flag(
        "Exchanging light and detector changes the values.", WARNING, "--quantity", effect=Effect.OF_DIM_VALUES
    ),
    "one-incidence": Flag("One angle of incidence: how the surface changes with it is not tested.", WARNING),
    "one-sided": Flag("Only the mirror side of the plane of incidence was measured."),
    "reciprocal": Flag("Exchanging light and detector leaves the values as they are."),
    "reflectance": Flag("How much of the light comes back in all."),
    "reflectance-factor": Flag("Values are π times the BRDF. Undone.", EITHER, "--quantity brdf"),
    "retro-peak": Flag("A lobe toward the source, which only a retro-reflecting lobe could follow.", WARNING),
    "retro-reflector": Flag("A strong lobe toward the source: no model of the guide has it.", ("outside",), "--anyway"),
    "rotation-untold": Flag("One rotation of the sample: whether it is isotropic cannot be told."),
    "saturated": Flag("The highest value is repeated: the detector's limit. Peaks are higher.", WARNING),
    "spikes": Flag(
        "Samples at the mirror direction stand alone: an ideal mirror seen through the instrument. Left out.",
        WARNING,
        "--anyway",
    ),
    "tis-agrees": Flag("The total integrated scatter that the file states is that of its values."),
    "tis-differs": Flag("The total integrated scatter that the file states is not that of its values.", WARNING),
    "too-bright": Flag("More light comes back than came in.", ("error",), "--quantity reflectance-factor, or --anyway"),
}

FITTED = {
    "above-noise": Flag("Even the best model misses by more than the noise.", WARNING),
    "at-bound": Flag(
        "A parameter ended at the end of its range; its true value may lie beyond.",
        EITHER,
        subject="parameter",
        effect=Effect.AT_BOUND,
    ),
    "axis-undetermined": Flag("The lobe is round within its error: no axis.", WARNING, "", "parameter", Effect.LOOSENS),
    "coarse": Flag("Far behind the best: searched for, not refined.", effect=Effect.UNREFINED),
    "at-the-floor": Flag("No law would do much better: the data are the limit."),
    "coarse-scan": Flag(
        "The lobe is narrower than two steps of the scan: L* is rough, the order of models is not.",
        effect=Effect.OF_LOOKS,
    ),
    "curved": Flag("Two standard errors mislead; the interval is given.", subject="parameter"),
    "discrepancy": Flag(
        "The model is systematically off, by so many percent: neighbouring residuals are alike.",
        WARNING,
        effect=Effect.OF_MISFIT,
    ),
    "f0-above-dielectrics": Flag("A dielectric was fitted that reflects more than any.", WARNING, "--kind metal"),
    "f0-below-metals": Flag("A metal was fitted that reflects less than any.", WARNING, "--kind dielectric"),
    "few-values": Flag("Models with as many parameters as there are values were left out.", WARNING),
    "floor-of-reciprocity": Flag("What is left is a difference between a value and that of exchanged directions."),
    "imitates": Flag("Its lobes imitate the data at the fitted angles only.", WARNING, effect=Effect.FORBIDS),
    "instrument": Flag("Gains of scans and the zero of the detector's arm explain the misfit.", WARNING),
    "metric-decides": Flag("Another scale of error has another winner.", WARNING, "--metric"),
    "no-index": Flag("A fitted n that no dielectric has, or one by colour.", WARNING, "--fix, --kind", "parameter"),
    "no-model-looks-right": Flag(
        "Even the best model is seen to differ, by more than 8 L* on a sphere.", WARNING, effect=Effect.OF_LOOKS
    ),
    "not-converged": Flag(
        "The search was still moving when it was stopped: do not use the values.", WARNING, effect=Effect.FORBIDS
    ),
    "not-of-this-form": Flag("No lobe, masking and Fresnel factor over a body comes near what the data allow."),
    "not-to-be-trusted": Flag(
        "Even the best model is far off, or every one ended at a bound.", ("warning", "outside"), "--anyway"
    ),
    "ridge": Flag("Only a combination of these parameters is determined.", WARNING, "--fix"),
    "rough-regime": Flag(
        "Only σ/τ is determined: σ is a lower bound, any larger one fits as well.",
        WARNING,
        subject="parameter",
        effect=Effect.BOUNDS,
    ),
    "starts-disagree": Flag("Two starts ended equally well in different places.", WARNING),
    "undetermined": Flag("Data do not determine this parameter.", WARNING, subject="parameter", effect=Effect.LOOSENS),
    "unused": Flag("A term's amplitude is 0: leave the term out.", subject="parameter"),
    "weighed-by-scan": Flag("Scans differ in length: every incidence counts alike.", option="--weights none"),
    "weighed-by-stderr": Flag("Each value is weighed by its standard error.", option="--weights none"),
    "weighed-robustly": Flag("Values far off the model count little, as --robust asks."),
}

SCENE = {
    "over-budget": Flag("Nothing within the tolerance fits the time budget.", WARNING),
    "pruned-refused": Flag("Good on the directions drawn, but not when checked."),
    "refit-at-bound": Flag("A parameter, refitted over the scene, reached its bound.", WARNING),
    "scene-beyond-data": Flag("The scene shows directions that were not measured.", WARNING),
    "scene-may-stray": Flag("A moved camera or light shows a difference.", WARNING, "camera_moves: true in the scene"),
    "scene-not-converged": Flag("More directions change the deciding numbers."),
}

DESCRIBED = {
    "albedo-disagrees": Flag("Albedo by eye and by fit differ."),
    "choice-disagrees": Flag("The guidelines would choose another model than the fit."),
    "height-disagrees": Flag("The rms height of a stylus and of a fit differ by more than a factor of two.", WARNING),
    "kind-disagrees": Flag("Described as a metal and measured as a dielectric, or the other way.", WARNING),
    "mirror-image-disagrees": Flag("No mirror image was seen, yet the fitted roughness would show one."),
    "width-disagrees": Flag("Width of the highlight by eye and by fit differ."),
}

AUDITED = {
    "energy-kept": Flag("The surface sends back no more light than it receives."),
    "gains-energy": Flag("The surface sends back more light than it receives.", WARNING),
    "mirror-part": Flag("It needs a perfect mirror of its own beside the finite lobe."),
    "second-opinion": Flag(
        "How far SciPy's least squares goes on from where a fit ended.", EITHER, effect=Effect.DENIES
    ),
    "narrow-lobe": Flag("So narrow a lobe that uniform sampling will miss it."),
    "steep-rise": Flag("Grows steeply toward grazing: bright rims and fireflies."),
}

SMALL_SUMS = {
    "alternative": Flag("Another value is in use for this substance."),
    "authors-differ": Flag("Several authors measured it and differ."),
    "brightness-not-linear": Flag("The eye does not judge lightness linearly."),
    "criterion_refused": Flag("The He-Torrance criterion does not answer, and why."),
    "gloss": Flag("Two pictures with the lamp moved differ: gloss.", WARNING),
    "highlight-tilted": Flag("A highlight's profile is tilted, so that its width gives alpha to some 7 %."),
    "includes-gloss": Flag("One picture: the gloss that fell into it is in the number."),
    "eq2-on-a-metal": Flag("Eq. 2 speaks of dielectrics; this is a metal."),
    "eq3_below_15": Flag("Table 2 begins at 15°: C is continued below it."),
    "eq3_low_at_85": Flag("Table 2 is 20 to 25 % low at 85°: prefer the criterion."),
    "eq3_refused": Flag("Eq. 3 does not answer, and why."),
    "several_sigmas": Flag("One τ has several σ at so grazing an angle."),
    "shallow": Flag("σ/τ below 0.01: most surfaces lie in 0.01 to 1."),
    "steep": Flag("σ/τ above 0.3: the theory loses light."),
}

SECTIONS = {
    "Reading a file (`data.findings`)": READING,
    "Photographs (`data.findings`)": PHOTOGRAPHED,
    "Examining it (`inspect`, and what `fit` notes from it)": EXAMINED,
    "Fitting (`ranking[].flags`, `warnings`)": FITTED,
    "Pruning for a scene (`scene.findings`)": SCENE,
    "A description against its measurement (`disagreements`)": DESCRIBED,
    "Audit of a surface (`check --fit`)": AUDITED,
    "Small sums (`roughness`, `index`, `albedo`)": SMALL_SUMS,
}
FLAGS = {code: flag for section in SECTIONS.values() for code, flag in section.items()}


def require_listed(code: str, severity: str, option: str, subject: str) -> None:
    """Raises ValueError for a code that is not listed, and for what its entry does not say."""
    flag = FLAGS.get(code)
    if flag is None:
        raise ValueError(f"no flag called {code}: list it in flags.py")
    if severity not in flag.severities:
        raise ValueError(f"{code} is listed as {' or '.join(flag.severities)}, found {severity}")
    if not set(_switches(option)) <= set(_switches(flag.option)):
        raise ValueError(f"{code} is listed with the option '{flag.option}', found '{option}'")
    if bool(subject) != bool(flag.subject):
        raise ValueError(f"{code} is listed {'with' if flag.subject else 'without'} a subject, found '{subject}'")


def _switches(option: str) -> list[str]:
    """The options that a sentence names; the sentence itself where it names none."""
    return [word.rstrip(",") for word in option.split() if word.startswith("--")] or [option] * bool(option)


def flags_page() -> str:
    """`docs/flags.md`."""
    lines = [
        "# Flags",
        "",
        "What the doubts and notes in an answer mean. The `code` stays the same from version to version; the sentence",
        "beside it gives this surface's numbers. This page is written by `python -m brdfguide.flags`.",
        "",
        *(f"- **{severity}**: {meaning}." for severity, meaning in SEVERITIES.items()),
        "",
        "A code with a subject is printed as `code:subject`, such as `at-bound:ggx.alpha`; JSON also gives the two as",
        "`flag` and `subject`. Contradictions in a description (`conflicts`) carry the name of the rule that found",
        "them.",
    ]
    for title, flags in SECTIONS.items():
        lines += ["", f"## {title}", "", "| code | how grave | what it means | overridden by |", "|---|---|---|---|"]
        for code, flag in sorted(flags.items()):
            name = f"{code}:{flag.subject.upper()}" if flag.subject else code
            override = f"`{flag.option}`" if flag.option else ""
            lines.append(f"| `{name}` | {', '.join(flag.severities)} | {flag.meaning} | {override} |")
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    print(flags_page(), end="")

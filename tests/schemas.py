"""The JSON Schema of every document, written from what the commands print: `python -m tests.schemas`.

A key is required where every document of its kind has it. Objects whose keys are data (parameters, angles, names) are
maps: their keys are free and their values alike. More keys may be added in later versions, none renamed.
"""

import io
import json
import shlex
import sys
from contextlib import chdir, redirect_stderr, redirect_stdout
from pathlib import Path
from tempfile import TemporaryDirectory

from brdfguide.cli import main

from .conftest import ROOT

FOLDER = ROOT / "brdfguide" / "schemas"
DRAFT = "https://json-schema.org/draft/2020-12/schema"
PLASTIC, PAPER, ALUMINIUM = (f"examples/{name}.csv" for name in ("rough_plastic", "white_paper", "rough_aluminium"))
# Every document of the program, each in the forms that it has; {out} is a folder to write in, {fit} a fit's JSON.
COMMANDS = (
    f"fit {PLASTIC} --json",
    f"fit {PAPER} -m lambertian+ggx,lambertian+lafortune:2 --json --no-timing --next --numbers --scene default",
    f"fit {PAPER} -m lambertian --json --no-timing --as gltf",
    f"fit {PAPER} -m oren-nayar+ggx --json --no-timing --theta-max 60",
    f"fit {ALUMINIUM} -m ggx --kind metal --json --baselines --export mitsuba:{{out}}/it.xml --aperture-deg 1",
    f"fit {ALUMINIUM} -m lambertian+student-t,lambertian+lafortune:2 --json --no-timing",
    "fit {abg} --json --no-timing",
    "fit {grain} -m ggx-aniso --kind metal --json --no-timing",
    f"fit {PAPER} {PLASTIC} -m lambertian --json",
    f"inspect {PAPER} {PLASTIC} --json",
    "recommend --files-from {listed} --no-timing --json",
    "fit nowhere.csv also-nowhere.csv -m lambertian --json",
    "recommend porcelain --json",
    "recommend chrome --json",
    f"recommend {PLASTIC} --json -m lambertian+ggx",
    "recommend gold-leaf blue-car-paint velvet wet-stone --json --no-timing --explain",
    f"recommend office-paper {PAPER} -m lambertian+ggx --json --numbers --as gltf --scene default",
    "recommend {described} --json --export gltf:{out}/it.gltf",
    "recommend porcelain --json --no-timing --as gltf --scene default",
    "recommend {hair} --json",
    f"inspect {PLASTIC} --json",
    "inspect examples/photographs/shots.yaml --json",
    "inspect {abg} --json",
    "compare lambertian+ggx lambertian+ward --json",
    "compare lambertian+ggx lambertian+ward ggx --json",
    f"compare {PLASTIC} lambertian+ggx --json",
    "roughness --angle 75 --json",
    "roughness --angle 0 --json",
    "roughness --angle 75 --json --contour --angle-error 3",
    "roughness --angle 80 --never --json",
    "roughness --angle 80 --angle-across 78 --slope 0.3 --json",
    "roughness --sigma-um 0.5 --tau-um 5 --json",
    "roughness --highlight-half-width 8 --json",
    "roughness --mirror {dimmed} --json",
    "index gold --json",
    "index --n 1.5 --json",
    "index --f0 0.04 --json",
    "albedo --json",
    "albedo --patch white --json",
    "albedo --between white black --position 0.3 --json",
    "albedo --ratio 0.3 --reference 0.9 --json",
    "gloss --at-60 40 --json",
    "gloss --at-20 88 --at-60 93 --json",
    "gloss --alpha 0.1 --n 1.5 --json",
    "scatter --ra 12nm --json",
    "scatter --tis 0.01 --json",
    "scatter abg a=1e-4 b=1e-5 g=1.8 --json",
    "scatter abc --json",
    "scatter {abg} --json",
    "evaluate lambertian+ggx --theta-r 0 --json",
    f"evaluate --fit {{fit}} --data {PAPER} --json",
    "export --json",
    "export --model lambertian+ward ward.alpha=0.2 --to mitsuba -o {out}/paint.xml --json",
    "export porcelain --to gltf -o {out}/porcelain.gltf --json",
    "models --json",
    "models he-torrance --json",
    "models ggx --json",
    "materials --json",
    "materials --keys --json",
    "materials porcelain --json",
    "materials gold-leaf --json",
    "numbers porcelain --json",
    "numbers car-paint --json",
    "numbers lambertian+ggx --json",
    "check lambertian ward --json",
    f"check --fit {{fit}} --certify {PAPER} --json",
    "check --fit {fit} --json",
    "bench -m lambertian --json",
    f"bench {PAPER} -m lambertian --json",
    "verify {fit} --json",
    f"fit {PAPER} {PLASTIC} --out {{out}}/fits -m lambertian --json --no-timing --aperture-deg 2",
    "collect {out}/fits -o {out}/all.sqlite --json",
    f"convert {PAPER} {{out}}/lost.csv -q",
    "fit {out}/lost.csv --out {out}/left -m lambertian --json --no-timing",
    f"convert {PLASTIC} {{out}}/lost.csv --force -q",
    "prune-answers {out}/left --json",
    "search {out}/fits --json",
    "search {out}/fits metal --like porcelain --json",
    "search {out}/fits --alike --json",
    "convert --from ward --to ggx alpha=0.2 rho_s=0.1 --json",
    "convert --from gltf --to openpbr base_color=0.8,0.1,0.1 roughness=0.4 --json",
    "plan porcelain --budget 2 --theta-max 40 --json",
)
FILES = {
    "described.yaml": "name: mug\ncomposition: porcelain\nappearance: solid colour\nfinish: high gloss\n"
    "diffuse_reflectance: [0.05, 0.10, 0.30]\ngloss: {20: 80, 60: 92}\n",
    "hair.yaml": "structure: hair\n",
    "listed.txt": "porcelain\ngold-leaf\ncopper\nno-such-material\n",
    "dimmed.csv": "theta_deg,R,G,B\n60,0.03,0.01,0.001\n75,0.28,0.18,0.08\n85,0.71,0.63,0.5\n",
}
MAPS = {  # keys whose values are objects with free keys
    *("parameters", "typed", "start", "winners", "scales", "errors", "rms_ln_by_theta_i", "numbers", "gloss_gu"),
    *("intervals_95", "shows_from", "given", "shown", "alpha_shows_from", "gamma", "missed_by_doubts", "measured"),
    *("predicted_gu", "alpha_of_each", "readings_gu", "box", "breaks", "values", "where", "operations", "whole"),
    *("energy", "written", "pruned", "at", "material", "sources", "inferred_numbers", "kinds", "keys_of"),
}
NULLABLE = {  # null where the data do not say it, which the commands above all do
    *("floor", "unlike", "not_reciprocal", "factored", "by_form", "beyond_form", "growth", "r_mirror", "r_max"),
    *("r_mirror_data", "r_max_data", "gloss_gu", "held_out_rms_ln", "seen", "stderr", "known_to", "shows_from"),
    *("measured_rms_ln", "measured_off_percent", "key", "energy", "reciprocity", "off_plane", "missing"),
    *(
        "noise_relative",
        "with_it",
        "held_out_fits",
        "held_out_on",
        "instrument",
        "at_mirror",
        "greatest",
        "high",
        "needs",
        "relative",
    ),
}
OPTIONAL = {  # there or not, as was asked
    *("time_per_sample_ns", "ns_per_sample", "fit_time_s", "on_front", "standard_error_left", "differ_by_noise"),
    *("saving_ns", "saving_stderr_ns", "saving_measurable"),
    *("pairs", "median_ratio", "median_ratio_over_cosine", "power_of_cosine", "power_stderr"),
}
NUMBERS = {"type": ["array", "number"], "items": {"type": "number"}}
ENDS = {
    "_deg": "degrees",
    "_nm": "nanometres",
    "_um": "micrometres",
    "_sr": "steradians",
    "_per_sr": "1/sr",
    "_mm": "millimetres",
    "_s": "seconds",
    "_ns": "nanoseconds",
    "_percent": "percent",
}
MEANINGS = {
    "schema": "which document this is, and of which version: keys are added within one, none is renamed",
    "recommended": "name of the model to use",
    "recommended_fit": "the row of that model, whole",
    "trustworthy": "false: exit status 1, see no_answer",
    "means": "label -> what the number is in every program, whatever it is called there",
    "no_answer": "why no model should be trusted; null where one may be",
    "because": "why this one",
    "ranking": "every candidate, the recommended one first, the others by their error",
    "rms_ln": "rms of ln(model/data)",
    "off_percent": "the same as a percentage: how far off it typically is",
    "held_out_rms_ln": "the same at incidence angles that the fit did not see",
    "held_out_fits": "what was found without each group of incidences, or of turns of the sample, from which these "
    "errors follow; an array has a value for each channel that was looked at",
    "turns_deg": "azimuths of the light that were left out; none where incidences were",
    "held_out_on": "the directions, by their numbers in the order of the file as it is read, the first 0, and the "
    "channels that fits without a group looked at; null: all that have a value",
    "instrument": "what the instrument did, fitted beside the model: errors are without it; null where nothing was",
    "zero_deg": "the true reflected angle is the reported one plus this [deg]",
    "ln_gains": "ln of how much too bright the values of each scan were, in the order of theta_i_deg",
    "behind": "how much larger its error is than the best one's",
    "behind_se": "standard error of that, over blocks of neighbouring directions",
    "tied": "cannot be told from the best by these data",
    "close": "close enough to the best for the eye",
    "seen": "rms difference in lightness of two spheres, averaged over lamps all around [L*]",
    "typed": "parameter -> value, as `evaluate` and `export --model` take them",
    "parameters": "name -> value and its doubt; an array has a value for each channel, a number is shared",
    "stderr": "standard error, in the shape of the value; null where it was not fitted",
    "at_bound": "low, high or null",
    "flags": "doubts about this model; `brdfguide --explain CODE`",
    "warnings": "doubts about the answer; `brdfguide --explain CODE`",
    "findings": "what was noticed; `brdfguide --explain CODE`",
    "code": "stable from version to version",
    "text": "the same in a sentence, with the numbers of this surface",
    "channels": "names of the wavelengths or colours",
    "start": "parameter -> value to begin with; an array has a value for each channel",
}


def printed(line: str, names: dict[str, str]) -> dict | None:
    """The document that a command prints; None where it prints none."""
    out = io.StringIO()
    try:
        with redirect_stdout(out), redirect_stderr(io.StringIO()), chdir(ROOT):
            main(shlex.split(line.format(**names)))
    except SystemExit:
        pass
    return json.loads(out.getvalue()) if out.getvalue() else None


def documents(folder: Path) -> list[tuple[str, dict]]:
    """(command, document) of every command, in this process."""
    for name, text in FILES.items():
        (folder / name).write_text(text)
    names = {path.stem: str(path) for path in sorted(folder.iterdir())} | {"out": str(folder)}
    names |= {name.partition(".")[0]: str(folder / name) for name in ("fit.json", "abg.csv", "grain.csv")}
    (folder / "abg.csv").write_text(_polished())
    (folder / "grain.csv").write_text(_grained())
    fit = printed(f"fit {PAPER} -m lambertian+ggx,lambertian+ward --json --no-timing", names)
    (folder / "fit.json").write_text(json.dumps(fit))
    found = [(line, printed(line, names)) for line in COMMANDS]
    return [(line, document) for line, document in found if document is not None]


def _polished() -> str:
    """A scan of a polished surface: a shoulder and a power law about the mirror direction."""
    from math import radians, sin

    lines = ["# wavelength_nm: 633", "aoi,theta_s,brdf"]
    for step in range(-40, 41):
        angle = 5 + 2.0 * step
        if step and abs(angle) < 85:
            x = abs(sin(radians(angle)) - sin(radians(5)))
            lines.append(f"5,{angle:g},{1e-4 / (1e-5 + x**1.8):.6g}")
    return "\n".join(lines) + "\n"


def _grained() -> str:
    """Scans of a brushed metal under four turns, of more directions than fits without a group look at."""
    import numpy as np

    from brdfguide.models import term
    from brdfguide.physics.geometry import Geometry, rows

    turn, theta_i, theta_r = (each.ravel() for each in np.meshgrid([0, 45, 90, 135], [20, 50], np.arange(-75, 80, 2)))
    geom = rows(Geometry.from_degrees(theta_i, turn, np.abs(theta_r), turn + np.where(theta_r < 0, 0, 180)))
    brdf = term("ggx-aniso")(geom, alpha_x=0.3, alpha_y=0.1, axis=0.5, n=1.0, k=4.0, scale=1.0)[:, 0]
    cells = zip(turn, theta_i, theta_r, brdf, strict=True)
    return "phi_i,theta_i,theta_r,brdf\n" + "".join(f"{a},{b},{c},{d:.6g}\n" for a, b, c, d in cells)


# --- the shape of values -------------------------------------------------------------------------------------


DEFINED = {  # objects that stand in several places, by the keys that only they have
    "fit": {"schema", "ranking", "recommended_fit", "data"},
    "finding": {"code", "text"},
    "row": {"candidate", "rms_ln", "parameters", "flags"},
    "typed": {"program", "shader", "hex", "means"},
}


def defined(value) -> str:
    """The name of what stands in several places; "" of anything else."""
    keys = value.keys() if isinstance(value, dict) else set()
    return next((name for name, own in DEFINED.items() if own <= keys), "")


def collected(value, name: str) -> list[dict]:
    """Every object of that name within a value."""
    inside = list(value.values()) if isinstance(value, dict) else value
    if not isinstance(inside, list):
        return []
    here = [value] if defined(value) == name else []
    return here + [each for item in inside for each in collected(item, name)]


def shape(values: list, key: str = "", within: str = "") -> dict:
    """The JSON Schema that all of these values follow; `within` the definition of that name."""
    names = {defined(value) for value in values if value is not None}
    if len(names) == 1 and (name := names.pop()) and name != within:
        about = _meaning(key)
        there = {"$ref": f"#/$defs/{name}"}
        there = {"anyOf": [there, {"type": "null"}]} if None in values else there
        return ({"description": about} if about else {}) | there
    kinds = {_kind(value) for value in values}
    made: dict = {}
    if about := _meaning(key):
        made["description"] = about
    if key in NULLABLE:
        kinds.add("null")
    if kinds != {"null"}:  # of what is never there no more is known
        made["type"] = sorted(kinds)[0] if len(kinds) == 1 else sorted(kinds)
    objects = [value for value in values if isinstance(value, dict)]
    if objects and (key in MAPS or any(_is_data(name) for each in objects for name in each)):
        inside = [item for each in objects for item in each.values()]
        free: dict | bool = shape(inside) if inside else True
        if key == "numbers" and within == "finding" and free == {"type": "number"}:
            free = {"type": ["null", "number"]}  # where one has no bound
        made["additionalProperties"] = NUMBERS if key == "written" else free
    elif objects:
        names = dict.fromkeys(name for each in objects for name in each)
        made["properties"] = {
            name: shape([e[name] for e in objects if name in e], name, within if name == "numbers" else "")
            for name in names
        }
        always = [name for name in names if name not in OPTIONAL and all(name in each for each in objects)]
        made["required"] = always
    arrays = [item for value in values if isinstance(value, list) for item in value]
    if arrays:
        made["items"] = shape(arrays)
        if key == "stderr" and made["items"] == {"type": "number"}:
            made["items"] = {"type": ["null", "number"]}  # of a channel that says nothing of it
    return made


def _kind(value) -> str:
    if value is None:
        return "null"
    for kind, name in ((bool, "boolean"), (str, "string"), ((int, float), "number"), (list, "array")):
        if isinstance(value, kind):
            return name
    return "object"


def _is_data(name: str) -> bool:
    """Whether a key is a name of something and no word of ours."""
    return not name.replace("_", "a").isalnum() or name[:1].isdigit() or name[:1].isupper()


def _meaning(key: str) -> str:
    if key in MEANINGS:
        return MEANINGS[key]
    unit = max((end for end in ENDS if key.endswith(end)), key=len, default="")
    return ENDS.get(unit, "")


def schemas(found: list[tuple[str, dict]]) -> dict[str, dict]:
    """Name -> JSON Schema of the documents, by what each says that it is."""
    by_name: dict[str, list[dict]] = {}
    for _, document in found:
        for each in [document, *document.get("recommendations", ())]:
            by_name.setdefault(each["schema"], []).append(each)
    every = [document for each in by_name.values() for document in each]
    everywhere = {word: shape(collected(every, word), within=word) for word in DEFINED}
    made = {}
    for full, each in sorted(by_name.items()):
        name = full.split("/")[1]
        entry = shape(each, within="fit")  # the document itself is told in place
        entry["properties"]["schema"] |= {"const": full}
        made[name] = {"$schema": DRAFT, "$id": f"urn:{full.replace('/', ':')}", "title": full, **entry}
        if definitions := {word: everywhere[word] for word in DEFINED if collected(each, word)}:
            made[name]["$defs"] = definitions
    return made


KEPT = {path.stem: json.loads(path.read_text()) for path in sorted(FOLDER.glob("*.json"))}


def wrong(document: dict) -> list[str]:
    """What a document has that its schema does not allow. Needs the package jsonschema."""
    from jsonschema import Draft202012Validator

    validator = Draft202012Validator(KEPT[document["schema"].split("/")[1]])
    return [f"{each.json_path}: {each.message[:200]}" for each in validator.iter_errors(document)]


def file_text(schema: dict) -> str:
    """A schema as it is kept."""
    return json.dumps(schema, indent=1, ensure_ascii=False) + "\n"


def write() -> None:
    """Writes every schema into the package."""
    with TemporaryDirectory() as folder:
        found = documents(Path(folder))
    FOLDER.mkdir(exist_ok=True)
    for old in FOLDER.glob("*.json"):
        old.unlink()
    for name, schema in schemas(found).items():
        (FOLDER / f"{name}.json").write_text(file_text(schema))


if __name__ == "__main__":
    sys.exit(write())

"""What else comes from other people: JSON that comes back, descriptions, scenes, names, options."""

import copy
import json
from random import Random

from damage import NUMBERS, SIGNS, damaged

LAWS = (
    "lambertian",
    "lambertian+ggx",
    "ggx",
    "lambertian+he-torrance",
    "ward",
    "mirror",
    "oren-nayar+ggx",
    "sgd",
    "abg",
)
ODD = (
    None,
    True,
    False,
    0,
    -1,
    1e300,
    10**400,
    0.5,
    "",
    "x",
    "\ud800",
    "\x1b[31m",
    [],
    {},
    [0],
    [[]],
    {"value": 1},
    ["a"],
)


def fit_json(draw: Random) -> bytes:
    """A fit's or a recommendation's JSON, a few of whose places are something else."""
    law = draw.choice(LAWS)
    row = {"model": law, "candidate": law, "freed": [], "rms_ln": 0.1, "parameters": {}}
    if "ggx" in law:
        row["parameters"] = {"ggx.alpha": {"value": 0.3, "stderr": None}, "ggx.n": {"value": [1.5]}}
    data = {"channels": ["brdf"], "wavelength_nm": [550.0], "solid_angle_sr": None}
    document: dict = {"schema": "brdfguide/fit/1", "data": data, "recommended": law, "ranking": [row]}
    if draw.random() < 0.4:
        start = {"ggx.alpha": 0.2} if "ggx" in law else {}
        document = {"schema": "brdfguide/recommend/1", "candidates": [{"model": law, "start": start}]}
    for _ in range(draw.choice((0, 1, 1, 2, 4))):
        _changed(draw, document)
    text = json.dumps(document, indent=draw.choice((None, 1)))
    return (
        damaged(draw, text, ["NaN", "Infinity", "model", "value", "null", *LAWS])
        if draw.random() < 0.4
        else text.encode()
    )


def _changed(draw: Random, at) -> None:
    """One place of a document left out, renamed or something else."""
    while True:
        keys = list(at) if isinstance(at, dict) else list(range(len(at)))
        if not keys:
            return
        key = draw.choice(keys)
        if isinstance(at[key], (dict, list)) and draw.random() < 0.7:
            at = at[key]
            continue
        change = draw.randrange(4)
        if change == 0:
            del at[key]
        elif change == 1 and isinstance(at, dict):
            at[draw.choice(("x", "value", "model", "ggx.k", "schema"))] = at.pop(key)
        else:
            at[key] = copy.deepcopy(draw.choice(ODD))
        return


def _yaml(value, indent: str = "") -> str:
    lines = []
    for key, each in value.items():
        inner = f"\n{_yaml(each, indent + '  ')}" if isinstance(each, dict) else f" {each}"
        lines.append(f"{indent}{key}:{inner}")
    return "\n".join(lines)


def description(draw: Random) -> bytes:
    """A material's YAML of keys that there are, with values that may be."""
    from brdfguide.advice import material

    given: dict = {"name": json.dumps(name(draw)) if draw.random() < 0.4 else "x"}
    for field in draw.sample(material.OBSERVATIONS, draw.randint(1, 6)):
        given[field.name] = _field(draw, field)
    text = _yaml(given) + "\n"
    words = [field.name for field in material.FIELDS]
    return damaged(draw, text, words) if draw.random() < 0.5 else text.encode()


def _field(draw: Random, field):
    """A value that its field may take, mostly; else a number that none may."""
    if field.kind == "group":
        inner = [each for each in field.fields if each.required or draw.random() < 0.7] or field.fields[:1]
        return {each.name: _field(draw, each) for each in inner}
    if field.choices and draw.random() < 0.9:
        return draw.choice(field.choices)
    if field.kind == "flag":
        return draw.choice(("true", "false"))
    if field.kind in ("text", "texts"):
        word = draw.choice(("gold", "brass", "x", "'#'", "acrylic", '"\\ud800"', '"a\\0b"'))
        return f"[{word}, white]" if field.kind == "texts" else word
    low, high = field.low or field.above or 0.0, field.high or 10.0
    likely = (f"{draw.uniform(low, high):.4g}", f"{low:g}", f"{high:g}", f"{low + 1e-12:.13g}", "1e-300")
    number = draw.choice((*likely, likely[0], draw.choice(NUMBERS)))
    if field.kind == "numbers" and draw.random() < 0.4:
        return f"[{', '.join([number] * draw.choice((1, 3)))}]"
    return number


def scene(draw: Random) -> bytes:
    """A scene's YAML."""

    def number(low, high):
        return draw.choice((f"{draw.uniform(low, high):.4g}",) * 6 + (f"{low:g}", f"{high:g}", draw.choice(NUMBERS)))

    text = (
        f"name: {json.dumps(name(draw)) if draw.random() < 0.2 else 'x'}\n"
        f"shape: {draw.choice(('plane', 'sphere', 'cylinder', 'box', 'arbitrary'))}\n"
        f"camera: {{theta_deg: [{number(0, 30)}, {number(30, 90)}], phi_deg: {number(-180, 180)}}}\n"
        f"lights:\n  - {{theta_deg: [{number(0, 30)}, {number(30, 90)}], radius_deg: {number(0, 60)}}}\n"
        f"pixels: {number(1, 1e9)}\ntolerance: {{worst_jnd: {number(0, 5)}, p95_jnd: {number(0, 5)}}}\n"
    )
    words = [
        "shape",
        "camera",
        "lights",
        "theta_deg",
        "radius_deg",
        "phi_deg",
        "tolerance",
        "pixels",
        "display",
        "bits",
    ]
    return damaged(draw, text, words) if draw.random() < 0.6 else text.encode()


PIECES = (
    "paint", "gold 1", "größe", "白い", "👍", "\r", "\n", "\x1b[31m", "\x1b]0;T\x07", "\u202e", "\u2028", "\x85",
    "\ud800", "\udcff", "-->", "<x/>", "*/", "/*", '"""', "'", "\\", "$\\frac{$", "coding: utf-7", "+AAo-", "!touch X",
    "#", "{", "}", "; rm", "=1+1", "@x", "-", "--", "gl_", "color", "bg", "__", ".", "..", "[red]", "[/]", "%s", "{0}",
    "%(x)s", "\0", "\t",
)  # fmt: skip


def name(draw: Random) -> str:
    """A name that no honest person gives."""
    made = "".join(draw.choice((*PIECES, draw.choice(SIGNS))) for _ in range(draw.randint(1, 6)))
    return made * draw.choice((1,) * 12 + (400,))


def typed(name: str) -> str:
    """A name as a shell can hand it over, and no path out of the folder."""
    text = "".join(letter for letter in name if letter not in "/\0" and not "\ud800" <= letter < "\udc80")
    return text.encode(errors="surrogateescape").decode(errors="surrogateescape")


# Commands with their options, a line each.
_COMMANDS = """
    roughness --angle --slope --sigma-um --tau-um --wavelength-nm --pupil-mm --distance-mm --never --contour --json
    evaluate --theta-i --theta-r --phi --wavelength-nm --json --fit --data --model
    index --f0 --n --k --wavelength-nm --json
    gloss --at-20 --at-60 --at-85 --alpha --n --albedo --lobe --json
    albedo --patch --ratio --reference --position --data-set --json
    models --json
    materials --keys --json
    inspect --wavelength --in-plane --theta-max --columns --unit --quantity --wavelength-nm --select --mirror-side
        --average-phi-i --json
    convert --wavelength --theta-max --columns --unit --quantity --select --force
    export --to --output --model --channel --name --max-export-error --force --json
    recommend --models --explain --anyway --json --no-timing --export
    fit --models --kind --metric --weights --robust --fix --start --theta-max --quantity --json --residuals --out
        --group
    compare --aperture-deg --to --json
"""
COMMANDS: dict[str, list[str]] = {}
for _word in _COMMANDS.split():
    if _word.startswith("--"):
        COMMANDS[list(COMMANDS)[-1]].append(_word)
    else:
        COMMANDS[_word] = []
_WORDS = """
    a.csv fit.json m.yaml none.csv . - porcelain gold lambertian+ggx ggx ward alpha=0.2 ggx.alpha=0.2
    lambertian.albedo=0.1,0.2,0.3 x=1 = glsl mitsuba usd osl:x.osl glsl:y.glsl out.csv x.glsl deg rad brdf-cos
    negative white metal ln theta_i=theta_i 450:650 0:80:5 theta_i sample=a d lambertian /dev/null none/x.csv
"""
WORDS = ["", *_WORDS.split()]


def command_line(draw: Random) -> list[str]:
    """A command with options of its own and words that may stand there; the folder holds a.csv, fit.json, m.yaml."""
    command = draw.choice(list(COMMANDS))
    words = [command]
    if command == "fit":
        words += ["-m", "lambertian"]
    for _ in range(draw.randint(0, 5)):
        kind = draw.random()
        if kind < 0.6:
            words.append(draw.choice(COMMANDS[command]))
        if kind < 0.3:
            words.append(draw.choice(NUMBERS))
        elif kind > 0.45:
            words.append(draw.choice(WORDS) if draw.random() < 0.85 else typed(name(draw)))
    return words

"""A name is shown in a comment and made an identifier; it never becomes a second statement, in any target."""

import ast
import json
import os
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from brdfguide import exporters, models
from brdfguide.data import formats
from brdfguide.models.surface import Surface
from brdfguide.printable import identifier

# Each with words of its own, so that its identifier is no word of the target.
HOSTILE = {
    "carriage return": "qx\rINJECTED = 1\r#",
    "line feed": "qx\nINJECTED = 1\n#",
    "next line": "qx\x85INJECTED = 1\x85#",
    "line separator": "qx\u2028INJECTED = 1\u2029#",
    "vertical tabulator": "qx\x0bINJECTED\x0cx",
    "escape sequence": "qx\x1b]0;TITLE\x07\x1b[31m",
    "zero byte": "qx\0y",
    "lone surrogate": "qx\ud800y",
    "a byte of a file's name": "qx\udcffy",
    "turned direction": "qx\u202e;1 = DETCEJNI\u2066",
    "end of a comment of C": "qx */ int injected; /*",
    "end of a comment of XML": "qx --><injected/><!-- --",
    "quotes and braces": "qx\"'); } injected {%$`&<>",
    "backslash at the end": "qx\\",
    "an encoding": "qx coding: utf-7 +AAo-INJECTED = 1+AAo-",
    "a command of Radiance": "qx\n!touch INJECTED\n#",
    "a word of GLSL": "gl_qx__injected",
    "a word of OSL": "color",
    "our own functions": "bg",
    "other scripts": "qx 白い 👍 größe",
    "no letter": "7--",
    "a hundred thousand letters": "qx" * 50_000,
    "a command beyond what Radiance reads of a comment": "qx " * 1000 + "!touch INJECTED",
    "the same in letters of four bytes": "qx 👍" * 600 + " !touch INJECTED",
    "a directive of pbrt": 'qx"\nInclude "/etc/passwd"\n#',
}
COMMENTS = {  # what a line of comment begins with where that is no #
    "glsl": "//",
    "osl": "//",
    "astm": "COMMENT",
    "fred": "!!",
    "speos": "written by brdfguide",  # the line of its description
    "speos-anisotropic": "written by brdfguide",
    "tracepro": "File Name\t",
}
# with a line or more of comments
TABLES = ("astm", "csv", "fred", "lighttools", "speos", "speos-anisotropic", "tracepro", "zemax")
XML = ("gltf-pbr", "mitsuba", "materialx", "openpbr", "standard-surface")
TEXTS = [target for target in exporters.names() if target not in ("merl", "rgl", "rgl-spectral")]
MODEL = models.get("lambertian+ggx")
VALUES = {"lambertian.albedo": 0.3, "ggx.alpha": 0.2}


def made(target: str, name: str, stem: str = "qstem"):
    """The surface called `name`, asked for by a command that has the name in it too, of a channel that has it."""
    surface = Surface(MODEL, VALUES, (name,), 0.55)
    return exporters.export(target, exporters.coloured(surface, name, f"brdfguide export {name}"), stem=stem)


@cache
def made_plain(target: str) -> str:
    return made(target, "qplain").content


def comments(target: str, text: str) -> list[str]:
    """Lines of comments."""
    if target in XML:
        return [line for found in re.findall(r"<!--(.*?)-->", text, flags=re.S) for line in found.split("\n")]
    if target == "gltf":
        return json.loads(text)["materials"][0]["extras"]["brdfguide"]
    if target == "factors":
        return json.loads(text)["comment"]
    return [line for line in text.split("\n") if line.startswith(COMMENTS.get(target, "#"))]


def bare(target: str, text: str, name: str) -> str:
    """The file without its comments, under another name."""
    if target == "gltf":
        document = json.loads(text)
        del document["materials"][0]["extras"], document["materials"][0]["name"]
        return json.dumps(document)
    if target == "factors":
        return json.dumps({**json.loads(text), "comment": ""})
    if target in XML:
        text = re.sub(r"<!--.*?-->", "", text, flags=re.S)
    else:
        text = "\n".join(line for line in text.split("\n") if not line.startswith(COMMENTS.get(target, "#")))
    return re.sub(rf"(?<![A-Za-z]){identifier(name)}(?![A-Za-z])", "NAME", text)


@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
@pytest.mark.parametrize("target", TEXTS)
def test_it_is_the_same_file_but_for_names_and_comments(target, name):
    hostile, plain = made(target, name).content, made_plain(target)
    assert all(cell.isprintable() for line in hostile.split("\n") for cell in line.split("\t"))
    assert all(len(line.encode()) < 2040 for line in comments(target, hostile))
    assert bare(target, hostile, name) == bare(target, plain, "qplain")
    assert len(comments(target, hostile)) == len(comments(target, plain)) > (0 if target in TABLES else 4)
    hostile.encode()


@pytest.mark.parametrize("target", ["astm", "csv", "speos", "tracepro"])
def test_names_of_several_channels_are_no_lines_of_a_table(target):
    def written(*channels: str) -> list[str]:
        surface = Surface(MODEL, VALUES, (*channels, "550nm", "600nm", "650nm"), np.linspace(0.45, 0.65, 5))
        return exporters.export(target, exporters.coloured(surface, "qplain")).content.split("\n")

    hostile, plain = written("qx\n0,0,0,0,INJECTED", "qy\t=1"), written("450nm", "500nm")
    assert len(hostile) == len(plain) and not any("\n" in line or line.startswith("0,0,0,0,I") for line in hostile)
    assert [line.count(",") for line in hostile] == [line.count(",") for line in plain]


@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_files_of_radiance_hold_no_command_and_no_more_words(name):
    export = made("radiance-cal", name, stem=name)
    ((file, cal),) = export.beside.items()
    plain = made("radiance-cal", "qplain")
    assert not any(line.startswith("!") for text in (export.content, cal) for line in text.split("\n"))
    words, wanted = ([line for line in each.content.split("\n") if line[:3] == "10 "] for each in (export, plain))
    assert len(words) == 1 and len(words[0].split()) == len(wanted[0].split()) == 11 and words[0].split()[-1] == file
    assert re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]*\.cal", file)
    head, rest = cal.split("\n}\n", 1)  # the comment ends once
    assert "}" not in head and head.count("{") == 1
    assert bare("radiance-cal", rest, name) == bare(
        "radiance-cal", plain.beside["qstem.cal"].split("\n}\n", 1)[1], "qplain"
    )


@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_python_runs_one_statement(name, tmp_path):
    content = made("mitsuba-dict", name).content.encode()
    assert len(ast.parse(content).body) == 1
    found: dict = {}
    exec(compile(content, "m.py", "exec"), found)  # as bytes: a comment may not choose how they are read
    assert found.keys() - {"__builtins__"} == {"MATERIAL"}


@pytest.mark.parametrize("target", ["rgl", "rgl-spectral"])
def test_a_table_has_the_name_in_its_description_alone(target):
    surface = Surface(models.get("lambertian"), {"lambertian.albedo": 0.3}, ("\x1b[31m\r",), 0.55)
    one = exporters.export(target, exporters.coloured(surface, HOSTILE["carriage return"], "\0\u2028")).content
    source = formats.format.Source("x.bsdf", one)
    assert formats.recognised(one[: formats.HEAD], "x.bsdf").read(source, formats.Options()).brdf.size
    start = one.index(b"brdfguide")
    text = one[start : one.index(b"table of", start)].decode()
    assert text.count("\n") == 7 and all(line.isprintable() for line in text.split("\n"))


# --- what loads them ---------------------------------------------------------------------------------


@pytest.mark.validate
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_mitsuba_loads_them(name):
    mitsuba = pytest.importorskip("mitsuba", reason="pip install mitsuba: the reader of these exports")
    mitsuba.set_variant("scalar_rgb")
    assert isinstance(mitsuba.load_string(made("mitsuba", name).content), mitsuba.BSDF)
    found: dict = {}
    exec(compile(made("mitsuba-dict", name).content.encode(), "m.py", "exec"), found)
    assert isinstance(mitsuba.load_dict(found["MATERIAL"]), mitsuba.BSDF)


@pytest.mark.validate
@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
@pytest.mark.parametrize("target", ["materialx", "openpbr", "standard-surface"])
def test_materialx_reads_one_material(target, name):
    materialx = pytest.importorskip("MaterialX", reason="pip install materialx: the reader of these exports")
    document = materialx.createDocument()
    materialx.readFromXmlString(document, made(target, name).content)
    assert [each.getName() for each in document.getMaterialNodes()] == [identifier(name)]


@pytest.mark.validate
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_usd_opens_one_prim(name):
    sdf = pytest.importorskip("pxr.Sdf", reason="pip install usd-core: the reader of these exports")
    layer = sdf.Layer.CreateAnonymous(".usda")
    assert layer.ImportFromString(made("usd", name).content)
    assert [each.name for each in layer.rootPrims] == [identifier(name)]


@pytest.mark.validate
@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_glsl_compiles(name, tmp_path):
    if shutil.which("glslangValidator") is None:
        pytest.skip("apt-get install glslang-tools: compiles the shaders")
    own = identifier(name)
    main = f"in vec3 L; in vec3 V; out vec4 o; void main() {{ o = vec4({own}_brdf(L, V, vec3(0, 0, 1)), 1); }}"
    for version in ("#version 130", "#version 300 es\nprecision highp float;"):
        (tmp_path / "law.frag").write_text(f"{version}\n{made('glsl', name).content}\n{main}\n")
        run = subprocess.run(["glslangValidator", str(tmp_path / "law.frag")], capture_output=True, text=True)
        assert run.returncode == 0, run.stdout


@pytest.mark.validate
@pytest.mark.parametrize("name", HOSTILE.values(), ids=HOSTILE)
def test_radiance_reads_both_of_its_targets(name, tmp_path):
    pyradiance = pytest.importorskip("pyradiance", reason="pip install pyradiance: the reader of these exports")
    from .test_radiance import traced

    home = Path(pyradiance.__file__).parent
    environment = dict(os.environ, PATH=f"{home / 'bin'}:{os.environ['PATH']}", RAYPATH=f".:{home / 'lib'}")
    light = np.array([0.3, 0.0, 0.954])
    seen = traced(
        made("radiance-cal", name, stem=name), identifier(name), light, np.array([-0.3, 0.0, 0.954]), tmp_path
    )
    assert np.all(seen > 0.05)
    (tmp_path / "r.rad").write_text(made("radiance", name).content + f"{identifier(name)} sphere s 0 0 4 0 0 0 1\n")
    run = subprocess.run(["oconv", "r.rad"], cwd=tmp_path, env=environment, capture_output=True)
    assert run.returncode == 0 and not run.stderr, run.stderr
    assert not (tmp_path / "INJECTED").exists()


@pytest.mark.validate
def test_the_validator_of_gltf_has_nothing_against_them(tmp_path):
    environment = dict(os.environ)
    if shutil.which("node") is None:
        pytest.skip("no node: apt-get install nodejs npm; npm install -g gltf-validator")
    if "NODE_PATH" not in environment and shutil.which("npm"):
        environment["NODE_PATH"] = subprocess.run(["npm", "root", "-g"], capture_output=True, text=True).stdout.strip()
    if subprocess.run(["node", "-e", "require('gltf-validator')"], env=environment, capture_output=True).returncode:
        pytest.skip("npm install -g gltf-validator (or NODE_PATH): the reader of these exports")
    script = """
    const v = require('gltf-validator'), fs = require('fs');
    (async () => { for (const path of process.argv.slice(1)) {
      const r = await v.validateBytes(new Uint8Array(fs.readFileSync(path)));
      console.log(r.issues.numErrors + r.issues.numWarnings); } })();
    """
    paths = []
    for number, name in enumerate(HOSTILE.values()):
        paths.append(tmp_path / f"{number}.gltf")
        paths[-1].write_text(made("gltf", name).content)
    run = subprocess.run(["node", "-e", script, *map(str, paths)], env=environment, capture_output=True, text=True)
    assert run.stdout.split() == ["0"] * len(HOSTILE), run.stderr


@pytest.mark.validate
def test_the_compiler_of_osl_takes_them(tmp_path):
    python = os.environ.get("BPY_PYTHON")
    if python is None:
        pytest.skip("BPY_PYTHON: an interpreter with the package bpy, whose OSL compiler reads these exports")
    from .test_shaders import COMPILE

    paths = []
    for number, name in enumerate(HOSTILE.values()):
        paths.append(tmp_path / f"{number}.osl")
        paths[-1].write_text(made("osl", name).content)
    run = subprocess.run([python, "-c", COMPILE, *map(str, paths)], capture_output=True, text=True)
    assert [line.split()[0] for line in run.stdout.splitlines() if line.endswith(".osl")] == ["True"] * len(HOSTILE)

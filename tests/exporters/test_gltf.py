"""Khronos' validator, which checks ranges too, finds nothing but that a lone material is unused."""

import json
import os
import shutil
import subprocess

import pytest

from brdfguide import exporters
from brdfguide.exporters.exporter import Refused

from .conftest import EVERY_LAW, NAMES

pytestmark = pytest.mark.validate
SCRIPT = """
const v = require('gltf-validator'), fs = require('fs');
v.validateBytes(new Uint8Array(fs.readFileSync(process.argv[1])))
  .then(r => console.log(JSON.stringify(r.issues.messages)),
  e => { console.error(e); process.exit(3); });
"""


@pytest.fixture(scope="module")
def validate(tmp_path_factory):
    """Messages of the validator for a text. `npm install -g gltf-validator`, or NODE_PATH where it lies."""
    if shutil.which("node") is None:
        pytest.skip("no node: apt-get install nodejs npm; npm install -g gltf-validator")
    environment = dict(os.environ)
    if "NODE_PATH" not in environment and shutil.which("npm"):
        environment["NODE_PATH"] = subprocess.run(["npm", "root", "-g"], capture_output=True, text=True).stdout.strip()
    if subprocess.run(["node", "-e", "require('gltf-validator')"], env=environment, capture_output=True).returncode:
        pytest.skip("npm install -g gltf-validator (or NODE_PATH): the reader of these exports")
    path = tmp_path_factory.mktemp("gltf") / "material.gltf"

    def messages(text: str) -> list[dict]:
        path.write_text(text)
        run = subprocess.run(["node", "-e", SCRIPT, str(path)], env=environment, capture_output=True, text=True)
        assert run.returncode == 0, run.stderr
        return json.loads(run.stdout)

    return messages


def test_the_validator_sees_a_wrong_roughness(validate):
    document = json.loads(exporters.export("gltf", EVERY_LAW["ggx"]).content)
    document["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 5
    assert any(each["severity"] == 0 for each in validate(json.dumps(document)))


@pytest.mark.parametrize("name", NAMES)
def test_material_has_no_errors_or_warnings(name, of, validate):
    for surface in of(name):
        try:
            text = exporters.export("gltf", surface).content
        except Refused:
            continue
        messages = validate(text)
        assert [each for each in messages if each["severity"] < 2] == [], surface.name
        assert {each["code"] for each in messages} <= {"UNUSED_OBJECT"}

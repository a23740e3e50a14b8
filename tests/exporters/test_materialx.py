"""MaterialX reads, validates and turns every document into GLSL, and glslang compiles that."""

import shutil
import subprocess

import pytest

from brdfguide import exporters
from brdfguide.exporters.exporter import Refused

from .conftest import EVERY_LAW, NAMES

materialx = pytest.importorskip("MaterialX", reason="pip install materialx: the reader of these exports")
pytestmark = [pytest.mark.validate, pytest.mark.filterwarnings("ignore")]


@pytest.fixture(scope="module")
def libraries():
    library = materialx.createDocument()
    materialx.loadLibraries(materialx.getDefaultDataLibraryFolders(), materialx.getDefaultDataSearchPath(), library)
    return library


@pytest.mark.parametrize("target", ["materialx", "openpbr", "standard-surface"])
@pytest.mark.parametrize("name", NAMES)
def test_document_validates_and_its_shader_compiles(target, name, of, libraries, tmp_path):
    for surface in of(name):
        try:
            text = exporters.export(target, surface).content
        except Refused:
            continue
        made = generated(text, libraries)
        if shutil.which("glslangValidator") is None:
            pytest.skip("apt-get install glslang-tools: compiles the generated shaders")
        for stage in ("vert", "frag"):
            (tmp_path / f"shader.{stage}").write_text(made[stage])
            run = subprocess.run(
                ["glslangValidator", str(tmp_path / f"shader.{stage}")], capture_output=True, text=True
            )
            assert run.returncode == 0, run.stdout


def generated(text: str, libraries) -> dict[str, str]:
    """The GLSL that MaterialX makes of a document that it finds valid."""
    import MaterialX.PyMaterialXGenGlsl as glsl
    import MaterialX.PyMaterialXGenShader as shader

    document = materialx.createDocument()
    materialx.readFromXmlString(document, text)
    document.setDataLibrary(libraries)
    valid, message = document.validate()
    assert valid, message
    [material] = document.getMaterialNodes()
    generator = glsl.GlslShaderGenerator.create()
    context = shader.GenContext(generator)
    context.registerSourceCodeSearchPath(materialx.getDefaultDataSearchPath())
    made = generator.generate("shader", shader.findRenderableElements(document)[0], context)
    return {"vert": made.getSourceCode(shader.VERTEX_STAGE), "frag": made.getSourceCode(shader.PIXEL_STAGE)}


@pytest.mark.parametrize("target", ["materialx", "openpbr", "standard-surface"])
def test_inputs_lie_within_what_the_nodes_document(target, libraries):
    """The nodes carry uimin and uimax, which validate() does not look at."""
    document = materialx.createDocument()
    materialx.readFromXmlString(document, exporters.export(target, EVERY_LAW["paint"]).content)
    document.setDataLibrary(libraries)
    checked = 0
    for node in document.getNodes():
        definition = node.getNodeDef()
        for value in node.getInputs():
            if definition is None or not value.getValueString():
                continue
            declared = definition.getActiveInput(value.getName())
            assert declared is not None, (node.getCategory(), value.getName())
            numbers = (
                [float(each) for each in value.getValueString().split(",")]
                if value.getType() in ("float", "color3", "vector2")
                else []
            )
            low, high = declared.getAttribute("uimin"), declared.getAttribute("uimax")
            for number in numbers:
                assert not low or number >= float(low.split(",")[0]), (value.getName(), number)
                assert not high or number <= float(high.split(",")[0]), (value.getName(), number)
                checked += 1
    assert checked >= 4

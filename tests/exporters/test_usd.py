"""USD opens every stage and finds no fault; every input name and type is one of the shader's own."""

import pytest

from brdfguide import exporters
from brdfguide.exporters._base import Refused

from .conftest import EVERY_LAW, MATERIALS

pxr = pytest.importorskip("pxr", reason="pip install usd-core: the reader of these exports")
pytestmark = [pytest.mark.validate, pytest.mark.filterwarnings("ignore")]


@pytest.mark.parametrize("name", [*EVERY_LAW, *MATERIALS])
def test_stage_opens_and_validates(name, surfaces, tmp_path):
    from pxr import Sdr, Usd, UsdShade, UsdValidation

    try:
        text = exporters.export("usd", surfaces[name]).content
    except Refused:
        return
    (tmp_path / "material.usda").write_text(text)
    stage = Usd.Stage.Open(str(tmp_path / "material.usda"))
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 10
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    assert [(each.GetName(), each.GetMessage()) for each in errors] == []
    material = UsdShade.Material(stage.GetDefaultPrim())
    shader = UsdShade.Shader(stage.GetPrimAtPath(f"{stage.GetDefaultPrim().GetPath()}/surface"))
    assert material.ComputeSurfaceSource()[0].GetPath() == shader.GetPath()
    node = Sdr.Registry().GetShaderNodeByIdentifier("UsdPreviewSurface")
    known = {} if node is None else {str(each): node.GetShaderInput(each) for each in node.GetShaderInputNames()}
    for given in shader.GetInputs():
        if known:
            assert given.GetBaseName() in known, f"{given.GetBaseName()} is no input of UsdPreviewSurface"
        values = given.Get()
        for value in values if hasattr(values, "__len__") else [values]:
            assert 0 <= value <= 1

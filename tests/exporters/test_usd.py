"""USD opens every stage and finds no fault; every input name and type is one of the shader's own."""

import pytest

from brdfguide import exporters
from brdfguide.exporters.exporter import Refused

from .conftest import NAMES

pxr = pytest.importorskip("pxr", reason="pip install usd-core: the reader of these exports")
pytestmark = [pytest.mark.validate, pytest.mark.filterwarnings("ignore")]


@pytest.mark.parametrize("name", NAMES)
def test_stage_opens_and_validates(name, of, tmp_path):
    for number, surface in enumerate(of(name)):
        try:
            text = exporters.export("usd", surface).content
        except Refused:
            continue
        (tmp_path / f"{number}.usda").write_text(text)
        check(str(tmp_path / f"{number}.usda"))


def check(path: str) -> None:
    """No validator finds anything; every input is the shader's own and within 0..1."""
    from pxr import Sdr, Usd, UsdShade, UsdValidation

    stage = Usd.Stage.Open(path)
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

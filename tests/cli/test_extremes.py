"""Numbers at and beyond every edge: an answer without inf and nan, or one sentence; no warning, no mistake of ours."""

import re

import pytest

from brdfguide.cli import main

from ..conftest import ROOT

SAMPLE = str(ROOT / "examples" / "rough_plastic.csv")
NUMBERS = [
    "0",
    "-0",
    "90",
    "89.999999",
    "90.0000001",
    "1e-300",
    "1e300",
    "-1e300",
    "inf",
    "nan",
    "-inf",
    "-1",
    "1e-12",
    "180",
    "1e15",
    "1e400",
]
LINES = """
    evaluate lambertian+ggx --theta-i X
    evaluate lambertian+ggx --theta-r X
    evaluate lambertian+ggx --phi X
    evaluate he-torrance --theta-i X --theta-r X
    evaluate he-torrance --wavelength-nm X
    evaluate lambertian --theta-r 0:80:X
    evaluate lambertian --theta-r X:80:10
    evaluate ggx alpha=X
    evaluate ggx n=X
    evaluate ward alpha=X
    evaluate he-torrance sigma=X
    index --f0 X
    index --n X
    index --n 1.5 --k X
    gloss --at-60 X
    gloss --at-20 X --at-60 50 --at-85 80
    gloss --alpha X
    gloss --alpha 0.1 --n X
    gloss --alpha 0.1 --albedo X
    albedo --ratio X --reference 0.5
    albedo --ratio 0.5 --reference X
    albedo --between white black --position X
    roughness --angle X
    roughness --angle 80 --slope X
    roughness --angle 80 --sigma-um X
    roughness --angle 80 --tau-um X
    roughness --angle 80 --wavelength-nm X
    roughness --angle 80 --pupil-mm X
    roughness --angle 80 --distance-mm X
    roughness --sigma-um X --tau-um X
    export --model lambertian+ggx ggx.alpha=X --to glsl -o -
    export --model ggx ggx.n=X --to usd -o -
    export --model lambertian lambertian.albedo=X --to gltf -o -
    export --model he-torrance he-torrance.sigma=X --to osl -o -
    export porcelain --to usd -o - --max-export-error X
    fit SAMPLE --jobs X
    fit SAMPLE -m lambertian --theta-max X
    fit SAMPLE -m lambertian --wavelength X
    fit SAMPLE -m lambertian --aperture-deg X
    fit SAMPLE -m lambertian --fix lambertian.albedo=X
    fit SAMPLE -m lambertian --start lambertian.albedo=X
    preview ggx --size X -o /nowhere/p.png
""".strip().splitlines()


@pytest.mark.parametrize("line", [each.strip() for each in LINES])
def test_extreme_numbers_are_answers_or_sentences(line, capsys):
    for number in NUMBERS:
        words = line.replace("X", number).replace("SAMPLE", SAMPLE).split()
        with pytest.raises(SystemExit) as end:
            main(words)
        out, err = capsys.readouterr()
        assert (end.value.code or 0) in (0, 1, 2) and "mistake of brdfguide" not in err, f"{words}: {err}"
        assert "Warning" not in err, words
        if not end.value.code:
            assert not re.search(r"\b(inf|nan|infinity)\b", out, flags=re.I), words
        else:
            assert err.strip(), words

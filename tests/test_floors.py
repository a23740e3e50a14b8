"""The house rule on imports: a module imports from its own floor or below, members of a folder never each other."""

import ast

import pytest

from .conftest import ROOT

PACKAGE = ROOT / "brdfguide"
FLOORS = tuple(
    set(floor.split())
    for floor in (
        """
        albedo
        aperture
        catalog
        errors
        geometry
        material
        outputs
        roughness
        shelf
        special
        substances
        yaml_schema
        """,
        """
        conventions
        display
        draws
        gloss
        hemisphere
        measurement
        optical_constants
        optics
        quantity
        reciprocity
        reflectance
        retro
        sampling
        simplified
        smoothness
        """,
        """
        formats
        guidelines
        models
        """,
        """
        agreement
        candidates
        compare
        costs
        examine
        tabulated
        fitting
        levenberg
        misfit
        next_measurement
        parts
        picture
        pixels
        predict
        profile
        pruning
        quadrature
        ranking
        reach
        recommend
        saved
        scene
        screens
        search
        stand_ins
        starting
        starts
        weights
        uncertainty
        validation
        waves
        verdict
        """,
        """
        batch
        bench
        check
        exporters
        preview
        audited
        laws
        limits
        references
        report
        """,
        """
        __main__
        cli
        quick
        """,
    )
)
FOLDERS = ("models", "formats", "guidelines", "exporters")


def floor_of(module: str) -> int:
    for level, members in enumerate(FLOORS):
        if module in members:
            return level
    raise AssertionError(f"brdfguide/{module}: say in tests/test_floors.py on which floor it lives")


def imports(path):
    """(line, parts of the module inside the package) of every relative or absolute import of our own."""
    here = path.relative_to(PACKAGE).with_suffix("").parts
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = here[: len(here) - node.level]
            module = tuple(node.module.split(".")) if node.module else ()
            targets = [base + module] if module else [base + (alias.name,) for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and (node.module or "").startswith("brdfguide"):
            targets = [tuple(node.module.split("."))[1:]]
        else:
            continue
        for target in targets:
            if target and target[0] != "__version__":
                yield node.lineno, target


FILES = sorted(p for p in PACKAGE.rglob("*.py") if p.name != "__init__.py" or p.parent != PACKAGE)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_imports_point_down(path):
    here = path.relative_to(PACKAGE).with_suffix("").parts
    for line, target in imports(path):
        assert floor_of(target[0]) <= floor_of(here[0]), f"{path}:{line} imports {'.'.join(target)} from above"
        if here[0] in FOLDERS and target[0] == here[0] and len(target) > 1 and len(here) > 1 and here[-1] != "__init__":
            assert target[1].startswith("_"), f"{path}:{line}: a member imports its sibling {target[1]}"

"""The recipes of docs/farm.md that one machine can run: shards by xargs and by make are what one run makes."""

import os
import shutil
import subprocess
import sys

import pytest

from ..conftest import ROOT
from .test_run import some
from .test_store import content

RECIPES = {
    "xargs": "seq 0 2 | xargs -P 2 -I I {fit} --shard I/3 -q",
    "parallel": "seq 0 2 | parallel -j 2 {fit} --shard {{}}/3 -q",
    "make": "printf 'all: s-0 s-1 s-2\\ns-%%: ; {fit} --shard $*/3 -q\\n' > Makefile && make -s -j 2",
    "snakemake": (
        'printf \'rule all:\\n    input: expand("done/{{i}}", i=range(3))\\nrule shard:\\n'
        '    output: touch("done/{{i}}")\\n    shell: "{fit} --shard {{wildcards.i}}/3 -q"\\n\' > Snakefile'
        " && snakemake --cores 2 --quiet"
    ),
}


@pytest.mark.skipif(os.name == "nt", reason="a POSIX shell")
@pytest.mark.parametrize("tool", RECIPES)
def test_shards_by_other_peoples_engines_are_what_one_run_makes(tool, tmp_path):
    if shutil.which(tool) is None:
        pytest.skip(f"{tool} is not installed")
    files = [some(tmp_path, f"{part}.csv", part) for part in range(6)]
    (tmp_path / "list").write_text("".join(f"{file}\n" for file in files))
    fit = f"{sys.executable} -m brdfguide fit --files-from list -m lambertian --no-timing"
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    for line in (f"{fit} --out one", RECIPES[tool].format(fit=f"{fit} --out shards")):
        subprocess.run(
            line, shell=True, check=True, cwd=tmp_path, env=environment, stdout=subprocess.DEVNULL, timeout=300
        )
    assert content(tmp_path / "one") == content(tmp_path / "shards") and len(content(tmp_path / "one")) == 6

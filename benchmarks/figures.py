"""Every figure of every example and given file, of every shipped material and of the guide, looked at by the probe.

Run as `python benchmarks/figures.py [FILE...]` in the source's root; given files lie in the folder named by
BRDFGUIDE_DATA. The tests look at a sample of these. Prints a line for each source with its faults; exit status 1 if
there is one. Candidates stand at their start values: what is looked at are the figures, not the fits.
"""

import sys
from pathlib import Path

import numpy as np
from given_tables import DATA, ROOT

sys.path.insert(0, str(ROOT))

from brdfguide.advice import library, material, recommend
from brdfguide.data import examine, formats
from brdfguide.errors import InputError, NoAnswer
from brdfguide.report.figures import beta, inspection, lobe_views, paper, promises, style
from brdfguide.report.figures import ranking as drawing
from tests.report import probe, test_eye

MEASURED = (".csv", ".binary", ".brdf", ".dat", ".bsdf", ".txt", ".anisotropicbsdf")
kept: list = []


def main(words: list[str]) -> int:
    """The exit status."""
    style.save = _keep
    files = [Path(word) for word in words] or sorted((ROOT / "examples").glob("*.csv")) + sorted(
        path for path in DATA.glob("*/*") if path.suffix in MEASURED and "LICENSE" not in path.name
    )
    bad = figures = sources = 0
    for file in files:
        kept.clear()
        try:
            _of_measurement(formats.read(file))
        except (InputError, NoAnswer) as refused:
            print(f"{file.name}: {str(refused).splitlines()[0][:90]}", flush=True)
            continue
        bad, figures, sources = bad + _told(file.name), figures + len(kept), sources + 1
    for name in () if words else library.library_names():
        kept.clear()
        found = recommend.recommend(material.read_material(library.path(name)))
        if found.candidates:
            kept.append(promises.promised(found.candidates, name=name))
        bad, figures, sources = bad + _told(name), figures + len(kept), sources + 1
    for number in () if words else paper.TITLES:
        kept.clear()
        needed = paper.SAMPLES.get(number)
        sample = formats.read(ROOT / "examples" / needed[0]) if needed else None
        kept.append(paper.plot_figure(number, sample, "here"))
        bad, figures, sources = bad + _told(f"Figure {number}"), figures + 1, sources + 1
    print(f"{figures} figures of {sources} sources, {bad} with faults")
    return int(bad > 0)


def _keep(figure, path, theme="light") -> None:
    kept.append(figure)


def _of_measurement(measurement) -> None:
    rows = test_eye.ranking(measurement) if measurement.usable.any() else None  # without a value there is no fit
    drawn = (drawing.plot_ranking, lobe_views.plot_polar, beta.plot_beta, lobe_views.plot_in_space)
    for draw in () if rows is None else drawn:
        try:
            draw(rows, measurement, Path("it.png"))
        except (InputError, NoAnswer) as refused:
            print(f"    {draw.__name__}: {str(refused).splitlines()[0][:90]}")
    looked_at, spiky, pairs, level = examine.plotted(measurement)
    inspection.plot_survey(looked_at, np.asarray(spiky), pairs, level, Path("it.png"), measurement.name)


def _told(name: str) -> int:
    """How many of the kept figures have faults."""
    found = [probe.faults(figure) for figure in kept]
    print(f"{name}: {len(kept)} figures" + "".join(f"\n    {fault}" for each in found for fault in each), flush=True)
    return sum(map(bool, found))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

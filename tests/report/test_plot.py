"""The figures of a ranking: what is drawn, from which directions, and files that come out the same twice."""

from types import SimpleNamespace

import numpy as np
import pytest

from brdfguide import files, models
from brdfguide.data.measurement import Measurement
from brdfguide.errors import InputError
from brdfguide.models.surface import Surface
from brdfguide.physics.geometry import Geometry, in_plane, rows
from brdfguide.report.figures import cost, dark, lobes, palette, panels, style
from brdfguide.report.figures import lines as figure_lines
from brdfguide.report.figures import ranking as plot

from .probe import faults

TRUE = {"lambertian.albedo": np.array([0.4, 0.5]), "ward.rho_s": np.array([0.1, 0.1]), "ward.alpha": 0.2}


def scan(angles=(10.0, 30.0, 45.0, 60.0, 75.0)) -> Measurement:
    """A two-channel scan in the plane of incidence, made by lambertian+ward."""
    theta_i, theta_r = np.meshgrid(angles, np.arange(-80, 81, 5.0), indexing="ij")
    geom = rows(in_plane(theta_i, theta_r, np.array([0.45, 0.55])))
    return Measurement(geom, models.get("lambertian+ward")(geom, TRUE), ("450nm", "550nm"))


def row(name, rms_ln, ns, on_front, values=None):
    model = models.get(name)
    return SimpleNamespace(
        fit=SimpleNamespace(
            name=name,
            surface=Surface(model, values or model.defaults(), ("450nm", "550nm"), np.array([0.45, 0.55])),
        ),
        rms_ln=rms_ln,
        ns_per_sample=ns,
        on_front=on_front,
    )


def ranking(times=True):
    rows_ = [
        row("lambertian+ward", 0.01, 30, True, TRUE),
        row("ward", 0.4, 20, True),
        row("lambertian", 0.6, 25, False),
    ]
    for each in rows_:
        each.ns_per_sample = each.ns_per_sample if times else None
    return SimpleNamespace(rows=rows_)


@pytest.mark.parametrize("suffix", files.PICTURES)
def test_a_figure_is_the_same_file_each_time(tmp_path, suffix):
    first, second = tmp_path / f"a.{suffix}", tmp_path / f"b.{suffix}"
    plot.plot_ranking(ranking(), scan(), first)
    plot.plot_ranking(ranking(), scan(), second)
    assert first.read_bytes() == second.read_bytes()
    assert list(tmp_path.glob(".*")) == []


def test_an_unknown_kind_of_picture_is_refused_before_drawing(tmp_path):
    with pytest.raises(InputError, match="no kind of picture called 'jpg'; .*there are: png, svg, pdf"):
        plot.plot_ranking(ranking(), scan(), tmp_path / "a.jpg")


def test_a_folder_that_is_not_there_is_named(tmp_path):
    with pytest.raises(InputError, match="cannot write .*nowhere"):
        plot.plot_ranking(ranking(), scan(), tmp_path / "nowhere" / "a.svg")


def test_panels_are_the_least_the_middle_and_the_largest_incidence():
    found = panels.panels(scan(), 0)
    assert [each.theta_i for each in found.shown] == [10, 45, 75] and found.how == "in plane"


def ggx(geom):
    return models.get("lambertian+ggx")(geom, {"lambertian.albedo": 0.3, "ggx.alpha": 0.15})


def scattered(count=6000, widest=85.0) -> Measurement:
    rng = np.random.default_rng(1)
    theta_i, theta_r, phi = rng.uniform(5, 80, count), rng.uniform(0, widest, count), rng.uniform(0, 360, count)
    geom = rows(Geometry.from_degrees(theta_i, 0.0, theta_r, phi, np.array([0.55])))
    return Measurement(geom, ggx(geom))


def table() -> Measurement:
    """Half-vector angles as MERL's tables have them, every second one."""
    tilt, apart, turn = np.meshgrid(np.arange(1, 90, 2) ** 2 / 90, np.arange(1, 90, 2), np.arange(1, 180, 4.0))
    h, d, p = np.radians(tilt.ravel()), np.radians(apart.ravel()), np.radians(turn.ravel())
    difference = np.stack([np.sin(d) * np.cos(p), np.sin(d) * np.sin(p), np.cos(d)], axis=-1)

    def about(v):
        x, y, z = np.moveaxis(v, -1, 0)
        return np.stack([np.cos(h) * x + np.sin(h) * z, y, np.cos(h) * z - np.sin(h) * x], axis=-1)

    i, r = about(difference), about(difference * [-1, -1, 1])
    lit = (i[:, 2] > 0.02) & (r[:, 2] > 0.02)
    geom = rows(Geometry.from_vectors(i[lit], r[lit], np.array([0.55])))
    return Measurement(geom, ggx(geom))


@pytest.mark.parametrize("data, typical, worst", [(table(), 0.01, 0.1), (scattered(20_000), 0.03, 0.5)])
def test_tables_and_scattered_directions_are_sliced_at_10_45_and_75_degrees(data, typical, worst):
    """The slice is the law itself, interpolated; and it holds directions on both sides of the normal."""
    found = panels.panels(data, 0)
    assert [each.theta_i for each in found.shown] == [10, 45, 75] and found.how == "interpolated into the plane"
    for each in found.shown:
        off = np.abs(np.log(each.value / ggx(each.geom)[:, 0]))
        assert np.median(off) < typical and off.max() < worst
        assert len(each.value) > 100 and each.theta_r.min() < -45 and each.theta_r.max() > 60


def test_a_slice_ends_where_the_data_end():
    for each in panels.panels(scattered(6000, widest=40.0), 0).shown:
        assert np.abs(each.theta_r).max() < 48


def test_a_slice_of_two_phase_angles_stays_by_them_and_extrapolates_nothing():
    """As photographs have them: half the phase is the difference angle, 20° and 55°, to 0.3°; noise of 2 %."""
    rng, count = np.random.default_rng(3), 900
    tilt, turn = np.radians(rng.uniform(0, 50, count)), rng.uniform(0, 2 * np.pi, count)
    half = np.stack([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=-1)
    apart = np.radians(rng.choice([20.0, 55.0], count) + rng.uniform(-0.3, 0.3, count))
    around = rng.normal(size=(count, 3))
    across = np.cross(half, around)
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    i = np.cos(apart)[:, None] * half + np.sin(apart)[:, None] * across
    r = 2 * np.cos(apart)[:, None] * half - i
    up = (i[:, 2] > 0.05) & (r[:, 2] > 0.05)
    geom = rows(Geometry.from_vectors(i[up], r[up], np.array([0.55])))
    noisy = ggx(geom) * np.exp(rng.normal(0, 0.02, (len(geom), 1)))
    for each in panels.panels(Measurement(geom, noisy), 0).shown:
        theta_d = np.degrees(np.arccos(each.geom.cos_d[:, 0]))
        assert np.minimum(np.abs(theta_d - 20), np.abs(theta_d - 55)).max() <= panels.BEYOND + 0.5
        off = np.abs(np.log(each.value / ggx(each.geom)[:, 0]))
        assert np.median(off) < 0.06 and off.max() < 0.15


def test_directions_far_from_the_plane_are_drawn_over_the_half_vector():
    geom = rows(Geometry.from_degrees(np.full(30, 40.0), 0.0, np.linspace(30, 60, 30), 90.0, np.array([0.55])))
    data = Measurement(geom, ggx(geom))
    assert panels.panels(data, 0).shown == ()
    axis = lobes.plot_lobes([], data).axes[0]
    assert len(axis.lines[0].get_xdata()) == 30 and "half vector" in axis.get_xlabel()


def test_a_mirror_image_stands_above_the_lobe_as_a_receiver_reads_it():
    values = {"he-torrance.sigma": 0.02, "he-torrance.slope": 0.02, "he-torrance.n": 1.5, "he-torrance.k": 0.0}
    surface = Surface(models.get("he-torrance"), {**models.get("he-torrance").defaults(), **values})
    line = figure_lines.Line("he-torrance", surface, None)
    at = np.array([45.0, 45.9, 46.1])
    drawn = figure_lines.curve(line, 0, 45.0, at)
    reflected = surface.mirror(rows(in_plane(45.0, 45.0)))[0, 0]
    cone = 2 * np.pi * (1 - np.cos(np.radians(1.0)))
    lobe = surface.brdf(rows(in_plane(45.0, at)))[:, 0]
    np.testing.assert_allclose(drawn[:2] - lobe[:2], reflected / (np.cos(np.pi / 4) * cone), rtol=1e-4)
    assert drawn[2] == lobe[2]


def test_a_law_looks_the_same_whatever_else_is_drawn():
    alone = figure_lines.Line("lambertian+ggx", Surface(models.get("lambertian+ggx"), {}), 0.1)
    assert alone.stroke == palette.stroke("ggx", "lambertian+ggx")
    assert alone.stroke.colour == "#56B4E9"  # for ever


def test_laws_that_stand_in_one_figure_have_colours_of_their_own():
    facets = ("ggx", "beckmann", "cook-torrance", "student-t")
    laws = ("phong", "ward", "lafortune", "he-torrance", *facets)
    hue = {law: palette.stroke(law, law).colour for law in (*laws, "phong-lewis", "blinn", "ward-gmd", "ward-duer")}
    assert len({hue[law] for law in laws}) == len(laws)
    assert hue["phong"] == hue["phong-lewis"] == hue["blinn"] and hue["ward"] == hue["ward-gmd"] == hue["ward-duer"]
    for law in facets:
        sums = [palette.stroke(law, name).dashes for name in (f"lambertian+{law}", f"{law} (metal)")]
        assert len(set(sums)) == 2


def test_a_dark_figure_has_no_ink_and_no_paper_left():
    fig = cost.plot_cost(figure_lines.lines_of(ranking()))
    light, dark_ = style.figure_file(fig, "svg").decode(), style.figure_file(fig, "svg", "dark").decode()
    for old in (palette.INK, palette.PAPER):
        assert old in light and old not in dark_
        assert palette.SWAPPED[old] in dark_
    assert dark.SWAPPED is palette.SWAPPED


def test_the_channel_drawn_is_the_one_nearest_550_nm_that_has_values():
    full = scan()
    assert figure_lines.nominal_channel(full) == 1
    empty = full.brdf.copy()
    empty[:, 1] = np.nan
    assert figure_lines.nominal_channel(Measurement(full.geom, empty, full.channels)) == 0


def test_the_line_drawn_is_the_model_itself():
    line = figure_lines.lines_of(ranking())[0]
    drawn = figure_lines.curve(line, 1, 45.0, np.array([50.0]))
    geom = in_plane(45, 50)
    expected = models.term("lambertian")(geom, albedo=0.5) + models.term("ward")(geom, rho_s=0.1, alpha=0.2)
    np.testing.assert_allclose(drawn[0], expected, rtol=1e-14)


def test_many_models_are_drawn_as_the_best_and_the_reports_families():
    names = [
        "lambertian+ggx",
        "lambertian+beckmann",
        "lambertian+ward-gmd",
        "lambertian+lafortune:2",
        "ward",
        "lambertian+ward",
        "phong-lewis",
        "phong",
    ]
    lines = [figure_lines.Line(name, Surface(models.get(name), {}), 0.1) for name in names]
    best = ["lambertian+ggx", "lambertian+ward-gmd", "lambertian+lafortune:2", "phong-lewis"]
    assert [line.name for line in figure_lines.shown_lines(lines)] == best


def test_without_times_the_errors_are_drawn_alone(tmp_path):
    plot.plot_ranking(ranking(times=False), scan(), tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_no_point_and_no_name_lies_outside_the_frame():
    fig = cost.plot_cost(figure_lines.lines_of(ranking()))
    fig.draw_without_rendering()
    frame = fig.axes[0].get_window_extent()
    for text in fig.axes[0].texts:
        box = text.get_window_extent()
        assert frame.x0 <= box.x0 and box.x1 <= frame.x1 and frame.y0 <= box.y0 and box.y1 <= frame.y1, text.get_text()


CROWD = {
    "lambertian": (12, 0.66), "oren-nayar": (12.1, 0.66), "lambertian+phong-lewis": (17.2, 0.51),
    "lambertian+blinn": (18.6, 0.51), "lambertian+phong": (21.9, 0.358), "lambertian+ward": (19.4, 0.335),
    "lambertian+ward-gmd": (16, 0.173), "lambertian+lafortune": (41, 0.15), "lambertian+ggx": (49, 0.094),
    "oren-nayar+ggx": (68, 0.094), "lambertian+lafortune:2": (43, 0.0748), "lambertian+cook-torrance": (64, 0.0718),
    "lambertian+beckmann": (83, 0.066), "lambertian+student-t": (193, 0.065), "lambertian+he-torrance": (370, 0.0693),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2])
def test_names_of_fifteen_models_close_together_do_not_meet(seed):
    """Times and errors of the rough plastic, and others drawn at random about its times."""
    rng = np.random.default_rng(seed)
    lines = []
    for name, (ns, error) in CROWD.items():
        if seed is not None:
            ns, error = ns * np.exp(rng.normal(0, 0.15)), 0.05 * np.exp(rng.gamma(1.2, 0.7))
        surface = Surface(models.get(name), {})
        lines.append(figure_lines.Line(name, surface, error, ns, True, recommended=name == "lambertian+cook-torrance"))
    fig = cost.plot_cost(lines)
    assert faults(fig) == []
    named = {text.get_text() for text in fig.axes[0].texts}
    assert "lambertian+cook-torrance" in named and len(named) >= 12


@pytest.mark.parametrize("errors", [(0.75, 1.13), (0.056, 0.061), (0.07, 2.2)])
def test_an_axis_of_errors_has_at_least_two_numbers(errors):
    lines = [
        figure_lines.Line(name, Surface(models.get(name), {}), error, ns, True)
        for name, error, ns in zip(("ward", "ggx"), errors, (50, 20), strict=True)
    ]
    axis = cost.plot_cost(lines).axes[0]
    low, high = axis.get_ylim()
    assert np.count_nonzero((axis.get_yticks() >= low) & (axis.get_yticks() <= high)) >= 2


def test_names_of_thirty_models_without_times_do_not_meet():
    lines = [
        figure_lines.Line(f"{name} {times}", Surface(models.get(name), {}), times * error, None, True)
        for name, (_, error) in CROWD.items()
        for times in (1, 2)
    ]
    assert faults(cost.plot_cost(lines)) == []
    fig = cost.plot_cost(lines)
    fig.draw_without_rendering()
    boxes = [label.get_window_extent() for label in fig.axes[0].get_yticklabels()]
    assert len(boxes) == len(lines) > 25 and not any(a.overlaps(b) for a, b in zip(boxes, boxes[1:], strict=False))

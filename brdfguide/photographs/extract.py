"""From a plan and its pictures to BRDF values: the ball found, the lamp found, each pixel a value, gathered in cells.

    f(i, r) = (albedo_ref/π) P/P_ref     at the same pixel

so that the lamp's strength and colour, 1/distance², cos θi, vignetting and exposure cancel.

Source: Marschner, Westin, Lafortune and Torrance 2000, "Image-based bidirectional reflectance distribution function
measurement", Applied Optics 39; Matusik et al. 2003, "A data-driven reflectance model".
"""

from dataclasses import replace
from math import pi

import numpy as np

from ..errors import InputError
from ..finding import Finding
from ..numerics.least_squares import minimise
from ..physics.directions import FIELDS, Directions
from ..records import dataclass
from . import faults
from .cells import Cells, gather, gather_blocks, highlight_alpha
from .lamp import LIMB_PX, phase_deg, shading_residuals
from .outline import Outline, find_outline, limb_near, through
from .picture import Exposure, Photograph, Window, clip_level
from .plan import Plan, Shot
from .readers import read_picture
from .rod_outline import LEANS_PX, find_rod
from .sight import NEAR_WHITE, Sight, sight, sparkle
from .solids import Pinhole, Points, plate_points, points
from .unnoticed import Changed, Doubts, in_all_shots, shot_changes, unseen_finding

MOST_ACROSS = 1200  # blocks of pixels across the sample; finer pictures are averaged to it
HALF_QUANTUM = 2.0**-10  # relative step of a half float
FLOAT_QUANTUM = 1e-3
GUESSED_BODY = 0.3  # albedo of the body where the level is not known, so that laws with bounds can be fitted at all
MOST_MOVED_PX = 0.5  # from the limb
OFF_PX = 1.0  # between the stated outline and the limb
OFF_SHARE = 0.02  # of a rod's half width, by which its stated outline may differ from what its shading tells


@dataclass(frozen=True, eq=False)
class Extract:
    """Values (n, 3) [1/sr] with standard errors and directions, what was noticed, and the shots pixel by pixel."""

    directions: Directions
    f: np.ndarray
    stderr: np.ndarray
    findings: tuple[Finding, ...]
    sights: tuple[Sight, ...]
    changed: tuple[Changed, ...] = ()  # how the values would read under faults that are not noticed


def extract(plan: Plan) -> Extract:
    """Reads the pictures of a plan and measures them.

    Raises InputError for a picture that cannot be read, that does not match its reference, or without a usable pixel.
    """
    pairs = [_pictures(plan, shot) for shot in plan.shots]
    findings = [note for pair in pairs for picture in pair if picture is not None for note in picture.findings]
    if plan.solid == "flat":
        return _of_plate(plan, pairs, findings)
    if plan.solid == "cylinder":
        plan, outline, of_outline = _rod(plan, pairs)
    else:
        outline, of_outline = _outline(plan, pairs)
    view = Pinhole(outline.centre, outline.radius, plan.distance)
    findings += of_outline
    if not np.isfinite(plan.distance):
        text = "the camera is taken as infinitely far away"
        consequence = "24 radii taken as far make alpha 1 to 5 % too large and n up to 0.02"
        findings.append(Finding("camera-far", text, "warning", consequence))
    sights, cells, blocks, changed, unsure = [], [], [], [], []
    for shot, (sample, reference) in zip(plan.shots, pairs, strict=True):
        window = _window(plan, outline, sample)
        seen, doubts, found = _sight(plan, shot, sample, reference, view, window)
        sights.append(seen)
        cells.append(gather(seen.points[seen.used], seen.f, seen.lamp))
        changed.append(shot_changes(seen, cells[-1], doubts, window.block, plan.solid, view))
        unsure.append(doubts)
        blocks.append(window.block)
        findings += found
    findings += faults.phases_finding([phase_deg(seen.lamp) for seen in sights])
    alphas = [highlight_alpha(each, seen.lamp) for each, seen in zip(cells, sights, strict=True)]
    alpha = min((each for each in alphas if each is not None), default=None)
    findings += faults.width_findings(alpha, view, max(blocks), plan.lamp_half_deg)
    findings += [_broad_band(), unseen_finding(unsure)]
    return _together(plan, cells, sights, changed, findings)


def _of_plate(plan: Plan, pairs, findings: list[Finding]) -> Extract:
    """The same of a flat sample under a moved lamp: no outline, and no shading to find the lamp from."""
    sights, cells, phases, changed = [], [], [], []
    for shot, (sample, reference) in zip(plan.shots, pairs, strict=True):
        assert shot.lamp is not None and plan.width_mm is not None and plan.patch_px is not None
        window = _patch_window(plan.patch_px, sample)
        x, y = window.middles()
        grid = plate_points(plan.distance, plan.camera_angle_deg, plan.width_mm, sample.size, x[None, :], y[:, None])
        light, clipped = sample.reduced(window)
        of_reference = None
        if reference is not None:
            of_reference, clipped_too = reference.reduced(window)
            clipped = clipped | clipped_too
        unit, exposed = _unit_light(plan, shot, sample, reference, of_reference, grid, shot.lamp)
        inside = np.full(clipped.shape, np.inf)
        label = shot.file.name
        seen = sight(
            label, light, of_reference, unit, grid, inside, shot.lamp, clipped, plan.theta_max_deg, sample.least
        )
        if not seen.used.any():
            raise InputError(f"{sample.name}: no usable pixel in patch_px; wanted a lit sample, not clipped")
        sights.append(seen)
        cells.append(gather_blocks(seen.points, seen.f, seen.used))
        changed.append(shot_changes(seen, cells[-1], Doubts(), window.block))
        between = np.sum(grid.toward_lamp(shot.lamp) * grid.toward, axis=-1)
        phases.append(float(np.degrees(np.arccos(np.clip(between, -1, 1))).mean()))
        count = int(np.count_nonzero(seen.clipped))
        findings += exposed
        findings += faults.pixel_findings(label, count, seen.hot, seen.missing, seen.used.size, sparkle(seen))
    findings += faults.phases_finding(phases)
    findings += [_broad_band(), unseen_finding([Doubts()])]
    return _together(plan, cells, sights, changed, findings)


def _patch_light(patch, sample: Photograph) -> np.ndarray:
    """(3,): mean light of a patch of the chart."""
    light, clipped = sample.reduced(_patch_window(patch, sample, "chart_px"))
    if clipped.any():
        raise InputError(f"{sample.name}: the patch at chart_px is clipped: expose less")
    mean = light.reshape(-1, 3).astype(float).mean(axis=0)
    if not np.all(np.isfinite(mean) & (mean > 0)):
        raise InputError(f"{sample.name}: the patch at chart_px holds no light")
    return mean


def _patch_window(patch, sample: Photograph, key: str = "patch_px") -> Window:
    left, top, width, height = (int(each) for each in patch)
    columns, rows = sample.size
    if width < 2 or height < 2 or left + width > columns or top + height > rows:
        raise InputError(f"{sample.name}: {key} lies outside its {columns} x {rows} pixels, or is no area")
    block = max(1, -(-max(width, height) // MOST_ACROSS))
    return Window(left, top, width // block, height // block, block)


def _broad_band() -> Finding:
    text = "a camera's channels are broad: each is taken at one wavelength"
    return Finding("broad-band", text, consequence="He-Torrance and the index of each channel are approximate")


def _together(
    plan: Plan, cells: list[Cells], sights: list[Sight], changed: list[list[Changed]], findings: list[Finding]
) -> Extract:
    directions = [each.points.directions(seen.lamp) for each, seen in zip(cells, sights, strict=True)]
    fields = {name: np.concatenate([getattr(each, name) for each in directions]) for name in FIELDS}
    f = np.concatenate([each.f for each in cells])
    stderr = np.concatenate([each.stderr for each in cells])
    if plan.reference_albedo is None and plan.chart_albedo is None:
        scale = GUESSED_BODY / pi / np.nanmedian(f)
        f, stderr = scale * f, scale * stderr
        text = f"no reference: the level is not known, and was set so that the body's albedo is {GUESSED_BODY:g}"
        consequence = "shapes hold (which lobe, alpha); albedo, n and every amplitude mean nothing"
        findings.append(Finding("level-unknown", text, "warning", consequence))
    return Extract(Directions(**fields), f, stderr, tuple(findings), tuple(sights), in_all_shots(changed, directions))


# --- reading ----------------------------------------------------------------------------------------------


def _pictures(plan: Plan, shot: Shot) -> tuple[Photograph, Photograph | None]:
    sample = _unclipped(read_picture(shot.file, plan.transfer))
    if shot.reference is None:
        return sample, None
    reference = _unclipped(read_picture(shot.reference, plan.transfer))
    if sample.size != reference.size:
        sizes = " and ".join(f"{columns} x {rows}" for columns, rows in (sample.size, reference.size))
        raise InputError(f"{sample.name} and its reference {reference.name} differ in size: {sizes} pixels")
    return sample, reference


def _unclipped(picture: Photograph) -> Photograph:
    """The picture with its white where its codes were cut off, if that is below the file's."""
    whole = picture.codes.dtype.kind == "u"
    quantum = HALF_QUANTUM if picture.codes.dtype == np.float16 else FLOAT_QUANTUM
    level = np.inf
    for channel in range(3):
        codes = picture.codes[..., channel]
        top = float(np.max(codes, where=np.isfinite(codes), initial=0)) if not whole else float(codes.max())
        near = codes[codes >= 0.9 * top].astype(float)
        level = min(level, clip_level(near[np.isfinite(near)], 2 / top if whole and top > 0 else quantum))
    return replace(picture, white=min(picture.white, NEAR_WHITE * level))


def _exposure(stated: Exposure, picture: Photograph) -> Exposure:
    """What the description says, and EXIF where it says nothing."""
    exif = picture.exposure
    pairs = {name: getattr(stated, name) or getattr(exif, name) for name in ("seconds", "iso", "f_number")}
    return Exposure(**pairs)


# --- the outline ------------------------------------------------------------------------------------------


def _outline(plan: Plan, pairs) -> tuple[Outline, list[Finding]]:
    references = list({id(each): each for _, each in pairs if each is not None}.values())
    if plan.outline is not None:
        return plan.outline, _against_limb(plan.outline, references)
    shown = references or [sample for sample, _ in pairs]
    _check_one_size(plan, shown)
    circles, limbs = zip(*(find_outline(picture) for picture in shown), strict=True)
    outline, _ = through(np.concatenate(limbs))
    outline = _by_shading(plan, outline, references)
    apart = max(circle.off_px(limb) for circle in circles for limb in limbs)
    text = (
        f"the ball's outline was found at ({outline.x:.1f}, {outline.y:.1f}) px, radius {outline.radius:.1f} px, "
        f"scattering by {outline.rms_px:.2f} px"
    )
    numbers = (("x_px", outline.x), ("y_px", outline.y), ("radius_px", outline.radius))
    found = [Finding("outline-found", text, numbers=numbers)]
    if apart > max(OFF_PX, 0.01 * outline.radius):
        found.append(_outline_differs(f"the pictures show the ball up to {apart:.1f} px apart", apart))
    return outline, found


def _check_one_size(plan: Plan, pictures) -> None:
    if len({picture.size for picture in pictures}) > 1:
        raise InputError(f"{plan.name}: the pictures differ in size; wanted one camera that stands still")


def _rod(plan: Plan, pairs) -> tuple[Plan, Outline, list[Finding]]:
    """The plan with a rod's rows, its outline (compared with what is stated), and what was noticed."""
    references = [reference for _, reference in pairs if reference is not None]
    if not references:
        assert plan.outline is not None
        return plan, plan.outline, []
    _check_one_size(plan, references)
    lamps = [shot.lamp for shot, (_, reference) in zip(plan.shots, pairs, strict=True) if reference is not None]
    try:
        found, rows, leans = find_rod(references, lamps, plan.distance)
    except InputError:
        if plan.outline is None:
            raise
        return plan, plan.outline, []
    notes = []
    if leans > LEANS_PX:
        notes.append(_outline_differs(f"the rod leans: its edge stands {leans:.1f} px apart above and below", leans))
    if plan.outline is not None:
        off = abs(found.x - plan.outline.x) + abs(found.radius - plan.outline.radius)
        if off > max(OFF_PX, OFF_SHARE * found.radius):
            notes.append(_outline_differs(f"the reference's shading puts the rod {off:.1f} px off its outline", off))
        return plan, plan.outline, notes
    text = (
        f"the rod's outline was found: middle at {found.x:.1f} px, half width {found.radius:.1f} px, rows "
        f"{rows[0]:.0f} to {rows[1]:.0f}; the camera is taken to be at the height of the picture's middle"
    )
    numbers = (("x_px", found.x), ("y_px", found.y), ("radius_px", found.radius))
    rows = rows if plan.rows_px is None else plan.rows_px
    return replace(plan, rows_px=rows), found, [Finding("outline-found", text, numbers=numbers), *notes]


def _against_limb(outline: Outline, references) -> list[Finding]:
    limbs = [limb_near(picture, replace(outline, rms_px=0.0)) for picture in references]
    off = max((outline.off_px(limb) for limb in limbs if len(limb) > 40), default=0.0)
    if off <= OFF_PX:
        return []
    return [_outline_differs(f"the limb of the reference lies {off:.1f} px off the stated outline", off)]


def _outline_differs(text: str, off: float) -> Finding:
    consequence = "a centre 4 px off (of 240) makes alpha 4 to 15 % too large"
    return Finding("outline-differs", text, "warning", consequence, numbers=(("off_px", off),))


def _by_shading(plan: Plan, outline: Outline, references) -> Outline:
    """The outline moved so that the shading inside is that of a sphere under one lamp, as far as the limb allows."""
    if not references:
        return outline
    grids = []
    for picture in references:
        window = _window(plan, outline, picture, most=200)
        light, clipped = picture.reduced(window)
        x, y = window.middles()
        inside = (np.hypot(x - outline.x, (y - outline.y)[:, None]) < 0.93 * outline.radius) & ~clipped
        row, column = np.nonzero(inside & np.isfinite(light).all(-1))
        grids.append((x[column], y[row], light[row, column].mean(-1)))

    def residuals(moved) -> np.ndarray:
        view = Pinhole((outline.x + moved[0], outline.y + moved[1]), outline.radius + moved[2], plan.distance)
        parts = [shading_residuals(points("sphere", view, x, y), grey) for x, y, grey in grids]
        return np.concatenate([*parts, moved / LIMB_PX])

    def with_slopes(shared, per_channel, slopes):
        here = residuals(shared)
        if not slopes:
            return here[:, None]
        step = 0.02
        columns = [(residuals(shared + step * axis) - here) / step for axis in np.eye(3)]
        return here[:, None], np.stack(columns, -1)[None], np.zeros((1, len(here), 0))

    x, y, r = minimise(with_slopes, np.zeros(3), low=-MOST_MOVED_PX, high=MOST_MOVED_PX, tolerance=1e-3, most=5).shared
    return replace(outline, x=outline.x + float(x), y=outline.y + float(y), radius=outline.radius + float(r))


# --- one shot ---------------------------------------------------------------------------------------------


def _window(plan: Plan, outline: Outline, picture: Photograph, most: int = MOST_ACROSS) -> Window:
    half = outline.radius + 2
    centre, height = outline.centre, half
    if plan.rows_px is not None:
        low, high = sorted(plan.rows_px)
        centre, height = (outline.x, (low + high) / 2), (high - low) / 2
    window = Window.around(centre, half, height, picture.size, most)
    if min(window.rows, window.columns) < 8:
        raise InputError(f"{picture.name}: the outline lies outside the picture, or is smaller than 8 pixels")
    return window


def _sight(plan: Plan, shot: Shot, sample: Photograph, reference: Photograph | None, view: Pinhole, window: Window):
    """The shot pixel by pixel, and what was noticed."""
    x, y = window.middles()
    grid = points(plan.solid, view, x[None, :], y[:, None])
    rim = _inside(plan, view, x, y) / window.block
    light, clipped = sample.reduced(window)
    label = shot.file.name
    found: list[Finding] = []
    of_reference, lamp, doubts = None, shot.lamp, Doubts()
    if reference is not None:
        of_reference, clipped_too = reference.reduced(window)
        sound = (rim > 2) & np.isfinite(of_reference).all(-1) & ~clipped_too & np.isfinite(grid.cos_r)
        if np.count_nonzero(sound) < 100:
            raise InputError(f"{reference.name}: hardly any pixel of the reference is usable: expose less")
        grey = of_reference[sound].mean(-1).astype(float)
        shown, found = faults.reference_findings(label, grid[sound], grey, lamp)
        doubts = Doubts.by_reference(grid[sound], grey, shown, lamp)
        lamp = shown.position if lamp is None else lamp
        clipped = clipped | clipped_too
    assert lamp is not None
    unit, exposed = _unit_light(plan, shot, sample, reference, of_reference, grid, lamp)
    label = f"{label}, phase {phase_deg(lamp):.0f} degrees"
    seen = sight(label, light, of_reference, unit, grid, rim, lamp, clipped, plan.theta_max_deg, sample.least)
    if np.count_nonzero(seen.used) < 50:
        raise InputError(
            f"{sample.name}: {np.count_nonzero(seen.used)} usable pixels; wanted a lit sample, not clipped"
        )
    surface = int(np.count_nonzero(rim > 2))
    count = int(np.count_nonzero(seen.clipped))
    pixels = faults.pixel_findings(label, count, seen.hot, seen.missing, surface, sparkle(seen))
    return seen, doubts, [*found, *exposed, *pixels]


def _inside(plan: Plan, view: Pinhole, x, y) -> np.ndarray:
    """Distance inside the outline [px], (rows, columns)."""
    across = np.abs(x - view.centre_px[0])[None, :]
    if plan.solid == "cylinder":
        return np.broadcast_to(view.radius_px - across, (len(y), len(x)))
    return view.radius_px - np.hypot(across, (y - view.centre_px[1])[:, None])


def _unit_light(plan: Plan, shot: Shot, sample, reference, of_reference, grid: Points, lamp):
    """Light (rows, columns, 3) that a BRDF of 1/sr would have sent, and notes on the exposure.

    Without a reference in the sample's place: that of a patch that faces the lamp, in parts of its albedo/π; without
    one either, in an unknown unit.
    """
    if of_reference is None or plan.reference_albedo is None:
        irradiance = np.repeat(grid.irradiance(lamp)[..., None], 3, axis=-1)
        if shot.chart_px is None or plan.chart_albedo is None:
            return irradiance, []
        return irradiance * (_patch_light(shot.chart_px, sample) * pi / plan.chart_albedo), []
    ratio, untold = _exposure(shot.exposure, sample).over(_exposure(shot.reference_exposure, reference))
    found = []
    if untold:
        text = f"{shot.file.name}: only one of sample and reference states its {' and '.join(untold)}: taken as equal"
        found.append(Finding("exposure", text, "warning", "the level is wrong by their ratio"))
    if ratio != 1:
        text = f"{shot.file.name}: exposed {ratio:.4g} times as much as its reference: allowed for"
        found.append(Finding("exposure", text, numbers=(("ratio", ratio),)))
    return of_reference * (pi * ratio / plan.reference_albedo), found

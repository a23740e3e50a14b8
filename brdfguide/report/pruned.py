"""What a scene does not need, as one dict for programs and as text for people."""

from math import degrees

from ..parts import Cut
from ..picture import Errors
from ..pruning import Pruned, Single
from ..search import Candidate
from .document import finding
from .plain import plain
from .ranking import notes_text, wrapped
from .table import columns


def document(found: Pruned, timing: bool = True) -> dict:
    """The `scene` block of `fit --json` and `recommend --json`."""
    scene = found.scene
    block = {
        "name": scene.name,
        "file": scene.source or None,
        "assumptions": scene.describe(),
        "unit": "JND" if scene.colour == "grey" else "Delta E ITP",
        "tolerance": {"worst": scene.tolerance.worst, "p95": scene.tolerance.p95},
        "model": found.whole.name,
        "pruned": found.sum.name,
        "without": parts_of(found.cut),
        "other_law": found.stand_in,
        "parameters": {key: _outside(found.sum.parameters[key], value) for key, value in found.values.items()},
        "error": errors(found.errors),
        "error_fresh": errors(found.fresh),
        "error_strayed": [{"angles_times": factor, **errors(each)} for factor, each in found.moved.items()],
        "parts": [_single(each, timing) for each in found.singles],
        "operations": {"whole": dict(found.operations[0]), "pruned": dict(found.operations[1])},
        "pareto": [_candidate(each, found, timing) for each in found.pareto],
        "next_cheaper": _next(found, -1),
        "next_better": _next(found, 1),
        "box": {name: [round(low, 2), round(high, 2)] for name, (low, high) in found.box_deg.items()},
        "quadrature": {"pixels": found.pixels, "skipped_dark": found.skipped, "convergence": found.convergence, "seed": found.seed, "listed": bool(scene.pairs)},
        "findings": [finding(each) for each in found.findings],
    }
    if timing:
        block["time_per_sample_ns"] = {
            "whole": found.whole_time.ns, "pruned": found.time.ns,
            "saved": found.saving.ns if found.cut.out else 0.0, "saved_stderr": found.saving.stderr if found.cut.out else 0.0,
        }  # fmt: skip
    return plain(block)


def left_out(found: Pruned, timing: bool = True) -> list[dict]:
    """The parts left out, as the `left_out` list of a fit's document."""
    return plain([
        {"term": str(each.part), "error": errors(each.errors), "saving_ns": each.saving.ns if timing and each.saving.measurable else None,
         "why": f"replaced by {found.sum.terms[-1].label}" if found.stand_in and not each.part.feature else f"changes {found.scene.name} by {each.errors.visible:.2g} {_unit(found)} at worst"}
        for each in found.singles if each.left_out
    ])  # fmt: skip


def errors(each: Errors) -> dict:
    return {
        "mean": each.mean, "p95": each.p95, "worst": each.worst, "worst_visible": each.visible, "worst_codes": each.codes,
        "at": dict(zip(("theta_i_deg", "theta_r_deg", "phi_deg"), each.at_deg)),
    }  # fmt: skip


def parts_of(cut: Cut) -> list[str]:
    return [str(part) for part in sorted(cut.out)]


def _single(each: Single, timing: bool) -> dict:
    entry = {"part": str(each.part), "left_out": each.left_out, "error_alone": errors(each.errors), "bound": each.screen}
    return entry | ({"saving_ns": each.saving.ns, "saving_stderr_ns": each.saving.stderr, "saving_measurable": each.saving.measurable} if timing else {})


def _candidate(each: Candidate, found: Pruned, timing: bool) -> dict:
    entry = {"model": each.sum.name, "without": parts_of(each.cut), "other_law": each.stand_in, "worst": each.errors.visible, "p95": each.errors.p95, "operations": each.work, "picked": each.values is found.values}
    return entry | ({"time_per_sample_ns": each.time.ns} if timing else {})


def _next(found: Pruned, step: int) -> dict | None:
    """The neighbour of the pick on the Pareto list, by cost."""
    work = next((each.work for each in found.pareto if each.values is found.values), None)
    if work is None:
        return None
    others = [each for each in found.pareto if (each.work - work) * step > 0]
    pick = min(others, key=lambda each: abs(each.work - work), default=None)
    return {"model": pick.sum.name, "without": parts_of(pick.cut), "worst": pick.errors.visible, "operations": pick.work} if pick else None


def _outside(parameter, value):
    """A value with angles in degrees."""
    turn = degrees if parameter.unit == "rad" else float
    return turn(value) if not hasattr(value, "__len__") else [turn(each) for each in value]


def _unit(found: Pruned) -> str:
    return "JND" if found.scene.colour == "grey" else "ΔE_ITP"


# --- text -------------------------------------------------------------------------------------------


def text(block: dict, notes: bool = True) -> str:
    """The block for people: what is left, what that costs and saves, where it holds, what was doubtful."""
    paragraphs = [_verdict(block), _parts_table(block), _pareto_table(block), _reach(block)]
    if notes:
        paragraphs.append(notes_text("doubts:", block["findings"]))
    return "\n\n".join(paragraph for paragraph in paragraphs if paragraph)


def _verdict(block: dict) -> str:
    out, error, fresh = block["without"], block["error"], block["error_fresh"]
    unit = _short(block)
    lines = [wrapped(f"scene: {block['assumptions']}").lstrip()]
    if not out:
        return "\n".join([*lines, f"keep all of {block['model']}: nothing that can be left out within the tolerance saves measurable time"])
    does = f"use {block['pruned']} in place of {block['model']}, without {', '.join(out)}" if block["other_law"] else f"leave out {', '.join(out)} of {block['model']}"
    lines.append(wrapped(does).lstrip())
    lines.append(f"  differs by {_jnd(error['mean'])} {unit} on average, {_jnd(error['p95'])} at most for 95 % of the picture, {_jnd(error['worst_visible'])} at worst")
    lines.append(f"  ({_where(error)})" + ("" if block["quadrature"]["listed"] else f"; {_jnd(fresh['worst_visible'])} at worst on fresh directions"))
    time = block.get("time_per_sample_ns")
    if time:
        lines.append(f"  {time['whole']:.0f} -> {time['pruned']:.0f} ns per sample ({time['whole'] / time['pruned']:.1f} times faster), saving {time['saved']:.0f} ± {time['saved_stderr']:.0f}")
    lines.append(f"  operations per sample: {_operations(block['operations']['whole'])} -> {_operations(block['operations']['pruned'])}")
    lines.append(wrapped("with " + " ".join(f"{key}={_word(value)}" for key, value in block["parameters"].items())))
    return "\n".join(lines)


def _parts_table(block: dict) -> str:
    if not block["parts"]:
        return ""
    timed = "time_per_sample_ns" in block
    header = ("left out alone", "mean", "p95", "worst", "bound", "codes", "where", *(("saves ns",) if timed else ()), "")
    lines = []
    for each in block["parts"]:
        error = each["error_alone"]
        line = [each["part"], f"{error['mean']:.2f}", f"{error['p95']:.2f}", f"{error['worst_visible']:.2f}", _bound(each["bound"]), f"{error['worst_codes']:.1f}", _where(error)]
        line += [f"{each['saving_ns']:.0f} ± {each['saving_stderr_ns']:.0f}" if each["saving_measurable"] else "not measurable"] if timed else []
        lines.append([*line, "left out" if each["left_out"] else "kept"])
    return columns(header, lines, right=(1, 2, 3, 4, 5, 7) if timed else (1, 2, 3, 4, 5))


def _bound(value) -> str:
    """A closed form's upper bound, where there is one that says something."""
    return "-" if value is None or value > 999 else f"{value:.2g}"


def _pareto_table(block: dict) -> str:
    timed = "time_per_sample_ns" in block
    header = ("worst", "p95", "operations", *(("ns",) if timed else ()), "what")
    lines = [
        [f"{each['worst']:.2f}", f"{each['p95']:.2f}", f"{each['operations']:.0f}", *([f"{each['time_per_sample_ns']:.0f}"] if timed else []),
         _label(each) + ("  <- picked" if each["picked"] else "")]
        for each in block["pareto"]
    ]  # fmt: skip
    return "cheapest for each error:\n" + columns(header, lines, right=(0, 1, 2, 3) if timed else (0, 1, 2))


def _label(each: dict) -> str:
    if each["other_law"]:
        return f"{each['model']} instead, without {', '.join(each['without'])}"
    return "without " + (", ".join(each["without"]) or "nothing")


def _reach(block: dict) -> str:
    angles = ", ".join(f"{name.removesuffix('_deg')} {low:g}..{high:g}" for name, (low, high) in block["box"].items())
    q = block["quadrature"]
    if q["listed"]:
        return wrapped(f"holds for the {q['pixels']} directions listed: {angles} degrees").lstrip()
    change = f", doubling them changed the deciding numbers by {_jnd(q['convergence'])} {_short(block)}"
    dark = f", {q['skipped_dark']} too dark to compare" if q["skipped_dark"] else ""
    return wrapped(f"holds for {angles} degrees; {q['pixels']} pixels{change}{dark}, seed {q['seed']}").lstrip()


def _jnd(value: float) -> str:
    """Two digits of what might be seen, 0 of what is far from it."""
    return f"{value:.2g}" if value >= 0.005 else "0"


def _where(error: dict) -> str:
    at = error["at"]
    if at["theta_i_deg"] >= 90:
        return f"theta_r {at['theta_r_deg']:.0f}, turned from the light"
    return f"theta_i {at['theta_i_deg']:.0f}, theta_r {at['theta_r_deg']:.0f}, phi {at['phi_deg']:.0f}"


def _operations(counted: dict) -> str:
    return ", ".join(f"{number:.0f} {group}" for group, number in counted.items() if round(number)) or "none"


def _word(value) -> str:
    return ",".join(f"{each:.4g}" for each in value) if isinstance(value, list) else f"{value:.4g}"


def _short(block: dict) -> str:
    return "JND" if block["unit"] == "JND" else "ΔE_ITP"

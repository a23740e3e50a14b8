"""`brdfguide plan` in words."""

from .table import columns


def plan_text(result: dict) -> str:
    """What it is for and what it gives, then every block with its directions or scans."""
    return "\n\n".join(
        ["\n".join(plan_head(result)), *(_block(number, each) for number, each in enumerate(result["blocks"], start=1))]
    )


def plan_head(result: dict) -> list[str]:
    """Lines: what it gives, what it takes, and that what was seen changes the rest."""
    last, first = result["blocks"][-1], result["blocks"][0]
    count = f"{result['directions']} direction{'s' * (result['directions'] != 1)}"
    there = f" beside the {result['measured_before']} that were measured" if result["measured_before"] else ""
    if result["purpose"] == "tell":
        one, other = result["of"]
        lines = [f"{count} to tell {one} from {other}{there}: they will differ by {last['expected_after']:.3g} noises"]
    elif result["purpose"] == "pin":
        left = 100 * last["expected_after"]
        lines = [f"{count} to pin {result['of'][0]}{there}: {left:.3g} % of today's standard error will be left"]
    else:
        before = "" if first["expected_before"] is None else f" (today {first['expected_before']:.3g} times)"
        expected = f"{last['expected_after']:.3g} times as much as one fitted to all{before}"
        lines = [f"{count}{there}: fitted to them, a model should err over all directions {expected}"]
    if result["seconds"] is not None:
        lines.append(f"takes {_time(result['seconds'])}")
    if len(result["blocks"]) > 1:
        lines.append("measure a block, then plan again with --after: what was seen changes what is worth measuring")
    return lines


def _time(seconds: float) -> str:
    if seconds < 120:
        return f"{seconds:.3g} s"
    return f"{seconds / 60:.3g} min" if seconds < 7200 else f"{seconds / 3600:.3g} h"


def _block(number: int, block: dict) -> str:
    before = "" if block["expected_before"] is None else f"{block['expected_before']:.3g} before, "
    head = f"block {number}: {before}{block['expected_after']:.3g} after"
    head += f", {_time(block['seconds'])}" if block["seconds"] is not None else ""
    if block["scans"]:
        ends = [each["theta_r_deg"] * (1 if 90 <= each["phi_deg"] <= 270 else -1) for each in block["directions"]]
        lines = [
            f"  scan at theta_i {each['theta_i_deg']:g}"
            + (f", plane turned by {each['plane_deg']:g}" if each["plane_deg"] else ", in the plane of incidence")
            + f", theta_r {min(ends):g} to {max(ends):g} deg ({len(ends)} values)"
            for each in block["scans"]
        ]
        return "\n".join([head, *lines])
    rows = [
        (f"{each['theta_i_deg']:g}", f"{each['theta_r_deg']:g}", f"{each['phi_deg']:g}") for each in block["directions"]
    ]
    table = columns(("theta_i", "theta_r", "phi"), rows, right=(0, 1, 2))
    return "\n".join([head, *(f"  {line}" for line in table.splitlines())])

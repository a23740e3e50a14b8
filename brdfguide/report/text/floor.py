"""How much of a misfit any law could remove, in words."""

from .folding import folded, wrapped_text


def floor_text(document: dict) -> str:
    """What some smooth law, and what another law of the same form, would remove; where the model differs most."""
    floor = document.get("floor")
    if not floor:
        return ""
    share = _percent(floor["reducible"])
    first = (
        f"of the misfit of {floor['candidate']} ({floor['model']:.2g}), {share} could be removed by some "
        f"smooth reciprocal law (floor {floor['smooth']:.2g}, noise {floor['noise']:.2g})"
    )
    return "\n".join([folded(first, "", "  "), *map(wrapped_text, _further(floor))])


def _further(floor: dict):
    if not floor["resolves"]:
        yield (
            f"the floor itself is {floor['smooth'] / max(floor['noise'], 1e-6):.2g} times the noise of a single value: "
            f"structure finer than it resolves, or doubts that neighbours share"
        )
    if floor["by_form"] is None:
        return
    yield (
        f"another shape of lobe, masking or Fresnel curve in the same form would remove at most "
        f"{_percent(floor['by_form'])} (factored floor {floor['factored']:.2g})"
    )
    unlike = floor["unlike"]
    if unlike and unlike["rms_ln"] > floor["noise"]:
        places = ", ".join(
            f"{ratio:.2g} at {angle:.0f}"
            for angle, ratio in zip(unlike["angle_deg"], unlike["free_over_model"], strict=True)
        )
        yield f"the {unlike['factor']} differs most: free over the model's {places} deg ({unlike['angle_of']})"


def _percent(share: float) -> str:
    return f"{100 * share:.0f} %"

"""Gloss readings and the lobes behind them, in words."""

from .table import columns
from .values import percent_words


def lobes_text(document: dict) -> str:
    rows = [(lobe, *(f"{value:.1f}" for value in units.values())) for lobe, units in document["gloss_gu"].items()]
    header = ("lobe", *(f"{angle} deg" for angle in next(iter(document["gloss_gu"].values()))))
    return f"{columns(header, rows, right=(1, 2, 3))}\n{shows(document, document['alpha_shows_from'])}"


def shows(document: dict, by_lobe: dict) -> str:
    """From which change on the width shows, on this body."""
    albedo = document["albedo"]
    on = f"a body of albedo {albedo:g}" if albedo else "a black body"
    said = [f"{'no size' if share is None else percent_words(share)} ({lobe})" for lobe, share in by_lobe.items()]
    return f"for the eye, on {on}: alpha shows from a change of {', '.join(said)}"


def readings_text(document: dict) -> str:
    header = ("lobe", "alpha", "n", "predicted GU", "alpha of each reading", "agrees")
    rows = [
        (
            fit["lobe"],
            f"{fit['alpha']:.4g}",
            f"{fit['n']:.2f}",
            _joined(fit["predicted_gu"]),
            _joined(fit["alpha_of_each"]),
            "yes" if fit["agrees"] else "no",
        )
        for fit in document["fits"]
    ]
    by_lobe = {fit["lobe"]: fit["alpha_shows_from"] for fit in document["fits"]}
    return f"{columns(header, rows, right=(1, 2))}\n{shows(document, by_lobe)}"


def _joined(values: dict) -> str:
    return "/".join("none" if value is None else f"{value:.3g}" for value in values.values())

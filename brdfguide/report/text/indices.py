"""Indices of refraction in words: what follows from them, and what each simplification costs."""

from .folding import folded
from .table import columns


def text(document: dict) -> str:
    """One line for each substance or author; then what a simplification costs, and the source."""
    header = ("substance", "nm", "n", "k", "F0", "F at 60, 75, 80, 85 deg")
    table = columns(header, [_line(each) for each in document["entries"]])
    return "\n\n".join([table, *map(_about, document["entries"])])


def _line(each: dict) -> tuple[str, ...]:
    wavelength = "-" if each["wavelength_nm"] is None else f"{each['wavelength_nm']:.7g}"
    angles = "  ".join(f"{each[f'fresnel_{angle}_deg']:.4f}" for angle in (60, 75, 80, 85))
    return each["name"], wavelength, f"{each['n']:.5g}", f"{each['k']:.4g}", f"{each['f0']:.4f}", angles


def _about(each: dict) -> str:
    """What Fresnel's curve may be simplified to, at what cost, and where the numbers come from."""
    at = "" if each["wavelength_nm"] is None else f" at {each['wavelength_nm']:.7g} nm"
    simple = each["simplified"]
    if simple is None:
        cost = "nothing simpler comes near"
    elif simple["as"] == "constant":
        cost = (
            f"a constant {simple['value']:.3f} in place of F is at most {100 * simple['worst_to_75_deg']:.1f} % off "
            f"to 75 deg, {100 * simple['worst_to_85_deg']:.1f} % to 85; the real index that F0 gives (Eq. 2), "
            f"{each['eq2']['n']:.3g}, is 5 % off from {each['eq2']['within_5_percent_to_deg']:g} deg on"
        )
    else:
        cost = f"the usual n = 1.5 in its place is {100 * simple['worst_to_85_deg']:+.0f} % off, at most, to 85 deg"
    return folded(f"{each['name']}{at}: {cost}; {each['source']}", "", "  ")

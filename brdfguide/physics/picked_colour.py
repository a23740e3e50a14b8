"""A colour picker's #rrggbb as linear sRGB, without NumPy: descriptions are read without it."""


def of_hex(text: str) -> tuple[float, float, float]:
    """Linear sRGB of #rrggbb (IEC 61966-2-1)."""
    red, green, blue = (_linear(int(text[place : place + 2], 16) / 255) for place in (1, 3, 5))
    return red, green, blue


def _linear(shown: float) -> float:
    return shown / 12.92 if shown <= 0.04045 else ((shown + 0.055) / 1.055) ** 2.4

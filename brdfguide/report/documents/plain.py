"""Results in the types that JSON knows."""

from math import expm1, inf


def plain(value):
    """`value` with arrays as lists, and None for a number that is not finite."""
    kind = type(value)
    if kind is str or kind is int or kind is bool or value is None:
        return value
    if kind is float:
        return value if abs(value) < inf else None
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if isinstance(value, float) and not (abs(value) < inf):
        return None
    return value


def off_percent(rms_ln: float, digits: int = 4) -> float:
    """How far off that typically is: an rms of ln 0.07 is 7 %."""
    return float(f"{100 * expm1(min(rms_ln, 50.0)):.{digits}g}")

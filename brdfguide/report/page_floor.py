"""The floor on a page: one bar from 0 to the best model's misfit, marked where noise and other laws would end."""

from html import escape

from .text.floor import floor_text

WIDTH_REM = 30.0
MARKS = ("noise", "smooth", "factored")


def floor_bar(document) -> str:
    """The bar and its sentence; "" where there is no floor."""
    floor = document.get("floor")
    if not floor:
        return ""
    marks = [(name, floor[name]) for name in MARKS if floor.get(name) is not None]
    whole = max(floor["model"], *(value for _, value in marks))
    lines = "".join(
        f'<span class="mark" style="left:{WIDTH_REM * value / whole:.2f}rem" title="{name} {value:.3g}"></span>'
        for name, value in marks
    )
    label = f"model {floor['model']:.2g}, " + ", ".join(f"{name} {value:.2g}" for name, value in marks)
    bar = (
        f'<div class="floor" role="img" aria-label="{escape(label)}" style="width:{WIDTH_REM:g}rem">'
        f'<span class="bar" style="width:{WIDTH_REM * floor["model"] / whole:.2f}rem"></span>{lines}</div>'
    )
    said = "".join(f"<p>{escape(' '.join(line.split()))}</p>" for line in _paragraphs(floor_text(document)))
    return (
        f'<h3>how much any law could remove</h3><div class="wide">{bar}</div><p class="soft">{escape(label)}</p>{said}'
    )


def _paragraphs(text: str) -> list[str]:
    """Lines with those that go on in the next joined to it."""
    found: list[str] = []
    for line in text.splitlines():
        if line.startswith("    ") and found:
            found[-1] += " " + line.strip()
        else:
            found.append(line.strip())
    return found

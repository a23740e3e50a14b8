"""Rows of values as CSV."""

from ...printable import cell, comment


def csv(document: dict) -> str:
    lines = [",".join(map(cell, document["columns"]))]
    lines += [",".join(cell(each) if isinstance(each, str) else repr(each) for each in row) for row in document["rows"]]
    return "\n".join(lines) + "\n"


def residuals_csv(document: dict) -> str:
    """What a fit leaves over, nine digits of each number; the wavelength as it was given."""
    about = comment(f"# ln(model/data) of {document['candidate']} on {document['data']}")
    lines = [about, ",".join(document["columns"])]
    for *where, channel, wavelength, value, model, ratio in document["rows"]:
        angles = ",".join(f"{angle:.9g}" for angle in where)
        lines.append(f"{angles},{cell(channel)},{wavelength:g},{value:.9g},{model:.9g},{ratio:.9g}")
    return "\n".join(lines) + "\n"


def percent_words(share: float) -> str:
    """Two digits, without decimals from 10 % on."""
    return f"{100 * share:.2g} %" if share < 0.0995 else f"{100 * share:.0f} %"

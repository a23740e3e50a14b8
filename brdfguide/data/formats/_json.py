"""Which JSON is a table of named columns, and not a document of a format's own."""

import re

ROWS = ("data", "rows", "records", "measurements", "samples", "values", "points", "brdf")  # keys of the rows
BEGINS = re.compile(
    rb'\s*(?:\[\s*\{\s*"|\{"[^{}\n]{1,2000}\}\s*\n\s*\{'  # rows in a list, or one a line
    rb'|\{\s*"[^"]{1,200}"\s*:\s*(?:\[\s*(?:[-\d"]|NaN|null)|\{\s*"0"\s*:))'  # columns
)
NAMED_ROWS = re.compile(rb'"(?:' + "|".join(ROWS).encode() + rb')"\s*:\s*\[\s*[\[{]')
OF_OTHERS = re.compile(rb'"lookupTable"|"schema"\s*:\s*"brdfguide/')


def is_table(head: bytes) -> bool:
    """Whether the first bytes are those of rows or columns with names."""
    if not re.match(rb'\s*[\[{]\s*["{]', head) or OF_OTHERS.search(head):
        return False
    return (
        BEGINS.match(head) is not None or re.match(rb"\s*\{", head) is not None and NAMED_ROWS.search(head) is not None
    )

"""What one shader can do for a measurement, as a document."""

from collections.abc import Mapping

from ...fitting.ranked import Ranking, Row
from ...physics import seen
from .findings import finding
from .plain import off_percent, plain


def as_shader_block(target: str, found: Ranking, laws: Ranking, readings: Mapping[str, float]) -> dict:
    """Of `fit --as`: the shader's best setting with its error against the measurement, and the best law's.

    `readings`: words for another published reading of the shader's text -> its rms ln with the same numbers.
    """
    row, best = found.recommended, laws.rows[0]
    values = row.fit.model.defaults() | dict(row.fit.values)
    return plain(
        {
            "target": target,
            **_entry(row),
            "parameters": {
                key: {"value": parameter.outside(values[key]), "fitted": row.fit.stderr.get(key) is not None}
                for key, parameter in row.fit.model.parameters.items()
            },
            "readings": [
                {"with": words, "rms_ln": error, "off_percent": off_percent(error)} for words, error in readings.items()
            ],
            "best_law": _entry(best),
            "settings": [_entry(each) for each in (row, *(each for each in found.rows if each.fit is not row.fit))],
            "cannot_follow": [finding(each) for each in row.warnings],
        }
    )


def _entry(row: Row) -> dict:
    return {
        "candidate": row.fit.name,
        "off_percent": off_percent(row.rms_ln),
        "rms_ln": row.rms_ln,
        "seen": row.seen,
        "seen_words": seen.band_words(row.seen),
    }

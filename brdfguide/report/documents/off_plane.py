"""What data in the plane of incidence cost, and which term the law lacks, as blocks of a fit's document."""

from ...fitting.missing_term import WORDS, MissingTerm
from ...fitting.off_plane_price import GRAZING_DEG, Price
from .plain import off_percent


def price_block(price: Price | None) -> dict | None:
    """`off_plane` of `fit --json`; None for data that leave the plane of incidence."""
    if price is None:
        return None
    return {
        "expected_percent": off_percent(price.rms_ln, digits=3),
        "rms_ln": price.rms_ln,
        "in_plane_rms_ln": price.in_plane,
        "probability": price.probability,
        "toward_grazing": None
        if price.grazing is None
        else {
            "beyond_deg": GRAZING_DEG,
            "expected_percent": off_percent(price.grazing, digits=3),
            "rms_ln": price.grazing,
        },
        "if_right": [
            {
                "candidate": each.name,
                "probability": each.probability,
                "rms_ln": each.rms_ln,
                "grazing_rms_ln": each.grazing,
            }
            for each in price.by_law
        ],
        "apart": [
            {
                "candidate": each.name,
                "ties": each.ties,
                "rms_ln": each.rms_ln,
                "then_percent": off_percent(each.then, digits=3),
                "at": [
                    {"theta_i_deg": theta_i, "theta_r_deg": theta_r, "phi_deg": phi, "ln_ratio": ratio}
                    for theta_i, theta_r, phi, ratio in each.at
                ],
            }
            for each in price.apart
        ],
    }


def missing_block(term: MissingTerm | None) -> dict | None:
    """`missing` of `fit --json`; None where no term is named."""
    if term is None:
        return None
    return {
        "term": term.kind,
        "words": term.words,
        "share": term.share,
        "confidence": term.confidence,
        "with_it": term.candidate,
        "beside": [{"term": kind, "words": WORDS[kind], "share": share} for kind, share in term.beside],
    }

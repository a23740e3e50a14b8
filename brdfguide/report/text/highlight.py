"""Roughness from the width of a highlight, in words."""


def highlight_text(document: dict) -> str:
    alpha = document["alpha"]
    where = f"half as bright where the lamp has moved by {document['half_width_deg']:g} deg"
    return f"alpha {alpha['ggx']:.3f} as GGX, {alpha['beckmann']:.3f} as Beckmann: {where}"

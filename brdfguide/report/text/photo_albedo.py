"""A reflectance beside a chart in a photograph, in words."""


def text(document: dict) -> str:
    """The answer first, then what it was read from."""
    key = "albedo" if "albedo" in document else "reflectance_factor"
    value, doubt = document[key], document["doubt_relative"]
    parts = "   ".join(f"{name} {value[name]:.4f} +- {100 * doubt[name]:.1f} %" for name in value)
    lines = [
        f"{key.replace('_', ' ')}   {parts}   (linear sRGB)",
        f"Y {100 * document['luminance_factor']:.1f} %   L* {document['lightness']:.1f}   by the chart of "
        f"{document['data_set']}",
    ]
    for name, other in document["other_data_set"].items():
        lines.append(f"by {name}: " + "   ".join(f"{each} {other[each]:.4f}" for each in other))
    if document["pictures_differ"] is not None:
        lines.append(f"the two pictures differ by {100 * document['pictures_differ']:.1f} %")
    for each in document["pictures"]:
        lamp = each["lamp_chart_widths"]
        corners = " ".join(f"{x:.0f},{y:.0f}" for x, y in each["corners_px"])
        lines.append(
            f"{each['file']}: chart at {corners}; its patches fit to {100 * each['residual_rms']:.1f} %; lamp "
            f"{lamp['height']:.2g} chart widths above it"
        )
    return "\n".join(lines)

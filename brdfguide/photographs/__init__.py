"""From pictures of a lit sphere, rod or plate to BRDF values, and from a picture of a chart to an albedo."""

"""General representations of a BRDF, which know no surface: how well anything could describe data, at what cost."""

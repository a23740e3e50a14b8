"""Objects on a floor among lights, ray-cast and lit by what stands around them: what `preview` shows."""

"""One HTML file to turn a surface's knobs in: state, shaders, and the block that holds them."""

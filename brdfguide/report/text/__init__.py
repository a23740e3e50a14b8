"""Documents in words for a terminal or a pipe."""

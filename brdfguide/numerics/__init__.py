"""Mathematics without physics; imports NumPy alone."""

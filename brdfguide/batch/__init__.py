"""Many inputs: one answer each."""

"""Whether the laws hold where they must, and what they cost."""

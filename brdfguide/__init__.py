"""Choose a reflectance model for a surface, and its parameters."""

__version__ = "0.1.0"

"""What a picture of a scene can do without."""

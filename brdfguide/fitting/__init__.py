"""Surfaces fitted to measurements, compared, and how far the numbers can be trusted."""

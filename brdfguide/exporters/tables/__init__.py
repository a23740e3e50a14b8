"""Surfaces as tables of values: containers, node placement, dense tables."""

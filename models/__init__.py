"""Whole systems composed from the component library."""

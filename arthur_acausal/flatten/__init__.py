"""Flattening: from a component to one flat system of equations, each with its source line."""

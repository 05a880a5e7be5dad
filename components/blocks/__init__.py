"""Causal signal blocks: sources, gains, filters and controllers."""

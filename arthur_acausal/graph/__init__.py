"""Graph algorithms on plain integers."""

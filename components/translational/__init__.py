"""One-dimensional translational mechanics."""

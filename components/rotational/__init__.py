"""One-dimensional rotational mechanics."""

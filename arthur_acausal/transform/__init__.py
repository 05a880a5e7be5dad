"""Transformations: alias elimination, index reduction, causalisation. Each pass takes a frozen value to the next."""

"""Tests; the folders mirror the package, `components` and `models`."""

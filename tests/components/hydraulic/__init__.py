"""Tests of the hydraulic library."""

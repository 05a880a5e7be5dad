"""Consistent initialisation, integration and events."""

"""Authoring: connectors, components, records, quantities and statements."""

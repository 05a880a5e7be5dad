"""Declaring: connectors, components and records, their quantities, and the statements between them."""

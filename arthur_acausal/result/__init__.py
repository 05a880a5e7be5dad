"""Solutions: every variable by its path, with units, tables, files and plots."""

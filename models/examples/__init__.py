"""Small models, each showing one feature."""

"""Analysis of translated models: linearisation, steady state, sensitivities."""

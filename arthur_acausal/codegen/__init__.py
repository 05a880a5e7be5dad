"""From a structured DAE to kernels that a solver calls."""

"""The ARTHuR hydraulic quadruped."""

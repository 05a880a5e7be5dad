"""Exchange with other tools: a translated model as a flat Modelica model."""

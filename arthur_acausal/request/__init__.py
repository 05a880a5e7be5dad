"""What a user asks for as text: models by name, parameters, inputs and start values."""

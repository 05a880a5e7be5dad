"""The study of the pump's control: how much a powertrain saves that foresees what the legs will need."""

"""Hydraulics: fluids, ports, machines, valves, volumes, lines, sources and sensors."""

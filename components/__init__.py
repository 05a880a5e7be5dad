"""The component library: every module declares the physics of one kind of part."""

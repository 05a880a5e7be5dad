"""Models of reference cases, each built from the component library by ``connect``."""

"""Films of runs: rigid bodies as MuJoCo draws them, with curves beside them."""

from arthur_acausal.render.film import View, render

__all__ = ["View", "render"]

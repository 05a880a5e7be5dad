"""MuJoCo bodies in a system of equations: an MJCF model is a component like any other."""

from arthur_acausal.mujoco.body import MujocoBody
from arthur_acausal.mujoco.purity import FORCED
from arthur_acausal.mujoco.replay import Contact, Replay

__all__ = ["FORCED", "Contact", "MujocoBody", "Replay"]

"""Any model as a Gymnasium environment (extra ``learning``)."""

from arthur_acausal.learning.environment import Channel, Episode, ModelEnv

__all__ = ["Channel", "Episode", "ModelEnv"]

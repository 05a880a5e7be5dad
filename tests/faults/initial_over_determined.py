"""An initial equation and a fixed start for one state."""

from __future__ import annotations

from arthur_acausal import Equations, InitializationError, der, simulate
from tests.errors.decay import Decay

ERROR = InitializationError
EXPECT = [r"contradict each other", r"\"at rest\"", r"fixed start of x", r"remove one of them"]


class AtRest(Decay):
    def initial_equations(self) -> Equations:
        yield "at rest", der(self.x) == 0  # culprit


def run() -> object:
    return simulate(AtRest(), 1.0)

"""What to tell when a run ends early."""

from __future__ import annotations

from arthur_acausal.errors import SimulationError
from arthur_acausal.solve.trajectory import Trajectory


class SolverFailure(SimulationError):
    """The integration stopped early; `trajectory` holds what was computed up to there."""

    trajectory: Trajectory | None = None


class SolverInterrupted(KeyboardInterrupt):
    """Ctrl-C; `trajectory` holds what was computed up to there."""

    def __init__(self, trajectory: Trajectory) -> None:
        super().__init__(trajectory.message)
        self.trajectory = trajectory

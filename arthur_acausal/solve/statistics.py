"""Counts and times of one run."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(slots=True)
class Statistics:
    """Counts and wall times of one run; it grows while the run goes on.

    IDA's own counters do not pass through its Python binding, so steps are counted from the times at which IDA
    asks for residuals: a later time is a new step, an earlier one a repetition of a rejected step.

    Attributes
    ----------
    unknowns : states and algebraic variables that IDA integrates.
    steps : accepted steps.
    rejected_steps : steps repeated because of the error test or because Newton's iteration did not converge.
    residual_evaluations : by IDA; one for each iteration of its Newton method.
    jacobian_evaluations : by IDA; each is followed by one factorisation.
    root_evaluations : evaluations of the relations that make state events.
    non_finite_residuals : residual evaluations with a value that is no finite number.
    external_calls, external_s : evaluations of external functions; wall time in these and their derivatives, s.
    restarts : how often integration started anew after an event; events that change no equation need none.
    events, state_events, time_events : instants at which something happened, and the two kinds.
    initial_iterations : Newton iterations of the initialisation.
    initial_method : what found the initial values: "Newton", "pseudo-transient", "homotopy".
    event_iterations : Newton iterations of all events.
    load_s : wall time of loading IDA's and SciPy's libraries, s; once a process.
    initialize_s, integrate_s, events_s, output_s, total_s : wall time of the phases and of all, s.
    messages : notices for the user.
    """

    unknowns: int = 0
    linear_solver: str = ""
    steps: int = 0
    rejected_steps: int = 0
    residual_evaluations: int = 0
    jacobian_evaluations: int = 0
    root_evaluations: int = 0
    non_finite_residuals: int = 0
    external_calls: int = 0
    external_s: float = 0.0
    restarts: int = 0
    events: int = 0
    state_events: int = 0
    time_events: int = 0
    initial_iterations: int = 0
    initial_method: str = ""
    event_iterations: int = 0
    load_s: float = 0.0
    initialize_s: float = 0.0
    integrate_s: float = 0.0
    events_s: float = 0.0
    output_s: float = 0.0
    total_s: float = 0.0
    messages: list[str] = field(default_factory=list)

    @property
    def us_per_residual_call(self) -> float:
        """Wall time of integration over residual evaluations, microseconds: everything IDA does included."""
        return 1e6 * self.integrate_s / self.residual_evaluations if self.residual_evaluations else 0.0

    def as_dict(self) -> dict[str, Any]:
        """All counts and times by name, ready for JSON."""
        return asdict(self) | {"us_per_residual_call": self.us_per_residual_call}

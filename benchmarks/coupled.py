"""One scenario of the locomotion stack in the coupled model, and the figures of its run."""

from __future__ import annotations

import time
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from arthur_acausal import ArthurError, Solution, SolverOptions, translate
from arthur_acausal.models.arthur.displaced import start_of
from arthur_acausal.models.arthur.figures import headings
from arthur_acausal.models.arthur.locomotion.commands import Command
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.trouble import counts
from arthur_acausal.result.simulated import ComputedValues
from benchmarks.locomotion import CALM, CRUISING, Scenario

LIMITS = {"speed_error": 0.1, "max_roll_deg": 5.0, "max_pitch_deg": 5.0, "slip_share": 0.05, "v_y": 0.1}
TRACKING = 0.1
POINTS = 200
"""Times a second at which the figures are taken."""


@dataclass(frozen=True, slots=True)
class Walked:
    """What a run gave.

    Attributes
    ----------
    seconds : simulated. message : why it ended early. speed_error : of the mean speed or yaw rate after 1.5 s.
    v_y : largest sideways speed from 2 s after a push on [m/s]. closure : of the energy, share of the input.
    tracked : whether the forces have to follow their demand: in an undisturbed trot. trouble : counts.
    cpu_s_per_s : of all, the controller included.
    """

    scenario: str
    seed: int
    seconds: float
    message: str
    fell: bool
    mean_speed_m_s: float
    speed_error: float | None
    max_roll_deg: float
    max_pitch_deg: float
    slip_share: float
    v_y: float | None
    force_tracking_rms: float
    closure: float
    cost_of_transport: float | None
    trouble: dict[str, int]
    cpu_s_per_s: float
    required: bool
    tracked: bool

    @property
    def met(self) -> bool:
        """Whether the figures meet what is required."""
        found = asdict(self)
        followed = not self.tracked or self.force_tracking_rms <= TRACKING
        within = all(found[name] is None or found[name] <= most for name, most in LIMITS.items())
        return not self.fell and not self.message and within and followed


def robot(scenario: Scenario, seed: int) -> Quadruped:
    """Return the robot that does what a scenario says."""
    command, push = scenario.command, scenario.push
    shove = (
        {} if push is None else {"push": push.force[1], "t_push": push.start, "push_duration": push.duration}
    )
    return Quadruped(
        gait=command.gait,
        v_x=command.v_x,
        v_y=command.v_y,
        yaw_rate=command.yaw_rate,
        swing_height=command.swing_height,
        terrain=scenario.terrain,
        payload=scenario.payload,
        seed=seed,
        audit=True,
        **shove,  # type: ignore[arg-type]
    )


def run(scenario: Scenario, seed: int, rtol: float) -> Walked:
    """Run a scenario with one seed of noise and start; where the model cannot be solved that is its message."""
    model = translate(robot(scenario, seed))
    options = SolverOptions(rtol=rtol, intervals=1)  # each control tick gives two rows
    begin = time.process_time()
    try:
        solution = model.simulate(scenario.duration, start=start_of(seed), options=options)
    except ArthurError as error:
        return _failed(scenario, seed, str(error))
    spent = time.process_time() - begin
    return walked(thinned(solution, POINTS), model.model, scenario, seed, spent)


def _failed(scenario: Scenario, seed: int, message: str) -> Walked:
    """Return what stands for a run that came to no end."""
    figures = (
        "mean_speed_m_s",
        "max_roll_deg",
        "max_pitch_deg",
        "slip_share",
        "force_tracking_rms",
        "closure",
    )
    return Walked(
        scenario=scenario.name,
        seed=seed,
        seconds=0.0,
        message=message,
        fell=False,
        speed_error=None,
        v_y=None,
        cost_of_transport=None,
        trouble={},
        cpu_s_per_s=0.0,
        required=scenario.required,
        tracked=_tracked(scenario),
        **dict.fromkeys(figures, np.inf),
    )


def _tracked(scenario: Scenario) -> bool:
    return scenario.command == Command(v_x=0.5) and scenario.push is None and not scenario.payload


def thinned(solution: Solution, points: int) -> Solution:
    """Return a solution of so many rows a second: what is not a state costs much to compute for each row."""
    (piece,) = solution.pieces
    x = piece.trajectory
    wanted = np.arange(0.0, x.t[-1], 1.0 / points)
    rows = np.append(np.searchsorted(x.t, wanted, side="right") - 1, x.t.size - 1)
    columns = {name: getattr(x, name)[rows] for name in ("t", "y", "yp", "u", "z", "m")}
    return Solution(ComputedValues(piece.dae, replace(x, **columns)), solution.run)


def walked(solution: Solution, model: Any, scenario: Scenario, seed: int, spent: float) -> Walked:
    """Return the figures of a run."""
    told = model.figures(solution)
    figures, end = told["locomotion"], float(solution.t[-1])
    names = ("fell", "mean_speed_m_s", "max_roll_deg", "max_pitch_deg", "slip_share", "force_tracking_rms")
    level = headings(solution)
    return Walked(
        scenario=scenario.name,
        seed=seed,
        seconds=end,
        message=solution.run.message,
        speed_error=_speed_error(solution, level, scenario),
        v_y=_sideways(solution, level, scenario),
        closure=solution.energy().closure,
        cost_of_transport=told["cost_of_transport"],
        trouble=counts(solution),
        cpu_s_per_s=spent / end,
        required=scenario.required,
        tracked=_tracked(scenario),
        **{name: figures[name] for name in names},
    )


def _speed_error(solution: Solution, level: Any, scenario: Scenario) -> float | None:
    """Return the relative error of the mean velocity in the direction commanded, or of the yaw rate."""
    command, cruising = scenario.command, solution.t >= CRUISING
    wanted = np.array([command.v_x, command.v_y])
    speed = float(np.linalg.norm(wanted))
    if not cruising.any() or not (speed or command.yaw_rate):
        return None
    t = solution.t[cruising]
    signal, target = (
        (level @ wanted / speed, speed) if speed else (solution["body.base_w_z"], command.yaw_rate)
    )
    mean = np.trapezoid(signal[cruising], t) / np.ptp(t)
    return float(abs(mean / target - 1.0))


def _sideways(solution: Solution, level: Any, scenario: Scenario) -> float | None:
    if scenario.push is None:
        return None
    calm = solution.t >= scenario.push.start + scenario.push.duration + CALM
    return float(np.abs(level[calm, 1]).max(initial=0.0)) if calm.any() else np.inf

"""What the valves cost the quadruped in a trot: its budget with ideal and with driven valves in a leg."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

import numpy as np

from arthur_acausal import Solution, SolverOptions, translate
from arthur_acausal.models.arthur.figures import valve_actuation
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.valves.direct import ValveKind
from arthur_acausal.models.arthur.valves.robot import Robot
from arthur_acausal.models.arthur.valves.strokes import GPM, PSI

BEGIN, STRIDE = 0.5, 0.625
"""When the budget begins, after the first steps, and how long it is [s]."""
VALVES = 3
"""Driven ones, in the leg FL."""


def trots(stop_time: float = BEGIN + STRIDE) -> dict[str, Solution]:
    """Return the begin of a trot at 0.5 m/s, with each kind of valves in the leg FL."""
    options = SolverOptions(rtol=1e-3, intervals=round(stop_time / 2e-3))
    return {
        kind: translate(Quadruped(gait="trot", v_x=0.5, audit=True, valve=kind)).simulate(
            stop_time, options=options
        )
        for kind in get_args(ValveKind)
    }


def mean_power(run: Solution, term: str, begin: float) -> float:
    """Return a term of the power unit's energy audit as its mean power [W] from ``begin`` [s] on."""
    energy = run[f"unit.energy_{term}.E"]
    return float(energy[-1] - np.interp(begin, run.t, energy)) / float(run.t[-1] - begin)


def trot_numbers(runs: Mapping[str, Solution], begin: float = BEGIN) -> dict[str, Any]:
    """Return the robot's budget from ``begin`` on [W] and how long a battery lasts [min], by the kind of the valves.

    Pilots: their flow at this robot's pressure, by the efficiency that its trot has from the battery to the fluid, as
    pump and motor would be larger in proportion. Driven valves: the battery gives four times what it gives more for
    the three of a leg, their drives come on top, and all but that grows with their mass, as in `Robot.minutes_with`.
    """
    robot, ideal = Robot(), runs["ideal"]
    battery = mean_power(ideal, "input", begin)
    t, flow, rise, p = (
        values[ideal.t >= begin]
        for values in (ideal.t, *(ideal[path] for path in ("unit.pump.q", "unit.pump.dp", "unit.manifold.p")))
    )
    efficiency = float(np.trapezoid(flow * rise, t)) / float(t[-1] - t[0]) / battery
    pressure = float(p.mean())
    pilots = robot.pilot_flow(pressure / PSI)
    pilot_power = pilots * GPM * pressure / efficiency
    result: dict[str, Any] = {
        "battery_W": battery,
        "battery_to_fluid": efficiency,
        "pressure_bar": pressure / 1e5,
        "pilot_flow_gpm": pilots,
        "pilot_electrical_W": pilot_power,
        "minutes_ideal": robot.minutes_at(battery),
        "minutes_two_stage": robot.minutes_at(battery + pilot_power),
    }
    for kind in ("rotary", "spool"):
        drives = valve_actuation(runs[kind], begin)
        more = (mean_power(runs[kind], "input", begin) - battery) * robot.valves / VALVES
        spent = robot.valves * (drives["mechanical_W"] / robot.eta_motor + drives["copper_W"])
        walking = battery * (1 + robot.valves * robot.heavier / robot.mass)
        result[kind] = drives | {
            "battery_more_W": more,
            "drives_W": spent,
            "minutes": robot.minutes_at(walking + more + spent),
        }
    return result

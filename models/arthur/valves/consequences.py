"""What follows from the valves' loads: the testbed's torques, the position loops, and what it costs the robot."""

from __future__ import annotations

from typing import get_args

from arthur_acausal import Solution, SolverOptions, translate
from arthur_acausal.models.arthur.valves.actuation import Motor, PositionDrive, PositionLoop
from arthur_acausal.models.arthur.valves.robot import Robot, robot_numbers
from arthur_acausal.models.arthur.valves.strokes import GPM
from arthur_acausal.models.arthur.valves.testbed import Spool, Testbed
from arthur_acausal.models.arthur.valves.variants import PRECISE, at


def testbed_runs() -> dict[str, Solution]:
    """Return the testbed's run with each of its three spools, of the house shape."""
    return {
        spool: translate(Testbed(spool=spool, shape="house"), compile="never").simulate(1.0, options=PRECISE)
        for spool in get_args(Spool)
    }


def testbed_numbers(run: Solution) -> dict[str, float]:
    """Return what the testbed would measure with a spool."""
    before = run["z"] <= 0
    torque = run["T_jet"][before]
    return {
        "T_jet_max_mNm": float(torque.max()) * 1e3,
        "z_of_the_max": float(run["z"][before][torque.argmax()]),
        "T_friction_max_mNm": float(run["T_friction"].max()) * 1e3,
        "T_transducer_max_mNm": float(run["T_forward"].max()) * 1e3,
        "Q_max_gpm": float(run["Q"].max()) / GPM,
        "T_jet_max_over_Q_max_mNm_per_gpm": float(torque.max()) * 1e3 / (float(run["Q"].max()) / GPM),
    }


def loop_runs() -> dict[str, Solution]:
    """Return the position loop's run with each motor: six steps of 2 deg."""
    return {
        motor: translate(PositionLoop(drive=PositionDrive(motor=motor)), compile="never").simulate(
            0.35, options=SolverOptions(intervals=700)
        )
        for motor in get_args(Motor)
    }


def of_the_robot(rotary: Solution, spool: Solution, robot: Robot | None = None) -> dict[str, object]:
    """Return what the two direct-drive valves cost the robot, from their case studies."""
    robot = robot or Robot()
    s = robot.stroke
    strokes = {
        "rotary": (
            at(rotary, "W_with_jet", s),
            at(rotary, "W_no_jet", s),
            at(rotary, "T_jet", s),
        ),
        "spool": (
            at(spool, "W", s),
            at(spool, "W_friction", s) + at(spool, "W_inertia", s),
            at(spool, "F_steady", s) * robot.lever,
        ),
    }
    leaks = {"rotary": rotary.initial("Q_leak") / GPM, "spool": spool.initial("Q_leak") / GPM}
    return robot_numbers(robot, strokes, leaks)

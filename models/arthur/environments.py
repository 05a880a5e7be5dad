"""The robot's supply and the whole robot as Gymnasium environments (extra ``learning``)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal

import numpy as np

from arthur_acausal import Equations, Real, SolverOptions, Table, connect, real_input, translate
from arthur_acausal.learning import Channel, Episode, ModelEnv
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS
from arthur_acausal.models.arthur.displaced import displaced
from arthur_acausal.models.arthur.pump_plant import PumpPlant
from arthur_acausal.models.arthur.quadruped import Quadruped
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions

Driven = Literal["speed", "voltage"]

RECORDED = Path(__file__).with_name("data") / "trot.npz"
"""The demand of 4 s of trot at 0.5 m/s, as `record` gives it."""

COMMANDS = {
    "speed": Channel("w_command", 50.0, 550.0),
    "voltage": Channel("V_command", 0.0, 44.0),
}
"""What an agent sets about the pump's motor: its speed [rad/s] or its voltage [V]."""

SUPPLY = (
    Channel("unit.manifold.p", 100e5, 150e5),
    Channel("unit.reservoir.p", 0.0, 10e5),
    Channel("unit.motor.w", 0.0, 550.0),
    Channel("unit.motor.I", -50.0, 50.0),
)
FLOW = (0.0, 1.2e-4)
"""Range of planned flows [m^3/s]."""

POWER = 100.0
"""Electrical power that counts as 1 in a reward [W]."""
FLOOR, SAG = 130e5, 5e5
"""Supply pressure below which it is undershot, and an undershoot that counts as 1, squared [Pa]."""


def planned(points: int) -> list[Channel]:
    """Return the flows that the locomotion controller plans for the next ``points`` of 30 ms."""
    return [Channel(f"unit.control.plan[{k}].q", *FLOW) for k in range(points)]


def supplied(before: Mapping[str, float], after: Mapping[str, float], period: float) -> float:
    """Return the reward of a supply: minus the electrical power / 100 W, minus the squared undershoot / 5 bar."""
    power = (after["unit.energy_input.E"] - before["unit.energy_input.E"]) / period
    sag = max(FLOOR - after["unit.manifold.p"], 0.0) / SAG
    return -power / POWER - sag**2


MEASURES = ("unit.energy_input.E", "unit.manifold.p")


class PumpEnv(ModelEnv):
    """The supply alone, from which a walking robot's recorded demand is taken; it begins at any time of the recording.

    Action: speed or voltage of the motor. Observation: pressures, speed and current of the motor, and what is planned
    for 0, 30, ... ms ahead. Reward: `supplied`.
    """

    def __init__(
        self,
        drive: Driven = "speed",
        *,
        demand: Demand | None = None,
        ahead: int = 6,
        period: float = 0.02,
        duration: float = 3.0,
    ) -> None:
        self.demand = Demand.load(RECORDED) if demand is None else demand
        self._spare = float(self.demand.t[-1]) - duration
        self._inputs = smooth(self.demand)
        law: Any = f"given {drive}"
        super().__init__(
            translate(PumpPlant(demand=self.demand, law=law), compile="often"),
            actions=[COMMANDS[drive]],
            observations=[*SUPPLY, *planned(ahead)],
            measures=MEASURES,
            period=period,
            duration=duration,
            options=SolverOptions(rtol=1e-3),
        )

    def episode(self, rng: np.random.Generator) -> Episode:
        """Begin at a random time of the recording."""
        begin = round(float(rng.uniform(0.0, max(self._spare, 0.0))), 2)  # when a plan is made
        return Episode(inputs=self._inputs, start_time=begin)

    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        """Return the reward of a supply."""
        return supplied(before, after, self.period)


def smooth(demand: Demand, interval: float = 0.01) -> dict[str, Table]:
    """Return a demand as inputs with a continuous slope: linear pieces of 2 ms would bend 500 times a second.

    At rtol 1e-3 a second of the supply takes 0.08 CPU s then in place of 0.26 at 1e-4; its energy differs by 1e-4.
    """
    t = np.arange(0.0, float(demand.t[-1]), interval)
    series = {"q": demand.q, "q_command": demand.command}
    return {
        name: Table(t, np.interp(t, demand.t, values), interpolation="pchip", extrapolation="hold")
        for name, values in series.items()
    }


class PumpDrivenQuadruped(Quadruped):
    """The quadruped, its locomotion controller included, with the pump driven from outside.

    ``w_command`` [rad/s] counts with ``pump="given speed"`` of its options, ``V_command`` [V] with "given voltage".
    """

    w_command: Real = real_input("rad/s", default=100.0, nominal=500.0, display="rpm")
    V_command: Real = real_input("V", default=10.0, nominal=40.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.w_command, self.unit.w_command)
        yield connect(self.V_command, self.unit.V_command)


class WalkingEnv(ModelEnv):
    """The whole robot trots, its locomotion controller at work; an agent drives the pump.

    As PumpEnv, but the legs feel what the supply gives them. A fall terminates, with a reward of -100.
    """

    def __init__(
        self,
        drive: Driven = "speed",
        *,
        ahead: int = 6,
        period: float = 0.02,
        duration: float = 3.0,
        v_x: float = 0.5,
    ) -> None:
        options = QuadrupedOptions(pump="given speed" if drive == "speed" else "given voltage")
        robot = PumpDrivenQuadruped(gait="trot", v_x=v_x, audit=True, options=options)
        super().__init__(
            translate(robot, compile="often"),
            actions=[COMMANDS[drive]],
            observations=[*SUPPLY, *planned(ahead), Channel("body.base_v_x", -1.0, 1.0)],
            measures=[*MEASURES, "body.base_x", "fallen"],
            period=period,
            duration=duration,
        )

    def episode(self, rng: np.random.Generator) -> Episode:
        """Begin with the legs displaced by up to 0.02 rad."""
        return Episode(start=displaced(rng))

    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        """Return the reward of a supply, and -100 for a fall."""
        return supplied(before, after, self.period) - 100.0 * after["fallen"]

    def failed(self) -> float:
        """A run that cannot go on counts as a fall."""
        return -100.0


class ForceDrivenQuadruped(Quadruped):
    """The quadruped without a locomotion controller: the forces of the cylinders are asked for from outside.

    ``F_FL_hip`` ... [N] of each joint's cylinder, positive extends.
    """

    def commanded(self) -> Equations:
        for k, actuator in enumerate(self.actuators):
            yield connect(self.F[k], actuator.F_d)

    F: Real = real_input("N", shape=12, default=0.0, nominal=100.0)


class QuadrupedEnv(ModelEnv):
    """The whole robot with the forces of its cylinders as actions: for learning to walk.

    Observation: height, orientation and velocities of the trunk, angles and speeds of the joints, forces on the feet,
    supply pressure. Reward: speed ahead up to 0.5 m/s, less the electrical power / 1 kW; -10 for a fall.
    """

    def __init__(self, *, period: float = 0.01, duration: float = 5.0, F_max: float = 400.0) -> None:
        axes = ("x", "y", "z")
        observations = [Channel("body.base_z", 0.0, 0.5)]
        observations += [Channel(f"body.base_q_{x}", -0.5, 0.5) for x in axes]
        observations += [Channel(f"body.base_v_{x}", -1.0, 1.0) for x in axes]
        observations += [Channel(f"body.base_w_{x}", -5.0, 5.0) for x in axes]
        observations += [Channel(f"body.{joint}_phi", -2.0, 2.0) for joint in JOINT_NAMES]
        observations += [Channel(f"body.{joint}_w", -10.0, 10.0) for joint in JOINT_NAMES]
        observations += [Channel(f"body.sensor_{leg}_touch", 0.0, 100.0) for leg in LEGS]
        super().__init__(
            translate(ForceDrivenQuadruped(audit=True), compile="often"),
            actions=[Channel(f"F[{k}]", -F_max, F_max) for k in range(len(JOINT_NAMES))],
            observations=[*observations, SUPPLY[0]],
            measures=[*MEASURES, "body.base_x", "fallen"],
            period=period,
            duration=duration,
        )

    def episode(self, rng: np.random.Generator) -> Episode:
        """Begin with the legs displaced by up to 0.02 rad."""
        return Episode(start=displaced(rng))

    def reward(self, before: Mapping[str, float], after: Mapping[str, float]) -> float:
        """Return the reward of a step."""
        speed = (after["body.base_x"] - before["body.base_x"]) / self.period
        power = (after["unit.energy_input.E"] - before["unit.energy_input.E"]) / self.period
        return min(speed, 0.5) - power / 1000.0 - 10.0 * after["fallen"]

    def failed(self) -> float:
        """A run that cannot go on counts as a fall."""
        return -10.0


def record(duration: float = 4.0, v_x: float = 0.5, seed: int = 1) -> Demand:
    """Return the demand of a trotting robot on its supply."""
    model = translate(Quadruped(gait="trot", v_x=v_x, seed=seed), compile="often")
    return Demand.of(model.simulate(duration, tolerance=1e-4))

"""The whole robot: battery to foot, driven by a locomotion controller."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce
from typing import TYPE_CHECKING, Any, Literal

from casadi import SX, cos, fabs, fmax, fmin, logic_and, logic_or

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    connect,
    discrete,
    if_else,
    parameter,
    pre,
    real_output,
    sampled,
    start,
    terminate,
    time,
    when,
)
from arthur_acausal.models.arthur.budget import budget
from arthur_acausal.models.arthur.dimensions import JOINT_NAMES, LEGS, Dimensions
from arthur_acausal.models.arthur.figures import figures, valve_actuation
from arthur_acausal.models.arthur.hydraulics import Hydraulics
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders
from arthur_acausal.models.arthur.locomotion.commands import Command, Constant
from arthur_acausal.models.arthur.locomotion.controller import Configuration
from arthur_acausal.models.arthur.mjcf import quadruped_mjcf
from arthur_acausal.models.arthur.quadruped_picture import picture
from arthur_acausal.models.arthur.trouble import notes
from arthur_acausal.models.arthur.walking import Walking
from arthur_acausal.mujoco import MujocoBody

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SINKAGE = 2e-3
"""How deep the feet are first assumed to sink in [m]: where they only touch, the ground bears nothing yet."""


class SetPoint(Component):
    """A force that the controller asks for, held to first order.

    The signal ``y`` [N] goes from the discrete ``before`` to ``value`` within the ``period`` [s] after ``since`` [s].
    """

    y: Real = real_output("N", nominal=100.0)
    period: Real = parameter("s", min=0.0)
    before: Real = discrete("N", description="asked at the sample before")
    value: Real = discrete("N", description="asked at the last sample")
    since: Real = discrete("s", description="time of the last sample")

    def equations(self) -> Equations:
        share = fmin((time() - self.since) / self.period, 1)
        yield self.y == self.before + (self.value - self.before) * share


class Push(Component):
    """A force ``y`` = F [N] from ``begin`` [s] for ``duration`` [s]; two events."""

    y: Real = real_output("N", nominal=10.0)
    F: Real = parameter("N")
    begin: Real = parameter("s")
    duration: Real = parameter("s", min=0.0)

    def equations(self) -> Equations:
        t = time()
        yield self.y == if_else(logic_and(t >= self.begin, t < self.begin + self.duration), self.F, 0)


class Quadruped(Hydraulics):
    """A hydraulic quadruped of 10 kg: battery, pump, twelve cylinders through their linkages, rigid bodies, ground.

    It starts standing, in balance and under pressure; all accelerations are zero. The pistons' mass is in the joints
    (armature). ``body`` is MuJoCo's: ``base_x`` ... of the trunk, ``FL_hip_phi`` ... of the joints.

    A locomotion controller acts each ``period``: an object with ``fresh()`` that is called with the time and
    ``sensors()``, and returns what ``asked()`` lists. The forces that it asks for become those of the cylinders by
    control within the actuators, which is continuous.

    Structural parameters: ``options``, see QuadrupedOptions; ``valve``, see Hydraulics; ``terrain`` and
    ``payload`` [kg], see quadruped_mjcf; ``controller``, by default one that walks as ``gait`` and the speeds say;
    ``push`` [N], a force to the left at the trunk's centre from ``t_push`` for ``push_duration``.
    """

    start_at_demand: bool = False
    gait: str = "stand"
    v_x: float = 0.0
    v_y: float = 0.0
    yaw_rate: float = 0.0
    swing_height: float = 0.05
    seed: int | None = None
    terrain: Literal["flat", "step", "slope"] = "flat"
    payload: float = 0.0
    push: float = 0.0
    controller: Any = None
    period: Real = parameter("s", default=0.002, min=0.0, description="of the locomotion controller")
    t_push: Real = parameter("s", default=3.0, description="beginning of the push")
    push_duration: Real = parameter("s", default=0.1, min=0.0)
    p_low: Real = parameter("Pa", default=1e4, display="bar", description="below it a chamber cavitates")
    z_low: Real = parameter("m", default=0.12, description="height of the trunk below which it has fallen")
    tilt: Real = parameter("rad", default=1.0, display="deg", description="angle beyond which it has fallen")
    fallen: Real = discrete("1", start=0.0, description="1: it has fallen")
    at_stop: Real = discrete("1", start=0.0, description="times that a cylinder reached a stop")
    cavitating: Real = discrete(
        "1", start=0.0, description="times that a chamber's pressure fell below p_low"
    )
    valve_saturated: Real = discrete(
        "1", start=0.0, description="times that a valve's current reached its limit"
    )
    voltage_limited: Real = discrete("1", start=0.0, description="times that the bus voltage was the limit")
    current_limited: Real = discrete(
        "1", start=0.0, description="times that the drive limited the motor's current"
    )

    def build(self) -> None:
        super().build()
        robot = Dimensions()
        # The pose is given; how the trunk stands and what the cylinders bear is solved for.
        angles = zip(JOINT_NAMES, robot.stand * len(LEGS), strict=True)
        pose: dict[str, Any] = {f"{joint}_phi": start(angle, fixed=True) for joint, angle in angles}
        self.body = MujocoBody(
            mjcf=quadruped_mjcf(self.terrain, self.payload),
            keyframe="stand",
            steady=True,
            wrenches=("imu",) if self.push else (),
            observe=("energy", "power") if self.audit else (),
            base_z=robot.stand_height - SINKAGE,
            **pose,
        )
        if self.push:
            self.shove = Push(F=self.push, begin=self.t_push, duration=self.push_duration)
        self.set_points = [SetPoint(period=self.period) for _ in JOINT_NAMES]
        self.control = self._walking() if self.controller is None else self.controller

    def _walking(self) -> Walking:
        command = Command(
            v_x=self.v_x, v_y=self.v_y, yaw_rate=self.yaw_rate, gait=self.gait, swing_height=self.swing_height
        )
        cylinders = Cylinders(q_rated=self.options.q_rated)
        return Walking(Configuration(commands=Constant(command), cylinders=cylinders, seed=self.seed))

    def equations(self) -> Equations:
        yield from super().equations()
        for name, actuator in zip(JOINT_NAMES, self.actuators, strict=True):
            yield connect(actuator.joint, getattr(self.body, name))
        if self.push:
            yield connect(self.shove.y, self.body.imu_f_y)
        yield from self.commanded()
        yield from self._watch()

    def commanded(self) -> Equations:
        """Yield what gives each cylinder the force that it is asked for: the locomotion controller."""
        for actuator, set_point in zip(self.actuators, self.set_points, strict=True):
            yield connect(set_point.y, actuator.F_d)
        yield sampled(self.control, period=self.period, inputs=self.sensors(), outputs=self.asked())

    def _watch(self) -> Equations:
        """Count what goes wrong; where it falls the run ends."""
        cylinders, unit, motor = [a.cylinder for a in self.actuators], self.unit, self.unit.motor
        lowest = largest(-p for c in cylinders for p in (c.p_A, c.p_B))
        beyond = largest(x for c in cylinders for x in (c.y - c.y_max, c.y_min - c.y))
        asked = largest(fabs(a.control.I) - a.control.I_rated for a in self.actuators)
        yield when(beyond > 0, self.at_stop == pre(self.at_stop) + 1)
        yield when(lowest > -self.p_low, self.cavitating == pre(self.cavitating) + 1)
        yield when(asked > 0, self.valve_saturated == pre(self.valve_saturated) + 1)
        limited = unit.control.V > unit.drive.V_bus
        yield when(limited, self.voltage_limited == pre(self.voltage_limited) + 1)
        yield when(
            unit.drive.V > motor.R_LL * motor.I_max + motor.K_e * motor.w,
            self.current_limited == pre(self.current_limited) + 1,
        )
        x, y = self.body.base_q_x, self.body.base_q_y
        tipped = 2 * (x**2 + y**2) > 1 - cos(self.tilt)  # 1 - the cosine of the angle to the vertical
        yield when(
            logic_or(self.body.base_z < self.z_low, tipped), self.fallen == 1, terminate("the robot fell")
        )

    def figures(self, solution: Solution) -> dict[str, Any]:
        """Return how it walked and what that took, driven valves included: see models.arthur.figures."""
        found = figures(solution, self.payload)
        if self.valve != "ideal":
            found["valve_actuation"] = valve_actuation(solution)
        return found

    def beside(self) -> dict[str, dict[str, str]]:
        """Return what a film shows beside the robot: the supply's pressures, and the chambers of a knee."""
        knee = f"actuators[{JOINT_NAMES.index('FL_knee')}].cylinder"
        return {
            "supply [bar]": {"manifold": "unit.manifold.p", "filter": "unit.filter.p_s"},
            "FL knee [bar]": {"side A": f"{knee}.p_A", "side B": f"{knee}.p_B"},
        }

    def figure(self, solution: Solution) -> Figure:
        """Return the picture of a run: with ``audit`` where the energy went, else how it moved and was fed."""
        if self.audit:
            return budget({f"{self.gait}, {solution.t[-1]:.3g} s": solution})
        return picture(solution)

    def notes(self, solution: Solution) -> list[str]:
        """Return what went wrong, a line each: see models.arthur.trouble."""
        return notes(solution)

    def sensors(self) -> list[SX]:
        """Return what the controller is given.

        Trunk: position 3, quaternion 4, velocity in the world 3, angular velocity in its own frame 3; angles 12 and
        speeds 12 of the joints; normal forces on the feet 4; accelerometer 3; forces of the cylinders 12.
        """
        body = self.body
        axes = ("x", "y", "z")
        names = [f"base_{x}" for x in axes] + ["base_q_w"] + [f"base_q_{x}" for x in axes]
        names += [f"base_v_{x}" for x in axes] + [f"base_w_{x}" for x in axes]
        names += [f"{joint}_phi" for joint in JOINT_NAMES] + [f"{joint}_w" for joint in JOINT_NAMES]
        names += [f"sensor_{leg}_touch" for leg in LEGS] + [f"sensor_accelerometer_{x}" for x in axes]
        return [getattr(body, name) for name in names] + [a.load_cell.f for a in self.actuators]

    def asked(self) -> list[SX]:
        """Return what is set at a sample: forces before 12 and now 12, time 12 times, planned flows and pressures."""
        points, plan = self.set_points, self.unit.control.plan
        held = [s.before for s in points] + [s.value for s in points] + [s.since for s in points]
        return held + [ahead.q for ahead in plan] + [ahead.p for ahead in plan]


def largest(values: Iterable[SX]) -> SX:
    """Return the largest of expressions."""
    return reduce(fmax, values)

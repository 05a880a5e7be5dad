"""The control step (7.0, Algorithm 1): from sensors and commands to joint torques."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, expm1, hypot, sin

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import compile_functions
from arthur_acausal.models.arthur.dimensions import Dimensions
from arthur_acausal.models.arthur.locomotion.actuation import Cylinders
from arthur_acausal.models.arthur.locomotion.base_trajectory import BaseReference
from arthur_acausal.models.arthur.locomotion.commands import Command, Commands, Constant
from arthur_acausal.models.arthur.locomotion.estimation import Estimate, Estimator
from arthur_acausal.models.arthur.locomotion.flow import (
    compression_flow,
    piston_forces,
    predicted_flow,
    required_pressure,
)
from arthur_acausal.models.arthur.locomotion.foot_placement import foot_placement, hips
from arthur_acausal.models.arthur.locomotion.gait_modulator import GaitModulator
from arthur_acausal.models.arthur.locomotion.gaits import GAITS
from arthur_acausal.models.arthur.locomotion.kernel import Kernel
from arthur_acausal.models.arthur.locomotion.leg_model import inverse_kinematics, kinematics
from arthur_acausal.models.arthur.locomotion.leg_state import LegState
from arthur_acausal.models.arthur.locomotion.leg_torques import leg_torques
from arthur_acausal.models.arthur.locomotion.rotation import about_z, cross
from arthur_acausal.models.arthur.locomotion.sensors import Reader
from arthur_acausal.models.arthur.locomotion.settings import Noise, Settings
from arthur_acausal.models.arthur.locomotion.stance_control import StanceControl
from arthur_acausal.models.arthur.locomotion.stance_trajectory import (
    NEVER,
    FootPlan,
    foot_plan,
    stance_vectors,
)
from arthur_acausal.models.arthur.locomotion.walk_state import Walk, walk_state

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Configuration:
    """All that makes a controller.

    Attributes
    ----------
    commands : for each time. robot, cylinders, settings, noise : see there.
    seed : of the sensors' noise; None: no noise. true_velocity : whether the trunk's true position and velocity are
        taken (7.3.9, 7.3.10) in place of the estimate.
    """

    commands: Commands = field(default_factory=lambda: Constant(Command()))
    robot: Dimensions = field(default_factory=Dimensions)
    cylinders: Cylinders = field(default_factory=Cylinders)
    settings: Settings = field(default_factory=Settings)
    noise: Noise = field(default_factory=Noise)
    seed: int | None = None
    true_velocity: bool = False


class Controller:
    """The locomotion stack as a function of time and sensors, to be called at every period of the settings.

    ``fresh()`` gives a new one in its initial state, so that it serves as the function of ``sampled``. The inputs are
    those of sensors.FIELDS, the outputs those of outputs_of; joints and feet in the order of JOINT_NAMES and LEGS.
    """

    def __init__(self, configuration: Configuration | None = None) -> None:
        c = Configuration() if configuration is None else configuration
        self.configuration = c
        n, h = c.settings.horizon, c.settings.step
        self.places = outputs_of(c.settings)
        self._read = Reader(c.noise, c.seed)
        self._estimate = Estimator(c.robot, c.settings, c.true_velocity)
        self._modulator = GaitModulator()
        self._legs = tuple(LegState(c.settings) for _ in range(4))
        self._reference = BaseReference(c.settings)
        self._stance_control = StanceControl(c.robot.mass, c.settings)
        self._leg_torques = Kernel(leg_torques(c.robot, c.cylinders, c.settings))
        self._foot_plan = Kernel(foot_plan(n, h))
        self._postures = Kernel(inverse_kinematics(c.robot, n + 1))
        self._kinematics = Kernel(compile_functions([kinematics(c.robot)])[0].map(n + 1))
        self._times: FloatArray = h * np.arange(n + 1.0)
        self._every = max(1, round(c.settings.mpc_period / c.settings.period))
        self._tick = 0
        self._stance = np.ones(4, dtype=bool)
        self._start, self._v_0, self._end, self._v_1 = (np.zeros((4, 3)) for _ in range(4))
        self._height = np.zeros(4)
        self._force = np.zeros((4, 3))
        self._torque = np.zeros(12)
        self._share = (
            1.0 if c.settings.smoothing <= 0.0 else -expm1(-c.settings.period / c.settings.smoothing)
        )
        self._ground = np.zeros((n, 4, 3))
        self._flow, self._pressure = np.zeros(n + 1), np.zeros(n + 1)
        self._age = 0.0
        self._rates = np.zeros((n + 1, 12))

    def fresh(self) -> Controller:
        """Return a controller of the same configuration in its initial state."""
        return Controller(self.configuration)

    def __call__(self, t: float, inputs: FloatArray) -> FloatArray:
        """Return the outputs at time t [s]."""
        command = self.configuration.commands(float(t))
        state = self._estimate(self._read(inputs), self._stance)
        walking = self._update_gait(command, state)
        self._place_feet(command, state)
        self._reference.update(command, state, walking)
        stance = np.array([leg.c_sync for leg in self._legs])
        if self._tick % self._every == 0 or (stance != self._stance).any():
            self._plan(state, stance)
            self._age = 0.0
        self._stance = stance
        outputs = self._outputs(state, self._torques(state, stance))
        self._tick += 1
        self._age += self.configuration.settings.period
        return outputs

    def _update_gait(self, command: Command, state: Estimate) -> bool:
        """Run the walk state machine, the gait modulator and the leg state machines (7.5 to 7.7)."""
        c = self.configuration
        radius = hypot(c.robot.hip_x, c.robot.hip_y + c.robot.offset)
        wanted = hypot(command.v_x, command.v_y) + radius * abs(command.yaw_rate)
        walking = walk_state(wanted, c.settings.still, command.gait) is Walk.WALK
        speed = hypot(*self._reference.velocity[:2]) + radius * abs(self._reference.yaw_rate)
        gait, limits = GAITS[command.gait], c.settings.stance_limits
        self._modulator.update(c.settings.period, walking, gait, command.half_step, speed, limits)
        m = self._modulator
        for leg, st, sw, contact in zip(self._legs, m.S_st, m.S_sw, state.contact.tolist(), strict=True):
            leg.update(st, sw, contact)
        return walking

    def _place_feet(self, command: Command, state: Estimate) -> None:
        """Begin the swing of legs that lift: foot placement (7.8) and the ends of the trajectory (7.11)."""
        self._height[self._stance] = command.swing_height
        lifting = [i for i, leg in enumerate(self._legs) if leg.e_sw]
        if not lifting:
            return
        level = about_z(state.yaw)
        there = self._landings(state, level.T @ state.velocity)
        for i in lifting:
            self._start[i] = state.foot[i]
            self._end[i] = there[i]
            self._v_0[i] = self._ground_velocity(state, state.foot[i])
            self._v_1[i] = self._ground_velocity(state, there[i])
            self._v_1[i, 2] += self.configuration.settings.touch_down

    def _landings(self, state: Estimate, velocity: FloatArray) -> FloatArray:
        """Return where the feet's centres shall land, in the trunk's frame (4, 3); ``velocity`` in the level frame."""
        robot, reference = self.configuration.robot, self._reference
        place = foot_placement(
            hips(robot, self._modulator.gait.inward),
            velocity,
            np.array(reference.velocity),
            reference.yaw_rate,
            self._modulator.T_st,
            self.configuration.settings.velocity_gain,
        )
        place[:, 2] = robot.foot_radius - state.position[2]
        return place @ about_z(state.yaw).T @ state.R

    @staticmethod
    def _ground_velocity(state: Estimate, foot: FloatArray) -> FloatArray:
        """Return the velocity of the ground at a foot in the trunk's frame, -(v + w x r)."""
        return -(state.R.T @ state.velocity + cross(state.rate_B, foot))

    def _plan(self, state: Estimate, stance: BoolArray) -> None:
        """Plan the feet over the horizon, solve for the forces (7.9, 7.10, 7.12), predict the flow."""
        c, reference = self.configuration, self._reference
        plan = self._planned_feet(state, stance)
        plan.stance[0] = stance
        arms = stance_vectors(
            plan, state.R, reference.yaw_rate, state.centre, c.robot.foot_radius, self._times[:-1]
        )
        if plan.stance.any():
            problem = self._stance_control.problem(state, reference.trajectory(), arms, plan.stance)
            self._ground = self._stance_control.forces(problem, plan.stance)
            self._force = self._ground[0]
        angles, rates = self._postures(plan.foot.reshape(-1), plan.velocity.reshape(-1))
        self._rates = rates.reshape(-1, 12).copy()
        self._predict(angles, state.R)

    def _predict(self, angles: FloatArray, R: FloatArray) -> None:
        """Predict the flow and the pressure that the plan needs of the supply; the last step's forces stay."""
        c, rates = self.configuration, self._rates
        up = np.tile(R[2], len(rates))
        _, _, _, jacobians, _ = self._kinematics(angles, rates.ravel(), up)
        angles = angles.reshape(-1, 12)
        ground = np.concatenate([self._ground, self._ground[-1:]])
        arms = jacobians.reshape(-1, 4, 3, 3).transpose(0, 1, 3, 2)
        forces = piston_forces(ground, arms, R, angles)
        self._flow = predicted_flow(angles, rates, c.cylinders)
        self._flow += compression_flow(forces, c.settings.step, c.cylinders)
        self._pressure = required_pressure(forces, angles, rates, c.cylinders)

    def _planned_feet(self, state: Estimate, stance: BoolArray) -> FootPlan:
        m, n = self._modulator, self.configuration.settings.horizon
        T = m.T_st + m.T_sw
        phase = np.empty((4, 4))
        phase[:, 1], phase[:, 2] = m.T_st, m.T_sw
        for i, leg in enumerate(self._legs):
            S = self._swing_state(i)
            if not leg.c_sync:
                phase[i, 0], phase[i, 3] = max(0.0, 1.0 - S) * m.T_sw, S
            else:
                ahead = (m.duty - m.S[i]) % 1.0
                phase[i, 0], phase[i, 3] = ahead * T if m.running else NEVER, 0.0
        level = about_z(state.yaw)
        v = state.R.T @ level @ self._reference.velocity
        w = self._reference.yaw_rate * state.R[2]
        after = self._landings(state, np.array(self._reference.velocity))
        foot, velocity, standing = self._foot_plan(
            phase.reshape(-1),
            np.where(stance, 0.0, 1.0),
            np.where(stance[:, None], state.foot, self._start).reshape(-1),
            self._v_0.reshape(-1),
            self._end.reshape(-1),
            self._v_1.reshape(-1),
            self._height,
            after.reshape(-1),
            np.tile(v, 4),
            np.tile(w, 4),
        )
        shape = (4, n + 1, 3)
        return FootPlan(
            foot.reshape(shape).transpose(1, 0, 2).copy(),
            velocity.reshape(shape).transpose(1, 0, 2).copy(),
            standing.reshape(4, n).T > 0.5,
        )

    def _swing_state(self, i: int) -> float:
        """Return S_sw of a leg, above 1 while it waits for the contact."""
        late: float = self._legs[i].waiting / self._modulator.T_sw
        S = self._modulator.S_sw[i]
        return S if S > 0.0 else 1.0 + late

    def _torques(self, state: Estimate, stance: BoolArray) -> FloatArray:
        """Return the joint torques within what the cylinders can give (7.12, 7.13)."""
        states = [self._swing_state(i) for i in range(4)]
        swing = [x.ravel() for x in (self._start, self._v_0, self._end, self._v_1)]
        R, force, T_sw = state.R.T.ravel(), self._force.ravel(), self._modulator.T_sw
        angles, speeds = state.angles, state.speeds
        (wanted,) = self._leg_torques(stance, R, angles, speeds, force, states, T_sw, *swing, self._height)
        share = self._share if self._tick else 1.0
        self._torque += share * (wanted - self._torque)
        return self._torque

    def _outputs(self, state: Estimate, torques: FloatArray) -> FloatArray:
        """Gather what outputs_of lists, in its order."""
        reference, modulator = self._reference, self._modulator
        c, s = cos(state.yaw), sin(state.yaw)
        x, y, z = state.velocity.tolist()
        small = [*modulator.S_st, *modulator.S_sw, *self._stance, *state.contact]
        small += [
            reference.velocity[0],
            reference.velocity[1],
            reference.yaw_rate,
            c * x + s * y,
            c * y - s * x,
            z,
        ]
        ahead = [np.interp(self._times + self._age, self._times, x) for x in (self._flow, self._pressure)]
        return np.concatenate([torques, small, self._force.ravel(), *ahead, self._rates.ravel()])


def outputs_of(settings: Settings) -> dict[str, slice]:
    """Return where each kind of output stands in the controller's result.

    torque : of the joints, 12 [N m]. S_st, S_sw : stance and swing state, 4 each. stance : c_sync, 4. contact : c_f, 4.
    desired : velocity ahead, left [m/s], yaw rate [rad/s]. velocity : estimated, ahead, left, up [m/s].
    force : on the feet, in the world, 12 [N]. flow : predicted supply flow from now on, at 0, h, ..., N h [m^3/s].
    pressure : of the supply that is needed then [Pa].
    rates : predicted joint rates at these times after the last plan, 12 each [rad/s].
    """
    points = settings.horizon + 1
    lengths = {
        "torque": 12,
        "S_st": 4,
        "S_sw": 4,
        "stance": 4,
        "contact": 4,
        "desired": 3,
        "velocity": 3,
        "force": 12,
        "flow": points,
        "pressure": points,
        "rates": 12 * points,
    }
    places, start = {}, 0
    for name, length in lengths.items():
        places[name] = slice(start, start + length)
        start += length
    return places

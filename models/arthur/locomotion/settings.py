"""What the locomotion stack can be tuned by: rates, weights, gains."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Noise:
    """Standard deviations of the sensors' white noise (assumed; small MEMS and encoder grade).

    Attributes
    ----------
    orientation : of roll, pitch and yaw [rad]. rate : gyro [rad/s]. acceleration : [m/s^2].
    angle, speed : of the joints [rad], [rad/s]. force : of the contact forces [N].
    position, velocity : of the trunk, where they are used [m], [m/s].
    """

    orientation: float = 0.002
    rate: float = 0.01
    acceleration: float = 0.1
    angle: float = 5e-4
    speed: float = 0.02
    force: float = 0.5
    position: float = 0.0
    velocity: float = 0.0


@dataclass(frozen=True, slots=True)
class Weights:
    """Costs of the force problem, for each step of the horizon; they penalise squares.

    Attributes
    ----------
    angles : roll, pitch, yaw [1/rad^2]. position : x, y, z [1/m^2]. rate : angular velocity [s^2/rad^2].
    velocity : x, y, z [s^2/m^2]. force : deviation of a foot's force from an even share of the weight [1/N^2].
    """

    angles: tuple[float, float, float] = (15.0, 15.0, 10.0)
    position: tuple[float, float, float] = (2.0, 2.0, 100.0)
    rate: tuple[float, float, float] = (0.5, 0.5, 0.5)
    velocity: tuple[float, float, float] = (4.0, 4.0, 1.0)
    force: float = 1e-6


@dataclass(frozen=True, slots=True)
class Settings:
    """Rates, limits and gains of the stack. The report gives only the swing time; the others walked in simulation.

    Attributes
    ----------
    period : of state and leg control [s]. mpc_period : of the force problem [s], also solved at contact changes.
    horizon : steps of the force problem; step : their length [s].
    friction : coefficient assumed of the ground. max_force : vertical force of one foot [N].
    inertia : of the whole robot about its centre of mass, principal, in the trunk's frame [kg m^2].
    gravity : [m/s^2].
    stiffness, damping : of the swing foot's error [1/s^2], [1/s].
    smoothing : time constant of the torques asked [s], so that the cylinders can follow where legs lift and land.
    touch_down : vertical speed relative to the ground at the end of a swing [m/s].
    early : share of the swing after which a contact ends it. patience : time to wait for a late contact [s].
    contact_force : that makes a contact [N].
    odometry_gain : share of a stance foot's velocity error taken at each period.
    velocity_gain : of the foot placement [s]. stance_limits : shortest and longest stance [s].
    acceleration : of the commanded velocity [m/s^2], [rad/s^2]: steps of the command become ramps.
    position_reach, yaw_reach : how far the reference may run ahead of the trunk [m], [rad].
    still : speed below which the command means standing [m/s].
    """

    period: float = 0.002
    mpc_period: float = 0.01
    horizon: int = 10
    step: float = 0.03
    friction: float = 0.5
    max_force: float = 150.0
    inertia: tuple[float, float, float] = (0.0755, 0.207, 0.237)
    gravity: float = 9.81
    weights: Weights = Weights()
    stiffness: float = 6400.0
    damping: float = 160.0
    smoothing: float = 0.004
    touch_down: float = -0.1
    early: float = 0.6
    patience: float = 0.04
    contact_force: float = 3.0
    odometry_gain: float = 0.04
    velocity_gain: float = 0.1
    stance_limits: tuple[float, float] = (0.2, 0.5)
    acceleration: float = 1.0
    position_reach: float = 0.05
    yaw_reach: float = 0.1
    still: float = 0.01

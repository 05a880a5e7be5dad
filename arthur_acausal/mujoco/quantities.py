"""What a MuJoCo body declares: the names of its quantities, joint by joint, in the order of MuJoCo's vectors.

A joint called ``knee`` has, of position, speed and acceleration,

- hinge: ``knee_phi`` [rad], ``knee_w`` [rad/s], ``knee_a`` [rad/s^2]
- slide: ``knee_s`` [m], ``knee_v`` [m/s], ``knee_a`` [m/s^2]
- ball: the quaternion ``knee_q_w``, ``_q_x``, ``_q_y``, ``_q_z``; ``knee_w_x`` ... [rad/s], ``knee_alpha_x`` ...
  [rad/s^2] in the body's own frame
- free: ``knee_x`` ... [m], ``knee_v_x`` ... [m/s], ``knee_a_x`` ... [m/s^2] in the world, and what a ball has
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from arthur_acausal import Real, parameter, real_input, variable
from arthur_acausal.mujoco.layout import Joint, JointKind, Layout

AXES = ("x", "y", "z")
Ending: TypeAlias = tuple[str, str]  # of a name, with the unit


def _vector(what: str, unit: str) -> tuple[Ending, ...]:
    return tuple((f"{what}_{axis}", unit) for axis in AXES)


QUATERNION: tuple[Ending, ...] = (("_q_w", "1"), *_vector("_q", "1"))
POSITION: dict[JointKind, tuple[Ending, ...]] = {
    "hinge": (("_phi", "rad"),),
    "slide": (("_s", "m"),),
    "ball": QUATERNION,
    "free": (*_vector("", "m"), *QUATERNION),
}
SPEED: dict[JointKind, tuple[Ending, ...]] = {
    "hinge": (("_w", "rad/s"),),
    "slide": (("_v", "m/s"),),
    "ball": _vector("_w", "rad/s"),
    "free": (*_vector("_v", "m/s"), *_vector("_w", "rad/s")),
}
ACCELERATION: dict[JointKind, tuple[Ending, ...]] = {
    "hinge": (("_a", "rad/s^2"),),
    "slide": (("_a", "m/s^2"),),
    "ball": _vector("_alpha", "rad/s^2"),
    "free": (*_vector("_a", "m/s^2"), *_vector("_alpha", "rad/s^2")),
}
# standing still leaves open where on the floor and in which direction, and how fast soft contacts creep
HELD = ("_x", "_y")
CREEPING = ("_v_x", "_v_y", "_w_z")


def of_joint(joint: Joint) -> tuple[list[str], list[str], list[str]]:
    """Return the names of a joint's positions, speeds and accelerations."""
    tables = POSITION, SPEED, ACCELERATION
    position, speed, acceleration = ([joint.name + ending for ending, _ in t[joint.kind]] for t in tables)
    return position, speed, acceleration


def positions(layout: Layout) -> list[str]:
    """Return the names of qpos."""
    return [name for joint in layout.joints for name in of_joint(joint)[0]]


def speeds(layout: Layout) -> list[str]:
    """Return the names of qvel."""
    return [name for joint in layout.joints for name in of_joint(joint)[1]]


def accelerations(layout: Layout) -> list[str]:
    """Return the names of qacc."""
    return [name for joint in layout.joints for name in of_joint(joint)[2]]


def quaternion(joint: Joint) -> list[str]:
    """Return the names of a joint's quaternion, none if it has none."""
    return of_joint(joint)[0][-4:] if joint.n_q >= 4 else []


def wrenches(layout: Layout) -> list[str]:
    """Return the names of forces and torques at sites."""
    return [f"{site.name}_{what}_{a}" for site in layout.wrenches for what in ("f", "tau") for a in AXES]


def activations(layout: Layout) -> list[str]:
    """Return the names of the states of actuators."""
    return [f"{item.name}_act" for item in layout.activations]


def controls(layout: Layout) -> list[str]:
    """Return the names of the controls of actuators."""
    return [f"{item.name}_ctrl" for item in layout.controls]


def inputs(layout: Layout) -> list[str]:
    """Return the paths of all inputs of the dynamics, in their order."""
    forces = [f"{j.name}.{'tau' if j.kind == 'hinge' else 'f'}" for j in layout.flanges]
    return [
        *positions(layout),
        *speeds(layout),
        *forces,
        *activations(layout),
        *controls(layout),
        *wrenches(layout),
    ]


def declarations(layout: Layout, *, steady: bool) -> Iterator[tuple[str, Real]]:
    """Yield all quantities but those that are observed, with start values."""
    for joint in layout.joints:
        yield from _of_joint(joint, steady)
    for name in activations(layout):
        yield name, variable("1", start=0.0, fixed=not steady, description="state of the actuator")
    for name in controls(layout):
        yield name, real_input("1", default=0.0, description="control of the actuator")
    for name in wrenches(layout):
        unit = "N*m" if "_tau_" in name else "N"
        yield name, real_input(unit, default=0.0, description="acts at the site, in world directions")


def _of_joint(joint: Joint, steady: bool) -> Iterator[tuple[str, Real]]:
    name, what, free = joint.name, f"of the joint {joint.label}", joint.kind == "free"
    for (ending, unit), value in zip(POSITION[joint.kind], joint.q_start, strict=True):
        fixed = not steady or (free and ending in HELD)
        yield name + ending, variable(unit, start=value, fixed=fixed, description=f"position {what}")
    for (ending, unit), value in zip(SPEED[joint.kind], joint.v_start, strict=True):
        fixed = not steady or not (free and ending in CREEPING)
        start = 0.0 if steady else value
        yield name + ending, variable(unit, start=start, fixed=fixed, description=f"speed {what}")
    for ending, unit in ACCELERATION[joint.kind]:
        yield name + ending, variable(unit, description=f"acceleration {what}")
    if free and steady:
        yield (
            f"{name}_heading",
            parameter("rad", default=joint.heading, description="in which it stands at the start"),
        )

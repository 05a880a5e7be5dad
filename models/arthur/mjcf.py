"""The quadruped's rigid bodies as an MJCF text for MuJoCo."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.dimensions import JOINTS, LEGS, Dimensions, Link, front_of, side_of

AXES = {"abduction": "1 0 0", "hip": "0 1 0", "knee": "0 1 0"}
ROUGHNESS = 1e-4
"""Torsional and rolling friction of the feet [m]; without effect on contacts of three directions."""


@dataclass(frozen=True, slots=True)
class Terrain:
    """The ground: level, and from ``start`` [m] ahead of the origin on a step or a slope.

    ``step`` [m]: height of a step, up. ``slope`` [rad]: angle of a slope, positive uphill.
    """

    step: float = 0.0
    slope: float = 0.0
    start: float = 0.5


TERRAINS = {"flat": Terrain(), "step": Terrain(step=0.03), "slope": Terrain(slope=0.1)}


@dataclass(frozen=True, slots=True)
class Payload:
    """A block fastened to the trunk: mass [kg], centre [m] in the trunk's frame, edge [m]."""

    mass: float
    centre: tuple[float, float, float] = (0.0, 0.0, 0.09)
    edge: float = 0.08


def quadruped_mjcf(
    terrain: Literal["flat", "step", "slope"] | Terrain = "flat",
    payload: Payload | float = 0.0,
    robot: Dimensions | None = None,
) -> str:
    """Return the MJCF of the quadruped on a ground; nothing is written.

    Names: bodies ``trunk``, ``FL_thigh``...; the free joint ``base``; joints ``FL_abduction``, ``FL_hip``, ``FL_knee``
    and so for FR, RL, RR; geoms ``FL_foot`` (the others touch nothing) and ``ground``; sites ``imu`` and ``FL_foot``;
    sensors ``orientation``, ``gyro``, ``accelerometer``, ``FL_hip_position``, ``FL_hip_velocity``, ``FL_touch``; the
    keyframe ``stand``. The joints have no limits of their own: the cylinders' stops are the limits.

    Parameters
    ----------
    terrain : "flat", "step" (3 cm), "slope" (0.1 rad uphill), or a Terrain.
    payload : mass of a block on the trunk [kg], or a Payload.
    robot : the dimensions.
    """
    robot = Dimensions() if robot is None else robot
    root = Element("mujoco", model="quadruped")
    SubElement(root, "compiler", angle="radian", autolimits="false")
    option = SubElement(root, "option", cone="elliptic", impratio="10", integrator="Euler", solver="Newton")
    option.set("jacobian", "sparse")  # a fifth faster on three feet or four
    SubElement(option, "flag", warmstart="disable", refsafe="disable")
    visual = SubElement(root, "visual")
    SubElement(visual, "global", offwidth="1280", offheight="720")
    _assets(SubElement(root, "asset"))
    world = SubElement(root, "worldbody")
    SubElement(world, "light", pos="0 -1 3", dir="0 0.3 -1", directional="true")
    _ground(world, _terrain(terrain))
    _trunk(world, robot, payload if isinstance(payload, Payload) else Payload(payload))
    _sensors(SubElement(root, "sensor"))
    keyframe = SubElement(root, "keyframe")
    angles = robot.stand * len(LEGS)
    SubElement(keyframe, "key", name="stand", qpos=text(0, 0, robot.stand_height, 1, 0, 0, 0, *angles))
    indent(root)
    return tostring(root, encoding="unicode")


def text(*numbers: float) -> str:
    """Return numbers as an attribute's text, with all digits."""
    return " ".join(repr(number) for number in numbers)


def _terrain(terrain: str | Terrain) -> Terrain:
    if isinstance(terrain, Terrain):
        return terrain
    if terrain not in TERRAINS:
        raise UsageError(
            f"the quadruped has no terrain {terrain!r}", remedy=f"choose one of {', '.join(TERRAINS)}"
        )
    return TERRAINS[terrain]


def _assets(asset: Element) -> None:
    sky = {"type": "skybox", "rgb1": "0.9 0.95 1", "rgb2": "0.6 0.7 0.8", "width": "64", "height": "64"}
    SubElement(asset, "texture", sky, name="sky", builtin="gradient")
    tiles = {
        "type": "2d",
        "rgb1": "0.75 0.75 0.75",
        "rgb2": "0.65 0.65 0.65",
        "width": "256",
        "height": "256",
    }
    SubElement(asset, "texture", tiles, name="tiles", builtin="checker")
    SubElement(asset, "material", name="tiles", texture="tiles", texrepeat="5 5", texuniform="true")


def _ground(world: Element, terrain: Terrain) -> None:
    """Add the ground: contacts arise between what has contype 1 (ground) and conaffinity 1 (feet, trunk)."""
    common = {"contype": "1", "conaffinity": "0", "material": "tiles"}
    SubElement(world, "geom", common, name="ground", type="plane", size="20 20 1")
    if terrain.slope:
        # A second plane: behind its start it lies below the first, so that the ground is the upper one of both.
        place = {"pos": text(terrain.start, 0, 0), "euler": text(0, -terrain.slope, 0)}
        SubElement(world, "geom", place | common, name="slope", type="plane", size="20 20 1")
    if terrain.step:
        length, half = 10.0, terrain.step / 2
        place = {"pos": text(terrain.start + length, 0, half), "size": text(length, length, half)}
        SubElement(world, "geom", place | common, name="step", type="box")


def _trunk(world: Element, robot: Dimensions, payload: Payload) -> None:
    trunk = SubElement(world, "body", name="trunk", pos=text(0, 0, robot.stand_height))
    SubElement(trunk, "freejoint", name="base")
    _inertial(trunk, robot.trunk, 1)
    SubElement(trunk, "site", name="imu", size="0.01")
    half = text(*(edge / 2 for edge in robot.trunk_size))
    SubElement(trunk, "geom", _contact(robot), name="trunk", type="box", size=half, rgba="0.2 0.35 0.5 1")
    if payload.mass:
        body = SubElement(trunk, "body", name="payload", pos=text(*payload.centre))
        size = text(*[payload.edge / 2] * 3)
        block = SubElement(body, "geom", name="payload", type="box", size=size, mass=text(payload.mass))
        block.attrib.update(contype="0", conaffinity="0", rgba="0.8 0.5 0.2 1")
    SubElement(trunk, "camera", name="side", mode="trackcom", pos="0.1 -1.3 0.25", xyaxes="1 0 0 0 0.2 1")
    for leg in LEGS:
        _leg(trunk, leg, robot)


def _leg(trunk: Element, leg: str, robot: Dimensions) -> None:
    side = side_of(leg)
    hip = text(front_of(leg) * robot.hip_x, side * robot.hip_y, 0)
    abduction = _link(trunk, leg, "abduction", hip, robot.abduction, robot)
    _bar(abduction, (0.0, side * robot.offset, 0.0), "0.3 0.3 0.3 1")
    thigh = _link(abduction, leg, "hip", text(0, side * robot.offset, 0), robot.thigh, robot)
    _bar(thigh, (0.0, 0.0, -robot.thigh_length), "0.75 0.75 0.8 1")
    calf = _link(thigh, leg, "knee", text(0, 0, -robot.thigh_length), robot.calf, robot)
    _bar(calf, (0.0, 0.0, -robot.calf_length), "0.75 0.75 0.8 1")
    place = {"pos": text(0, 0, -robot.calf_length)}
    radius = text(robot.foot_radius)
    foot = {"name": f"{leg}_foot", "type": "sphere", "size": radius, "rgba": "0.15 0.15 0.15 1"}
    SubElement(calf, "geom", foot | place | _contact(robot))
    # A touch sensor counts what acts inside its site: a little more than the foot.
    site = {"type": "sphere", "size": text(1.5 * robot.foot_radius), "rgba": "0 0 0 0"}
    SubElement(calf, "site", site | place, name=f"{leg}_foot")


def _link(parent: Element, leg: str, joint: str, place: str, link: Link, robot: Dimensions) -> Element:
    name = {"abduction": "abduction", "hip": "thigh", "knee": "calf"}[joint]
    body = SubElement(parent, "body", name=f"{leg}_{name}", pos=place)
    SubElement(body, "joint", name=f"{leg}_{joint}", axis=AXES[joint], armature=text(robot.armature))
    _inertial(body, link, side_of(leg))
    return body


def _inertial(body: Element, link: Link, side: int) -> None:
    x, y, z = link.centre
    place = text(x, side * y, z)
    SubElement(body, "inertial", pos=place, mass=text(link.mass), diaginertia=text(*link.inertia))


def _bar(body: Element, end: tuple[float, float, float], colour: str) -> None:
    """Add what is seen of a link, from its joint to ``end``; it touches nothing."""
    shape = {"type": "capsule", "fromto": text(0.0, 0.0, 0.0, *end), "size": "0.012"}
    SubElement(body, "geom", shape, contype="0", conaffinity="0", rgba=colour, mass="0")


def _contact(robot: Dimensions) -> dict[str, str]:
    """Return the attributes of what touches the ground: impedance grows from 0, so that contact begins smoothly."""
    return {
        "contype": "0",
        "conaffinity": "1",
        "condim": "3",
        "friction": text(robot.friction, ROUGHNESS, ROUGHNESS),
        "priority": "1",
        "solref": text(robot.contact_time, 1.0),
        "solimp": text(0.0, robot.contact_impedance, robot.contact_width, 0.5, 2.0),
        "mass": "0",
    }


def _sensors(sensor: Element) -> None:
    SubElement(sensor, "framequat", name="orientation", objtype="site", objname="imu")
    SubElement(sensor, "gyro", name="gyro", site="imu")
    SubElement(sensor, "accelerometer", name="accelerometer", site="imu")
    for leg in LEGS:
        for joint in JOINTS:
            SubElement(sensor, "jointpos", name=f"{leg}_{joint}_position", joint=f"{leg}_{joint}")
            SubElement(sensor, "jointvel", name=f"{leg}_{joint}_velocity", joint=f"{leg}_{joint}")
        SubElement(sensor, "touch", name=f"{leg}_touch", site=f"{leg}_foot")

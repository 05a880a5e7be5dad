"""What can be observed of a model beside its coordinates: sensors, contact forces, energies, centre of mass."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from arthur_acausal import UsageError
from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.engine import MjData, MjModel, mujoco
from arthur_acausal.mujoco.layout import Layout, Named, identifier

Measure: TypeAlias = Callable[[MjModel, MjData], "FloatArray | list[float]"]


@dataclass(frozen=True, slots=True)
class Observed:
    """One quantity that is observed."""

    name: str
    unit: str
    description: str


@dataclass(frozen=True, slots=True)
class Group:
    """Quantities that are measured together."""

    observed: tuple[Observed, ...]
    measure: Measure


class ObservingDynamics(Dynamics):
    """The dynamics of a model whose outputs are what is observed."""

    senses = True

    def __init__(self, model: MjModel, layout: Layout, groups: Sequence[Group]) -> None:
        super().__init__(model, layout)
        self._groups = tuple(groups)
        self.observed = tuple(o for group in groups for o in group.observed)

    @property
    def n_outputs(self) -> int:
        return len(self.observed)

    def read(self, outputs: FloatArray) -> None:
        first = 0
        for group in self._groups:
            last = first + len(group.observed)
            outputs[first:last] = group.measure(self.model, self.data)
            first = last


def observables(
    model: MjModel, layout: Layout, observe: Sequence[str], contacts: Sequence[str]
) -> list[Group]:
    """Return what is observed of a model: all its sensors, and what is asked for."""
    for name in observe:
        if name not in GROUPS:
            raise UsageError(f"{name!r} cannot be observed", remedy=f"observe has {', '.join(GROUPS)}")
    groups = [_sensors(model, layout.sensors)] if layout.sensors else []
    groups += [GROUPS[name] for name in dict.fromkeys(observe)]
    return groups + [_contact(model, name) for name in dict.fromkeys(contacts)]


# --- energies and powers


def _energies(model: MjModel, data: MjData) -> list[float]:
    mujoco().mj_energyPos(model, data)
    mujoco().mj_energyVel(model, data)
    potential, kinetic = data.energy.tolist()
    return [kinetic, potential]


def _powers(model: MjModel, data: MjData) -> list[float]:
    v = data.qvel
    forces = (
        data.qfrc_applied,
        data.qfrc_actuator,
        data.qfrc_constraint,
        data.qfrc_passive - data.qfrc_spring - data.qfrc_gravcomp,
    )
    return [float(force @ v) for force in forces]


def _centre(model: MjModel, data: MjData) -> FloatArray:
    mujoco().mj_subtreeVel(model, data)
    return np.concatenate([data.subtree_com[0], data.subtree_linvel[0]])


GROUPS = {
    "energy": Group(
        (
            Observed("E_kinetic", "J", "kinetic energy"),
            Observed("E_potential", "J", "of gravity and of springs; contacts have none"),
        ),
        _energies,
    ),
    "power": Group(
        (
            Observed("P_external", "W", "of flanges and wrenches, into the body"),
            Observed("P_actuators", "W", "of the model's own actuators, into the body"),
            Observed("P_constraints", "W", "of contacts, limits, dry friction and equality constraints"),
            Observed("P_passive", "W", "of dampers and of the medium around: negative"),
        ),
        _powers,
    ),
    "com": Group(
        (
            *(Observed(f"com_{a}", "m", "centre of mass of the model") for a in "xyz"),
            *(Observed(f"com_v_{a}", "m/s", "velocity of the centre of mass") for a in "xyz"),
        ),
        _centre,
    ),
}


# --- contacts


def _contact(model: MjModel, name: str) -> Group:
    """Return the force that acts on a geom, or on all geoms of a body, by contacts."""
    geoms = contact_geoms(model, name)
    made = identifier(name)

    def measure(model: MjModel, data: MjData) -> list[float]:
        normal, total, tangential = 0.0, np.zeros(3), np.zeros(3)
        for force, direction, pushing in contact_forces(model, data, geoms):
            normal += pushing
            total += force
            tangential += force - direction * (force @ direction)
        return [normal, float(np.sqrt(tangential @ tangential)), *total.tolist()]

    what = f"on {name} by contacts"
    return Group(
        (
            Observed(f"{made}_contact_n", "N", f"normal force {what}"),
            Observed(f"{made}_contact_t", "N", f"tangential force {what}"),
            *(Observed(f"{made}_contact_{a}", "N", f"force {what}, in the world") for a in "xyz"),
        ),
        measure,
    )


def contact_geoms(model: MjModel, name: str) -> frozenset[int]:
    """Return the geom of a name, or else all geoms of the body of that name."""
    for k in range(model.ngeom):
        if model.geom(k).name == name:
            return frozenset((k,))
    for b in range(model.nbody):
        if model.body(b).name == name:
            first = int(model.body_geomadr[b])
            return frozenset(range(first, first + int(model.body_geomnum[b])))
    names = [model.geom(k).name for k in range(model.ngeom)] + [
        model.body(b).name for b in range(model.nbody)
    ]
    raise UsageError(
        f"the model has no geom or body {name!r}", remedy=f"it has {', '.join(n for n in names if n)}"
    )


def movable_geoms(model: MjModel) -> dict[int, str]:
    """Return the names of all geoms that can move: their own, or else their bodies'."""
    moves = (model.body_weldid[model.geom_bodyid] != 0).nonzero()[0].tolist()
    return {k: model.geom(k).name or model.body(int(model.geom_bodyid[k])).name or f"geom {k}" for k in moves}


def contact_forces(
    model: MjModel, data: MjData, geoms: frozenset[int]
) -> Iterator[tuple[FloatArray, FloatArray, float]]:
    """Yield of each contact of the geoms with others: force on them [N], normal in the world, normal force [N]."""
    result = np.zeros(6)
    for k, (one, two) in enumerate(data.contact.geom.tolist()):
        if (one in geoms) == (two in geoms):
            continue
        mujoco().mj_contactForce(model, data, k, result)
        frame = data.contact.frame[k].reshape(
            3, 3
        )  # its first row is the normal, from the first geom to the second
        sign = 1.0 if two in geoms else -1.0
        yield sign * (result[:3] @ frame), frame[0], float(result[0])


# --- sensors

AXES = {3: "xyz", 4: "wxyz"}
UNITS = {
    "TOUCH": "N",
    "ACCELEROMETER": "m/s^2",
    "VELOCIMETER": "m/s",
    "GYRO": "rad/s",
    "FORCE": "N",
    "TORQUE": "N*m",
    "RANGEFINDER": "m",
    "BALLANGVEL": "rad/s",
    "FRAMEPOS": "m",
    "FRAMELINVEL": "m/s",
    "FRAMEANGVEL": "rad/s",
    "FRAMELINACC": "m/s^2",
    "FRAMEANGACC": "rad/s^2",
    "SUBTREECOM": "m",
    "SUBTREELINVEL": "m/s",
    "SUBTREEANGMOM": "kg*m^2/s",
    "E_POTENTIAL": "J",
    "E_KINETIC": "J",
    "CLOCK": "s",
}
BY_JOINT = {
    "JOINTPOS": ("rad", "m"),
    "JOINTVEL": ("rad/s", "m/s"),
    "JOINTACTFRC": ("N*m", "N"),
    "JOINTLIMITPOS": ("rad", "m"),
    "JOINTLIMITVEL": ("rad/s", "m/s"),
    "JOINTLIMITFRC": ("N*m", "N"),
}


def _sensors(model: MjModel, sensors: Sequence[Named]) -> Group:
    """Return all sensors at once: a few microseconds each would add up in a controller's sample."""
    places = np.concatenate([np.arange(s.first, s.first + s.size) for s in sensors])
    return Group(
        tuple(observed for sensor in sensors for observed in _of_sensor(model, sensor)),
        lambda model, data: data.sensordata[places],
    )


def _of_sensor(model: MjModel, sensor: Named) -> list[Observed]:
    k = model.sensor(sensor.label).id
    kind = mujoco().mjtSensor(int(model.sensor_type[k])).name.removeprefix("mjSENS_")
    unit = UNITS.get(kind, "1")
    if kind in BY_JOINT:
        slides = model.jnt_type[int(model.sensor_objid[k])] == int(mujoco().mjtJoint.mjJNT_SLIDE)
        unit = BY_JOINT[kind][int(slides)]
    axes = AXES.get(sensor.size, [str(i) for i in range(sensor.size)])
    endings = [""] if sensor.size == 1 else [f"_{a}" for a in axes]
    told = f"sensor {sensor.label}, {kind.lower()}"
    return [Observed(f"sensor_{sensor.name}{ending}", unit, told) for ending in endings]

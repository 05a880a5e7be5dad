"""What an MJCF model consists of as a component sees it: joints, actuators and sensors with names and places.

Names become identifiers: ``front-left/hip`` is ``front_left_hip``. A joint without a name has the name of its body.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import atan2
from typing import Literal, TypeAlias

from arthur_acausal import DeclarationError, UsageError
from arthur_acausal.mujoco.engine import MjModel, mujoco

JointKind: TypeAlias = Literal["free", "ball", "slide", "hinge"]
KINDS: tuple[JointKind, ...] = ("free", "ball", "slide", "hinge")  # as mjtJoint counts them
N_Q = {"free": 7, "ball": 4, "slide": 1, "hinge": 1}
N_V = {"free": 6, "ball": 3, "slide": 1, "hinge": 1}


@dataclass(frozen=True, slots=True)
class Joint:
    """A joint: where its coordinates begin in qpos and qvel, and where it begins.

    ``name`` is an identifier, ``label`` the name in the model, ``flange`` whether components can be connected.
    """

    name: str
    label: str
    kind: JointKind
    q: int
    v: int
    flange: bool
    q_start: tuple[float, ...]
    v_start: tuple[float, ...]

    @property
    def n_q(self) -> int:
        return N_Q[self.kind]

    @property
    def n_v(self) -> int:
        return N_V[self.kind]

    @property
    def heading(self) -> float:
        """Turn about the vertical [rad] in which a free joint begins."""
        w, *_, z = self.q_start[3:]
        return 2.0 * atan2(z, w)


@dataclass(frozen=True, slots=True)
class Named:
    """An actuator, a sensor or a site: its identifier, its name in the model, and where its ``size`` numbers begin."""

    name: str
    label: str
    first: int
    size: int = 1


@dataclass(frozen=True, slots=True)
class Layout:
    """The parts of a model. ``activations``: states of actuators; ``wrenches``: sites that take forces and torques."""

    joints: tuple[Joint, ...]
    controls: tuple[Named, ...]
    activations: tuple[Named, ...]
    sensors: tuple[Named, ...]
    wrenches: tuple[Named, ...]
    n_q: int
    n_v: int

    @property
    def flanges(self) -> tuple[Joint, ...]:
        """Joints of one degree of freedom that components are connected to."""
        return tuple(j for j in self.joints if j.flange)


def identifier(name: str) -> str:
    """Return a name as an identifier."""
    made = re.sub(r"\W", "_", name, flags=re.ASCII)
    return f"_{made}" if not made or made[0].isdigit() or keyword.iskeyword(made) else made


def layout(model: MjModel, *, keyframe: str = "", wrenches: Sequence[str] = ()) -> Layout:
    """Return the parts of a model, and where its joints begin: in a keyframe, or as the model is drawn."""
    q_start, v_start = _start(model, keyframe)
    joints = tuple(_joint(model, j, q_start, v_start) for j in range(model.njnt))
    controls, activations = _actuators(model)
    sensors = tuple(
        Named(identifier(label), label, int(model.sensor_adr[k]), int(model.sensor_dim[k]))
        for k in range(model.nsensor)
        if (label := model.sensor(k).name)
    )
    sites = {model.site(k).name: k for k in range(model.nsite)}
    for name in wrenches:
        _known("site", name, sites)
    found = tuple(Named(identifier(name), name, sites[name]) for name in wrenches)
    for kind, named in (("joint", joints), ("control", controls), ("sensor", sensors), ("site", found)):
        _distinct(kind, named)
    return Layout(joints, controls, activations, sensors, found, int(model.nq), int(model.nv))


def _start(model: MjModel, keyframe: str) -> tuple[list[float], list[float]]:
    if not keyframe:
        return model.qpos0.tolist(), [0.0] * int(model.nv)
    keys = {model.key(k).name: k for k in range(model.nkey)}
    _known("keyframe", keyframe, keys)
    k = keys[keyframe]
    return model.key_qpos[k].tolist(), model.key_qvel[k].tolist()


def _joint(model: MjModel, j: int, q_start: list[float], v_start: list[float]) -> Joint:
    kind = KINDS[int(model.jnt_type[j])]
    q, v = int(model.jnt_qposadr[j]), int(model.jnt_dofadr[j])
    own = model.joint(j).name
    label = own or model.body(int(model.jnt_bodyid[j])).name or f"joint{j}"
    return Joint(
        name=identifier(label),
        label=label,
        kind=kind,
        q=q,
        v=v,
        flange=kind in ("hinge", "slide") and (bool(own) or _actuated(model, j)),
        q_start=tuple(q_start[q : q + N_Q[kind]]),
        v_start=tuple(v_start[v : v + N_V[kind]]),
    )


def _actuated(model: MjModel, j: int) -> bool:
    transmissions = (int(mujoco().mjtTrn.mjTRN_JOINT), int(mujoco().mjtTrn.mjTRN_JOINTINPARENT))
    pairs = zip(model.actuator_trntype.tolist(), model.actuator_trnid[:, 0].tolist(), strict=True)
    return any(kind in transmissions and target == j for kind, target in pairs)


def _actuators(model: MjModel) -> tuple[tuple[Named, ...], tuple[Named, ...]]:
    """Return controls and activations, one by one, named after their actuators."""
    controls, activations = [], []
    count = model.actuator_dyntype.size
    numbers = getattr(model, "actuator_ctrlnum", [1] * count)  # older versions have one control an actuator
    first = 0
    for k in range(count):
        label = model.actuator(k).name or f"actuator{k}"
        name, n = identifier(label), int(numbers[k])
        controls += [Named(name if n == 1 else f"{name}_{i}", label, first + i) for i in range(n)]
        first += n
        n = int(model.actuator_actnum[k])
        begin = int(model.actuator_actadr[k])
        activations += [Named(name if n == 1 else f"{name}_{i}", label, begin + i) for i in range(n)]
    return tuple(controls), tuple(activations)


def _known(kind: str, name: str, names: Iterable[str]) -> None:
    if name not in names:
        raise UsageError(
            f"the model has no {kind} {name!r}", remedy=f"it has {', '.join(n for n in names if n) or 'none'}"
        )


def _distinct(kind: str, named: Sequence[Joint | Named]) -> None:
    seen: dict[str, str] = {}
    for item in named:
        if item.name in seen:
            raise DeclarationError(
                f"two {kind}s would have the same name {item.name!r}",
                cause=f"they are called {seen[item.name]!r} and {item.label!r} in the model",
                remedy="rename one of them; what is no letter, digit or underscore becomes an underscore",
            )
        seen[item.name] = item.label

"""``MujocoBody``: an MJCF model as a component."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from casadi import SX, cos, sin

from arthur_acausal import Component, DeclarationError, Equations, Real, der, external, parameter, variable
from arthur_acausal.components.rotational import Flange as TurningFlange
from arthur_acausal.components.translational import Flange as SlidingFlange
from arthur_acausal.mujoco import quantities
from arthur_acausal.mujoco.function import BodyFunction
from arthur_acausal.mujoco.layout import Joint, Layout
from arthur_acausal.mujoco.load import read
from arthur_acausal.mujoco.recipe import Recipe


class MujocoBody(Component):
    """An MJCF model: its joints' coordinates are states, its hinges and slides are flanges.

    MuJoCo gives the accelerations; contacts, limits, tendons, equality constraints, springs and dampers of the model
    act as MuJoCo computes them. The solver integrates, at its own times: `opt.timestep` has no meaning.

    Each hinge or slide that has a name or an actuator is a connector of that name, a rotational or translational
    flange; a torque into it accelerates the joint in its positive direction. Which quantities there are is told in
    :mod:`arthur_acausal.mujoco.quantities`; they take start values as everywhere: ``MujocoBody(mjcf=...,
    knee_phi=0.3)``. Controls of the model's own actuators are inputs of the actuators' names.

    Parameters
    ----------
    mjcf : path of an MJCF file, or MJCF text. The file is not changed.
    keyframe : name of the keyframe to begin with; default: as the model is drawn, at rest.
    steady : begin at rest, with accelerations of zero: positions are found. What drives the joints must hold them.
    wrenches : names of sites that take forces ``{site}_f_x`` ... [N] and torques ``{site}_tau_x`` ... [N m] as
        inputs, in world directions.
    observe : what is computed besides the sensors, which all are: "energy", "power", "com".
    contacts : names of geoms or bodies whose contact forces are computed.
    k_norm : rate [1/s] at which the length of a quaternion returns to one. MuJoCo normalises quaternions itself, so
        that it does not act on the motion.
    """

    mjcf: str | Path
    keyframe: str = ""
    steady: bool = False
    wrenches: Sequence[str] = ()
    observe: Sequence[str] = ()
    contacts: Sequence[str] = ()
    k_norm: Real = parameter("1/s", default=1.0, min=0.0, description="stabilisation of quaternions")

    _recipe: ClassVar[Recipe | None] = None
    _layout: ClassVar[Layout]
    _observed: ClassVar[tuple[str, ...]] = ()

    if TYPE_CHECKING:  # what is declared depends on the model

        def __init__(
            self,
            *,
            mjcf: str | Path = ...,
            keyframe: str = "",
            steady: bool = False,
            wrenches: Sequence[str] = (),
            observe: Sequence[str] = (),
            contacts: Sequence[str] = (),
            **modifications: Any,
        ) -> None: ...

        def __getattr__(self, name: str) -> Any: ...

    def __new__(cls, **given: Any) -> Any:
        mjcf = given.get("mjcf", getattr(cls, "mjcf", None))
        kind: Any = cls
        if cls._recipe is None and mjcf is not None:
            chosen = {name: given.get(name, getattr(cls, name)) for name in _CHOICES}
            steady, keyframe = bool(chosen.pop("steady")), str(chosen.pop("keyframe"))
            recipe = Recipe(read(mjcf), keyframe, **{name: tuple(v) for name, v in chosen.items()})
            kind = _class_of(kind, recipe, steady)
        return super().__new__(kind)

    @property
    def recipe(self) -> Recipe:
        """The model as data, and what is asked of it."""
        if self._recipe is None:
            raise DeclarationError(
                f"{type(self).__name__} needs mjcf",
                where=self._where,
                remedy="give it the path of an MJCF file: MujocoBody(mjcf=...)",
            )
        return self._recipe

    def build(self) -> None:
        _ = self.recipe
        for joint in self._layout.flanges:
            setattr(self, joint.name, TurningFlange() if joint.kind == "hinge" else SlidingFlange())

    def equations(self) -> Equations:
        parts = self._layout
        for joint in parts.joints:
            yield from self._kinematics(joint)
        inputs = [self._input(path) for path in quantities.inputs(parts)]
        rates = [der(x) for x in self._all(quantities.activations(parts))]
        outputs = [*self._all(quantities.accelerations(parts)), *rates]
        yield "equations of motion", external(BodyFunction(self.recipe), inputs=inputs, outputs=outputs)
        if self._observed:
            function = BodyFunction(self.recipe, observes=True)
            yield "observed", external(function, inputs=inputs, outputs=self._all(self._observed))

    def initial_equations(self) -> Equations:
        if not self.steady:
            return
        for acceleration in self._all(quantities.accelerations(self._layout)):
            yield "at rest", acceleration == 0
        for activation in self._all(quantities.activations(self._layout)):
            yield "at rest", der(activation) == 0
        for joint in self._layout.joints:
            if q := self._all(quantities.quaternion(joint)):
                yield "unit quaternion", sum(x**2 for x in q) == 1
            if joint.kind == "free":
                heading = getattr(self, f"{joint.name}_heading")
                yield "heading", sin(heading / 2) * q[0] == cos(heading / 2) * q[3]

    def _kinematics(self, joint: Joint) -> Equations:
        """Yield how positions follow speeds, and speeds accelerations."""
        names = quantities.of_joint(joint)
        position, speed, acceleration = (self._all(part) for part in names)
        if joint.flange:
            flange = getattr(self, joint.name)
            yield position[0] == (flange.phi if joint.kind == "hinge" else flange.s)
        quaternion = self._all(quantities.quaternion(joint))
        straight = len(position) - len(quaternion)
        for x, v in zip(position[:straight], speed[:straight], strict=True):
            yield v == der(x)
        if quaternion:
            yield from self._turning(quaternion, speed[straight:])
        for v, a in zip(speed, acceleration, strict=True):
            yield a == der(v)

    def _turning(self, quaternion: list[SX], w: list[SX]) -> Equations:
        """Yield q' = q w / 2, with w in the body's own frame, and a pull towards unit length."""
        q_0, q_1, q_2, q_3 = quaternion
        stretch = self.k_norm * (1 - sum(x**2 for x in quaternion))
        yield der(q_0) == -(q_1 * w[0] + q_2 * w[1] + q_3 * w[2]) / 2 + stretch * q_0
        yield der(q_1) == (q_0 * w[0] + q_2 * w[2] - q_3 * w[1]) / 2 + stretch * q_1
        yield der(q_2) == (q_0 * w[1] - q_1 * w[2] + q_3 * w[0]) / 2 + stretch * q_2
        yield der(q_3) == (q_0 * w[2] + q_1 * w[1] - q_2 * w[0]) / 2 + stretch * q_3

    def _input(self, name: str) -> SX:
        """Return a quantity by its path within the body."""
        owner, _, own = name.rpartition(".")
        found: SX = getattr(getattr(self, owner) if owner else self, own)
        return found

    def _all(self, names: Sequence[str]) -> list[SX]:
        return [getattr(self, name) for name in names]


_CHOICES = ("keyframe", "steady", "wrenches", "observe", "contacts")


@lru_cache(maxsize=32)
def _class_of(cls: type[MujocoBody], recipe: Recipe, steady: bool) -> type[MujocoBody]:
    """Return the class with the quantities of a model."""
    parts = recipe.dynamics().layout
    observed = recipe.observing().observed
    declared = dict(quantities.declarations(parts, steady=steady))
    declared |= {o.name: variable(o.unit, description=o.description) for o in observed}
    for name in (*declared, *(joint.name for joint in parts.flanges)):
        if hasattr(cls, name):
            raise DeclarationError(
                f"the model {recipe.source.name} has a part with the name {name!r}",
                cause=f"{cls.__name__} has an attribute of this name",
                remedy="rename it in the model",
            )
    namespace = {
        **declared,
        "__doc__": cls.__doc__,
        "__module__": cls.__module__,
        "_recipe": recipe,
        "_layout": parts,
        "_observed": tuple(o.name for o in observed),
    }
    return type(cls.__name__, (cls,), namespace)

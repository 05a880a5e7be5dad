"""The derivative of MuJoCo's accelerations by staged differences in the tangent space.

Positions are moved along the n_v directions of motion, not along the n_q coordinates: a quaternion has three, not
four. Where only speeds (forces) change, what MuJoCo computes from positions (and speeds) is kept.
"""

from __future__ import annotations

import numpy as np

from arthur_acausal.mujoco.dynamics import Dynamics, FloatArray
from arthur_acausal.mujoco.engine import mujoco

MAX_AGE = 100  # uses of one derivative, where the same contacts act
FORWARD = ((1,), (1.0,))
CENTRAL = ((-2, -1, 1, 2), (1 / 12, -2 / 3, 2 / 3, -1 / 12))  # fourth order
STEP = 1e-6  # of positions [m, rad] and speeds, for forward differences
EXACT_STEP = 1e-5  # for central ones, of fourth order: right to 1e-8 with contacts a few millimetres deep
FORCE_STEP = 1e3  # how much further forces and controls are moved: accelerations are nearly linear in them


class Differences:
    """d outputs / d inputs of a model's dynamics."""

    def __init__(self, dynamics: Dynamics) -> None:
        self.dynamics = dynamics
        model, slots, n_v = dynamics.model, dynamics.slots, dynamics.layout.n_v
        self._base = np.empty(dynamics.n_outputs)
        self._moved = np.empty(slots.count)
        self._value = np.empty(dynamics.n_outputs)
        self._tangent = np.empty((dynamics.n_outputs, n_v))
        self._directions = np.eye(n_v)
        scale = np.ones(slots.count)
        # a force is moved so far that it accelerates about as much as a step says
        scale[slots.tau] = [FORCE_STEP * model.dof_M0[joint.v] for joint in dynamics.layout.flanges]
        scale[slots.ctrl] = FORCE_STEP
        mass, inertia = float(np.sum(model.body_mass)), float(model.stat.meaninertia)
        scale[slots.wrench] = FORCE_STEP * np.tile([mass] * 3 + [inertia] * 3, len(dynamics.layout.wrenches))
        self.scale = scale

    def write(self, inputs: FloatArray, jacobian: FloatArray, *, exact: bool = False) -> bool:
        """Fill ``jacobian`` (n_outputs, n_inputs); False, and NaN in it, where MuJoCo has no result."""
        dynamics, slots = self.dynamics, self.dynamics.slots
        if not dynamics.compute(inputs):
            jacobian.fill(np.nan)
            return False
        dynamics.read(self._base)
        step, scheme = (EXACT_STEP, CENTRAL) if exact else (STEP, FORWARD)
        complete = True
        for k in range(slots.qvel.start, slots.qvel.stop):
            complete &= self._column(inputs, k, jacobian[:, k], 1, step, scheme)
        dynamics.write(inputs)
        complete &= dynamics.forward(inputs, 1)
        for k in range(slots.tau.start, slots.count):
            complete &= self._column(inputs, k, jacobian[:, k], 2, step, scheme)
        for k in range(dynamics.layout.n_v):
            complete &= self._column(inputs, k, self._tangent[:, k], 0, step, scheme)
        self._to_coordinates(inputs, jacobian)
        if not complete:
            jacobian.fill(np.nan)
        return complete

    def _column(
        self,
        inputs: FloatArray,
        k: int,
        column: FloatArray,
        stage: int,
        step: float,
        scheme: tuple[tuple[int, ...], tuple[float, ...]],
    ) -> bool:
        """Difference along input ``k``, or along direction ``k`` of motion where ``stage`` is 0."""
        dynamics, moved = self.dynamics, self._moved
        if stage:
            step *= self.scale[k]
        column.fill(0.0)
        for offset, weight in zip(*scheme, strict=True):
            moved[:] = inputs
            if stage:
                moved[k] += offset * step
            else:
                mujoco().mj_integratePos(
                    dynamics.model, moved[dynamics.slots.qpos], self._directions[k], offset * step
                )
            dynamics.write(moved)
            if not dynamics.forward(moved, stage):
                return False
            dynamics.read(self._value)
            if scheme is FORWARD:
                self._value -= self._base
            column += weight * self._value
        column /= step
        return True

    def _to_coordinates(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """From the directions of motion to qpos: as MuJoCo normalises quaternions, their length has no effect."""
        for joint in self.dynamics.layout.joints:
            q, v, straight = joint.q, joint.v, {"free": 3, "ball": 0}.get(joint.kind, 1)
            jacobian[:, q : q + straight] = self._tangent[:, v : v + straight]
            if joint.kind in ("free", "ball"):
                q, v = q + straight, v + straight
                x, y, z = (
                    np.outer(self._tangent[:, v + k], turn)
                    for k, turn in enumerate(turning(inputs[q : q + 4]))
                )
                jacobian[:, q : q + 4] = x + y + z  # in this order: BLAS has one of its own on each machine


def turning(quaternion: FloatArray) -> FloatArray:
    """Return d theta / d q (3, 4) at a quaternion (w, x, y, z) of any length; theta turns in the body's own frame.

    theta = 2 Im(conj(q) dq) / |q|^2.
    """
    w, x, y, z = quaternion.tolist()
    rows = np.array([[-x, w, z, -y], [-y, -z, w, x], [-z, y, -x, w]])
    found: FloatArray = 2.0 / (w * w + x * x + y * y + z * z) * rows
    return found


class Stale:
    """A derivative that is kept: computed anew when other contacts act than before, and when it is old."""

    def __init__(self, differences: Differences, max_age: int) -> None:
        self.differences = differences
        self.renewals = 0
        self._max_age, self._age = max_age, max_age
        self._signature: bytes | None = b""
        self._kept = np.empty((differences.dynamics.n_outputs, differences.dynamics.slots.count))

    def restart(self) -> None:
        """Compute the next derivative anew."""
        self._age = self._max_age

    def write(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Fill ``jacobian`` with the derivative that is kept, renewed first if it is time."""
        signature = self._acting(inputs)
        if self._age >= self._max_age or self._signature != signature:
            self._age = 0 if self.differences.write(inputs, self._kept) else self._max_age
            self._signature = signature
            self.renewals += 1
        self._age += 1
        jacobian[:] = self._kept

    def _acting(self, inputs: FloatArray) -> bytes | None:
        """Return which contacts and limits act, and how: sticking, sliding, apart; None where there is no result."""
        if not self.differences.dynamics.compute(inputs):
            return None
        data = self.differences.dynamics.data
        found: bytes = data.efc_state.tobytes() + data.contact.geom.tobytes()
        return found

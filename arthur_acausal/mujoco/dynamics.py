"""MuJoCo's equations of motion as a pure function: accelerations from positions, speeds and forces.

Inputs, one after another, in SI and in MuJoCo's order and conventions:

    qpos (n_q)     positions; of a free joint the origin in the world and the quaternion (w, x, y, z)
    qvel (n_v)     speeds; of a free joint the velocity in the world, the angular velocity in the body's own frame
    tau            forces and torques of the joints with flanges
    act            states of actuators
    ctrl           controls of actuators
    wrench (6 k)   for each of k sites: force [N], torque [N m], in world directions, at the site

Outputs: qacc (n_v), then the rates of ``act``.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.mujoco.engine import MjModel, mujoco
from arthur_acausal.mujoco.layout import Layout

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Slots:
    """Which of the inputs are what."""

    qpos: slice
    qvel: slice
    tau: slice
    act: slice
    ctrl: slice
    wrench: slice

    @classmethod
    def of(cls, layout: Layout) -> Slots:
        """Return the places for a model."""
        sizes = (
            layout.n_q,
            layout.n_v,
            len(layout.flanges),
            len(layout.activations),
            len(layout.controls),
            6 * len(layout.wrenches),
        )
        ends = np.cumsum((0, *sizes)).tolist()
        return cls(*(slice(a, b) for a, b in pairwise(ends)))

    @property
    def count(self) -> int:
        """How many inputs there are."""
        return int(self.wrench.stop)


class Dynamics:
    """The model at one state: write inputs, compute, read. It has buffers of its own; the model is shared.

    Attributes
    ----------
    failure : why the last computation has no result, or an empty string.
    at : the inputs that MuJoCo's memory stands for, and behind them whether it stands for any.
    """

    senses = False  # whether sensors are computed

    def __init__(self, model: MjModel, layout: Layout) -> None:
        self.model, self.layout, self.slots = model, layout, Slots.of(layout)
        self.data = data = mujoco().MjData(model)
        self.failure = ""
        self.at = np.zeros(self.slots.count + 1)
        self._mujoco = mujoco()
        # views of MuJoCo's memory, made once: each access to an attribute of MjData costs a conversion
        self._qpos, self._qvel, self._qacc = data.qpos, data.qvel, data.qacc
        self._applied, self._act, self._ctrl = data.qfrc_applied, data.act, data.ctrl
        self._warnings = data.warning.number
        self._flange_dofs = np.array([j.v for j in layout.flanges], dtype=np.intp)
        self._sites = [(s.first, int(model.site_bodyid[s.first])) for s in layout.wrenches]
        self._force = np.empty(layout.n_v)

    @property
    def n_outputs(self) -> int:
        """Accelerations and rates of activations."""
        return self.layout.n_v + len(self.layout.activations)

    def write(self, inputs: FloatArray) -> None:
        """Set the state and all forces. Wrenches are applied by ``forward``: they need the sites' positions."""
        slots = self.slots
        self.at[-1] = 0.0
        self._qpos[:] = inputs[slots.qpos]
        self._qvel[:] = inputs[slots.qvel]
        self._applied[self._flange_dofs] = inputs[slots.tau]
        self._act[:] = inputs[slots.act]
        self._ctrl[:] = inputs[slots.ctrl]

    def forward(self, inputs: FloatArray, stage: int = 0) -> bool:
        """Compute everything for inputs that were written; False, and why in ``failure``, where it has no result.

        ``stage``: 0, or 1 (2) where positions (and speeds) are those of the call before.
        """
        self._warnings.fill(0)
        try:
            if self._sites:
                if stage == 0:
                    self._mujoco.mj_fwdKinematics(self.model, self.data)
                self._apply_wrenches(inputs)
            self._mujoco.mj_forwardSkip(self.model, self.data, stage, not self.senses)
        except self._mujoco.FatalError as error:
            self._mujoco.mj_resetData(self.model, self.data)
            self.failure = f"MuJoCo: {' '.join(str(error).split())}"
            return False
        if self._warnings.any():
            self.failure = "; ".join(self._told())
            return False
        return True

    def compute(self, inputs: FloatArray) -> bool:
        """Write and compute; False where the inputs are no numbers or MuJoCo has no result."""
        if self.at[-1] and self.at[:-1].tobytes() == inputs.tobytes():
            return True
        self.write(inputs)
        if not np.isfinite(inputs.dot(inputs)):
            self.failure = "a position, speed or force is not finite"
            return False
        if not self.forward(inputs):
            return False
        self.at[:-1] = inputs
        self.at[-1] = 1.0
        return True

    def read(self, outputs: FloatArray) -> None:
        """Write accelerations and rates of activations to the begin of ``outputs``."""
        n_v = self.layout.n_v
        outputs[:n_v] = self._qacc
        if self.layout.activations:
            outputs[n_v : self.n_outputs] = self.data.act_dot

    def _apply_wrenches(self, inputs: FloatArray) -> None:
        self._applied.fill(0.0)
        self._applied[self._flange_dofs] = inputs[self.slots.tau]
        wrenches = inputs[self.slots.wrench]
        for k, (site, body) in enumerate(self._sites):
            wrench = wrenches[6 * k : 6 * k + 6]
            self._mujoco.mj_applyFT(
                self.model,
                self.data,
                wrench[:3],
                wrench[3:],
                self.data.site_xpos[site],
                body,
                self._applied,
            )

    def _told(self) -> list[str]:
        texts = {
            "mjWARN_INERTIA": "the mass matrix is singular",
            "mjWARN_CONTACTFULL": "the contact buffer is full",
            "mjWARN_CNSTRFULL": "the constraint buffer is full",
            "mjWARN_BADCTRL": "a control is not a number, or very large",
        }
        kinds = self._mujoco.mjtWarning
        raised = [kinds(k).name for k in np.flatnonzero(self._warnings).tolist()]
        memory = "; give the model more memory: <size memory=...>"
        return [f"MuJoCo: {texts.get(n, n)}{memory if n.endswith('FULL') else ''}" for n in raised]

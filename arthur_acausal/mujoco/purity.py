"""What makes MuJoCo's accelerations a pure function of the state, free of any time step.

Options are forced where that changes how a result is computed, never what is modelled; the rest is refused. The
model of the caller is not changed: options are set on a copy.
"""

from __future__ import annotations

from copy import copy

from arthur_acausal import UsageError
from arthur_acausal.mujoco.engine import MjModel, mujoco

TOLERANCE = 1e-12  # of the constraint solver: relative to the model's mean inertia
ITERATIONS = 100  # Newton's method takes about five

FORCED: dict[str, str] = {
    "integrator": "Euler: MuJoCo does not integrate here; all but `discrete` give the same accelerations",
    "solver": "Newton: the only one that reaches the tolerance",
    "tolerance": f"{TOLERANCE:g}: error of the accelerations far below that of the integration",
    "iterations": f"{ITERATIONS}: enough for the tolerance",
    "warmstart": "disabled: accelerations would depend on the call before",
    "refsafe": "disabled: it ties the stiffness of contacts to opt.timestep",
    "island": "disabled: the order of operations would depend on what touches what",
    "energy": "disabled: what is observed is computed apart",
    "fwdinv": "disabled: a check that costs time",
}
"""Options that are forced, by name, with what they are set to and why."""


def pure(model: MjModel, name: str) -> MjModel:
    """Return a copy of the model whose accelerations are a pure function.

    Raises UsageError, with the part of the model that cannot be one.
    """
    for reason, remedy in _impurities(model):
        raise UsageError(
            f"{name} does not give accelerations as a pure function of its state", cause=reason, remedy=remedy
        )
    forced = copy(model)
    option, disable, enable = forced.opt, mujoco().mjtDisableBit, mujoco().mjtEnableBit
    option.integrator = mujoco().mjtIntegrator.mjINT_EULER
    option.solver = mujoco().mjtSolver.mjSOL_NEWTON
    option.tolerance, option.iterations = TOLERANCE, ITERATIONS
    for bit in (disable.mjDSBL_WARMSTART, disable.mjDSBL_REFSAFE, getattr(disable, "mjDSBL_ISLAND", 0)):
        option.disableflags |= int(bit)
    for bit in (enable.mjENBL_ENERGY, enable.mjENBL_FWDINV):
        option.enableflags &= ~int(bit)
    return forced


def _impurities(model: MjModel) -> list[tuple[str, str]]:
    """Return what cannot be a pure function (cause, remedy). Not all of it exists in every version of MuJoCo."""
    found = []
    option = model.opt
    discrete = getattr(mujoco().mjtIntegrator, "mjINT_DISCRETE", None)
    if discrete is not None and option.integrator == int(discrete):
        found.append(
            (
                'integrator="discrete": what it calls acceleration is the step of a given length',
                'choose another: integrator="implicitfast" is the nearest',
            )
        )
    sleep = getattr(mujoco().mjtEnableBit, "mjENBL_SLEEP", None)
    if sleep is not None and option.enableflags & int(sleep):
        found.append(('<flag sleep="enable"/>: bodies fall asleep after some steps', "remove the flag"))
    if model.nplugin:
        found.append(("it uses a plugin, whose code may keep a state", "model it by components"))
    if getattr(model, "nhistory", 0):
        found.append(
            ("an actuator or sensor has a delay, kept in samples", "take the delay out, or use `sampled`")
        )
    return found + _impure_actuators(model)


def _impure_actuators(model: MjModel) -> list[tuple[str, str]]:
    kinds = mujoco().mjtDyn
    ours = {
        int(getattr(kinds, f"mjDYN_{kind}", kinds.mjDYN_NONE))
        for kind in ("NONE", "INTEGRATOR", "FILTER", "FILTEREXACT", "MUSCLE")
    }
    found = []
    for k, kind in enumerate(model.actuator_dyntype.tolist()):
        name = model.actuator(k).name or f"number {k}"
        instead = "connect a component that does it to the joint's flange"
        if not model.actuator_actnum[k]:
            continue
        if kind not in ours:
            found.append((f"actuator {name!r} has a state that only MuJoCo's steps advance", instead))
        elif model.actuator_actlimited[k] and kind == int(kinds.mjDYN_INTEGRATOR):
            found.append((f"actuator {name!r} integrates within limits, clamped at each step", instead))
        elif model.actuator_actearly[k]:
            found.append(
                (f"actuator {name!r} has actearly: its force looks one step ahead", 'set actearly="false"')
            )
    return found

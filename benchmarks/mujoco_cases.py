"""Reference cases of rigid bodies, built as MJCF from the case's parameters and solved by ``MujocoBody``."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from arthur_acausal import SolverOptions, translate
from arthur_acausal.mujoco import MujocoBody

POINT = 1e-15  # kg m^2, stands for the inertia of a point mass: MuJoCo takes no zero


def double_pendulum(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Return the largest error of angles and speeds; the case's angles are from the vertical, MuJoCo's relative."""
    given, (one, two, w_one, w_two) = case["parameters"], case["y0"]

    def link(name: str, k: int, inner: str) -> str:
        length, mass = given[f"l{k}"], given[f"m{k}"]
        above = given["l1"] if k == 2 else 0.0
        return (
            f'<body pos="0 0 {-above!r}"><joint name="{name}" axis="0 -1 0"/>'
            f'<inertial mass="{mass!r}" pos="0 0 {-length!r}" diaginertia="{POINT} {POINT} {POINT}"/>{inner}</body>'
        )

    bodies = link("one", 1, link("two", 2, ""))
    text = f'<mujoco><option gravity="0 0 {-given["g"]!r}"/><worldbody>{bodies}</worldbody></mujoco>'
    start: dict[str, Any] = {"one_phi": one, "two_phi": two - one, "one_w": w_one, "two_w": w_two - w_one}
    model = translate(MujocoBody(mjcf=text, **start))
    times = {float(key.removeprefix("t=")): np.array(v) for key, v in case["reference"]["values"].items()}
    times = {t: v for t, v in times.items() if t in (1.0, 2.0)}
    errors = []
    for t, reference in times.items():
        solution = model.simulate(t, options=SolverOptions(rtol=1e-10, intervals=1))
        found = np.array([solution.final(path) for path in ("one_phi", "two_phi", "one_w", "two_w")])
        found[1::2] += found[::2]  # the second angle and speed over the first: absolute
        errors.append(float(np.max(np.abs(found - reference))))
    return max(errors), "rtol 1e-10"


def free_rigid_body(case: Mapping[str, Any], folder: Path) -> tuple[float, str]:
    """Return the largest error of the angular velocity at the end."""
    inertia = " ".join(repr(float(x)) for x in case["parameters"]["I"])
    text = (
        '<mujoco><option gravity="0 0 0"/><worldbody><body name="body"><freejoint/>'
        f'<inertial mass="1" pos="0 0 0" diaginertia="{inertia}"/></body></worldbody></mujoco>'
    )
    names = [f"body_w_{axis}" for axis in "xyz"]
    start: dict[str, Any] = dict(zip(names, case["y0"]["w_body"], strict=True))
    model = translate(MujocoBody(mjcf=text, **start))
    solution = model.simulate(30.0, options=SolverOptions(rtol=1e-11, intervals=1))
    found = np.array([solution.final(name) for name in names])
    return float(np.max(np.abs(found - np.array(case["reference"]["w_30"])))), "rtol 1e-11"

"""What each choice of the valve study changes: the case studies run again with one thing different."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from arthur_acausal import Component, Solution, SolverOptions, translate
from arthur_acausal.components.hydraulic.servo_valves import APEX
from arthur_acausal.models.arthur.valves.strokes import GPM, RotaryStroke, SpoolStroke

PRECISE = SolverOptions(rtol=1e-8, intervals=200)
CONTRACTION = 0.9 / 0.98

SHAPES = ("chord", "lens", *APEX)


@dataclass(frozen=True, slots=True)
class Variant:
    """One way of the study: a model with structural options, and parameters; ``says`` what is different."""

    name: str
    kind: type[Component]
    says: str
    options: dict[str, Any] = field(default_factory=dict)
    parameters: dict[str, float] = field(default_factory=dict)

    def run(self) -> Solution:
        """Return the run over the opening."""
        model = self.kind(**self.options)
        return translate(model, compile="never").simulate(1.0, parameters=self.parameters, options=PRECISE)


ROTARY = (
    Variant("default", RotaryStroke, "mended equations, square ports"),
    Variant("without C_c", RotaryStroke, "3.29 to 3.31 as printed", parameters={"C_c": 1.0}),
    Variant("3.25 as printed", RotaryStroke, "+ F_c2 sin", {"pressure_load": "printed"}),
    Variant("as printed", RotaryStroke, "both", {"pressure_load": "printed"}, {"C_c": 1.0}),
    Variant("active ports only", RotaryStroke, "3.23", {"pressure_load": "active only"}),
    Variant("balanced passages", RotaryStroke, "re-routed, 3.2.5", {"pressure_load": "balanced"}),
    Variant("continuous jet angle", RotaryStroke, "3.7 begins where 3.6 ends", {"jet_angle": "continuous"}),
    Variant("turbulent lines", RotaryStroke, "Darcy and Blasius for 3.44", {"line": "turbulent"}),
    Variant("offset 0.2", RotaryStroke, "antagonistic ports, 4.2", parameters={"offset": 0.2}),
    Variant("offset 0.5", RotaryStroke, "antagonistic ports, 4.2", parameters={"offset": 0.5}),
    *(Variant(shape, RotaryStroke, "shape of the passages", {"shape": shape}) for shape in SHAPES),
)

SPOOL = (
    Variant("default", SpoolStroke, "flow limited by the orifices"),
    Variant("with C_c", SpoolStroke, "3.48 with the contraction", parameters={"C_c": CONTRACTION}),
    Variant("two thirds at the load", SpoolStroke, "3.45", parameters={"load_share": 2 / 3}),
    Variant("constant flow", SpoolStroke, "0.5 gpm from s = 0.01, as printed", {"flow": "constant"}),
    Variant("continuous jet angle", SpoolStroke, "3.7 begins where 3.6 ends", {"jet_angle": "continuous"}),
    *(Variant(shape, SpoolStroke, "shape of the ports", {"shape": shape}) for shape in SHAPES),
)


def rotary_numbers(run: Solution) -> dict[str, float]:
    """Return what a variant of the rotary valve comes to; works in uJ, torques in mN m, flows in gpm."""
    W, jet, inertia = run["W_no_jet"], run["W_jet"], run["W_inertia"]
    needed = (
        float(np.interp(0.5 * GPM, run["Q_A"], run["s"])) if run["Q_A"][-1] >= 0.5 * GPM else float("nan")
    )
    return {
        "Q_A_full_gpm": run.final("Q_A") / GPM,
        "s_at_0.5_gpm": needed,
        "T_friction_max_mNm": float(run["T_friction"].max()) * 1e3,
        "T_jet_max_mNm": float(np.abs(run["T_jet"]).max()) * 1e3,
        "T_breakaway_mNm": run.initial("T_breakaway") * 1e3,
        "F_radial_least_N": float(run["F_radial"].min()),
        "F_transient_max_N": float(run["F_transient"].max()),
        "F_shear_max_N": float(run["F_shear"].max()),
        "W_no_jet_uJ": W[-1] * 1e6,
        "W_no_jet_no_inertia_uJ": (W[-1] - inertia[-1]) * 1e6,
        "W_with_jet_uJ": (W[-1] + jet[-1]) * 1e6,
        "W_with_jet_no_inertia_uJ": (W[-1] + jet[-1] - inertia[-1]) * 1e6,
        "W_with_jet_to_0.5_gpm_uJ": at(run, "W_with_jet", needed) * 1e6,
        "W_no_jet_to_0.5_gpm_uJ": at(run, "W_no_jet", needed) * 1e6,
    }


def spool_numbers(run: Solution) -> dict[str, float]:
    """Return what a variant of the spool valve comes to."""
    W, inertia = run["W"][-1], run["W_inertia"][-1]
    needed = float(np.interp(0.5 * GPM * (1 - 1e-6), run["Q_S"], run["s"]))
    return {
        "Q_S_full_gpm": run.final("Q_S") / GPM,
        "s_at_0.5_gpm": needed,
        "F_steady_max_N": float(run["F_steady"].max()),
        "F_friction_max_N": float(run["F_friction"].max()),
        "F_shear_least_N": float(run["F_shear"].min()),
        "W_uJ": W * 1e6,
        "W_no_inertia_uJ": (W - inertia) * 1e6,
        "W_to_0.5_gpm_uJ": at(run, "W", needed) * 1e6,
        "p_needed_max_bar": float(run["p_needed"].max()) / 1e5,
    }


def at(run: Solution, variable: str, s: float) -> float:
    """Return a variable at the opening ``s``, by interpolation."""
    return float(np.interp(s, run["s"], run[variable]))

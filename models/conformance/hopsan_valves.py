"""What stands for valves of Hopsan's default library."""

from __future__ import annotations

from collections.abc import Callable
from math import pi, sqrt
from typing import Any

from arthur_acausal import Component, start
from arthur_acausal.components.hydraulic import (
    CentreEdge,
    CheckValve,
    LoadSelector,
    LoadSensingValve,
    MeteringEdge,
    OpenCentreValve,
    PilotCheckValve,
    Spool,
    SwitchedCheckValve,
    Valve22,
    Valve33,
    Valve43,
)
from arthur_acausal.models.conformance.hopsan_given import RHO, Given

Make = Callable[[Given], Component]
SMALL = 1.0
"""Pressure drop [Pa] below which orifices are laminar: in Hopsan they are turbulent throughout."""


def _area(gain: float) -> float:
    """Return the area [m^2] that has the flow coefficient ``gain`` [m^3/(s Pa^0.5)] with C_d = 1."""
    return gain / sqrt(2 / RHO)


def check_valve(g: Given) -> CheckValve:
    crack = g("p_f", g("F_s", 0.0))
    return CheckValve(
        A_max=_area(g("K_s", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        dp_small=SMALL,
        fluid=g.fluid,
    )


def pilot_check_valve(g: Given) -> PilotCheckValve:
    crack = g("p_f", 1e5)
    return PilotCheckValve(
        A_max=_area(g("K_s", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        ratio=g("phi", 3.5),
        dp_small=SMALL,
        fluid=g.fluid,
    )


def switched_check_valve(g: Given) -> SwitchedCheckValve:
    crack = g("F_s", 0.0)
    return SwitchedCheckValve(
        A_max=_area(g("Kv_check", 5e-7)),
        A_held=_area(g("Kv_open", 5e-7)),
        C_d=1.0,
        dp_crack=crack,
        dp_open=crack + SMALL,
        dp_small=SMALL,
        hold=g("in", 0.0),
        fluid=g.fluid,
    )


def _spool(g: Given, *, one_sided: bool = False, switched: bool = False) -> Spool:
    x_max = g("x_vmax", 0.01)
    return Spool(
        switched=switched,
        x_max=x_max,
        x_min=0.0 if one_sided or switched else -x_max,
        omega=g("omega_h", 100.0),
        zeta=g("delta_h", 1.0),
        position=start(min(max(g("xv", 0.0), -x_max), x_max), fixed=True),
    )


def _edge(g: Given, which: str, overlap: float | None = None) -> dict[str, Any]:
    """Return the parameters of a metering edge; without ``overlap`` that of the case."""
    return {
        "width": g(f"f_{which}", g("f", 1.0)) * pi * g("d", 0.01),
        "overlap": g(f"x_{which}", -1e-6) if overlap is None else overlap,
        "C_d": g.discharge(g("C_q", 0.67), g("rho", 890.0)),
        "dp_small": SMALL,
    }


def valve(kind: type[Valve22], *, one_sided: bool = False, switched: bool = False) -> Make:
    """Return what makes a spool valve: an on-off valve's second position is the other end of the stroke."""

    def make(g: Given) -> Valve22:
        x_max = g("x_vmax", 0.01)
        opens = 0.0 if one_sided or switched else None
        closes = -x_max if switched else None
        parts: dict[str, Any] = {"edge_pa": MeteringEdge(**_edge(g, "pa", opens))}
        if issubclass(kind, Valve33):
            parts["edge_at"] = MeteringEdge(**_edge(g, "at", closes))
        if issubclass(kind, Valve43):
            parts["edge_pb"] = MeteringEdge(**_edge(g, "pb", closes))
            parts["edge_bt"] = MeteringEdge(**_edge(g, "bt", opens))
        if issubclass(kind, LoadSensingValve):
            parts["selector"] = LoadSelector(G=1e-8)
        if issubclass(kind, OpenCentreValve):
            parts["edge_cc"] = CentreEdge(x_max=x_max, **_edge(g, "cc"))
        command = g("in", 0.0) if switched else g("in", 0.0) / x_max
        spool = _spool(g, one_sided=one_sided, switched=switched)
        return kind(spool=spool, command=command, fluid=g.fluid, **parts)

    return make

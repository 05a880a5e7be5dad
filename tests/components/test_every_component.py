"""Every class of the library: it balances by itself, its units agree, its docstring tells what it is."""

from __future__ import annotations

import inspect
from types import ModuleType
from typing import Any

import pytest

from arthur_acausal import Component
from arthur_acausal.components import (
    blocks,
    electrical,
    hydraulic,
    planar,
    robotics,
    rotational,
    thermal,
    translational,
)
from arthur_acausal.flatten.flatten import flatten

ABSTRACT = {"TwoPort", "Compliant", "Block", "SISO", "Source"}
ABSTRACT |= {"LineForce", "TwoPin", "FourPin", "HeatingTwoPin", "ThermalElement"}
CURVE = {"times": (0.0, 1.0, 3.0), "values": (0.0, 2.0, 1.0)}
STRUCTURAL: dict[str, dict[str, Any]] = {
    "TimeTable": CURVE,
    "TableVoltage": CURVE,
    "TableCurrent": CURVE,
    "Table1D": {"us": (0.0, 1.0, 3.0), "ys": (0.0, 2.0, 1.0)},
    "Table2D": {"u1s": (0.0, 1.0), "u2s": (0.0, 1.0, 3.0), "ys": ((0.0, 1.0, 2.0), (2.0, 3.0, 1.0))},
}
OPTIONS = [
    hydraulic.BrushlessMotor(law="dc", clamp="none"),
    hydraulic.BrushlessMotor(clamp="above"),
    hydraulic.ReliefValve(law="listing"),
    hydraulic.ServoValve(law="listing"),
    hydraulic.ServoValve(spool="second order"),
    hydraulic.Cylinder(efficiency="printed"),
    hydraulic.Cylinder(stribeck=True, stop_events=True),
    hydraulic.Cylinder(inertia=False),
    hydraulic.GasReservoir(gas="integrated", stop_events=True),
    hydraulic.Volume(V=1e-3, fluid=hydraulic.Fluid(constant_density=True)),
    hydraulic.Volume(V=1e-3, fluid=hydraulic.Fluid(air=True)),
    hydraulic.Volume(V=1e-3, fluid=hydraulic.Fluid(cavitation=True)),
    hydraulic.Line(L=1.0, d=0.01, friction="turbulent", volume_a=True),
    hydraulic.Line(L=1.0, d=0.01, friction="none", volume_b=True),
    hydraulic.Spool(switched=True),
    hydraulic.CounterbalanceValve(A_max=1e-5, p_set=1e7, vented=True),
    hydraulic.WaveLine(T=0.1, Z_c=1e9, friction=True, R=1e7, wall=True, R_wall=1e6),
    blocks.TimeTable(times=(0.0, 1.0), values=(0.0, 1.0), events=True),
    *(blocks.LimPID(controller=kind, y_max=1.0) for kind in ("P", "PI", "PD", "PID")),
    blocks.TransferFunction(b=(1.0, 2.0), a=(1.0, 3.0, 3.0, 1.0)),
    blocks.TransferFunction(b=(2.0,), a=(4.0,)),
    blocks.StateSpace(A=((0.0, 1.0), (-1.0, -1.0)), B=(0.0, 1.0), C=(1.0, 0.0), D=0.5),
    blocks.Sum(n=4, k=(1.0, -1.0, 2.0, 0.5)),
    blocks.LowpassButterworth(n=5, f=1.0),
    blocks.Table1D(us=(0.0, 1.0, 3.0), ys=(0.0, 2.0, 1.0), smoothness="monotone", extrapolation="linear"),
    electrical.Resistor(R=1.0, use_heat_port=True),
    electrical.HeatingDiode(use_heat_port=False),
    electrical.HeatingNPN(use_heat_port=False),
    electrical.HeatingPNP(charge=False),
    electrical.NMOS(use_heat_port=True),
    thermal.ThermalCollector(m=5),
    planar.Revolute(use_flange=True),
    planar.Prismatic(use_flange=True),
    planar.PointMass(m=1.0, alone=True),
    rotational.BearingFriction(use_support=True, tau_pos=((0.0, 1.0), (1.0, 2.0), (3.0, 2.5))),
    rotational.Brake(use_support=True, f_n_max=1.0),
    rotational.IdealGear(use_support=True),
    rotational.IdealGearR2T(use_support=True, ratio=1.0),
    rotational.LossyGear(use_support=True, losses=((0.0, 0.9, 0.8, 1.0, 1.2), (1.0, 0.95, 0.9, 1.1, 1.3))),
    rotational.TorqueSource(use_support=True),
    rotational.AngleSource(exact=True),
    translational.Brake(use_support=True, f_n_max=1.0),
    translational.MassWithFriction(use_support=True, m=1.0),
    translational.SupportFriction(use_support=True),
]


def library() -> list[type[Component]]:
    """All component classes that can be used as they are."""
    found: list[type[Component]] = []
    modules: list[ModuleType] = [
        blocks,
        electrical,
        hydraulic,
        planar,
        robotics,
        rotational,
        thermal,
        translational,
    ]
    for module in modules:
        members = [getattr(module, name) for name in module.__all__]
        found += [m for m in members if inspect.isclass(m) and issubclass(m, Component)]
    return [c for c in found if c.__name__ not in ABSTRACT]


def example(component: type[Component]) -> Component:
    """Return an instance, with 1 for each parameter that has no default."""
    quantities = component._declarations.quantities
    required: dict[str, Any] = {
        n: 1.0 for n, q in quantities.items() if q.kind == "parameter" and q.default is None
    }
    return component(**required, **STRUCTURAL.get(component.__name__.partition("[")[0], {}))


@pytest.mark.parametrize("component", library(), ids=lambda c: f"{c.__module__.split('.')[-2]}.{c.__name__}")
def test_a_component_balances_and_its_units_agree(component: type[Component]) -> None:
    flat = flatten(example(component))
    assert flat.n_equations == len(flat.variables)


@pytest.mark.parametrize("component", OPTIONS, ids=repr)
def test_each_option_balances(component: Component) -> None:
    flat = flatten(component)
    assert flat.n_equations == len(flat.variables)


@pytest.mark.parametrize(
    "block", [c for c in library() if issubclass(c, blocks.Block)], ids=lambda c: c.__name__
)
def test_a_block_takes_other_units(block: type[blocks.Block]) -> None:
    if block not in (blocks.Clock, blocks.Timer):
        flatten(example(block.of("A")) if issubclass(block, blocks.Source) else example(block.of("A", "m")))


@pytest.mark.parametrize("component", library(), ids=lambda c: c.__name__)
def test_a_component_says_what_it_is(component: type[Component]) -> None:
    assert inspect.getdoc(component)
    for name, quantity in component._declarations.quantities.items():
        assert quantity.unit, name

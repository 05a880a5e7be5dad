"""Whatever the pressures, components without storage conserve mass and take power: properties, not examples."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from arthur_acausal import Component, Connector, Equations, Translation, connect, translate
from arthur_acausal.components import hydraulic as h

OIL = h.Fluid(constant_density=True)
PRESSURE = st.one_of(st.floats(0.0, 3e7), st.sampled_from([0.0, 1e5, 1e7]))
"""Pressures [Pa]; equal ones among them."""


class Rig(Component):
    """A component between pressure sources, one at each of its ports."""

    make: Callable[[], Component]
    ports: tuple[str, ...]

    def build(self) -> None:
        self.part = self.make()
        self.sources = [h.PressureSource(p=1e5, fluid=OIL) for _ in self.ports]

    def equations(self) -> Equations:
        for port, source in zip(self.ports, self.sources, strict=True):
            yield connect(source.port, getattr(self.part, port))


PARTS: dict[str, tuple[Callable[[], Component], dict[str, tuple[float, float]]]] = {
    "orifice": (lambda: h.Orifice(area=1e-5), {}),
    "variable orifice": (lambda: h.VariableOrifice(area=1e-5), {"opening": (0.0, 1.0)}),
    "linear resistance": (lambda: h.LinearResistance(R=1e10), {}),
    "laminar pipe": (lambda: h.LaminarPipe(L=1.0, d=0.01), {}),
    "check valve": (lambda: h.CheckValve(A_max=1e-5, A_leak=1e-9), {}),
    "pilot check valve": (lambda: h.PilotCheckValve(A_max=1e-5), {}),
    "switched check valve": (lambda: h.SwitchedCheckValve(A_max=1e-5, A_held=2e-5), {"hold": (0.0, 1.0)}),
    "relief valve": (lambda: h.ReliefValve(p_c=1e7), {}),
    "reducing valve": (lambda: h.PressureReducingValve(A_max=1e-5, p_set=1e7), {}),
    "sequence valve": (lambda: h.SequenceValve(A_max=1e-5, p_set=1e7), {}),
    "counterbalance valve": (lambda: h.CounterbalanceValve(A_max=1e-5, p_set=1e7), {}),
    "vented counterbalance valve": (lambda: h.CounterbalanceValve(A_max=1e-5, p_set=1e7, vented=True), {}),
    "shuttle valve": (lambda: h.ShuttleValve(A_max=1e-5), {}),
    "metering edge": (lambda: h.MeteringEdge(), {"x": (-1e-3, 1e-3)}),
    "centre edge": (lambda: h.CentreEdge(), {"x": (-1e-3, 1e-3)}),
    "load selector": (lambda: h.LoadSelector(), {"x": (-1e-3, 1e-3)}),
    "valve 2/2": (lambda: h.Valve22(), {"spool.position": (-1e-3, 1e-3)}),
    "valve 3/3": (lambda: h.Valve33(), {"spool.position": (-1e-3, 1e-3)}),
    "valve 4/3": (lambda: h.Valve43(), {"spool.position": (-1e-3, 1e-3)}),
    "open centre valve": (lambda: h.OpenCentreValve(), {"spool.position": (-1e-3, 1e-3)}),
    "load sensing valve": (lambda: h.LoadSensingValve(), {"spool.position": (-1e-3, 1e-3)}),
    "servo valve": (lambda: h.ServoValve(G_leak=1e-13), {"I": (-1.0, 1.0)}),
}


@cache
def rig(name: str) -> tuple[Translation, tuple[str, ...]]:
    make = PARTS[name][0]
    members = type(make())._declarations.parts
    ports = tuple(n for n, part in members.items() if isinstance(part, Connector))
    return translate(Rig(make=make, ports=ports), compile="never"), ports


@pytest.mark.parametrize("name", PARTS)
@settings(max_examples=15, deadline=None)
@given(data=st.data())
def test_mass_is_conserved_and_power_is_taken(name: str, data: st.DataObject) -> None:
    translation, ports = rig(name)
    pressures = [data.draw(PRESSURE) for _ in ports]
    inputs: dict[str, Any] = {}
    begin: dict[str, float] = {}
    for path, (low, high) in PARTS[name][1].items():
        (begin if "." in path else inputs)[f"part.{path}"] = data.draw(st.floats(low, high))
    parameters = {f"sources[{i}].p": p for i, p in enumerate(pressures)}
    solution = translation.simulate(1e-6, parameters=parameters, inputs=inputs, start=begin)
    flows = [float(solution.initial(f"part.{port}.q")) for port in ports]
    largest = max(abs(q) for q in flows)
    assert abs(sum(flows)) <= 1e-9 * largest
    power = sum(p * q for p, q in zip(pressures, flows, strict=True))
    assert power >= -1e-9 * largest * max(pressures)

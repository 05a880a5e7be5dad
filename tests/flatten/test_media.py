"""One medium in all that a connection joins: inherited, shared, or given twice and refused."""

from __future__ import annotations

from typing import Any

import pytest

from arthur_acausal import (
    Component,
    ConnectError,
    Connector,
    Equations,
    Real,
    Record,
    connect,
    flow,
    parameter,
    potential,
    translate,
    variable,
)
from arthur_acausal.components.hydraulic import Fluid, HydraulicPort, Orifice, PressureSource, Volume
from arthur_acausal.flatten.flatten import flatten


class Liquid(Record):
    rho: Real = parameter("kg/m^3", default=1000.0)
    thick: bool = False


class Oil(Liquid):
    nu: Real = parameter("m^2/s", default=1e-5)


class Port(Connector):
    medium = Liquid
    p: Real = potential("Pa")
    q: Real = flow("kg/s")


class Pipe(Component):
    """Flow 1 kg/s whatever the pressure; ``seen``: the density that its equations see."""

    a = Port()
    b = Port()
    liquid: Liquid = Liquid()
    seen: Real = variable("kg/m^3")

    def equations(self) -> Equations:
        yield self.a.p == self.b.p
        yield self.a.q + self.b.q == 0
        yield self.seen == (2 if self.liquid.thick else 1) * self.liquid.rho


class Tank(Component):
    port = Port()
    liquid: Liquid = Liquid()
    p: Real = parameter("Pa", default=0.0)
    seen: Real = variable("kg/m^3")

    def equations(self) -> Equations:
        yield self.port.p == self.p
        yield self.seen == self.liquid.rho


class Row(Component):
    """tank - pipe - pipe, with pipes given by the caller."""

    tank: Tank = Tank()
    first: Pipe = Pipe()
    second: Pipe = Pipe()

    def equations(self) -> Equations:
        yield connect(self.tank.port, self.first.a)
        yield connect(self.first.b, self.second.a)


PATHS = ("tank.seen", "first.seen", "second.seen")


def seen(model: Component, **parameters: Any) -> list[float]:
    """The densities that tank and pipes see."""
    given = {path.replace("__", "."): value for path, value in parameters.items()}
    solution = translate(model).simulate(1.0, parameters=given)
    return [solution.final(path) for path in PATHS]


def test_without_any_all_have_the_default_and_share_it() -> None:
    assert seen(Row()) == [1000.0] * 3
    translation = translate(Row())
    rhos = [info.path for info in translation.dae.parameters.infos if info.path.endswith("rho")]
    assert len(rhos) == 1, "one parameter stands for all"
    assert seen(Row(), second__liquid__rho=800.0) == [800.0] * 3, "by whatever path it is set"


@pytest.mark.parametrize("which", ["tank", "first", "second"])
def test_all_inherit_the_one_that_was_given(which: str) -> None:
    kinds: dict[str, type[Any]] = {"tank": Tank, "first": Pipe, "second": Pipe}
    model = Row(**{which: kinds[which](liquid=Liquid(rho=870.0))})
    assert seen(model) == [870.0] * 3
    assert seen(model, **{f"{which}__liquid__rho": 900.0}) == [900.0] * 3


def test_structural_parameters_of_the_medium_are_inherited_too() -> None:
    assert seen(Row(second=Pipe(liquid=Liquid(rho=500.0, thick=True)))) == [500.0, 1000.0, 1000.0]


def test_a_medium_of_a_subclass_is_inherited_whole() -> None:
    model = Row(tank=Tank(liquid=Oil(rho=850.0, nu=2e-5)))
    assert seen(model) == [850.0] * 3


def test_the_same_medium_given_twice_is_one() -> None:
    class Shared(Component):
        liquid: Liquid = Liquid(rho=700.0)

        def build(self) -> None:
            self.row = Row(tank=Tank(liquid=self.liquid), first=Pipe(liquid=self.liquid))

    solution = translate(Shared()).simulate(1.0)
    assert [solution.final(f"row.{path}") for path in PATHS] == [700.0] * 3
    other = translate(Shared()).simulate(1.0, parameters={"liquid.rho": 600.0})
    assert [other.final(f"row.{path}") for path in PATHS] == [600.0] * 3


def test_two_equal_ones_are_no_contradiction() -> None:
    model = Row(tank=Tank(liquid=Liquid(rho=900.0)), second=Pipe(liquid=Liquid(rho=900.0)))
    assert seen(model) == [900.0] * 3


@pytest.mark.parametrize(
    "other", [Liquid(rho=901.0), Liquid(rho=900.0, thick=True), Oil(rho=900.0), Liquid(rho="0.9 kg/m^3")]
)
def test_two_different_ones_are_refused(other: Liquid) -> None:
    model = Row(tank=Tank(liquid=Liquid(rho=900.0)), second=Pipe(liquid=other))
    with pytest.raises(ConnectError, match="two different media") as caught:
        flatten(model)
    assert {"tank.liquid", "second.liquid"} <= set(str(caught.value).replace("\n", " ").split())


def test_what_is_not_connected_may_differ() -> None:
    class Two(Component):
        left: Row = Row(tank=Tank(liquid=Liquid(rho=600.0)))
        right: Row = Row(tank=Tank(liquid=Liquid(rho=1200.0)))

    solution = translate(Two()).simulate(1.0)
    assert [solution.final(f"{side}.second.seen") for side in ("left", "right")] == [600.0, 1200.0]


def test_media_pass_through_the_connectors_of_a_hierarchical_component() -> None:
    class Box(Component):
        port = Port()
        pipe = Pipe()

        def equations(self) -> Equations:
            yield connect(self.port, self.pipe.a)

    class Plant(Component):
        tank = Tank(liquid=Liquid(rho=333.0))
        box = Box()

        def equations(self) -> Equations:
            yield connect(self.tank.port, self.box.port)

    assert translate(Plant()).simulate(1.0).final("box.pipe.seen") == 333.0


class Vessel(Component):
    """Gives its own fluid to its part, and inherits that fluid itself."""

    fluid: Fluid = Fluid()
    port_a = HydraulicPort()

    def build(self) -> None:
        self.inside = Volume(V=1e-3, fluid=self.fluid)

    def equations(self) -> Equations:
        yield connect(self.port_a, self.inside.port)


class Filling(Component):
    source: PressureSource = PressureSource(p=1e5, fluid=Fluid(rho=870.0))
    vessel: Vessel = Vessel()
    orifice: Orifice = Orifice(area=1e-6)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.orifice.port_a)
        yield connect(self.orifice.port_b, self.vessel.port_a)


def test_a_part_given_an_inherited_fluid_inherits_it_too() -> None:
    solution = translate(Filling()).simulate(0.01)
    assert solution.final("vessel.inside.fluid.rho") == 870.0
    assert solution.final("vessel.fluid.rho") == 870.0

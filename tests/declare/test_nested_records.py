"""Records that hold records: as parameters, shared, replaced, and as a medium."""

from __future__ import annotations

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
    simulate,
    translate,
    variable,
)


class Wall(Record):
    t: Real = parameter("m", default=1e-3)
    E: Real = parameter("Pa", default=2e11)


class Lined(Wall):
    """A wall with a lining, which only carries half."""

    @property
    def modulus(self) -> object:
        return self.E / 2

    lining: Real = parameter("m", default=5e-4)


class Pipe(Record):
    d: Real = parameter("m", default=0.01)
    wall: Wall = Wall()


class Hoop(Component):
    """The stretch of a pipe per pressure, Barlow's formula."""

    pipe: Pipe = Pipe()
    y: Real = variable("1/Pa")

    def equations(self) -> Equations:
        yield self.y == self.pipe.d / (2 * self.pipe.wall.t * self.pipe.wall.E)


def stretch(d: float = 0.01, t: float = 1e-3, modulus: float = 2e11) -> float:
    return d / (2 * t * modulus)


def test_values_of_the_inner_record() -> None:
    model = translate(Hoop(pipe=Pipe(d=0.02, wall=Wall(t="2 mm"))))
    assert model.simulate(1.0).final("y") == pytest.approx(stretch(0.02, 2e-3), rel=1e-12)
    given = model.simulate(1.0, parameters={"pipe.wall.E": 1e11, "pipe.wall.t": 5e-3})
    assert given.final("y") == pytest.approx(stretch(0.02, 5e-3, 1e11), rel=1e-12)


class Line(Component):
    """Two hoops: one of the whole record, one of its inner one in another pipe."""

    pipe: Pipe = Pipe(wall=Wall(t=3e-3))
    first: Hoop = Hoop(pipe=lambda self: self.pipe)  # type: ignore[arg-type]

    def build(self) -> None:
        self.second = Hoop(pipe=self.pipe)
        self.third = Hoop(pipe=Pipe(d=2 * self.pipe.d, wall=self.pipe.wall))


def test_one_value_counts_wherever_the_record_is_shared() -> None:
    model = translate(Line())
    as_built = model.simulate(1.0)
    assert as_built.final("first.y") == pytest.approx(stretch(t=3e-3), rel=1e-12)
    solution = model.simulate(1.0, parameters={"pipe.wall.E": 1e11, "pipe.d": 0.03})
    for path, d in (("first", 0.03), ("second", 0.03), ("third", 0.06)):
        assert solution.final(f"{path}.y") == pytest.approx(stretch(d, 3e-3, 1e11), rel=1e-12)
        assert solution.final(f"{path}.pipe.wall.E") == 1e11
        assert solution.final(f"{path}.pipe.wall.t") == 3e-3


class Modulus(Component):
    """Asks the wall for what only a lined one says."""

    pipe: Pipe = Pipe()
    y: Real = variable("Pa")

    def equations(self) -> Equations:
        wall = self.pipe.wall
        yield self.y == (wall.modulus if isinstance(wall, Lined) else wall.E)


def test_a_replaced_inner_record_is_shared_as_what_it_is() -> None:
    class Owner(Component):
        pipe: Pipe = Pipe()

        def build(self) -> None:
            self.one = Modulus(pipe=self.pipe)
            self.other = Modulus()

    solution = translate(Owner(pipe=Pipe(wall=Lined()))).simulate(1.0, parameters={"pipe.wall.E": 8e10})
    assert solution.final("one.y") == 4e10
    assert solution.final("one.pipe.wall.lining") == 5e-4
    assert solution.final("other.y") == 2e11


def test_a_record_in_no_model_has_its_values() -> None:
    assert float(Pipe(wall=Wall(t=2e-3)).wall.t) == 2e-3
    assert float(Pipe().wall.t) == 1e-3


class Air(Record):
    """Air in a liquid."""

    share: Real = parameter("1", default=0.01)


class FineAir(Air):
    limit: Real = parameter("1", default=0.5)


class Liquid(Record):
    rho: Real = parameter("kg/m^3", default=1000.0)
    air: Air = Air()


class Port(Connector):
    medium = Liquid
    p: Real = potential("Pa")
    q: Real = flow("m^3/s")


class Cell(Component):
    port = Port()
    liquid: Liquid = Liquid()
    y: Real = variable("1")

    def equations(self) -> Equations:
        air = self.liquid.air
        yield self.y == (air.limit if isinstance(air, FineAir) else 1) * air.share
        yield self.port.q == 0


class Source(Cell):
    p: Real = parameter("Pa", default=1e5)

    def equations(self) -> Equations:
        air = self.liquid.air
        yield self.y == (air.limit if isinstance(air, FineAir) else 1) * air.share
        yield self.port.p == self.p


class Joined(Component):
    source: Source = Source()
    cell: Cell = Cell()

    def equations(self) -> Equations:
        yield connect(self.source.port, self.cell.port)


@pytest.mark.parametrize(("air", "share"), [(Air(share=0.03), 0.03), (FineAir(share=0.03), 0.015)])
def test_a_medium_brings_what_it_holds(air: Air, share: float) -> None:
    solution = simulate(Joined(source=Source(liquid=Liquid(air=air))), 1.0)
    assert solution.final("source.y") == pytest.approx(share)
    assert solution.final("cell.y") == pytest.approx(share)


def test_media_that_differ_in_what_they_hold_do_not_meet() -> None:
    def two(first: float, second: float) -> Joined:
        return Joined(
            source=Source(liquid=Liquid(air=Air(share=first))),
            cell=Cell(liquid=Liquid(air=Air(share=second))),
        )

    assert simulate(two(0.02, 0.02), 1.0).final("cell.y") == 0.02
    with pytest.raises(ConnectError, match="two different media meet"):
        translate(two(0.02, 0.03))

"""The balance of each component by itself (Modelica specification 3.6, section 4.8), and what is named if it fails."""

from __future__ import annotations

import pytest

from arthur_acausal import (
    ArthurError,
    Component,
    Equations,
    Real,
    StructureError,
    connect,
    parameter,
    real_input,
    real_output,
    variable,
)
from arthur_acausal.flatten.flatten import flatten
from tests.circuit import Ground, Pin, Resistor, TwoPin, Voltage


def refusal(model: Component) -> StructureError:
    with pytest.raises(StructureError, match="does not balance by itself") as caught:
        flatten(model)
    return caught.value


class Balanced(Component):
    """A potential and a flow at each connector, an input given, an output and a variable determined."""

    p = Pin()
    n = Pin()
    u: Real = real_input("V", default=0.0)
    y: Real = real_output("V")
    x: Real = variable("V")
    R: Real = parameter("ohm", default=1.0)

    def equations(self) -> Equations:
        yield self.p.i + self.n.i == 0
        yield self.p.v - self.n.v == self.R * self.p.i
        yield self.x == self.u
        yield self.y == 2 * self.x


def test_a_balanced_component_passes_and_its_model_is_square() -> None:
    class Rig(Component):
        part = Balanced()
        source = Voltage()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.part.p)
            yield connect(self.source.n, self.part.n)
            yield connect(self.source.n, self.ground.p)

    flat = flatten(Rig())
    assert flat.n_equations == len(flat.variables)


@pytest.mark.parametrize("kept", [(1, 2, 3), (0, 2, 3), (0, 1, 3), (0, 1, 2)])
def test_one_equation_less(kept: tuple[int, ...]) -> None:
    class Short(Balanced):
        def equations(self) -> Equations:
            every = list(super().equations())
            for k in kept:
                yield every[k]

    error = refusal(Short())
    assert "6 equations for 7 unknowns" in error.message
    missing = error.message.split("not determined: ")[1]
    if kept == (0, 1, 2):
        assert missing == "y"
    elif kept == (0, 1, 3):
        assert set(missing.removeprefix("1 of ").split(", ")) == {"x", "y"}, "either would do"
    else:
        assert missing.startswith("1 of "), "any variable of the two connectors"


@pytest.mark.parametrize("at", [0, 2, 4])
def test_one_equation_more_names_one_that_is_too_many(at: int) -> None:
    class Long(Balanced):
        def equations(self) -> Equations:
            every = list(super().equations())
            every.insert(at, self.y - self.x == self.u)
            yield from every

    error = refusal(Long())
    assert "8 equations for 7 unknowns" in error.message
    # of the three that speak of x and y only, one is surplus
    surplus = error.message.split("surplus: ")[1]
    assert surplus.startswith(("x == u", "y == ", "(y-x) == u"))


def test_a_variable_in_no_equation_is_told_though_the_count_is_right() -> None:
    class Odd(Component):
        x: Real = variable("1")
        y: Real = variable("1")

        def equations(self) -> Equations:
            yield self.x == 1
            yield self.x == 2

    flatten(Odd())  # the count of the component is right: the structure tells, once for the whole model


def test_a_flow_that_no_equation_mentions_is_not_the_components_fault() -> None:
    class Blind(Component):
        p = Pin()

        def equations(self) -> Equations:
            yield self.p.v == 0

    flatten(Blind())


def test_the_whole_is_counted_by_what_its_parts_show_outside() -> None:
    class Whole(Component):
        a = Resistor()
        b = Resistor()
        p = Pin()
        n = Pin()
        sum: Real = variable("V")

        def equations(self) -> Equations:
            yield connect(self.p, self.a.p)
            yield connect(self.a.n, self.b.p)
            yield connect(self.b.n, self.n)
            yield self.sum == self.a.v + self.b.v

    class Rig(Component):
        whole: Whole = Whole()
        source = Voltage()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.whole.p)
            yield connect(self.source.n, self.whole.n)
            yield connect(self.source.n, self.ground.p)

    flatten(Rig())

    class Less(Whole):
        def equations(self) -> Equations:
            yield from list(super().equations())[:3]

    error = refusal(Rig(whole=Less()))
    assert error.path == "whole"
    assert "not determined: sum" in error.message
    assert error.where.startswith("test_balance.py:")

    class More(Whole):
        def equations(self) -> Equations:
            yield from super().equations()
            yield "once more", self.a.i == self.b.i

    error = refusal(Rig(whole=More()))
    assert 'surplus: "once more" (test_balance.py:' in error.message


def test_an_output_of_the_whole_that_nothing_gives() -> None:
    class Gain(Component):
        u: Real = real_input("V", default=0.0)
        y: Real = real_output("V")

        def equations(self) -> Equations:
            yield self.y == self.u

    class Whole(Component):
        gain = Gain()
        y: Real = real_output("V")

        def equations(self) -> Equations:
            yield from ()

    assert "not determined: y" in refusal(Whole()).message


def test_a_part_that_is_wrong_is_named_not_its_owner() -> None:
    class Half(TwoPin):
        pass

    class Circuit(Component):
        half = Half()
        ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.half.n, self.ground.p)

    error = refusal(Circuit())
    assert error.path == "half"
    assert error.message.startswith("Half does not balance")


def test_what_nothing_determines_is_told_apart_from_what_lacks_one_of_several() -> None:
    class Loose(Component):
        x: Real = variable("1")
        y: Real = variable("1")
        z: Real = variable("1")
        w: Real = variable("1")

        def equations(self) -> Equations:
            yield self.x == 1
            yield self.y == self.z + self.x

    error = refusal(Loose())
    assert "2 equations for 4 unknowns; not determined: w; 1 of y, z" in error.message
    assert error.remedy == "add an equation that determines w"


def test_an_equation_that_is_surplus_does_not_hide_what_is_missing() -> None:
    class Misaimed(Component):
        x: Real = variable("1")
        y: Real = variable("1")
        z: Real = variable("1")

        def equations(self) -> Equations:
            yield self.x == 1
            yield self.x == 2

    message = refusal(Misaimed()).message
    assert "2 equations for 3 unknowns; not determined: y; z; surplus: x == 2 (test_balance.py:" in message

    class Overfull(Misaimed):
        def equations(self) -> Equations:
            yield from super().equations()
            yield self.x == 3
            yield self.x == self.y

    message = refusal(Overfull()).message
    assert "4 equations for 3 unknowns; surplus: x == 2" in message
    assert message.endswith("; not determined: z")


class Inner(Component):
    """Balanced parts within a list."""

    def build(self) -> None:
        self.parts = [Balanced(), Balanced()]

    def equations(self) -> Equations:
        yield connect(self.parts[0].y, self.parts[1].u)


def test_a_connection_to_what_lies_deeper_is_counted_where_its_part_is_met() -> None:
    class Outer(Component):
        y: Real = real_output("V")
        one: Real = parameter("V", default=1.0)

        def build(self) -> None:
            self.inner = [Inner()]

        def equations(self) -> Equations:
            yield connect(self.inner[0].parts[1].y, self.y)
            yield "twice", self.y == self.one

    assert 'surplus: "twice"' in refusal(Outer()).message


def test_a_list_of_another_components_connectors_is_refused_by_name() -> None:
    class Borrower(Component):
        pins: list[Pin] = []

        def equations(self) -> Equations:
            yield self.pins[0].v == self.pins[1].v

    class Lender(Component):
        def build(self) -> None:
            self.pins = [Pin(), Pin()]
            self.borrower = Borrower(pins=self.pins)

        def equations(self) -> Equations:
            yield connect(self.pins[0], self.pins[1])

    with pytest.raises(ArthurError, match=r"pins\[0\].v belongs to no component"):
        flatten(Lender())

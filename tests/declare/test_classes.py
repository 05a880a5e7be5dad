"""What a class declares: inheritance, defaults, structural parameters, parts, and their paths."""

from __future__ import annotations

import pytest
from casadi import SX

from arthur_acausal import Component, Connector, Equations, Real, Record, flow, parameter, potential, variable
from arthur_acausal.declare.bind import bind_root
from arthur_acausal.declare.model import Model
from arthur_acausal.declare.scope import Scope
from arthur_acausal.errors import DeclarationError


class Port(Connector):
    p: Real = potential("Pa")
    q: Real = flow("m^3/s")


class Liquid(Record):
    rho: Real = parameter("kg/m^3", default=1000.0)
    air: bool = False


class Base(Component):
    a = Port()
    liquid: Liquid = Liquid()
    L: Real = parameter("m", default=2.0)
    A: Real = parameter("m^2", default=lambda self: self.L**2)
    x: Real = variable("m", start=1.0)


class Derived(Base):
    b = Port()
    L: Real = parameter("m", default=3.0)
    n: int = 2
    y: Real = variable("m")

    def build(self) -> None:
        self.cells = [Base(L=self.L / self.n) for _ in range(self.n)]
        self.half = self.n / 2


def bound(model: Component) -> tuple[Component, Scope]:
    scope = Scope()
    root = bind_root(model, scope)
    assert isinstance(root, Component)
    return root, scope


def paths(scope: Scope, space: str) -> list[str]:
    return [declared.path for declared in getattr(scope, space)]


def test_own_quantities_come_first_then_parts_in_order_records_before_others() -> None:
    _, scope = bound(Base())
    assert paths(scope, "variable") == ["x", "a.p", "a.q"]
    assert paths(scope, "parameter") == ["L", "A", "liquid.rho"]


def test_a_subclass_adds_to_its_bases_and_may_declare_anew() -> None:
    _, scope = bound(Derived(n=1))
    assert paths(scope, "variable") == [
        "x",
        "y",
        "a.p",
        "a.q",
        "b.p",
        "b.q",
        "cells[0].x",
        "cells[0].a.p",
        "cells[0].a.q",
    ]
    assert scope.parameter[0].path == "L"
    assert scope.parameter[0].value == 3.0, "the subclass's default"
    assert Base._declarations.quantities["L"].default == 2.0, "the base keeps its own"


def test_mixins_are_read_in_the_order_of_python() -> None:
    class Named(Component):
        L: Real = parameter("m", default=5.0)
        z: Real = variable("m")

    class Both(Named, Base):
        pass

    _, scope = bound(Both())
    assert scope.parameter[0].value == 5.0, "Named stands before Base in the MRO"
    assert paths(scope, "variable")[:2] == ["x", "z"]


def test_lists_of_parts_have_indexed_paths_and_their_own_modifications() -> None:
    root, scope = bound(Derived(n=3))
    assert [p for p in paths(scope, "variable") if p.endswith("].x")] == [f"cells[{i}].x" for i in range(3)]
    cells = root.__dict__["cells"]
    assert isinstance(cells, list) and all(isinstance(cell, Base) for cell in cells)
    assert root.__dict__["half"] == 1.5, "other attributes set in build() are plain Python"


def test_tuples_of_parts_are_taken_as_lists() -> None:
    class Pair(Component):
        def build(self) -> None:
            self.ends = (Base(), Base())

    _, scope = bound(Pair())
    assert {"ends[0].x", "ends[1].x"} <= set(paths(scope, "variable"))


def test_structural_parameters_are_plain_values() -> None:
    assert Derived().n == 2
    assert Derived(n=5).n == 5
    assert Liquid(air=True).air is True
    root, _ = bound(Derived(n=4))
    assert root.__dict__["n"] == 4


def test_private_names_and_class_variables_declare_nothing() -> None:
    class Odd(Component):
        _hidden: int = 3
        x: Real = variable("m")

    assert list(Odd._declarations.structural) == []
    assert not hasattr(Odd(), "medium")
    assert Port._declarations.structural == {}, "medium is a class variable"


def test_a_quantity_is_its_declaration_on_the_class_and_a_symbol_on_an_instance() -> None:
    assert Base.x.unit == "m"
    assert Base.x.kind == "variable"
    root, scope = bound(Base())
    assert isinstance(root, Base)
    assert isinstance(root.x, SX)
    assert str(root.x) == "x"
    assert str(root.a.p) == "a.p"
    assert root.x.element_hash() == root.x.element_hash(), "one symbol, whenever it is asked for"
    atom = scope.atom(root.a.q)
    assert atom is not None
    assert scope.quantity(atom) is Port.q


def test_the_instance_that_the_caller_made_is_not_changed() -> None:
    model = Derived(n=2)
    for _ in range(2):  # it may be used again
        root, _ = bound(model)
        assert root is not model
    assert model._binding is None
    assert "cells" not in model.__dict__


def test_parts_know_where_they_were_made() -> None:
    _, scope = bound(Derived(n=1))
    where = {d.path: d.where for d in scope.parameter}
    assert where["cells[0].L"].startswith("test_classes.py:")
    line = int(where["cells[0].L"].split(":")[1])
    with open(__file__, encoding="utf-8") as file:
        assert "self.cells = [Base(L=self.L / self.n)" in file.read().splitlines()[line - 1]


def test_a_replaceable_part_may_be_given_a_fixed_one_may_not() -> None:
    class Pipe(Component):
        end: Base = Base()
        start_ = Base()

    class Long(Base):
        extra: Real = variable("m")

    _, scope = bound(Pipe(end=Long(L=7.0)))
    assert "end.extra" in paths(scope, "variable")
    with pytest.raises(DeclarationError, match="fixed part"):
        Pipe(start_=Base())  # type: ignore[call-arg]


def test_a_part_may_be_given_as_a_function_of_its_owner() -> None:
    class Inner(Component):
        liquid: Liquid = Liquid()

    class Outer(Component):
        inner: Inner = Inner(liquid=lambda self: self.liquid)  # type: ignore[arg-type]
        liquid: Liquid = Liquid(rho=700.0)

    root, scope = bound(Outer())
    assert isinstance(root, Outer)
    assert [(a._binding.path, b._binding.path) for a, b in scope.shared if a._binding and b._binding] == [
        ("inner.liquid", "liquid")
    ]


def test_one_record_for_several_parts_keeps_their_numbering() -> None:
    class Plant(Component):
        liquid: Liquid = Liquid(rho=900.0)

        def build(self) -> None:
            self.left = Base(liquid=self.liquid)
            self.right = Base(liquid=self.liquid)

    root, scope = bound(Plant())
    assert paths(scope, "parameter").count("left.liquid.rho") == 1
    first = [root.__dict__[name]._binding.first["parameter"] for name in ("left", "right")]
    assert first[1] - first[0] == 3, "the same numbers within each: L, A, liquid.rho"


@pytest.mark.parametrize(
    "when", ["twice in build", "in the class and in build", "mixed list", "twice the same"]
)
def test_parts_are_made_once(when: str) -> None:
    class Wrong(Component):
        part = Base()

        def build(self) -> None:
            if when == "twice in build":
                self.other = Base()
                self.other = Base()
            elif when == "in the class and in build":
                self.part = Base()
            elif when == "mixed list":
                self.parts = [Base(), None]
            else:
                one = Base()
                self.a, self.b = one, one

    with pytest.raises(DeclarationError) as caught:
        bound(Wrong())
    assert caught.value.where.startswith("test_classes.py:")


def test_a_class_level_part_is_a_new_one_in_each_instance() -> None:
    class Twin(Component):
        left: Derived = Derived(n=1)
        right: Derived = Derived(n=1)

    _, scope = bound(Twin())
    assert {"left.a.p", "right.a.p", "left.cells[0].a.p"} <= set(paths(scope, "variable"))
    assert len(set(paths(scope, "variable"))) == len(scope.variable)


def test_equations_of_the_base_run_with_the_subclass() -> None:
    class Law(Base):
        def equations(self) -> Equations:
            yield self.x == self.L

    root, _ = bound(Law())
    assert isinstance(root, Model)
    assert len(list(root.equations())) == 1

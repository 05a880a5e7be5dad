"""The annotation of a replaceable part is its constraining type."""

from __future__ import annotations

import pytest

from arthur_acausal import Component, DeclarationError, Equations, Real, parameter, translate, variable


class Law(Component):
    """The interface: whoever replaces the law has an output y."""

    y: Real = variable("1")


class Constant(Law):
    value: Real = parameter("1", default=2.0)

    def equations(self) -> Equations:
        yield self.y == self.value


class Other(Component):
    """Has a y as well, but is no Law."""

    y: Real = variable("1")

    def equations(self) -> Equations:
        yield self.y == 1.0


class Holder(Component):
    law: Law = Constant()
    either: Law | Other = Constant()

    def equations(self) -> Equations:
        yield from ()


class Chosen(Component):
    """The class of a part is a structural parameter."""

    kind: type[Law] = Constant

    def build(self) -> None:
        self.law = self.kind()


def test_a_replacement_is_a_subclass_of_the_annotation() -> None:
    solution = translate(Holder(law=Constant(value=5.0), either=Other())).simulate(1.0)
    assert solution.final("law.y") == 5.0
    assert solution.final("either.y") == 1.0


def test_what_is_none_is_refused_with_both_classes_and_the_line() -> None:
    with pytest.raises(DeclarationError, match=r"Holder.law must be a Law, which Other is not") as caught:
        translate(Holder(law=Other()))  # type: ignore[arg-type]
    assert "test_constraint.py" in caught.value.where
    assert "base class" in caught.value.remedy
    with pytest.raises(DeclarationError, match=r"Holder.either must be a Law or Other"):
        translate(Holder(either=Holder()))  # type: ignore[arg-type]


def test_a_class_as_a_structural_parameter() -> None:
    class Doubled(Constant):
        def equations(self) -> Equations:
            yield self.y == 2.0 * self.value

    assert translate(Chosen()).simulate(1.0).final("law.y") == 2.0
    assert translate(Chosen(kind=Doubled)).simulate(1.0).final("law.y") == 4.0

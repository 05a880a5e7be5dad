"""Parts that are there under a condition: made in build(), or given by the caller."""

from __future__ import annotations

import re

import numpy as np
import pytest

from arthur_acausal import (
    Component,
    Connector,
    DeclarationError,
    Equations,
    Real,
    connect,
    der,
    flow,
    parameter,
    potential,
    simulate,
    translate,
)


class Shaft(Connector):
    w: Real = potential("rad/s")
    tau: Real = flow("N*m")


class Rotor(Component):
    shaft = Shaft()
    J: Real = parameter("kg*m^2", default=2.0)

    def equations(self) -> Equations:
        yield self.J * der(self.shaft.w) == self.shaft.tau


class Brake(Component):
    shaft = Shaft()
    d: Real = parameter("N*m*s", default=4.0)

    def equations(self) -> Equations:
        yield self.shaft.tau == self.d * self.shaft.w


class Hard(Brake):
    d: Real = parameter("N*m*s", default=8.0)


class Built(Component):
    """A brake that a flag decides about; with ``careless`` it is connected in any case."""

    with_brake: bool = True
    careless: bool = False
    rotor = Rotor()

    def build(self) -> None:
        if self.with_brake:
            self.brake = Brake()

    def equations(self) -> Equations:
        if self.with_brake or self.careless:
            yield connect(self.rotor.shaft, self.brake.shaft)

    def initial_equations(self) -> Equations:
        yield self.rotor.shaft.w == self.w_0

    w_0: Real = parameter("rad/s", default=3.0)


class Given(Component):
    """A brake that the caller may give."""

    rotor = Rotor()
    brake: Brake | None = None
    w_0: Real = parameter("rad/s", default=3.0)

    def equations(self) -> Equations:
        if self.brake is not None:
            yield connect(self.rotor.shaft, self.brake.shaft)

    def initial_equations(self) -> Equations:
        yield self.rotor.shaft.w == self.w_0


class Taken(Given):
    """It has one, which the caller may take away or replace."""

    brake: Brake | None = Brake()


class Careless(Given):
    def equations(self) -> Equations:
        yield connect(self.rotor.shaft, self.brake.shaft)  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("model", "d"),
    [
        (Built(), 4.0),
        (Built(with_brake=False), 0.0),
        (Given(), 0.0),
        (Given(brake=Brake(d=1.0)), 1.0),
        (Given(brake=Hard()), 8.0),
        (Taken(), 4.0),
        (Taken(brake=None), 0.0),
        (Taken(brake=Hard()), 8.0),
    ],
)
def test_a_rotor_slows_down_by_the_brake_that_is_there(model: Component, d: float) -> None:
    solution = simulate(model, 1.0, tolerance=1e-9)
    assert solution.final("rotor.shaft.w") == pytest.approx(3.0 * np.exp(-d / 2.0), abs=1e-7)
    assert ("brake.d" in solution) == (d > 0.0)


def test_the_parameters_of_a_given_part_have_paths() -> None:
    model = translate(Given(brake=Brake()))
    solution = model.simulate(1.0, parameters={"brake.d": 2.0}, tolerance=1e-9)
    assert solution.final("rotor.shaft.w") == pytest.approx(3.0 * np.exp(-1.0), abs=1e-7)


def test_what_build_did_not_make_is_told_with_its_condition() -> None:
    with pytest.raises(DeclarationError, match="Built has no 'brake' here") as caught:
        translate(Built(with_brake=False, careless=True))
    error = caught.value
    assert error.cause == "build() makes it only if self.with_brake"
    assert "`if self.with_brake:`" in error.remedy
    assert re.fullmatch(r"test_absent\.py:\d+", error.where)


def test_what_was_not_given_is_told_by_its_name() -> None:
    with pytest.raises(
        DeclarationError, match=r"self\.brake is absent: it is None, and has no 'shaft'"
    ) as caught:
        translate(Careless())
    assert "`if self.brake is not None:`" in caught.value.remedy
    assert caught.value.where.startswith("test_absent.py:")


class Chosen(Component):
    """One of two brakes, by nested conditions, over a declaration that says what it is."""

    level: int = 0
    rotor = Rotor()
    brake: Brake | None = None

    def build(self) -> None:
        if self.level > 0:
            for _ in range(1):
                if self.level > 1:
                    self.brake = Hard()

    def equations(self) -> Equations:
        yield connect(self.rotor.shaft, self.brake.shaft)  # type: ignore[union-attr]


def test_conditions_are_told_in_full() -> None:
    with pytest.raises(DeclarationError) as caught:
        translate(Chosen(level=1))
    assert caught.value.cause == "build() makes it only if self.level > 0 and self.level > 1"
    assert "brake.d" in simulate(Chosen(level=2), 0.1)


class Else(Component):
    stiff: bool = True

    def build(self) -> None:
        if self.stiff:
            self.rotor = Rotor()
        else:
            self.brake = Brake()

    def equations(self) -> Equations:
        yield connect(self.rotor.shaft, self.brake.shaft)


def test_the_other_branch_has_its_own_condition() -> None:
    with pytest.raises(DeclarationError) as caught:
        translate(Else())
    assert caught.value.cause == "build() makes it only if not (self.stiff)"


def test_connect_to_nothing() -> None:
    class Nothing(Component):
        shaft: Shaft | None = None
        rotor = Rotor()

        def equations(self) -> Equations:
            yield connect(self.rotor.shaft, self.shaft)

    with pytest.raises(DeclarationError, match=r"not None") as caught:
        translate(Nothing())
    assert "if self.part is not None" in caught.value.remedy


def test_what_is_given_is_of_the_annotated_class() -> None:
    with pytest.raises(DeclarationError, match="brake must be a Brake or None, which Rotor is not"):
        translate(Given(brake=Rotor()))  # type: ignore[arg-type]
    with pytest.raises(DeclarationError, match="must be a component"):
        translate(
            type("Whole", (Component,), {"__annotations__": {"rotor": Rotor}, "rotor": Rotor()})(rotor=None)
        )

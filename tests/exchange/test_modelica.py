"""The text of exported models: names, units, numbers, expressions, events."""

from __future__ import annotations

import casadi as ca
import pytest
from casadi import SX

from arthur_acausal import (
    Component,
    Equations,
    Real,
    UsageError,
    der,
    discrete,
    if_else,
    parameter,
    pre,
    real_input,
    reinit,
    smooth_if_else,
    terminate,
    time,
    translate,
    variable,
    when,
)
from arthur_acausal.exchange.expression import Printer, number
from arthur_acausal.exchange.names import identifier, model_name, unit

A, B, C, MODE = (SX.sym(name) for name in ("a", "b", "c", "mode"))
PRINTER = Printer(
    {A.element_hash(): "a", B.element_hash(): "b", C.element_hash(): "c"},
    {MODE.element_hash(): "a < b"},
    (),
    (),
    "",
)


@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("h", "h"),
        ("load.flange.s", "'load.flange.s'"),
        ("valves[3].I", "'valves[3].I'"),
        ("end", "'end'"),
        ("größe", "'gr_u00F6_u00DFe'"),
    ],
)
def test_identifiers(path: str, expected: str) -> None:
    assert identifier(path) == expected


def test_model_names() -> None:
    assert model_name("examples.jack") == "examples_jack"
    assert model_name("3D") == "M_3D" and model_name("model") == "M_model"


@pytest.mark.parametrize(
    ("pint", "expected"),
    [
        ("1", "1"),
        ("m^3/s", "m3/s"),
        ("kg*m^2", "kg.m2"),
        ("W/(m^2*K)", "W/(m2.K)"),
        ("N*s/m", "N.s/m"),
        ("W/m/K", "W/(m.K)"),
        ("1/s", "1/s"),
        ("m*s^-2", "m/s2"),
        ("ohm", "Ohm"),
        ("m^2.5/s", ""),
    ],
)
def test_units(pint: str, expected: str) -> None:
    assert unit(pint) == expected


@pytest.mark.parametrize("value", [0.1, 1e-300, 1 / 3, 12345678.0, 1e22, -2.5e-6, 5e-324])
def test_numbers_are_exact(value: float) -> None:
    assert float(number(value)) == value


def test_what_is_no_number_is_refused() -> None:
    with pytest.raises(UsageError, match="nan cannot be written in Modelica"):
        number(float("nan"))


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        (A + B * C, "a + b*c"),
        ((A + B) * C, "(a + b)*c"),
        (A - (B - C), "a - (b - c)"),
        (A - B - C, "a - b - c"),
        (A / (B * C), "a/(b*c)"),
        (A + (-B), "a - b"),
        ((-A) * B, "-a*b"),
        (A * (-B), "-a*b"),
        (A**2, "a^2"),
        ((A + B) ** 2, "(a + b)^2"),
        (A**B, "a^b"),
        ((-A) ** B, "(-a)^b"),
        (A**-1.5, "a^(-1.5)"),
        (2 * A, "2*a"),
        (1 / A, "1/a"),
        (ca.sqrt(A + B), "sqrt(a + b)"),
        (ca.fmax(A, 0), "max(a, 0)"),
        (ca.hypot(A, B), "sqrt(a^2 + b^2)"),
        (ca.floor(A), "noEvent(floor(a))"),
        (ca.if_else(MODE, A, B), "(if a < b then a else b)"),
        (ca.if_else(ca.logic_not(MODE), A, 0), "(if not (a < b) then a else 0)"),
        (ca.if_else(A > B, A, B), "noEvent(if b < a then a else b)"),
        (
            ca.if_else(ca.logic_or(MODE, ca.logic_and(MODE, A > 0)), 1, 0),
            "(if a < b or a < b and 0 < a then 1 else 0)",
        ),
    ],
)
def test_expressions(expression: SX, expected: str) -> None:
    assert PRINTER.real(expression) == expected


def test_an_unknown_operation_is_named() -> None:
    with pytest.raises(UsageError, match="no counterpart in Modelica: erf"):
        PRINTER.real(ca.erf(A))


class Everything(Component):
    """A ball with all there is: "quotes" too."""

    g: Real = parameter("m/s^2", default=9.81, min=0.0, description="gravity")
    e: Real = parameter("1", default=0.7)
    half: Real = parameter("m/s^2", default=lambda self: self.g / 2)
    late: Real = parameter("s", default=0.2)
    line: Real = parameter("m", default=0.5)
    wind: Real = real_input("m/s^2", default=0.5)
    h: Real = variable("m", start=1.0, fixed=True, nominal=2.0, state_select="prefer")
    v: Real = variable("m/s")
    drag: Real = variable("m/s^2")
    n: Real = discrete("1")
    high: Real = discrete("1", start=1.0)

    def equations(self) -> Equations:
        yield "kinematics", der(self.h) == self.v
        yield der(self.v) == self.wind - self.g - self.drag
        yield self.drag == smooth_if_else(self.v > 0, self.half, 0) + if_else(time() > self.late, self.g, 0)
        yield self.high == if_else(self.h > self.line, 1, 0)
        yield when(self.h < 0, reinit(self.v, -self.e * pre(self.v)), self.n == pre(self.n) + 1)
        yield when(self.n > 3, terminate("done"))


def test_a_whole_model() -> None:
    lines = translate(Everything()).to_modelica(stop_time=2.0, parameters={"e": 0.5}).splitlines()
    for line in (
        'model Everything "A ball with all there is: \\"quotes\\" too."',
        '  parameter Real g(unit="m/s2", min=0) = 9.81 "gravity";',
        "  parameter Real e = 0.5;",
        '  parameter Real half(unit="m/s2") = g/2;',
        '  input Real wind(unit="m/s2") = 0.5;',
        '  Real h(unit="m", start=1, fixed=true, nominal=2, stateSelect=StateSelect.prefer);',
        '  Real v(unit="m/s", start=0, fixed=true);',
        "  discrete Real n(start=0, fixed=true);",
        "  Integer high(start=1, fixed=true);",
        "equation",
        "  high = (if line < h then 1 else 0);",
        "    reinit(v, -e*pre(v));",
        "    n = pre(n) + 1;",
        '    terminate("done");',
        "  end when;",
        "  annotation(experiment(StopTime=2, Tolerance=1e-06));",
        "end Everything;",
    ):
        assert line in lines
    text = "\n".join(lines)
    assert (
        "  drag = noEvent(if 0 < v then half else 0) + (if late < time then g else 0); // test_modelica.py:"
        in text
    )
    assert "  der(h) = v; // kinematics test_modelica.py:" in text
    assert "  when h < 0 then // test_modelica.py:" in text


class Sampler(Component):
    """Calls Python at its samples."""

    x: Real = variable("1", start=0.0)
    y: Real = discrete("1")
    rate: Real = parameter("1/s", default=1.0)

    def equations(self) -> Equations:
        from arthur_acausal import sampled

        yield der(self.x) == self.rate * self.y
        yield sampled(lambda x: x + 1.0, period=0.1, inputs=[self.x], outputs=[self.y])


def test_functions_in_python_are_refused() -> None:
    with pytest.raises(UsageError, match="calls a function of Python at its samples"):
        translate(Sampler()).to_modelica()

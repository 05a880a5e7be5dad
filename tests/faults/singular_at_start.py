"""Two equations that are one at the start: the Jacobian is singular."""

from __future__ import annotations

from arthur_acausal import Component, Equations, InitializationError, Real, der, simulate, variable

ERROR = InitializationError
EXPECT = [r"singular Jacobian at t = 0", r"\b(a|b)\b", r"\"product\"", r"\"sum\"", r"remedy"]


class Product(Component):
    x: Real = variable("1", start=2.0, fixed=True)
    a: Real = variable("1", start=1.0)
    b: Real = variable("1", start=1.0)

    def equations(self) -> Equations:
        yield der(self.x) * 1.0 == 0 * self.x
        yield "product", self.a * self.b * self.x == 2.0
        yield "sum", self.a**2 + self.b**2 + 2 * self.a * self.b == 4.0 * self.x / 2.0


def run() -> object:
    return simulate(Product(), 1.0)

"""equations() without a yield."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, parameter, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Tank\b", r"equations\(\)", r"yield"]


class Tank(Component):
    x: Real = variable("m", start=1.0, fixed=True)
    v: Real = parameter("m/s", default=1.0)

    def equations(self) -> Equations:
        der(self.x) == -self.v  # pyright: ignore[reportUnusedExpression]  # noqa: B015
        return None  # type: ignore[return-value]


def run() -> object:
    return translate(Tank())

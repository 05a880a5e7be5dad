"""An equation that names a variable which does not exist."""

from __future__ import annotations

from arthur_acausal import Component, DeclarationError, Equations, Real, der, translate, variable

ERROR = DeclarationError
EXPECT = [r"^Mass\b", r"has no 'sped'|no attribute 'sped'", r"did you mean.* speed"]


class Mass(Component):
    speed: Real = variable("m/s", start=0.0)

    def equations(self) -> Equations:
        yield der(self.sped) == 0  # type: ignore[attr-defined]  # culprit


def run() -> object:
    return translate(Mass())

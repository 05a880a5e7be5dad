"""Integration of power, for energy audits."""

from __future__ import annotations

from typing import Any, cast

from casadi import SX

from arthur_acausal import Component, Equations, Real, der, real_input, variable


class EnergyMeter(Component):
    """Integrates the sum of some powers [W]. State: ``E`` [J], 0 at the start.

    ``EnergyMeter.of(n)`` has n inputs ``P_0`` to ``P_(n-1)``. The integral is a state, so that it is as
    exact as the rest; its nominal, 100 J, is meant for machines of about 1 kW and keeps it from shortening
    the steps.
    """

    E: Real = variable("J", start=0.0, fixed=True, nominal=100.0)

    @classmethod
    def of(cls, n: int) -> type[EnergyMeter]:
        """Return the meter with ``n`` inputs."""
        if (cls, n) not in _MADE:
            _MADE[cls, n] = _with_inputs(cls, n)
        return _MADE[cls, n]

    def inputs(self) -> list[SX]:
        """Return the input signals."""
        return [getattr(self, q.name) for q in self._declarations.quantities.values() if q.kind == "input"]

    def equations(self) -> Equations:
        yield der(self.E) == sum(self.inputs(), SX(0.0))


_MADE: dict[tuple[type[EnergyMeter], int], type[EnergyMeter]] = {}
"""The classes made by ``of``."""


def _with_inputs(meter: type[EnergyMeter], n: int) -> type[EnergyMeter]:
    body: dict[str, Any] = {f"P_{i}": real_input("W") for i in range(n)}
    return cast(
        "type[EnergyMeter]", type(f"EnergyMeter[{n}]", (meter,), {**body, "__module__": meter.__module__})
    )

"""The schemes of the pump's control that the study compares, and what is varied about each: data."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import cast

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.demand import Demand
from arthur_acausal.models.arthur.power_unit import PumpLaw
from arthur_acausal.models.arthur.pump_tuning import tuned
from arthur_acausal.models.arthur.quadruped_options import QuadrupedOptions

RPM, BAR = 2 * pi / 60, 1e5


@dataclass(frozen=True, slots=True)
class SetPoint:
    """What a scheme is told to keep: ``path`` of the parameter, ``unit`` in SI, by ``name`` and ``values`` in it.

    The first value is the scheme's own; the others are tried beside it.
    """

    path: str
    name: str
    unit: float
    values: tuple[float, ...]


SPEED = SetPoint("unit.control.w_0", "rpm", RPM, (5000.0, 4000.0, 3500.0, 3000.0))
TUNED_SPEED = SetPoint("unit.control.w_0", "rpm", RPM, (2762.0,))
PRESSURE = SetPoint("unit.P_des", "bar", BAR, (135.0, 120.0, 105.0, 90.0))


@dataclass(frozen=True, slots=True)
class Scheme:
    """A way of driving the pump.

    Attributes
    ----------
    name, says : as tables and figures have it, and in a few words. law : of the power unit, by default of that name.
    set_point : what it keeps. foresees : whether it uses the plan of the legs. models : whether it uses a model of the
        pump, which may err. knows : whether it knows the demand from a run before.
    """

    name: str
    says: str
    set_point: SetPoint = PRESSURE
    law: PumpLaw | None = None
    foresees: bool = False
    models: bool = False
    knows: bool = False

    def options(self, accumulator: bool, known: Demand | None = None) -> QuadrupedOptions:
        """Return the hydraulics with this scheme."""
        return QuadrupedOptions(pump=self._law, accumulator=accumulator, known=known)

    def tuning(self, accumulator: bool) -> dict[str, float]:
        """Return the parameters that the search has found, the same for all of a scheme's runs, by path."""
        found = {f"unit.control.{name}": x for name, x in tuned(self._law, accumulator).items()}
        return {path: value for path, value in found.items() if path != self.set_point.path}

    @property
    def _law(self) -> PumpLaw:
        return self.law or cast(PumpLaw, self.name)


SCHEMES = (
    Scheme("constant speed", "turns at one speed; the relief valve keeps the pressure", SPEED),
    Scheme("tuned speed", "turns at the one speed that the search has found", TUNED_SPEED, "constant speed"),
    Scheme("pressure", "PI on the supply pressure"),
    Scheme("feed-forward", "PI with feed-forward of the flow asked for now", models=True),
    Scheme("foresight", "PI with feed-forward of the flow that is planned", foresees=True, models=True),
    Scheme("predictive", "model predictive, pressure given", foresees=True, models=True),
    Scheme("predictive pressure", "model predictive, pressure a decision", foresees=True, models=True),
    Scheme(
        "clairvoyant", "model predictive, knows the demand of the same run before", models=True, knows=True
    ),
)
BASELINE, PRESENT = "constant speed", "feed-forward"
"""What the others are compared with: no control, and control by what is measured now. PRESENT's demand is recorded."""


def scheme_named(name: str) -> Scheme:
    """Return a scheme. Raises UsageError for an unknown name."""
    for scheme in SCHEMES:
        if scheme.name == name:
            return scheme
    known = ", ".join(repr(scheme.name) for scheme in SCHEMES)
    raise UsageError(f"the study has no scheme {name!r}", remedy=f"it has {known}")

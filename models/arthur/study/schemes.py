"""The schemes of the pump's control that the study compares, and what is varied about each: data."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.power_unit import PumpLaw
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


SPEED = SetPoint("unit.control.w_0", "rpm", RPM, (5000.0, 4500.0, 4000.0, 3500.0))
PRESSURE = SetPoint("unit.P_des", "bar", BAR, (135.0, 138.0, 130.0, 125.0, 120.0))


@dataclass(frozen=True, slots=True)
class Scheme:
    """A way of driving the pump.

    Attributes
    ----------
    name, says : as tables and figures have it, and in a few words. law : of the power unit.
    set_point : what it keeps. foresees : whether it uses the plan of the legs.
    """

    name: str
    says: str
    law: PumpLaw
    set_point: SetPoint = PRESSURE
    foresees: bool = False

    def options(self, accumulator: bool) -> QuadrupedOptions:
        """Return the hydraulics with this scheme."""
        return replace(QuadrupedOptions(), pump=self.law, accumulator=accumulator)


SCHEMES = (
    Scheme("constant speed", "turns at 5000 rpm; the relief valve keeps the pressure", "constant speed", SPEED),
    Scheme("pressure", "PI on the supply pressure", "pressure"),
    Scheme("feed-forward", "PI with feed-forward of the present flow", "feed-forward"),
)
BASELINE, PRESENT = "constant speed", "feed-forward"
"""What the others are compared with: without any control, and with that of the present flow alone."""


def scheme_named(name: str) -> Scheme:
    """Return a scheme. Raises UsageError for an unknown name."""
    for scheme in SCHEMES:
        if scheme.name == name:
            return scheme
    known = ", ".join(repr(scheme.name) for scheme in SCHEMES)
    raise UsageError(f"the study has no scheme {name!r}", remedy=f"it has {known}")

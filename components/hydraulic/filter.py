"""Filter."""

from __future__ import annotations

from arthur_acausal import Equations, Real, parameter, real_input
from arthur_acausal.components.hydraulic.two_port import TwoPort


class Filter(TwoPort):
    """A constant hydraulic resistance R_hf: p_d = p_s + q R_hf (ARTHuR report, eq. 6.1).

    ``drop`` (structural): "own flow", the default, takes the flow that passes the filter; "signal" takes
    the flow ``Q`` [m^3/s] of a signal, as the report's model does with the pump's flow, though the relief
    valve branches off before the filter. The report does not give R_hf; 1e9 Pa s/m^3 (0.6 bar at 1 gpm) is
    assumed.
    """

    drop: str = "own flow"
    R_hf: Real = parameter("Pa*s/m^3", default=1e9, min=0.0, description="hydraulic resistance; assumed")
    Q: Real = real_input("m^3/s", default=0.0, description='used where drop is "signal"')

    def equations(self) -> Equations:
        yield from super().equations()
        through = self.Q if self.drop == "signal" else self.q
        yield "linear resistance", self.dp == self.R_hf * through

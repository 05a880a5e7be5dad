"""Battery and motor drive."""

from __future__ import annotations

from casadi import fmax, fmin, sqrt

from arthur_acausal import Component, Equations, Real, parameter, real_input, real_output, variable


class BatteryDrive(Component):
    """A battery with internal resistance, and a drive that cannot give more than the bus voltage.

    The bus: V_bus = V_oc - R_i I_bus and V_bus I_bus = P_el/eta_drive, of whose two solutions the one with
    the higher voltage holds (Plett, Battery Management Systems, vol. 1, 2015, ch. 2: the R_int model). The
    drive gives ``V`` = ``V_command`` limited to +-V_bus. Connect ``V`` and ``P_el`` to the motor's. The
    open-circuit voltage does not fall with charge.

    Parameters: ``V_oc`` [V] 44.4 (12 cells in series), ``R_i`` [ohm], ``eta_drive`` [1]: assumed. Valid up
    to the greatest power that the battery can give, V_oc^2/(4 R_i).
    """

    V_command: Real = real_input("V", default=0.0, nominal=40.0)
    P_el: Real = real_input("W", default=0.0, nominal=1e3, description="power that the motor takes")
    V: Real = real_output("V", nominal=40.0, description="voltage that the drive gives")
    V_oc: Real = parameter("V", default=44.4, min=0.0, description="open-circuit voltage; assumed")
    R_i: Real = parameter("ohm", default=0.03, min=0.0, description="internal resistance; assumed")
    eta_drive: Real = parameter("1", default=1.0, min=0.0, max=1.0, description="efficiency of the drive")
    V_bus: Real = variable("V", nominal=40.0, start=40.0, description="bus voltage")
    I_bus: Real = variable("A", nominal=10.0, description="battery current")
    P_loss: Real = real_output("W", description="heat in the battery and the drive")
    P_battery: Real = real_output("W", description="power from the battery's chemistry")

    def equations(self) -> Equations:
        P_bus = self.P_el / self.eta_drive
        rest = fmax(self.V_oc**2 - 4 * self.R_i * P_bus, 0)
        yield "bus voltage", self.V_bus == (self.V_oc + sqrt(rest)) / 2
        yield self.I_bus == P_bus / self.V_bus
        yield "drive", self.V == fmax(fmin(self.V_command, self.V_bus), -self.V_bus)
        yield self.P_battery == self.V_oc * self.I_bus
        yield self.P_loss == self.R_i * self.I_bus**2 + P_bus - self.P_el

"""The hydraulic powertrain of the ARTHuR quadruped: report, sections 5 and 6."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any

from casadi import SX

from arthur_acausal import Component, Equations, Real, Solution, connect, der, parameter, start
from arthur_acausal.components.blocks import EnergyMeter
from arthur_acausal.components.choice import check_choice
from arthur_acausal.components.hydraulic import (
    GPM,
    BatteryDrive,
    BrushlessMotor,
    Cylinder,
    Filter,
    Fluid,
    GasReservoir,
    GearPump,
    ReliefValve,
    ServoValve,
    SignalFilter,
    Volume,
    consistent_displacement,
    gear_size,
    pump_scaling,
)
from arthur_acausal.components.translational import LoadForce
from arthur_acausal.models.arthur.energy import audit_terms, powers
from arthur_acausal.models.arthur.options import Options, options_of
from arthur_acausal.models.arthur.valves.direct import DirectValve, ValveKind, servo_valve

if TYPE_CHECKING:
    from matplotlib.figure import Figure

P_START = 3e5
"""Pressure [Pa] of Table 5, everywhere."""


class Powertrain(Component):
    """Motor, pump, manifold, relief valve, filter, n servo valves with cylinders, gas-piston reservoir.

    External inputs, by path, each 0 unless given: ``motor.V`` [V]; ``valves[i].I`` [A], positive extends;
    ``loads[i].F`` [N], positive pushes against the piston. With a battery the voltage is
    ``drive.V_command``.

    States: ``motor.w``, ``manifold.p``, of each cylinder ``v``, ``y``, ``p_A``, ``p_B``, of the reservoir
    ``v``, ``z``, ``p``. They start as in Table 5, at rest with 3 bar everywhere.

    Structural parameters: ``n`` actuators; ``variant``: "default", or "listing" for the printed Matlab
    code, or ``options`` for any mixture (see Options); ``audit``: ``energy_*.E`` [J] integrate the input,
    each loss and the work. Each energy comes from its own law, none is a difference: a flow q carries rho q
    h(p), a volume stores V (rho h - p), h being the integral of dp/rho. ``balanced``: the pressures at the
    start are no more than guesses; the pistons begin without acceleration under their loads, and the
    manifold in balance with the pump's flow at its speed; ``valve``: "ideal" valves, or the report's "rotary" ones or
    "spool" valves with their loads, each on its drive (see RotaryServoValve, SpoolServoValve).

    Parameters: the report's top-level constants, which it does not give: the flow ``Q_req`` (1 gpm) at the
    speed ``N_0`` (5000 rpm) by which the pump is sized with the efficiency ``eta_v`` (or, consistently,
    with the leakage at ``dp_0``); ``relief.p_c``, ``filter.R_hf`` and the fluid's stand with their parts.
    Tables 6 to 11 are the parts' defaults.
    """

    n: int = 12
    variant: str = "default"
    options: Options | None = None
    audit: bool = True
    balanced: bool = False
    valve: ValveKind = "ideal"
    fluid: Fluid = Fluid()
    Q_req: Real = parameter("m^3/s", default=GPM, min=0.0, display="gpm", description="pump sizing; assumed")
    N_0: Real = parameter("rad/s", default=5000 * 2 * pi / 60, min=0.0, display="rpm", description="assumed")
    eta_v: Real = parameter("1", default=0.85, min=0.0, max=1.0, description="Table 6; 0.7 in section 5.2")
    dp_0: Real = parameter("Pa", default=20.68e6, display="bar", description="of consistent sizing; assumed")
    rho_gear: Real = parameter("kg/m^3", default=7750.0, min=0.0, description="of the pump's gears: steel")
    R_G: Real = parameter("Pa*s/m^3", default=1e12, min=0.0, description="gear resistance, Table 7")
    RR_G: Real = parameter("1/m^3", default=1e8, min=0.0, description="gear reluctance, Table 7")

    def build(self) -> None:
        check_choice(self, "valve", ValveKind)
        self.choice = choice = self._choice()
        self._choose_fluid()
        self.motor = BrushlessMotor(
            law=choice.motor_law,
            clamp=choice.motor_clamp,
            phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True),
        )
        if choice.supply == "battery":
            self.drive = BatteryDrive()
        self.pump = self._pump()
        self.manifold = Volume(fluid=self.fluid, V=4.83e-6, p=start(P_START, fixed=not self.balanced))
        self.relief = ReliefValve(law=choice.relief_law)
        kind = Filter if choice.filter_drop == "own flow" else SignalFilter
        self.filter = kind(p_s=start(P_START))
        ideal = [ServoValve(law=choice.valve_law, spool=choice.spool) for _ in range(self.n)]
        self.valves: list[ServoValve | DirectValve] = [servo_valve(self.valve, one) for one in ideal]
        self.cylinders = [self._cylinder(i) for i in range(self.n)]
        self.loads = [LoadForce() for _ in range(self.n)]
        gas_start: dict[str, Any] = {"p_g": start(P_START, fixed=True)} if choice.gas == "integrated" else {}
        self.reservoir = GasReservoir(
            gas=choice.gas,
            stop_events=choice.stop_events,
            A_R=choice.A_R,
            k=choice.k_R,
            z=start(0.04, fixed=True),
            v=start(0.0, fixed=True),
            p=start(P_START, fixed=not self.balanced),
            **gas_start,
        )
        if self.audit:
            self._add_meters()

    def _choose_fluid(self) -> None:
        fluid, choice = self.fluid, self.choice
        fluid.constant_density = fluid.constant_density or choice.constant_density
        fluid.air = fluid.air or choice.air
        fluid.cavitation = fluid.cavitation or choice.cavitation

    def _pump(self) -> GearPump:
        if self.choice.sizing == "consistent":
            D = consistent_displacement(self.Q_req, self.N_0, self.dp_0, self.R_G, self.RR_G)
            size = gear_size(D, rho_gear=self.rho_gear)
        else:
            size = pump_scaling(self.Q_req, self.N_0, eta_v=self.eta_v, rho_gear=self.rho_gear)
        return GearPump(D=size.D, J=size.J, R_G=self.R_G, RR_G=self.RR_G)

    def _cylinder(self, i: int) -> Cylinder:
        choice = self.choice
        return Cylinder(
            efficiency=choice.efficiency,
            stribeck=choice.stribeck,
            stop_events=choice.stop_events,
            c=choice.c_others if i else choice.c_first,
            A_B=choice.A_B,
            y=start(0.0, fixed=True),
            v=start(0.0, fixed=True),
            p_A=start(P_START, fixed=not self.balanced),
            p_B=start(P_START, fixed=not self.balanced),
        )

    def equations(self) -> Equations:
        tank = self.reservoir.port
        yield connect(self.motor.flange, self.pump.flange)
        yield connect(tank, self.pump.port_a)
        yield connect(self.pump.port_b, self.manifold.port)
        yield connect(self.manifold.port, self.relief.port_a)
        yield connect(self.relief.port_b, tank)
        yield connect(self.manifold.port, self.filter.port_a)
        for valve, cylinder, load in zip(self.valves, self.cylinders, self.loads, strict=True):
            yield connect(self.filter.port_b, valve.port_p)
            yield connect(valve.port_t, tank)
            yield connect(valve.port_a, cylinder.port_a)
            yield connect(valve.port_b, cylinder.port_b)
            yield connect(cylinder.flange, load.flange)
        if isinstance(self.filter, SignalFilter):
            yield connect(self.pump.q, self.filter.Q)
        if self.choice.supply == "battery":
            yield connect(self.drive.V, self.motor.V)
            yield connect(self.motor.P_el, self.drive.P_el)
        if self.audit:
            yield from self._connect_meters()

    def initial_equations(self) -> Equations:
        if self.balanced:
            yield "manifold in balance", der(self.manifold.p) == 0
            for cylinder in self.cylinders:
                yield "piston in balance", der(cylinder.v) == 0

    def _metered(self) -> list[tuple[str, list[SX]]]:
        """Return each meter's name and the signals [W] that it integrates."""
        found = []
        for name, (part, signal) in powers(self.choice.supply).items():
            parts = getattr(self, part.removesuffix("[*]"))
            found.append((name, [getattr(p, signal) for p in (parts if part.endswith("[*]") else [parts])]))
        return found

    def _add_meters(self) -> None:
        for name, signals in self._metered():
            setattr(self, f"energy_{name}", EnergyMeter.of(len(signals))())
        self.energy_valves = [EnergyMeter.of(1)() for _ in range(self.n)]

    def _connect_meters(self) -> Equations:
        for name, signals in self._metered():
            for signal, into in zip(signals, getattr(self, f"energy_{name}").inputs(), strict=True):
                yield connect(signal, into)
        for valve, meter in zip(self.valves, self.energy_valves, strict=True):
            yield connect(valve.P_loss, meter.inputs()[0])

    def audit_terms(self) -> dict[str, Any]:
        """Return the paths that sum to each term of the energy balance: of energies, or else of powers."""
        return audit_terms(self._choice().supply, self.n, self.audit)

    def figure(self, solution: Solution) -> Figure:
        """Return the picture of a run: speed, pressures, flows, chamber pressures and powers."""
        from arthur_acausal.models.arthur.picture import picture

        return picture(solution)

    def _choice(self) -> Options:
        return options_of(self.variant) if self.options is None else self.options

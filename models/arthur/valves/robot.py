"""What the valves mean for the quadruped: pilot loss against direct drive, and how long a battery lasts (section 2)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi, sqrt

from arthur_acausal.components.hydraulic import pump_scaling
from arthur_acausal.models.arthur.valves.strokes import GPM, PSI

RPM = 2 * pi / 60


@dataclass(frozen=True, slots=True)
class Robot:
    """The 10 kg robot of figure 2-2, and how its valves move in a trot. All but the report's values are assumed.

    Attributes
    ----------
    valves, pilot_gpm, pilot_psi : 12 two-stage valves, 0.08 gpm each at 3000 psi (section 2).
    mass, minutes : kg and min of operation, by figure 2-2's budget, with two-stage valves.
    battery : kg, of the robot's mass; ``energy`` Wh/kg of its cells, assumed.
    heavier : kg that a direct-drive valve weighs more than a two-stage one (E242 against E024).
    eta_pump, eta_motor : from the battery to the fluid: 80 to 85 % each (section 2).
    needed_gpm : of the cylinders, the report's pump.
    speed : of the pump, rpm.
    stroke : opening of a valve in a trot, of the full one; ``strides`` Hz; in each it opens and closes to both sides.
    k_m : motor constant of the valve's actuator, N m/sqrt(W); ``lever`` m of a linear one; both assumed.
    """

    valves: int = 12
    pilot_gpm: float = 0.08
    pilot_psi: float = 3000.0
    mass: float = 10.0
    minutes: float = 8.0
    battery: float = 2.0
    energy: float = 180.0
    heavier: float = 0.095
    eta_pump: float = 0.85
    eta_motor: float = 0.8
    needed_gpm: float = 1.0
    speed: float = 5000.0
    stroke: float = 0.5
    strides: float = 2.0
    k_m: float = 0.01
    lever: float = 3.81e-3

    def draw(self) -> float:
        """Return the battery's mean power [W]."""
        return self.battery * self.energy * 60.0 / self.minutes

    def minutes_at(self, power: float) -> float:
        """Return how long [min] the battery gives ``power`` [W]."""
        return self.battery * self.energy * 60.0 / power

    def pilot_flow(self, psi: float) -> float:
        """Return the pilots' flow [gpm] at a supply pressure: an orifice's, as its square root."""
        return self.valves * self.pilot_gpm * sqrt(psi / self.pilot_psi)

    def electrical(self, gpm: float, psi: float) -> float:
        """Return the battery's power [W] for a flow at a pressure."""
        return gpm * GPM * psi * PSI / (self.eta_pump * self.eta_motor)

    def pump(self, gpm: float) -> dict[str, float]:
        """Return the pump that gives a flow (5.15 to 5.20), and the torque at the pilots' pressure."""
        size = pump_scaling(gpm * GPM, self.speed * RPM)
        torque = float(size.c_L) * self.pilot_psi * PSI
        return {
            "flow_gpm": gpm,
            "displacement_cc": float(size.D) * 1e6,
            "torque_Nm": torque,
            "shaft_power_W": torque * self.speed * RPM,
        }

    def minutes_with(self, saved: float, added: float, spent: float) -> float:
        """Return the minutes of operation with ``saved`` W less, ``added`` kg more and ``spent`` W for the drives.

        What is left of the budget grows with the mass: a constant cost of transport.
        """
        return self.minutes_at((self.draw() - saved) * (1 + added / self.mass) + spent)


def robot_numbers(
    robot: Robot, strokes: Mapping[str, tuple[float, float, float]], leaks_gpm: Mapping[str, float]
) -> dict[str, object]:
    """Return what each valve costs the robot.

    ``strokes``: name -> work [J] of opening, work of closing, torque [N m] that holds it open; ``leaks_gpm``: of one
    valve in its middle. Closing gives nothing back; holding costs (torque/k_m)^2 in the windings half of the time.
    """
    psi, pilots = robot.pilot_psi, robot.pilot_flow(robot.pilot_psi)
    saved, added = robot.electrical(pilots, psi), robot.valves * robot.heavier
    result: dict[str, object] = {
        "battery_draw_W": robot.draw(),
        "pilot_flow_gpm": pilots,
        "pilot_flow_2000_psi_gpm": robot.pilot_flow(2000.0),
        "pilot_hydraulic_W": pilots * GPM * psi * PSI,
        "pilot_electrical_W": saved,
        "pump_without_pilots": robot.pump(robot.needed_gpm),
        "pump_with_pilots": robot.pump(robot.needed_gpm + pilots),
        "minutes_two_stage": robot.minutes,
    }
    for name, (opening, closing, torque) in strokes.items():
        moving = robot.valves * 2 * robot.strides * (opening + closing) / robot.eta_motor
        holding = robot.valves * 0.5 * (torque / robot.k_m) ** 2
        leak = robot.electrical(robot.valves * leaks_gpm[name], psi)
        result[name] = {
            "added_mass_kg": added,
            "moving_W": moving,
            "holding_W": holding,
            "leakage_gpm_a_valve": leaks_gpm[name],
            "leakage_electrical_W": leak,
            "minutes": robot.minutes_with(saved, added, moving + holding),
            "minutes_with_leakage": robot.minutes_with(saved, added, moving + holding + leak),
        }
    return result

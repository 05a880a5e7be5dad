"""Transistors, thyristors and active filters of the Modelica Standard Library against their laws."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, Solution, SolverOptions, connect, simulate
from arthur_acausal.components.electrical import (
    NMOS,
    NPN,
    PMOS,
    ConstantVoltage,
    Ground,
    HeatingNPN,
    HeatingPNP,
    RampVoltage,
)
from arthur_acausal.models.conformance import msl_electrical
from arthur_acausal.models.conformance.msl_semiconductors import CASES, CauerLowPassSC

PRECISE = SolverOptions(rtol=1e-8, intervals=1000)


def run(name: str, stop_time: float) -> Solution:
    return simulate(CASES[f"msl_Electrical_Analog_{name}"].model(), stop_time=stop_time, options=PRECISE)


class Characteristic(Component):
    """A transistor with its drain swept from 0 to 5 V, a gate at 3 V; of a PMOS all with the other sign."""

    sign: int = 1
    ground = Ground()

    def build(self) -> None:
        self.transistor = NMOS() if self.sign > 0 else PMOS(beta=4.1e-5, V_t=-0.8, K5=0.7311, dL=-1.5e-6)
        self.gate = ConstantVoltage(V=3.0 * self.sign)
        self.drain = RampVoltage(V=5.0 * self.sign, duration=1.0)

    def equations(self) -> Equations:
        for pin in (self.transistor.source, self.transistor.bulk, self.gate.pin_n, self.drain.pin_n):
            yield connect(pin, self.ground.pin)
        yield connect(self.gate.pin_p, self.transistor.gate)
        yield connect(self.drain.pin_p, self.transistor.drain)


@pytest.mark.parametrize("sign", [1, -1])
def test_a_mos_transistor_is_linear_up_to_pinch_off(sign: int) -> None:
    solution = simulate(Characteristic(sign=sign), stop_time=1.0, options=PRECISE)
    u_ds, u = 5 * solution.t, 0.7311 * (3.0 - 0.8)
    v = 4.1e-5 * (20 - 2.5) / (6 - 1.5)
    i = v * np.where(u_ds < u, u_ds * (u - u_ds / 2), u**2 / 2) + u_ds / 1e7
    assert sign * solution["transistor.drain.i"] == pytest.approx(i, rel=1e-9, abs=1e-15)


class Biased(Component):
    """Transistors at 0.7 V between base and emitter and 5 V at the collector; the PNP with the other sign."""

    npn = HeatingNPN(use_heat_port=False)
    pnp = HeatingPNP(use_heat_port=False)
    plain = NPN()
    ground = Ground()

    def build(self) -> None:
        self.base, self.below = ConstantVoltage(V=0.7), ConstantVoltage(V=-0.7)
        self.collector, self.under = ConstantVoltage(V=5.0), ConstantVoltage(V=-5.0)

    def equations(self) -> Equations:
        for transistor, base, collector in (
            (self.npn, self.base, self.collector),
            (self.plain, self.base, self.collector),
            (self.pnp, self.below, self.under),
        ):
            yield connect(transistor.base, base.pin_p)
            yield connect(transistor.collector, collector.pin_p)
            yield connect(transistor.emitter, self.ground.pin)
        for source in (self.base, self.below, self.collector, self.under):
            yield connect(source.pin_n, self.ground.pin)


def test_a_bipolar_transistor_at_rest_has_the_currents_of_ebers_and_moll() -> None:
    solution = simulate(Biased(), stop_time=1.0)
    forward = 1e-16 * np.expm1(0.7 / 0.02585)
    for pin, value in (("collector", forward * (1 + 4.3 * 0.02)), ("base", forward / 50)):
        assert solution.final(f"npn.{pin}.i") == pytest.approx(value, rel=1e-9)
        assert solution.final(f"npn.{pin}.i") == pytest.approx(solution.final(f"plain.{pin}.i"), rel=1e-9)
        assert solution.final(f"pnp.{pin}.i") == pytest.approx(-solution.final(f"npn.{pin}.i"), rel=1e-9)


def test_a_difference_amplifier_amplifies_and_keeps_the_charge() -> None:
    """What the supply and the current source bring is what capacitors and resistors take."""
    solution = run("DifferenceAmplifier", 1e-8)
    t = solution.t
    for path in ("Transistor1.Tr", "Transistor2.Tr"):
        pins = (solution[f"{path}.{pin}.i"] for pin in ("collector", "base", "emitter"))
        assert np.sum(list(pins), axis=0) == pytest.approx(solution[f"{path}.i_CS"], abs=1e-12)
        junction = np.trapezoid(solution[f"{path}.i_CS"], t)
        assert junction == pytest.approx(1e-12 * solution.final(f"{path}.v_C"), rel=5e-2)
    gain = (solution["R2.pin_n.v"] - solution["R4.pin_n.v"])[t > 4e-9]
    assert np.ptp(gain) > 5 * np.ptp(solution["V1.v"][t > 4e-9])


def test_a_nand_gate_is_low_only_where_both_inputs_are_high() -> None:
    solution = run("NandGate", 1e-7)
    x1, x2, y = (solution[f"Nand.{pin}.v"] for pin in ("x1", "x2", "y"))
    for at in (15e-9, 35e-9, 45e-9, 75e-9):  # each 5 ns or more after the last edge
        k = int(np.argmin(abs(solution.t - at)))
        assert (y[k] < 0.5) == (min(x1[k], x2[k]) > 3.0), at
        assert y[k] < 0.5 or y[k] > 4.9


@pytest.mark.parametrize(("name", "sign"), [("HeatingNPN_NORGate", 1), ("HeatingPNP_NORGate", -1)])
def test_a_nor_gate_is_high_only_where_both_inputs_are_low_and_warms_up(name: str, sign: int) -> None:
    solution = run(name, 100.0)
    x1, x2, y = (sign * solution[f"{part}.v"] for part in ("V1", "V2", "C2"))
    for at, low in ((30.0, False), (62.0, True), (70.0, True), (85.0, True), (95.0, False)):
        k = int(np.argmin(abs(solution.t - at)))
        assert (max(x1[k], x2[k]) > 5.0) == low
        assert (y[k] < 0.5) == low, at
        assert y[k] < 0.5 or y[k] == pytest.approx(6.0, abs=1e-3)
    heat = np.trapezoid(solution["T1.P_loss"] + solution["T2.P_loss"], solution.t)
    assert 0.1 * (solution.final("HeatCapacitor1.T") - 293.15) == pytest.approx(heat, rel=1e-3)


def test_an_inverter_inverts_and_settles_at_the_ambient_temperature() -> None:
    solution = run("HeatingMOSInverter", 5.0)
    sine, out = solution["Sin.v"], solution["Capacitor1.v"]
    assert (out[sine > 4.9] < 0.5).all()  # it takes 20 ms to discharge
    assert (out[(sine < -3.0) & (solution.t > 0.6)] > 4.0).all()
    assert solution.final("HeatCapacitor1.T") == pytest.approx(300.0, abs=0.1)


def test_thyristors_block_and_conduct() -> None:
    """From firing with v > Vknee on to the end of the current, the turn-off one only while it is fired."""
    solution = run("CharacteristicThyristors", 6.0)
    t, v = solution.t, solution["SineVoltage1.v"]
    fired = ((t > 1.25) & (t < 3.2)) | ((t > 4.2) & (t < 4.25)) | ((t > 5.7) & (t < 5.72))
    edge = np.min(np.abs(t[:, None] - np.array([1.25, 3.2, 4.2, 4.25, 5.7, 5.72])), axis=1) < 1e-6
    assert solution["booleanStep1.y"][~edge] == pytest.approx(fired[~edge].astype(float), abs=1e-9)
    gto = solution["IdealGTOThyristor1.blocked"]
    clear = (np.abs(v - 1.0) > 0.1) & ~edge
    assert gto[clear & ~fired] == pytest.approx(1.0)
    assert gto[clear & fired & (v > 1.0)] == pytest.approx(0.0)
    held = (t > 4.26) & (t < 4.45)
    assert solution["IdealThyristor1.blocked"][held] == pytest.approx(0.0)


def test_an_active_filter_is_the_passive_one() -> None:
    """The outputs of its amplifiers are the ladder's voltages."""
    active = run("CauerLowPassOPV", 20.0)
    ladder = msl_electrical.CASES["msl_Electrical_Analog_CauerLowPassAnalog"].model()
    passive = simulate(ladder, stop_time=20.0, options=PRECISE)
    t = np.linspace(0.0, 20.0, 500)
    assert active.at(t, "Op5.out.v") == pytest.approx(passive.at(t, "C5.v"), abs=1e-5)


def test_switched_capacitors_stand_for_resistors() -> None:
    switched = simulate(CauerLowPassSC(), stop_time=6.0, options=SolverOptions(rtol=1e-6, intervals=500))
    active = run("CauerLowPassOPV", 6.0)
    t = np.linspace(0.0, 5.9, 60)
    assert switched.at(t, "Op5.out.v") == pytest.approx(active.at(t + 0.05, "Op5.out.v"), abs=3e-2)

"""Circuits whose capacitor voltages or inductor currents depend on each other, against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

from arthur_acausal import Component, Equations, SolverOptions, connect, start, translate
from arthur_acausal.components.electrical import (
    Capacitor,
    ConstantVoltage,
    Ground,
    Inductor,
    Resistor,
    TwoPin,
)

PRECISE = SolverOptions(rtol=1e-9)


class CapacitorLoop(Component):
    """A source behind a resistor; C_1 lies across C_2 and C_3 in series, which form a loop with it."""

    source = ConstantVoltage(V=10.0)
    resistor = Resistor(R=100.0)
    C_1 = Capacitor(C=2e-6, v=start(0.0, fixed=True))
    C_2 = Capacitor(C=3e-6, v=start(0.0, fixed=True))
    C_3 = Capacitor(C=6e-6)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.resistor.pin_p)
        yield connect(self.resistor.pin_n, self.C_1.pin_p)
        yield connect(self.resistor.pin_n, self.C_2.pin_p)
        yield connect(self.C_2.pin_n, self.C_3.pin_p)
        for pin in (self.C_1.pin_n, self.C_3.pin_n, self.source.pin_n):
            yield connect(pin, self.ground.pin)


def test_capacitors_in_a_loop_act_as_one() -> None:
    """2 uF beside 3 uF and 6 uF in series are 4 uF: tau = 0.4 ms; the loop's voltages divide as 1/C."""
    translation = translate(CapacitorLoop())
    assert len(translation.report.states) == 2
    solution = translation.simulate(1e-3, options=PRECISE)
    v = 10.0 * (1 - np.exp(-solution.t / 4e-4))
    np.testing.assert_allclose(solution["C_1.v"], v, atol=1e-7)
    np.testing.assert_allclose(solution["C_2.v"], v * 6 / 9, atol=1e-7)
    np.testing.assert_allclose(solution["C_3.v"], v * 3 / 9, atol=1e-7)


class InductorCutSet(Component):
    """Coils that meet in one node: one brings what two others, with resistors, take away."""

    source = ConstantVoltage(V=6.0)
    L_1 = Inductor(L=0.1)
    L_2 = Inductor(L=0.2, i=start(0.0, fixed=True))
    L_3 = Inductor(L=0.2, i=start(0.0, fixed=True))
    R_2 = Resistor(R=4.0)
    R_3 = Resistor(R=4.0)
    ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.pin_p, self.L_1.pin_p)
        yield connect(self.L_1.pin_n, self.L_2.pin_p)
        yield connect(self.L_1.pin_n, self.L_3.pin_p)
        yield connect(self.L_2.pin_n, self.R_2.pin_p)
        yield connect(self.L_3.pin_n, self.R_3.pin_p)
        for pin in (self.R_2.pin_n, self.R_3.pin_n, self.source.pin_n):
            yield connect(pin, self.ground.pin)


def test_inductors_that_meet_in_a_node() -> None:
    """Equal branches: 0.1 H + 0.2 H / 2 and 4 ohm / 2 in series, tau = 0.1 s; each takes half of the current."""
    translation = translate(InductorCutSet())
    assert len(translation.report.states) == 2
    solution = translation.simulate(0.5, options=PRECISE)
    i = 3.0 * (1 - np.exp(-solution.t / 0.1))
    np.testing.assert_allclose(solution["L_1.i"], i, atol=1e-7)
    np.testing.assert_allclose(solution["L_2.i"], i / 2, atol=1e-7)


class Star(Component):
    """Three sources, each behind a resistor, on a star of capacitors or coils whose middle a fourth one grounds."""

    coils: bool
    ground = Ground()

    def build(self) -> None:
        self.sources = [ConstantVoltage(V=v) for v in VOLTAGES]
        self.lines = [Resistor(R=R_LINE) for _ in VOLTAGES]
        self.arms: list[TwoPin] = [self._element(ARM, fixed=True) for _ in VOLTAGES]
        self.middle: TwoPin = self._element(MIDDLE, fixed=False)

    def _element(self, size: float, *, fixed: bool) -> TwoPin:
        return (
            Inductor(L=size, i=start(0.0, fixed=fixed))
            if self.coils
            else Capacitor(C=size, v=start(0.0, fixed=fixed))
        )

    def equations(self) -> Equations:
        for source, line, arm in zip(self.sources, self.lines, self.arms, strict=True):
            yield connect(source.pin_p, line.pin_p)
            yield connect(line.pin_n, arm.pin_p)
            yield connect(arm.pin_n, self.middle.pin_p)
            yield connect(source.pin_n, self.ground.pin)
        yield connect(self.middle.pin_n, self.ground.pin)


VOLTAGES = np.array([3.0, 6.0, 12.0])
R_LINE, ARM, MIDDLE = 2.0, 0.03, 0.05


@pytest.mark.parametrize("coils", [False, True])
def test_a_star_that_its_middle_grounds(coils: bool) -> None:
    """The mean sees arm and middle in series, the differences only the arms.

    Of capacitors, tau = R C C_0/(C_0 + 3 C) for the mean of the potentials and R C for what they differ; of coils
    (L + 3 L_0)/R and L/R, likewise for the currents.
    """
    translation = translate(Star(coils=coils))
    assert len(translation.report.states) == (3 if coils else 4)
    solution = translation.simulate(0.2, options=PRECISE)
    t, mean = solution.t, VOLTAGES.mean()
    if coils:
        taus, final = ((ARM + 3 * MIDDLE) / R_LINE, ARM / R_LINE), 1 / R_LINE
    else:
        taus, final = (R_LINE * ARM * MIDDLE / (MIDDLE + 3 * ARM), R_LINE * ARM), 1.0
    common, own = (final * (1 - np.exp(-t / tau)) for tau in taus)
    for k, voltage in enumerate(VOLTAGES):
        path = f"arms[{k}].i" if coils else f"arms[{k}].pin_p.v"
        np.testing.assert_allclose(solution[path], mean * common + (voltage - mean) * own, atol=1e-6)

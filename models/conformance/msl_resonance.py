"""Examples of the Modelica Standard Library 4.1.0, Electrical.Analog: circuits in resonance.

Parameters and topology are those of the examples named; the Modelica Standard Library is (c) Modelica
Association and contributors, BSD-3-Clause.
"""

from __future__ import annotations

from math import pi

from arthur_acausal import Component, Equations, connect, start
from arthur_acausal.components.blocks import (
    CosineVariableFrequencyAndAmplitude,
    Ramp,
    SineVariableFrequencyAndAmplitude,
)
from arthur_acausal.components.electrical import (
    Capacitor,
    CurrentSensor,
    Ground,
    Inductor,
    Resistor,
    SignalCurrent,
    SignalVoltage,
    VoltageSensor,
)
from arthur_acausal.models.conformance.case import Case, precise


class SeriesResonance(Component):
    """Two coils, capacitors and resistors in series, swept through resonance (SeriesResonance)."""

    ramp: Ramp = Ramp.of("Hz")(height=200.0)
    sine: SineVariableFrequencyAndAmplitude = SineVariableFrequencyAndAmplitude.of("V")()
    cosine: CosineVariableFrequencyAndAmplitude = CosineVariableFrequencyAndAmplitude.of("V")()

    def build(self) -> None:
        self.sineVoltage, self.cosineVoltage = SignalVoltage(), SignalVoltage()
        self.resistor1, self.resistor2 = [Resistor(R=0.5) for _ in range(2)]
        self.inductor1, self.inductor2 = [Inductor(L=0.1 / (2 * pi), i=start(0.0, fixed=True)) for _ in "12"]
        self.capacitor1, self.capacitor2 = [
            Capacitor(C=1e-3 / (2 * pi), v=start(0.0, fixed=True)) for _ in range(2)
        ]
        self.currentSensor1, self.currentSensor2 = CurrentSensor(), CurrentSensor()
        self.ground1, self.ground2 = Ground(), Ground()

    def equations(self) -> Equations:
        circuits = (
            (self.sine, self.sineVoltage, self.inductor1, self.capacitor1, self.resistor1),
            (self.cosine, self.cosineVoltage, self.inductor2, self.capacitor2, self.resistor2),
        )
        ends = ((self.currentSensor1, self.ground1), (self.currentSensor2, self.ground2))
        for (wave, source, inductor, capacitor, resistor), (sensor, ground) in zip(
            circuits, ends, strict=True
        ):
            yield connect(self.ramp.y, wave.f)
            yield connect(wave.y, source.V)
            node = source.pin_p
            for element in (inductor, capacitor, resistor, sensor):
                yield connect(node, element.pin_p)
                node = element.pin_n
            yield connect(node, ground.pin)
            yield connect(source.pin_n, ground.pin)


class ParallelResonance(Component):
    """Coils with resistors beside capacitors, swept through resonance (ParallelResonance)."""

    ramp: Ramp = Ramp.of("Hz")(height=200.0)
    sine: SineVariableFrequencyAndAmplitude = SineVariableFrequencyAndAmplitude.of("A")()
    cosine: CosineVariableFrequencyAndAmplitude = CosineVariableFrequencyAndAmplitude.of("A")()

    def build(self) -> None:
        self.sineCurrent, self.cosineCurrent = SignalCurrent(), SignalCurrent()
        self.resistor1, self.resistor2 = [Resistor(R=0.5) for _ in range(2)]
        self.inductor1, self.inductor2 = [Inductor(L=0.1 / (2 * pi), i=start(0.0, fixed=True)) for _ in "12"]
        self.capacitor1, self.capacitor2 = [
            Capacitor(C=1e-3 / (2 * pi), v=start(0.0, fixed=True)) for _ in range(2)
        ]
        self.voltageSensor1, self.voltageSensor2 = VoltageSensor(), VoltageSensor()
        self.ground1, self.ground2 = Ground(), Ground()

    def equations(self) -> Equations:
        circuits = (
            (self.sine, self.sineCurrent, self.inductor1, self.capacitor1, self.resistor1),
            (self.cosine, self.cosineCurrent, self.inductor2, self.capacitor2, self.resistor2),
        )
        ends = ((self.voltageSensor1, self.ground1), (self.voltageSensor2, self.ground2))
        for (wave, source, inductor, capacitor, resistor), (sensor, ground) in zip(
            circuits, ends, strict=True
        ):
            yield connect(self.ramp.y, wave.f)
            yield connect(wave.y, source.I)
            yield connect(resistor.pin_n, inductor.pin_p)
            for pin in (resistor.pin_p, capacitor.pin_p, sensor.pin_p):
                yield connect(source.pin_n, pin)
            for pin in (source.pin_p, inductor.pin_n, capacitor.pin_n, sensor.pin_n):
                yield connect(pin, ground.pin)


_PHASES = {"sineVoltage.phi": "sine.phi", "cosineVoltage.phi": "cosine.phi"}
_CURRENT_PHASES = {"sineCurrent.phi": "sine.phi", "cosineCurrent.phi": "cosine.phi"}

CASES: dict[str, Case] = {
    case.name: case
    for case in (
        Case("msl_Electrical_Analog_SeriesResonance", SeriesResonance, _PHASES, 1.0, precise(10000)),
        Case(
            "msl_Electrical_Analog_ParallelResonance", ParallelResonance, _CURRENT_PHASES, 1.0, precise(10000)
        ),
    )
}

"""Sources whose frequency and amplitude are signals, and the sinc (Modelica's Blocks.Sources)."""

from __future__ import annotations

from math import pi

import casadi

from arthur_acausal import Equations, Real, der, parameter, real_input, smooth_if_else, time, variable
from arthur_acausal.components.blocks.signal import Source
from arthur_acausal.components.blocks.waveforms import after


class SineVariableFrequencyAndAmplitude(Source):
    """y = offset + amplitude sin(phi), der(phi) = 2 pi f, with the signals ``amplitude`` and ``f`` [Hz].

    State: ``phi`` [rad], 0 at the start.
    """

    _units = {"y": "{y}", "amplitude": "{y}", "offset": "{y}"}
    amplitude: Real = real_input("1", default=1.0)
    f: Real = real_input("Hz", default=1.0)
    offset: Real = parameter("1", default=0.0)
    phi: Real = variable("rad", start=0.0, fixed=True, description="phase")

    def equations(self) -> Equations:
        yield "phase", der(self.phi) == 2 * pi * self.f
        yield self.y == self.offset + self.amplitude * casadi.sin(self.phi)


class CosineVariableFrequencyAndAmplitude(SineVariableFrequencyAndAmplitude):
    """y = offset + amplitude cos(phi), der(phi) = 2 pi f, with the signals ``amplitude`` and ``f`` [Hz]."""

    def equations(self) -> Equations:
        yield "phase", der(self.phi) == 2 * pi * self.f
        yield self.y == self.offset + self.amplitude * casadi.cos(self.phi)


class Sinc(Source):
    """y = offset + amplitude sin(x)/x, x = 2 pi f (t - start_time), from ``start_time`` [s] on; offset before."""

    _units = {"y": "{y}", "amplitude": "{y}", "offset": "{y}"}
    amplitude: Real = parameter("1", default=1.0)
    f: Real = parameter("Hz")
    offset: Real = parameter("1", default=0.0)
    start_time: Real = parameter("s", default=0.0)
    x_small: Real = parameter("1", default=1e-8, description="below it sin(x)/x is 1 to rounding")

    def equations(self) -> Equations:
        x = 2 * pi * self.f * (time() - self.start_time)
        near = casadi.fabs(x) < self.x_small
        wave = smooth_if_else(near, 1, casadi.sin(x) / smooth_if_else(near, 1, x))
        yield self.y == self.offset + self.amplitude * after(self.start_time, wave)

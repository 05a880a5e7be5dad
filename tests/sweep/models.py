"""Models that sweeps of the tests run."""

from __future__ import annotations

import os
import signal
import time as clock
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from arthur_acausal import (
    Component,
    Equations,
    Real,
    Solution,
    der,
    discrete,
    parameter,
    real_input,
    sampled,
    terminate,
    variable,
    when,
)


class Decay(Component):
    """tau x' = u - x, from x0."""

    tau: Real = parameter("s", default=1.0, min=0.0)
    x0: Real = parameter("1", default=1.0)
    u: Real = real_input("1", default=0.0)
    x: Real = variable("1")

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == self.u - self.x

    def initial_equations(self) -> Equations:
        yield self.x == self.x0


class Chain(Component):
    """As many lags in a row as ``n``."""

    n: int = 1
    tau: Real = parameter("s", default=1.0, min=0.0)
    x: Real = variable("1")

    def build(self) -> None:
        self.lags = [Decay(tau=self.tau) for _ in range(self.n)]

    def equations(self) -> Equations:
        yield self.x == sum((lag.x for lag in self.lags), 0.0)


class Parted(Component):
    """With a part that has a structure of its own."""

    chain = Chain()


class Guessed(Decay):
    """With a start value for what is computed."""

    y: Real = variable("1", start=3.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == 2 * self.x


class Explosion(Component):
    """x' = x^2 / T: infinite at t = T / x0."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("1", start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield self.T * der(self.x) == self.x**2


class Turning(Component):
    """A pendulum in Cartesian coordinates that turns over: no set of states serves all the way round."""

    L: Real = parameter("m", default=1.0, min=0.0)
    w: Real = parameter("rad/s", default=8.0)
    g: Real = parameter("m/s^2", default=9.81)
    x: Real = variable("m", start=1.0)
    y: Real = variable("m", start=0.0)
    v: Real = variable("m/s")
    u: Real = variable("m/s", start=8.0)
    pull: Real = variable("1/s^2", start=70.0)

    def equations(self) -> Equations:
        yield self.v == der(self.x)
        yield self.u == der(self.y)
        yield der(self.v) == -self.pull * self.x
        yield der(self.u) == -self.pull * self.y - self.g
        yield self.x**2 + self.y**2 == self.L**2

    def initial_equations(self) -> Equations:
        yield self.y == 0 * self.L
        yield self.u == self.w * self.L


class Ending(Component):
    """Ends itself at t = T."""

    T: Real = parameter("s", default=1.0)
    x: Real = variable("s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == 1
        yield when(self.x > self.T, terminate("enough"))


def misbehave(t: float, inputs: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sleep, or kill this process: always, or unless a file of this name tells that it was done before."""
    seconds, die = inputs.tolist()
    if die > 0.0:
        mark = Path(os.environ["ARTHUR_TEST_MARK"])
        if die > 1.0 or not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    clock.sleep(seconds)
    return np.zeros(1)


def refused(solution: Solution) -> float:
    """A reduction that fails for some runs."""
    if solution["tau"][0] > 1.5:
        raise ZeroDivisionError("no tau above 1.5")
    return 1.0


class Misbehaving(Component):
    """Takes its time at each tenth of a second, or kills its own process."""

    seconds: Real = parameter("s", default=0.0)
    die: Real = parameter("1", default=0.0)
    x: Real = variable("1", start=1.0, fixed=True)
    tau: Real = parameter("s", default=1.0)
    z: Real = discrete("1", start=0.0)

    def equations(self) -> Equations:
        yield self.tau * der(self.x) == -self.x
        yield sampled(misbehave, period=0.1, inputs=[self.seconds, self.die], outputs=[self.z])

"""A parameter that is called otherwise."""

from __future__ import annotations

from arthur_acausal import Component, ParameterError, simulate
from tests.errors.decay import Decay

ERROR = ParameterError
EXPECT = [r"no parameter 'tank\.TT'", r"did you mean tank\.T\?"]


class Plant(Component):
    tank = Decay()
    reserve = Decay()


def run() -> object:
    return simulate(Plant(), 1.0, parameters={"tank.TT": 2.0})

"""A mass without its mass."""

from __future__ import annotations

from arthur_acausal import Component, ParameterError, translate
from arthur_acausal.components.translational import Mass

ERROR = ParameterError
EXPECT = [r"^load\.m\b", r"Mass needs the parameter m \[kg\]", r"Mass\(m=\.\.\.\)"]


class Crane(Component):
    load = Mass()  # type: ignore[call-arg]  # culprit


def run() -> object:
    return translate(Crane())

"""Dry friction with exact sticking, for rotational and translational elements alike.

The characteristic (speed, friction) is a curve with a parameter ``sa``: while sliding ``sa`` stands for the
acceleration, while sticking for the friction that holds. A state machine, iterated at events, chooses the branch: no
stiffness, no small speed. Otter, Elmqvist and Mattsson (1999), "Hybrid modeling in Modelica based on the synchronous
data flow principle"; the branches are those of the Modelica Standard Library 4.1 (Interfaces.PartialFriction).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from casadi import SX, logic_and, logic_not, logic_or, sign

from arthur_acausal import Component, Equations, Real, discrete, if_else, pre, smooth_if_else

BACKWARD, STUCK, FORWARD, FREE, UNKNOWN = -1, 0, 1, 2, 3
"""Values of ``mode``; UNKNOWN only before the start."""

Points = tuple[tuple[float, float], ...]


class StickSlip(Component):
    """The state machine of an element with dry friction.

    Discrete: ``mode`` [1], -1 sliding backward, 0 stuck, 1 sliding forward, 2 free of friction;
    ``start_forward``, ``start_backward`` [0 or 1], sliding begins at speed zero; ``locked`` [0 or 1], no sliding.
    """

    mode: Real = discrete("1", start=UNKNOWN, description="-1 backward, 0 stuck, 1 forward, 2 free")
    start_forward: Real = discrete("1", description="1: forward sliding begins at speed zero")
    start_backward: Real = discrete("1", description="1: backward sliding begins at speed zero")
    locked: Real = discrete("1", description="1: held by friction")

    def branches(self, speed: SX, sa: SX, least: SX, most: SX, free: SX | None = None) -> Equations:
        """Yield the discrete equations.

        ``sa``: path parameter, in the unit of the friction. ``least``: sliding friction at speed zero, ``most``: the
        largest that sticking can hold. ``free``: where it holds there is no friction.
        """
        forward, backward = truth(speed > 0), truth(speed < 0)
        over, still_over = truth(sa > most), truth(sa > least)
        under, still_under = truth(sa < -most), truth(sa < -least)
        is_free = truth(free) if free is not None else SX(0.0)
        was = pre(self.mode)
        stuck, unknown, was_free = was == STUCK, was == UNKNOWN, was == FREE
        yield (
            self.start_forward
            == any_of(
                all_of(stuck, any_of(over, all_of(pre(self.start_forward), still_over))),
                all_of(unknown, forward),
            )
        )
        yield (
            self.start_backward
            == any_of(
                all_of(stuck, any_of(under, all_of(pre(self.start_backward), still_under))),
                all_of(unknown, backward),
            )
        )
        moving = any_of(was == FORWARD, was == BACKWARD, self.start_forward, self.start_backward)
        yield self.locked == logic_not(any_of(is_free, moving))
        slides = smooth_if_else(
            all_of(any_of(was == FORWARD, was_free, self.start_forward), forward),
            FORWARD,
            smooth_if_else(
                all_of(any_of(was == BACKWARD, was_free, self.start_backward), backward), BACKWARD, STUCK
            ),
        )
        yield self.mode == smooth_if_else(is_free, FREE, slides)

    def is_forward(self) -> SX:
        """Return whether the forward branch of the sliding friction holds."""
        going = all_of(pre(self.mode) == FORWARD, logic_not(self.start_backward))
        return any_of(self.start_forward, going)

    def excess(self, speed: SX, sa: SX, most: SX) -> SX:
        """Return ``sa`` without the friction of the branch: in proportion to the acceleration; 0 while locked."""
        direction = smooth_if_else(
            self.is_forward(),
            1,
            smooth_if_else(any_of(self.start_backward, pre(self.mode) == BACKWARD), -1, sign(speed)),
        )
        inactive = self.mode == FREE
        sliding = sa - smooth_if_else(inactive, 0, direction) * most
        return smooth_if_else(self.locked, 0, sliding)

    def friction(self, sa: SX, ahead: SX, back: SX) -> SX:
        """Return the friction: ``sa`` while locked, else ``ahead`` or minus ``back``, by the direction of sliding."""
        sliding = smooth_if_else(self.is_forward(), ahead, -back)
        return smooth_if_else(self.locked, sa, smooth_if_else(self.mode == FREE, 0, sliding))


def truth(condition: SX) -> SX:
    """Return 1 where ``condition`` holds, else 0; its relations make events."""
    return if_else(condition, 1, 0)


def all_of(*conditions: SX) -> SX:
    """Return whether all conditions hold."""
    result = conditions[0]
    for condition in conditions[1:]:
        result = logic_and(result, condition)
    return result


def any_of(*conditions: SX) -> SX:
    """Return whether one of the conditions holds."""
    result = conditions[0]
    for condition in conditions[1:]:
        result = logic_or(result, condition)
    return result


def interpolated(points: Sequence[tuple[float, float]], x: SX) -> SX:
    """Return the piecewise linear function through ``points`` (x increasing); the last pieces go on outside."""
    pieces = list(pairwise(points))
    if not pieces:
        return SX(points[0][1])
    result = SX(0.0)
    for k, ((x0, y0), (x1, y1)) in reversed(list(enumerate(pieces))):
        line = y0 + (y1 - y0) / (x1 - x0) * (x - x0)
        result = line if k == len(pieces) - 1 else smooth_if_else(x < x1, line, result)
    return result


def at_zero(points: Sequence[tuple[float, float]]) -> float:
    """Return what ``interpolated`` gives at 0."""
    return float(interpolated(points, SX(0.0)))

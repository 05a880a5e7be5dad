"""Dry friction with exact sticking, for rotational and translational elements alike.

The characteristic (speed, friction) is a curve with a parameter ``sa``: while sliding ``sa`` stands for the
acceleration, while sticking for the friction that holds. A state machine, iterated at events, chooses the branch: no
stiffness, no small speed. Otter, Elmqvist and Mattsson (1999), "Hybrid modeling in Modelica based on the synchronous
data flow principle"; the branches are those of the Modelica Standard Library 4.1 (Interfaces.PartialFriction).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

from casadi import SX, fabs, logic_and, logic_not, logic_or

from arthur_acausal import Component, Equations, Real, discrete, if_else, parameter, pre, smooth_if_else

BACKWARD, STUCK, FORWARD, FREE, UNKNOWN = -1, 0, 1, 2, 3
"""Values of ``mode``; UNKNOWN only before the start."""

HYSTERESIS = 1e-6
"""Share of the friction by which what tears may fall once sliding has begun: its start does not chatter."""

Points = tuple[tuple[float, float], ...]


class StickSlip(Component):
    """The state machine of an element with dry friction.

    Discrete: ``mode`` [1], -1 sliding backward, 0 stuck, 1 sliding forward, 2 free of friction;
    ``start_forward``, ``start_backward`` [0 or 1], sliding begins at speed zero; ``locked`` [0 or 1], no sliding;
    ``direction`` [-1, 0, 1], the branch of the sliding friction; ``started`` [0 or 1], after the initialisation.

    Two elements that hold the same part leave open which of them holds how much: give each a ``creep`` [1] of about
    1e-9, and they share it, moving by that part of what ``sa`` would move a free inertia of the path's scale.
    """

    creep: Real = parameter(
        "1", default=0.0, min=0.0, description="acceleration while stuck, over that of sa alone"
    )
    mode: Real = discrete("1", start=UNKNOWN, description="-1 backward, 0 stuck, 1 forward, 2 free")
    start_forward: Real = discrete("1", description="1: forward sliding begins at speed zero")
    start_backward: Real = discrete("1", description="1: backward sliding begins at speed zero")
    locked: Real = discrete("1", description="1: held by friction")
    direction: Real = discrete("1", description="branch of the sliding friction; 0: locked or free")
    started: Real = discrete("1", description="1 after the initialisation")

    def branches(
        self,
        speed: SX,
        sa: SX,
        least: SX,
        most: SX,
        unit: SX,
        free: SX | None = None,
        stop: SX | float = 0.0,
    ) -> Equations:
        """Yield the discrete equations.

        ``unit``: any speed but zero. ``sa``: path parameter, in the unit of the friction. ``least``: sliding friction
        at speed zero, ``most``: the largest that sticking can hold. ``free``: where it holds there is no friction.
        """
        is_free = truth(free) if free is not None else SX(0.0)
        was = pre(self.mode)
        forward, backward = self.moving(speed, unit)
        may_go, may_return = SX(stop) < 1, SX(stop) > -1
        forward, backward = all_of(may_go, forward), all_of(may_return, backward)
        pull, push = torn(any_of(self.locked, self.start_forward, self.start_backward), sa)
        still_pull, still_push = torn(any_of(self.start_forward, self.start_backward), sa)
        kept = (1 - HYSTERESIS) * least
        over, still_over = (all_of(may_go, truth(b)) for b in (pull > most, still_pull > kept))
        under, still_under = (all_of(may_return, truth(b)) for b in (push < -most, still_push < -kept))
        yield self.started == (was != UNKNOWN)
        yield self.start_forward == starting(was, forward, over, still_over, pre(self.start_forward))
        yield self.start_backward == starting(was, backward, under, still_under, pre(self.start_backward))
        ahead, back = any_of(was == FORWARD, self.start_forward), any_of(was == BACKWARD, self.start_backward)
        yield self.locked == logic_not(any_of(is_free, ahead, back))
        branch = smooth_if_else(
            self.start_backward, -1, smooth_if_else(ahead, 1, smooth_if_else(back, -1, 0))
        )
        yield self.direction == smooth_if_else(is_free, 0, branch)
        released = was == FREE
        going_back = all_of(any_of(released, back), backward)
        sliding = smooth_if_else(
            all_of(any_of(released, ahead), forward), FORWARD, smooth_if_else(going_back, BACKWARD, STUCK)
        )
        yield self.mode == smooth_if_else(is_free, FREE, sliding)

    def moving(self, speed: SX, unit: SX) -> tuple[SX, SX]:
        """Return whether the speed is positive, negative; while locked it is rounding, whose sign makes no event."""
        held = all_of(self.started, self.locked, self.mode == STUCK)
        return truth(smooth_if_else(held, -unit, speed) > 0), truth(smooth_if_else(held, unit, speed) < 0)

    def excess(self, sa: SX, most: SX) -> SX:
        """Return ``sa`` without the friction of the branch: in proportion to the acceleration.

        While locked it is ``creep`` times ``sa``: zero, unless several elements are to share what they hold.
        """
        return smooth_if_else(self.locked, self.creep * sa, sa - self.direction * most)

    def friction(self, sa: SX, ahead: SX, back: SX) -> SX:
        """Return the friction: ``sa`` while locked, else ``ahead`` or minus ``back``, by the direction of sliding."""
        sliding = smooth_if_else(self.direction > 0, ahead, smooth_if_else(self.direction < 0, -back, 0))
        return smooth_if_else(self.locked, sa, sliding)


def starting(was: SX, moves: SX, over: SX, still_over: SX, before: SX) -> SX:
    """Return whether sliding begins in one direction: from rest, or at the start of the run with that speed."""
    return any_of(
        all_of(was == STUCK, any_of(over, all_of(before, still_over))), all_of(was == UNKNOWN, moves)
    )


def torn(applies: SX, sa: SX) -> tuple[SX, SX]:
    """Return what tears at the contact forward, backward: ``sa`` where it ``applies``, else what makes no event.

    While it slides ``sa`` stands for the acceleration; so sticking is tried first when the speed has become zero.
    """
    return smooth_if_else(applies, sa, -fabs(sa)), smooth_if_else(applies, sa, fabs(sa))


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

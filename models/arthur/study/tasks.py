"""What the robot does in the study: data."""

from __future__ import annotations

from dataclasses import dataclass

from arthur_acausal.models.arthur.locomotion.commands import Command, Constant, Table

STAND = Command(gait="stand")


@dataclass(frozen=True, slots=True)
class Task:
    """A task of one run.

    Attributes
    ----------
    name : as tables have it. commands : to the locomotion controller.
    begin, end : of what is measured, and so of the run [s]: before ``begin`` it starts.
    speed, yaw_rate : wanted in the mean over that [m/s], [rad/s]; 0: no error is told.
    slope : whether the ground rises by 0.1 rad from 0.5 m ahead on. push : to the left at PUSHED [N].
    core : whether it is run with all seeds; the others with a few.
    """

    name: str
    commands: Constant | Table
    begin: float = 1.0
    end: float = 2.5
    speed: float = 0.0
    yaw_rate: float = 0.0
    slope: bool = False
    push: float = 0.0
    core: bool = False

    @property
    def moves(self) -> bool:
        """Whether there is a way of which the cost counts."""
        return self.speed > 0.0


PUSHED, PUSH_DURATION = 1.25, 0.1
"""When the push begins, and for how long it lasts [s]."""


def _trot(name: str, speed: float, **more: bool | float) -> Task:
    return Task(name, Constant(Command(v_x=speed)), speed=speed, **more)  # type: ignore[arg-type]


TASKS = (
    Task("stand", Constant(STAND), begin=0.5, end=1.5, core=True),
    _trot("trot 0.1", 0.1),
    _trot("trot 0.3", 0.3, core=True),
    _trot("trot 0.5", 0.5, core=True),
    _trot("fastest", 1.0, begin=1.5, end=3.0),
    Task("turn", Constant(Command(yaw_rate=0.5)), yaw_rate=0.5),
    _trot("slope", 0.5, begin=1.75, end=3.0, slope=True),
    _trot("push", 0.5, push=50.0),
    Task("start and stop", Table((0.0, 0.5, 1.5), (STAND, Command(v_x=0.5), STAND)), begin=0.25),
)
TASK = {task.name: task for task in TASKS}

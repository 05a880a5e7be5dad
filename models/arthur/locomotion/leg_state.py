"""The leg state machine (7.7, Algorithms 6 and 7)."""

from __future__ import annotations

from enum import Enum

from arthur_acausal.models.arthur.locomotion.settings import Settings


class Leg(Enum):
    """The phase in which a leg is. INIT: not yet told to walk; the leg carries as in stance."""

    INIT = "init"
    STANCE = "stance"
    SWING = "swing"


class LegState:
    """One leg's state, led by the gait modulator.

    Beyond the report: a contact after the share ``early`` of the swing ends it, and a swing whose time is over waits
    for the contact, though not longer than ``patience``: the foot goes on downward meanwhile.

    Attributes
    ----------
    state : of the leg. e_st, e_sw : begin of stance or swing, pulses of one step. c_sync : 1 in stance.
    waiting : time since the swing should have ended [s].
    """

    def __init__(self, settings: Settings) -> None:
        self.state = Leg.INIT
        self.e_st = self.e_sw = False
        self.waiting = 0.0
        self._settings = settings
        self._landed_early = False

    @property
    def c_sync(self) -> bool:
        """Return whether the leg stands."""
        return self.state is not Leg.SWING

    def update(self, S_st: float, S_sw: float, contact: bool) -> None:
        """Advance by one period; both zero means that the modulator rests."""
        self.e_st = self.e_sw = False
        if S_sw <= 0.0:
            self._landed_early = False
        if self.state is Leg.SWING:
            self._swing(S_sw, contact)
        elif S_sw > 0.0 and not self._landed_early:
            self.state, self.e_sw = Leg.SWING, True
        elif self.state is Leg.INIT and S_st > 0.0:
            self.state, self.e_st = Leg.STANCE, True

    def _swing(self, S_sw: float, contact: bool) -> None:
        over = S_sw <= 0.0
        self.waiting = self.waiting + self._settings.period if over else 0.0
        late = over and self.waiting >= self._settings.patience
        if late or (contact and (over or S_sw > self._settings.early)):
            self._landed_early = not over
            self.state, self.e_st, self.waiting = Leg.STANCE, True, 0.0

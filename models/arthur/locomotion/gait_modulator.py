"""The gait pattern modulator (7.6, Algorithm 5)."""

from __future__ import annotations

from arthur_acausal.models.arthur.locomotion.gaits import GAITS, Gait


def stance_time(gait: Gait, half_step: float, speed: float, limits: tuple[float, float]) -> float:
    """Return T_st [s]: by the gait's duty, else 2 L_span / |v_d| (7.6.3) within the limits."""
    if gait.duty is not None:
        return gait.swing_time * gait.duty / (1.0 - gait.duty)
    shortest, longest = limits
    return min(longest, max(shortest, 2.0 * half_step / max(speed, half_step / longest)))


class GaitModulator:
    """Gives each leg its place in the stride.

    The report's timer t + phi_i is never wrapped and jumps with the stride's length; here a phase, modulo one, is
    integrated with the present stride time, and the leg's own is this phase plus its lag (7.6.4).

    When it is stopped, or the gait is another one, swinging legs end their swing and no leg lifts any more; once all
    stand, it rests, and may start with the new gait.

    Attributes
    ----------
    S_st, S_sw : stance and swing state of each leg, 0..1; both zero at rest. running : whether a leg may lift.
    T_st, T_sw : stance and swing time [s]. gait : in use. S : the legs' place in the stride, 0..1.
    """

    def __init__(self) -> None:
        self.gait = GAITS["stand"]
        self.running = False
        self.S = self.S_st = self.S_sw = [0.0] * 4
        self.T_sw = self.gait.swing_time
        self.T_st = self.T_sw
        self._phase = 0.0
        self._parked = [True] * 4

    @property
    def duty(self) -> float:
        """Return the share of stance in the stride."""
        return self.T_st / (self.T_st + self.T_sw)

    def update(
        self,
        period: float,
        walking: bool,
        gait: Gait,
        half_step: float,
        speed: float,
        limits: tuple[float, float],
    ) -> None:
        """Advance by one period [s]; ``speed`` is |v_d| [m/s] with the yaw rate times the hips' radius."""
        if all(self._parked) and walking and not self.running:
            self.gait, self.running, self._phase = gait, True, 0.0
            self._parked = [False] * 4
            period = 0.0
        self.running = self.running and walking and gait == self.gait
        self.T_sw = self.gait.swing_time
        self.T_st = stance_time(self.gait, half_step, speed, limits)
        self._phase = (self._phase + period / (self.T_st + self.T_sw)) % 1.0
        self.S = [(self._phase + lag) % 1.0 for lag in self.gait.lag]
        duty = self.duty
        if not self.running:
            self._parked = [parked or S < duty for parked, S in zip(self._parked, self.S, strict=True)]
        each = list(zip(self.S, self._parked, strict=True))
        self.S_st = [S / duty if S < duty and not parked else 0.0 for S, parked in each]
        self.S_sw = [(S - duty) / (1.0 - duty) if S >= duty and not parked else 0.0 for S, parked in each]

"""Sampled blocks: functions called at fixed periods, their results held between the calls."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from arthur_acausal.errors import ParameterError, SimulationError
from arthur_acausal.solve.protocol import DAE, Evaluator, FloatArray


class Samples:
    """All sampled blocks of a model, and when each is due: offset + k period, never a sum of rounded steps."""

    def __init__(self, dae: DAE, evaluator: Evaluator, start_time: float) -> None:
        self._blocks, self._evaluator = dae.samples, evaluator
        count = len(self._blocks)
        times = evaluator.sample_times().copy() if count else np.zeros(0)
        self._period, self._offset = times[:count], times[count:]
        for block, period in zip(self._blocks, self._period.tolist(), strict=True):
            if not (math.isfinite(period) and period > 0.0):
                raise ParameterError(
                    f"{block.label}: the period is {period:g} s, not positive", where=block.where
                )
        # a fresh function for each run, where it has a state of its own
        self._functions = [getattr(b.function, "fresh", lambda f=b.function: f)() for b in self._blocks]
        self._outputs = [np.array(b.outputs, dtype=np.intp) for b in self._blocks]
        self._begins = [np.array(b.begins, dtype=np.intp) for b in self._blocks]
        self._triggers = {k: block.trigger for k, block in enumerate(self._blocks) if block.trigger >= 0}
        self._seen: dict[int, float] = {}  # values of the triggers when they were last asked for
        late = 1e-9 * self._period
        self._k = np.maximum(np.ceil((start_time - self._offset - late) / self._period), 0.0)
        self._due: FloatArray = self._offset + self._k * self._period
        self._next = float(self._due.min(initial=math.inf))

    def next(self) -> float:
        """Return the next time at which a block is due [s]; infinity if there is none."""
        return self._next

    def act(self, now: float) -> None:
        """Call what is due up to ``now`` [s] or triggered, in order; the evaluator holds the values before it."""
        due = self._due <= now
        if not self._seen:
            self._seen = {number: self._trigger(number) for number in self._triggers}
        for number in range(len(self._blocks)):
            if self._triggered(number) or due[number]:
                self._call(number)
        self._k[due] += 1.0
        self._due = self._offset + self._k * self._period
        self._next = float(self._due.min())

    def _trigger(self, number: int) -> float:
        return float(self._evaluator.sample_inputs()[self._triggers[number]])

    def _triggered(self, number: int) -> bool:
        """Whether a block's trigger has changed since it was last asked for."""
        if number not in self._triggers:
            return False
        before, self._seen[number] = self._seen[number], self._trigger(number)
        return self._seen[number] != before

    def _call(self, number: int) -> None:
        block, evaluator = self._blocks[number], self._evaluator
        t = float(evaluator.t[0])
        inputs = evaluator.sample_inputs()[block.first : block.first + block.count].copy()
        try:
            result = _numbers(self._functions[number](t, inputs))
        except Exception as error:
            raise SimulationError(
                f"{block.label} failed at t = {t:.9g} s: {type(error).__name__}: {error}",
                where=block.where,
                cause="the function of a sampled block raised",
            ) from error
        if result.size != len(block.outputs) or not np.isfinite(result).all():
            raise SimulationError(
                f"{block.label} returned {result.tolist()} at t = {t:.9g} s",
                where=block.where,
                cause=f"it must return {len(block.outputs)} finite numbers",
            )
        z, outputs, begins = evaluator.z, self._outputs[number], self._begins[number]
        if begins.size:
            z[begins] += (t - z[block.since]) * z[outputs]
            z[block.since] = t
            result = (result - z[begins]) / self._period[number]
        z[outputs] = result


def _numbers(result: Any) -> FloatArray:
    if isinstance(result, np.ndarray):
        return result.reshape(-1).astype(float)
    if result is None:
        return np.zeros(0)
    parts = result if isinstance(result, list | tuple) else [result]
    return (
        np.concatenate([np.asarray(part, dtype=float).reshape(-1) for part in parts])
        if parts
        else np.zeros(0)
    )

"""Bode plots: gain [dB] and phase [degrees] of each pair of input and output over frequency [Hz]."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from arthur_acausal.analysis.linearize import LinearModel
from arthur_acausal.errors import UsageError
from arthur_acausal.result.plot import PALETTE, STYLES, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

POINTS = 400
BEYOND = 30.0  # factor of the range of frequencies below the slowest and above the fastest mode
DEFAULT = 1.0  # Hz, where there is no mode with a frequency
MOST_CURVES = 12
WIDTH, HEIGHT = 9.0, 5.5  # inches


def frequencies(model: LinearModel) -> NDArray[np.float64]:
    """Return frequencies [Hz] that show all modes of the model, evenly spaced by their logarithm.

    Frequencies at the lightly damped modes are added, so that no resonance is missed.
    """
    modes = [mode.frequency for mode in model.modes() if mode.frequency > 0.0]
    largest = max(modes, default=DEFAULT)
    modes = [f for f in modes if f > 1e-9 * largest] or [DEFAULT]
    grid = np.geomspace(min(modes) / BEYOND, max(modes) * BEYOND, POINTS)
    around = np.concatenate([f * (1.0 + np.linspace(-0.05, 0.05, 21)) for f in modes])
    return np.unique(np.concatenate([grid, around]))


def bode(model: LinearModel) -> Figure:
    """Draw gain and phase from each input to each output. Raises UsageError where there are none, or too many."""
    pairs = [(i, j) for j in range(len(model.inputs)) for i in range(len(model.outputs))]
    if not pairs:
        raise UsageError(
            "a Bode plot needs an input and an output",
            cause="the model has no external input" if not model.inputs else "no output was named",
        )
    if len(pairs) > MOST_CURVES:
        raise UsageError(
            f"{len(model.inputs)} inputs and {len(model.outputs)} outputs make {len(pairs)} curves",
            remedy=f"name outputs and inputs so that there are {MOST_CURVES} at most",
        )
    f = frequencies(model)
    response = model.response(f)
    with style():
        return _draw(model, pairs, f, response)


def _draw(
    model: LinearModel,
    pairs: list[tuple[int, int]],
    f: NDArray[np.float64],
    response: NDArray[np.complex128],
) -> Figure:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDTH, HEIGHT), layout="constrained")
    gain, phase = figure.subplots(2, 1, sharex=True)
    for k, (i, j) in enumerate(pairs):
        value = response[:, i, j]
        look = {"color": PALETTE[k % len(PALETTE)], "linestyle": STYLES[k // len(PALETTE) % len(STYLES)]}
        size = np.abs(value)
        size[size == 0.0] = np.nan
        gain.semilogx(f, 20.0 * np.log10(size), label=f"{model.inputs[j]} → {model.outputs[i]}", **look)
        phase.semilogx(f, np.degrees(np.unwrap(np.angle(value))), **look)
    gain.set_ylabel("gain [dB, SI units]")
    phase.set_ylabel("phase [°]")
    phase.set_xlabel("frequency [Hz]")
    phase.set_xlim(f[0], f[-1])
    phase.yaxis.set_major_locator(_degrees())
    figure.legend(loc="outside lower center", ncols=1 if len(pairs) < 4 else 2)
    figure.suptitle(f"Linearised at t = {model.t:g} s", x=0.01, ha="left", fontsize=11.0)
    return figure


def _degrees() -> object:
    from matplotlib.ticker import MaxNLocator

    return MaxNLocator(nbins=6, steps=[1, 1.5, 3, 4.5, 9, 10])

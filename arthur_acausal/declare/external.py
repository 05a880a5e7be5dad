"""External functions: laws that are computed outside of the equations, by code that only gives numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
from casadi import SX
from numpy.typing import NDArray

from arthur_acausal.declare.scope import ExternalOutput, Scope, current_scope
from arthur_acausal.declare.vector import scalars
from arthur_acausal.errors import DeclarationError

FloatArray = NDArray[np.float64]
BoolArray = NDArray[np.bool_]


class ExternalFunction(Protocol):
    """A function of numbers, SI, that `external` makes equations of.

    ``evaluate`` must be a pure function of the inputs: the same outputs, to the last bit, whatever was called before.

    What an object may have besides:

    - ``exact_derivative(inputs, jacobian)``: like ``derivative``, but never stale or approximate: for initialisation
      and linearisation; without it ``derivative`` serves.
    - ``sparsity``: array of truth values (n_outputs, n_inputs), which input each output depends on; default: all.
    - ``units``: (units of the inputs, units of the outputs), checked against the equations' dimensions.
    - ``restart()``: the next point is another one, after an event or in the output; a stale derivative is renewed.
    - ``failure``: text, why the latest evaluation had no value; messages tell it.
    - ``native``: (self, evaluate, derivative), addresses of an object and of ``int evaluate(void *self, const double
      *inputs, double *outputs)`` and its like: the same in machine code, to the last bit, for the integrator to call
      without the interpreter. Nonzero: Python is to do it. They keep the interpreter's lock, and may be 0.
    - ``describe()`` and a class method ``restore(data)``, JSON data: the translated model can go to other processes.
    """

    @property
    def name(self) -> str:
        """What messages call it."""
        ...

    @property
    def n_inputs(self) -> int:
        """The number of inputs."""
        ...

    @property
    def n_outputs(self) -> int:
        """The number of outputs."""
        ...

    def evaluate(self, inputs: FloatArray, outputs: FloatArray) -> None:
        """Write the outputs (n_outputs,) for the inputs (n_inputs,); NaN where there is no value."""
        ...

    def derivative(self, inputs: FloatArray, jacobian: FloatArray) -> None:
        """Write d outputs / d inputs (n_outputs, n_inputs); it may be approximate: it feeds Newton's matrix only."""
        ...

    def fresh(self) -> ExternalFunction:
        """Return an independent copy with buffers of its own; each run has one."""
        ...


@dataclass(frozen=True, slots=True)
class External:
    """``outputs[i] == symbols[i]``, where the symbols stand for the function of the inputs."""

    function: ExternalFunction
    inputs: tuple[SX, ...]
    outputs: tuple[SX, ...]
    symbols: tuple[SX, ...]
    sparsity: BoolArray
    units: tuple[str, ...]  # of the inputs; empty where they are not known


def external(function: ExternalFunction, *, inputs: Sequence[Any], outputs: Sequence[Any]) -> External:
    """State ``outputs[i] == function(inputs)[i]``: as many equations as outputs.

    Parameters
    ----------
    function : see `ExternalFunction`. It is called once an evaluation of the equations, whatever its outputs.
    inputs : expressions; columns of several count as so many inputs.
    outputs : variables, derivatives, or expressions of them. A plain variable is computed directly, and is no unknown
        of the integrator's.
    """
    scope = current_scope("external()")
    _check_function(function)
    ins, outs = scalars(inputs), scalars(outputs)
    for what, found, wanted in (
        ("inputs", len(ins), function.n_inputs),
        ("outputs", len(outs), function.n_outputs),
    ):
        if found != wanted:
            raise DeclarationError(
                f"{function.name} has {wanted} {what}, but {found} are given",
                remedy=f"give external(...) as many {what} as the function has",
            )
    shape = (len(outs), len(ins))
    sparsity = np.array(getattr(function, "sparsity", np.ones(shape, dtype=bool)), dtype=bool)
    if sparsity.shape != shape:
        raise DeclarationError(
            f"the sparsity of {function.name} has the shape {sparsity.shape}, not {shape}",
            remedy="give an array of (n_outputs, n_inputs)",
        )
    units_in, units_out = _units(function, shape)
    first = len(scope.external)
    scope.external += [ExternalOutput(f"{function.name}[{k}]", units_out[k]) for k in range(len(outs))]
    symbols = tuple(scope.symbol("external", first + k) for k in range(len(outs)))
    _check_outputs(scope, outs)
    return External(function, ins, outs, symbols, sparsity, units_in)


def _check_function(function: Any) -> None:
    needed = ("name", "n_inputs", "n_outputs", "evaluate", "derivative", "fresh")
    missing = [name for name in needed if not hasattr(function, name)]
    if missing:
        raise DeclarationError(
            f"{function!r} is no external function: it has no {', '.join(missing)}",
            remedy="give an object with all that ExternalFunction asks for",
        )


def _check_outputs(scope: Scope, outputs: tuple[SX, ...]) -> None:
    for output in outputs:
        atom = scope.atom(output)
        if output.is_constant() or (atom is not None and atom.kind not in ("variable", "der")):
            raise DeclarationError(
                f"an output of external() is a variable, not {output}",
                remedy="declare it with variable(...), and use it where its value is needed",
            )


def _units(function: Any, shape: tuple[int, int]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the units of inputs and outputs; none for the inputs and empty ones for the outputs if not given."""
    units = getattr(function, "units", None)
    if units is None:
        return (), ("",) * shape[0]
    ins, outs = (tuple(part) for part in units)
    if (len(outs), len(ins)) != shape:
        raise DeclarationError(
            f"the units of {function.name} are {len(ins)} and {len(outs)}, not {shape[1]} and {shape[0]}",
            remedy="give (units of the inputs, units of the outputs)",
        )
    return ins, outs

"""Acausal, equation-based modelling of multi-domain systems, integrated by SUNDIALS IDA."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from arthur_acausal.api import Translation as Translation
    from arthur_acausal.api import simulate as simulate
    from arthur_acausal.api import translate as translate
    from arthur_acausal.codegen.build import compile_c as compile_c
    from arthur_acausal.codegen.kernel import compile_functions as compile_functions
    from arthur_acausal.declare.external import ExternalFunction as ExternalFunction
    from arthur_acausal.declare.external import external as external
    from arthur_acausal.declare.model import Component as Component
    from arthur_acausal.declare.model import Connector as Connector
    from arthur_acausal.declare.model import Equations as Equations
    from arthur_acausal.declare.model import Record as Record
    from arthur_acausal.declare.quantity import Real as Real
    from arthur_acausal.declare.quantity import discrete as discrete
    from arthur_acausal.declare.quantity import flow as flow
    from arthur_acausal.declare.quantity import parameter as parameter
    from arthur_acausal.declare.quantity import potential as potential
    from arthur_acausal.declare.quantity import real_input as real_input
    from arthur_acausal.declare.quantity import real_output as real_output
    from arthur_acausal.declare.quantity import start as start
    from arthur_acausal.declare.quantity import variable as variable
    from arthur_acausal.declare.sampled import sampled as sampled
    from arthur_acausal.declare.statement import connect as connect
    from arthur_acausal.declare.statement import der as der
    from arthur_acausal.declare.statement import edge as edge
    from arthur_acausal.declare.statement import homotopy as homotopy
    from arthur_acausal.declare.statement import if_else as if_else
    from arthur_acausal.declare.statement import initial as initial
    from arthur_acausal.declare.statement import pre as pre
    from arthur_acausal.declare.statement import reinit as reinit
    from arthur_acausal.declare.statement import smooth_if_else as smooth_if_else
    from arthur_acausal.declare.statement import terminate as terminate
    from arthur_acausal.declare.statement import time as time
    from arthur_acausal.declare.statement import when as when
    from arthur_acausal.errors import ArthurError as ArthurError
    from arthur_acausal.errors import ConnectError as ConnectError
    from arthur_acausal.errors import DeclarationError as DeclarationError
    from arthur_acausal.errors import InitializationError as InitializationError
    from arthur_acausal.errors import ParameterError as ParameterError
    from arthur_acausal.errors import ResultError as ResultError
    from arthur_acausal.errors import SimulationError as SimulationError
    from arthur_acausal.errors import StructureError as StructureError
    from arthur_acausal.errors import UnitError as UnitError
    from arthur_acausal.errors import UsageError as UsageError
    from arthur_acausal.result.solution import Solution as Solution
    from arthur_acausal.solve.options import SolverOptions as SolverOptions
    from arthur_acausal.solve.table import Table as Table

__version__ = "0.1.0"

# where each public name lives: a module is imported when one of its names is used for the first time
_HOME = {
    "api": ("Translation", "simulate", "translate"),
    "codegen.build": ("compile_c",),
    "codegen.kernel": ("compile_functions",),
    "declare.external": ("ExternalFunction", "external"),
    "declare.model": ("Component", "Connector", "Equations", "Record"),
    "declare.quantity": (
        "Real",
        "discrete",
        "flow",
        "parameter",
        "potential",
        "real_input",
        "real_output",
        "start",
        "variable",
    ),
    "declare.sampled": ("sampled",),
    "declare.statement": (
        "connect",
        "der",
        "homotopy",
        "if_else",
        "initial",
        "pre",
        "reinit",
        "edge",
        "smooth_if_else",
        "terminate",
        "time",
        "when",
    ),
    "errors": (
        "ArthurError",
        "ConnectError",
        "DeclarationError",
        "InitializationError",
        "ParameterError",
        "ResultError",
        "SimulationError",
        "StructureError",
        "UnitError",
        "UsageError",
    ),
    "result.solution": ("Solution",),
    "solve.options": ("SolverOptions",),
    "solve.table": ("Table",),
}
_MODULE = {name: module for module, names in _HOME.items() for name in names}

__all__ = sorted(_MODULE)  # pyright: ignore[reportUnsupportedDunderAll]


def __getattr__(name: str) -> Any:
    if name not in _MODULE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_MODULE[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})

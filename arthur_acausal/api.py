"""The public way through all stages: ``translate`` once a structure, ``simulate`` as often as wanted."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cached_property
from time import perf_counter
from typing import TYPE_CHECKING, Any

from arthur_acausal.codegen.compiled import CompiledDAE
from arthur_acausal.codegen.generate import generate
from arthur_acausal.declare.model import Component
from arthur_acausal.errors import ResultError, UsageError
from arthur_acausal.flatten.flatten import flatten
from arthur_acausal.flatten.system import FlatSystem
from arthur_acausal.transform.structured import StructuredDAE, StructureReport, report, transform

if TYPE_CHECKING:
    from arthur_acausal.analysis.linearize import LinearModel
    from arthur_acausal.analysis.sensitivity import Sensitivities
    from arthur_acausal.analysis.steady import SteadyState
    from arthur_acausal.result.solution import Solution
    from arthur_acausal.result.verify import Verification
    from arthur_acausal.solve.inputs import Input
    from arthur_acausal.solve.options import SolverOptions
    from arthur_acausal.solve.stepping import Stepper
    from arthur_acausal.solve.trajectory import Trajectory


@dataclass(frozen=True)
class Translation:
    """A translated model: simulate it with any parameter values, inputs and start values, without a recompile."""

    model: Component
    flat: FlatSystem = field(repr=False)
    structured: StructuredDAE = field(repr=False)
    dae: CompiledDAE = field(repr=False)
    seconds: Mapping[str, float] = field(repr=False)
    compile: str = field(default="auto", repr=False)
    _variants: dict[tuple[frozenset[int], bool], CompiledDAE] = field(default_factory=dict, repr=False)

    @cached_property
    def report(self) -> StructureReport:
        """The structural report: counts, states, blocks, index, what was differentiated."""
        return report(self.structured)

    def simulate(
        self,
        stop_time: float,
        *,
        start_time: float = 0.0,
        tolerance: float | None = None,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Input] | None = None,
        start: Mapping[str, Any] | None = None,
        options: SolverOptions | None = None,
        progress: Callable[[float], None] | None = None,
        steady: bool = False,
    ) -> Solution:
        """Simulate from ``start_time`` to ``stop_time`` [s].

        Parameters
        ----------
        tolerance : relative tolerance of the integration, short for ``options=SolverOptions(rtol=...)``.
        parameters, start : values by path: SI numbers, text with a unit ("150 bar"), or pint quantities.
        inputs : external inputs by path: constants, functions of time, or tables.
        progress : called with the present time about ten times a second.
        steady : begin at rest, see `steady_state`; initial conditions and start values are where it is sought from.

        Raises
        ------
        SimulationError : the run stopped early; its ``solution`` holds what was computed.
        InitializationError, ParameterError, UsageError : before the first step.
        """
        from arthur_acausal.result.power import Powers
        from arthur_acausal.result.simulated import run

        chosen = _options(options, tolerance)
        begin = None
        if steady:
            from arthur_acausal.analysis.steady import steady_state

            begin = steady_state(
                self.dae, time=start_time, parameters=parameters, inputs=inputs, start=start, options=chosen
            ).begin()
        solution = run(
            self.dae,
            self.model,
            stop_time=stop_time,
            start_time=start_time,
            options=chosen,
            parameters=parameters,
            inputs=inputs,
            start=start,
            progress=progress,
            variant=self._variant,
            begin=begin,
        )
        solution.powers = Powers(self.flat, self.structured)
        return solution

    def stepper(
        self,
        stop_time: float,
        *,
        start_time: float = 0.0,
        tolerance: float | None = None,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Input] | None = None,
        start: Mapping[str, Any] | None = None,
        options: SolverOptions | None = None,
        begin: Trajectory | None = None,
    ) -> Stepper:
        """Begin a run that its caller takes forward, setting inputs in between; the arguments are those of simulate.

        ``begin``: that of another stepper, with the same parameters and start values: nothing is solved for again.
        """
        from arthur_acausal.solve.stepping import Stepper

        return Stepper(
            self.dae,
            stop_time=stop_time,
            start_time=start_time,
            options=_options(options, tolerance),
            inputs=inputs,
            parameters=parameters,
            start=start,
            begin=begin,
        )

    def adopt(self, solution: Solution) -> Solution:
        """Let a solution that was read from a file know this model's connectors, for `Solution.power`; return it.

        Raises ResultError where it is of another model.
        """
        from arthur_acausal.result.power import Powers

        other = sorted(set(solution.paths) ^ set(self.dae.recovery.paths))
        if other:
            raise ResultError(
                f"the solution of {solution.model or 'a model'} is not of this model, {self.dae.name}",
                cause=f"only one of them has {other[0]}",
                remedy="translate the model that it was simulated with, its structural parameters as they were",
            )
        solution.powers = Powers(self.flat, self.structured)
        return solution

    def _variant(self, dummies: frozenset[int], continuation: bool) -> CompiledDAE:
        """Return the system compiled for another set of dummy derivatives, to start or continue a run; made once."""
        key = (dummies, continuation)
        if key not in self._variants:
            other = transform(self.flat, dummies)
            self._variants[key] = generate(other, compile=self.compile, continuation=continuation)
        return self._variants[key]

    def linearize(
        self,
        about: Solution | SteadyState | None = None,
        *,
        at: float | None = None,
        outputs: Sequence[str] | None = None,
    ) -> LinearModel:
        """Linearise about a point of a solution: that nearest to the time ``at`` [s], by default its end.

        Without a solution: about the initial point with the default parameters and inputs. ``outputs``: paths of any
        variables, by default all states.
        """
        from arthur_acausal.analysis.linearize import linearize, linearize_run
        from arthur_acausal.result.solution import Solution
        from arthur_acausal.solve.simulate import initial_point

        if isinstance(about, Solution):
            return linearize_run(about.pieces, at, outputs)
        point = initial_point(self.dae, stop_time=1.0) if about is None else about.point
        return linearize(self.dae, point, at, outputs)

    def steady_state(
        self,
        *,
        time: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Input] | None = None,
        start: Mapping[str, Any] | None = None,
    ) -> SteadyState:
        """Return the state of rest that is reached from the initial point, inputs held as they are at ``time`` [s].

        States that have no value of rest, the angle of a turning shaft, are named in its ``free`` and ``drifts``.
        Raises InitializationError, naming equations, where no state of rest is found.
        """
        from arthur_acausal.analysis.steady import steady_state

        return steady_state(self.dae, time=time, parameters=parameters, inputs=inputs, start=start)

    def sensitivities(
        self,
        solution: Solution,
        outputs: Sequence[str],
        parameters: Sequence[str],
        *,
        inputs: Mapping[str, Input] | None = None,
    ) -> Sensitivities:
        """Return the derivatives of outputs by parameters along a solution, over its times, also across its events.

        ``inputs``: those that the solution was computed with; constants need not be given again.
        """
        from arthur_acausal.analysis.sensitivity import sensitivities

        if "initial" in self.structured.nodes.start_only:
            raise UsageError(
                "sensitivities of a model that uses initial() are not computed",
                cause="its equations at the start are not those of the run",
            )
        run = solution.run
        held = {path: value for path, value in run.inputs.items() if isinstance(value, float)}
        for path in run.inputs:
            if path not in held and path not in (inputs or {}):
                raise UsageError(
                    f"the solution does not keep the input {path}",
                    remedy="give inputs= as for the simulation",
                )
        return sensitivities(
            self._plain,
            solution.pieces,
            outputs,
            parameters,
            given=run.parameters,
            start=run.start,
            inputs={**held, **(inputs or {})},
        )

    def to_modelica(
        self, *, parameters: Mapping[str, Any] | None = None, stop_time: float | None = None
    ) -> str:
        """Return the text of one flat Modelica model, for other tools; ``parameters`` replace the model's own values.

        Raises UsageError for what Modelica cannot say.
        """
        from arthur_acausal.exchange.modelica import Given, to_modelica
        from arthur_acausal.solve.conditions import choose

        dae = self.dae
        p = dae.parameter_vector(parameters)
        evaluator, attributes = dae.evaluator(), dae.attributes(p)
        evaluator.p[:], evaluator.y[:], evaluator.z[:] = p, attributes.start, attributes.z_start
        assumed = choose(dae, evaluator, attributes).assumed.tolist()
        fixed = {dae.y_paths[j]: float(attributes.start[j]) for j in assumed}
        infos = dae.parameters
        values = {infos.infos[k].path: float(p[k]) for k in map(infos.find, parameters or {})}
        return to_modelica(self.flat, Given(fixed, values, stop_time))

    @cached_property
    def _plain(self) -> CompiledDAE:
        """The system as CasADi expressions, which can be differentiated further."""
        return generate(self.structured, compile="never")

    def to_bytes(self, states: tuple[frozenset[int], bool] | None = None) -> bytes:
        """Return the compiled system for other processes of the same user, see `arthur_acausal.codegen.portable`.

        ``states``: for another set of states, by its dummy derivatives and whether a run is continued with it, as
        `arthur_acausal.result.chain` asks for it.
        """
        from arthur_acausal.codegen.portable import to_bytes

        if states is None:
            return to_bytes(self.dae, self._plain)
        dummies, continuation = states
        plain = generate(transform(self.flat, dummies), compile="never", continuation=continuation)
        return to_bytes(self._variant(dummies, continuation), plain)

    def verify(self, solution: Solution) -> Verification:
        """Evaluate every raw equation of the model, before any elimination, on a solution of it."""
        from arthur_acausal.result.verify import verify

        return verify(self.flat, self.structured, solution)


def _options(options: SolverOptions | None, tolerance: float | None) -> SolverOptions:
    from arthur_acausal.solve.options import SolverOptions

    if options is None:
        return SolverOptions() if tolerance is None else SolverOptions(rtol=tolerance)
    if tolerance is not None:
        raise UsageError("give the tolerance in the options, or by itself, not both")
    return options


@contextmanager
def _no_collection() -> Iterator[None]:
    """Pause the collection of cycles: a translation makes many lasting objects, a fifth of its time would go there."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def translate(
    model: Component,
    *,
    name: str = "",
    check_units: bool = True,
    compile: str = "auto",
    structural: Mapping[str, Any] | None = None,
) -> Translation:
    """Translate a model: flatten, reduce the index, order the equations, generate code.

    Parameters
    ----------
    check_units : whether the homogeneity of every equation is checked.
    compile : "auto" (by the system's C compiler where that pays), "often" (for what will run many times), "always",
        "never".
    structural : values of structural parameters by path, also of parts, in place of all that the model says.

    Raises
    ------
    DeclarationError, UnitError, ConnectError, ParameterError, StructureError : with path, equation and file:line.
    """
    with _no_collection():
        begun = perf_counter()
        flat = flatten(model, name=name, check_units=check_units, structural=structural)
        flattened = perf_counter()
        structured = transform(flat)
        transformed = perf_counter()
        dae = generate(structured, compile=compile)
        done = perf_counter()
    seconds = {
        "flatten": flattened - begun,
        "transform": transformed - flattened,
        "codegen": done - transformed,
    }
    return Translation(model, flat, structured, dae, seconds, compile)


def simulate(model: Component, stop_time: float, **arguments: Any) -> Solution:
    """Translate and simulate a model in one call; the arguments are those of ``Translation.simulate``."""
    return translate(model).simulate(stop_time, **arguments)

"""``generate``: from a structured system to a CompiledDAE."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np
from casadi import SX

from arthur_acausal.codegen.assemble import (
    Assembly,
    StartSlot,
    assemble,
    elements,
    lookup,
)
from arthur_acausal.codegen.chain_rule import ChainRule
from arthur_acausal.codegen.compiled import CompiledDAE, as_bools, pattern_of
from arthur_acausal.codegen.event_kernels import placed_row, samples_of, time_only, whens_of
from arthur_acausal.codegen.kernel import compile_functions
from arthur_acausal.codegen.origins import Origins, origins_of
from arthur_acausal.codegen.recovery import Recovery, Source
from arthur_acausal.codegen.starts import attribute_arrays, collect_starts, ignored_starts
from arthur_acausal.codegen.switching import RELATION, add_switching, continuation_starts
from arthur_acausal.codegen.tables import BoolArray, Relation
from arthur_acausal.codegen.values import parameter_table, start_entries, start_value
from arthur_acausal.declare.scope import Declared
from arthur_acausal.errors import ParameterError
from arthur_acausal.flatten.system import FlatEquation
from arthur_acausal.transform.structured import StructuredDAE

SHARED_UP_TO = 1000  # rows
COMPILED = ("residual", "jacobian", "roots")


def generate(
    dae: StructuredDAE, *, compile: str = "auto", continuation: bool = False, starting: bool = False
) -> CompiledDAE:
    """Return the compiled system.

    ``compile``: "auto" (by the system's C compiler where that pays), "often", "always" or "never". ``continuation``: it
    continues the run of another set of states: the states at the start are given, and nothing else holds there.
    ``starting``: the system that holds at the start only, with ``initial()`` true and homotopy as an argument.
    """
    slots = continuation_starts(dae) if continuation else collect_starts(dae)
    n_discrete = len(dae.flat.scope.discrete)
    assembly = assemble(dae, len(slots) + n_discrete, starting=starting)
    y_place = {node: k for k, node in enumerate(assembly.y_nodes)}
    table = parameter_table(dae, assembly)
    entries, aliases = start_entries(dae, slots, y_place, len(table.infos))
    rule = ChainRule(dae, assembly)
    functions, tables = _functions(dae, assembly, rule, slots, y_place, continuation)
    calls = rule.calls()
    functions |= {call.name: call.inputs for call in calls}
    often = [*COMPILED, *(call.name for call in calls)]
    hot = compile_functions([functions[name] for name in often], mode=compile, long_runs=bool(calls))
    functions |= dict(zip(often, hot, strict=True))
    nominal, minimum, maximum = attribute_arrays(dae, assembly.y_nodes)
    flat, n_states, start_only = dae.flat, len(dae.causal.states), dae.nodes.start_only
    own_start = bool(start_only) and not (starting or continuation)
    recovery, origins = _recovery(dae, assembly, rule, y_place)
    return CompiledDAE(
        name=flat.name,
        y_paths=[dae.nodes.name(n) for n in assembly.y_nodes],
        differential=as_bools([k < n_states for k in range(len(y_place))]),
        row_labels=assembly.row_labels,
        u_paths=[flat.variables[i].path for i in flat.inputs],
        u_default=np.array([_default(flat.variables[i]) for i in flat.inputs]),
        u_units=[flat.variables[i].quantity.unit for i in flat.inputs],
        z_paths=[d.path for d in flat.scope.discrete],
        nominal=nominal,
        minimum=minimum,
        maximum=maximum,
        parameters=table,
        starts=entries,
        start_aliases=aliases,
        pivot_labels=[label for _, label in assembly.pivots],
        functions=functions,
        calls=calls,
        recovery=recovery,
        origins=origins,
        sets=dae.reduced.sets,
        dummies=dae.reduced.dummies,
        blends=starting and "homotopy" in start_only,
        ignored=ignored_starts(dae, assembly.y_nodes),
        starting=generate(dae, compile="never", starting=True) if own_start else None,
        **tables,
    )


def _default(declared: Declared) -> float:
    """Return the value of an external input that a run does not give."""
    if isinstance(declared.value, SX) and not declared.value.is_constant():
        raise ParameterError(
            f"the default of an input is a number, not {declared.value}",
            path=declared.path,
            where=declared.where,
            remedy="connect the input to an output that has this value",
        )
    return float(declared.value) if declared.value is not None else 0.0


def _functions(
    dae: StructuredDAE,
    assembly: Assembly,
    rule: ChainRule,
    slots: list[StartSlot],
    y_place: dict[int, int],
    continuation: bool,
) -> tuple[dict[str, ca.Function], dict[str, Any]]:
    a = assembly.arguments
    arguments = a.continuous()
    look, before = lookup(dae, assembly, before=False), lookup(dae, assembly, before=True)
    residual = _shared(_column(assembly.residual))
    cj = SX.sym("cj")
    dy, dyp = rule(residual, a.y), rule(residual, a.yp)
    both = _shared(rule(residual, a.y, a.yp, cj) if dae.flat.calls else dy + cj * dyp)
    pattern = both.sparsity()
    roots = [dae.evaluator(placed_row(dae, r.relation.g, r), before) for r in dae.flat.relations]
    conditions, values, whens, assignments = events = whens_of(dae, before, y_place, starting=a.starting)
    entries = add_switching(dae, assembly, look, events)
    initial, labels = _initial(dae, assembly, slots, [] if continuation else dae.flat.initial)
    slope = ca.horzcat(rule(initial, a.y), rule(initial, a.yp))
    samples, sample_inputs, sample_times = samples_of(dae, look)
    starts = [start_value(dae, assembly, s.value, s.path) for s in slots]
    starts += [
        start_value(dae, assembly, d.start.value if d.start else 0.0, d.path) for d in dae.flat.scope.discrete
    ]
    kernels: dict[str, tuple[list[SX], SX]] = {
        "residual": (arguments, residual),
        "jacobian": ([*arguments, cj], both),
        "roots": (a.event(), _column(roots)),
        "jacobian_y": (arguments, ca.project(dy, pattern)),
        "jacobian_yp": (arguments, ca.project(dyp, pattern)),
        "jacobian_u": (arguments, rule(residual, a.u)),
        "conditions": (a.event(), _column(conditions)),
        "when_values": (a.event(), _column(values)),
        "initial": (arguments, initial),
        "initial_jacobian": (arguments, slope),
        "sample_inputs": (arguments, _column(sample_inputs)),
        "sample_times": ([a.p], _column(sample_times)),
        "starts": ([a.parameters], _column(starts)),
        "pivots": ([a.p], _column([v for v, _ in assembly.pivots])),
    }
    relations = [
        Relation(
            f"{r.path}: {r.relation.text}".lstrip(": "),
            r.relation.where,
            r.relation.inclusive,
            time_only(g, a),
            r.path,
        )
        for r, g in zip(dae.flat.relations, roots, strict=True)
    ]
    if entries is not None:
        kernels["state_sets"] = (arguments, entries)
        relations.append(RELATION)
    values_of = {name: value for name, (_, value) in kernels.items()}
    n_states = len(dae.causal.states)
    values_of["solving"] = ca.horzcat(
        dyp[:, :n_states], dy[:, n_states:]
    )  # for y' of states, and the algebraic y
    tables = {
        "relations": relations,
        "whens": whens,
        "assignments": assignments,
        "samples": samples,
        "relations_of_rates": bool(roots) and rule.reaches(_column(roots), a.yp),
        "needs": {name: need for name, value in values_of.items() if (need := rule.need(value))},
        "sparsity": pattern_of(both),
        "init_sparsity": pattern_of(slope),
        "init_labels": labels,
    }
    return {name: ca.Function(name, ins, [value]) for name, (ins, value) in kernels.items()}, tables


def _shared(matrix: SX) -> SX:
    """Return the same with common subexpressions computed once: a third less work for the powertrain.

    Left out for large systems, whose rows share little, and where the search would take a third of the translation.
    """
    return ca.cse(matrix) if matrix.size1() <= SHARED_UP_TO else matrix


def _column(values: list[SX]) -> SX:
    return ca.vertcat(*values) if values else SX(0, 1)


def _initial(
    dae: StructuredDAE, assembly: Assembly, slots: list[StartSlot], equations: list[FlatEquation]
) -> tuple[SX, list[str]]:
    look = lookup(dae, assembly, before=False)
    values: list[SX] = []
    labels: list[str] = []
    for equation in equations:
        row = dae.nodes.row(equation)
        values.append(dae.evaluator(row, look))
        labels.append(f"initial equation {row.text}")
    starts = elements(assembly.arguments.starts)
    for k, slot in enumerate(slots):
        if slot.fixed:
            values.append(slot.sign * assembly.node_values[slot.node] - starts[k])
            labels.append(f"fixed start of {slot.path}" + (f" ({slot.where})" if slot.where else ""))
    return _column(values), labels


def _recovery(
    dae: StructuredDAE, assembly: Assembly, rule: ChainRule, y_place: dict[int, int]
) -> tuple[Recovery, Origins]:
    paths, sources, quantities = [], [], []
    observed: list[SX] = []
    place_of_node: dict[int, int] = {}

    def source(node: int, sign: int) -> Source:
        if node in y_place:
            return Source("y", y_place[node], sign)
        if node not in place_of_node:
            place_of_node[node] = len(observed)
            observed.append(assembly.node_values[node])
        return Source("observed", place_of_node[node], sign)

    for i, declared in enumerate(dae.flat.variables):
        ref = dae.nodes.of_variable(i)
        paths.append(declared.path)
        quantities.append(declared.quantity)
        kind = {"input": "u", "zero": "zero"}.get(ref.kind)
        sources.append(source(ref.number, ref.sign) if kind is None else Source(kind, ref.number, ref.sign))
    for k, declared in enumerate(dae.flat.scope.discrete):
        paths.append(declared.path)
        quantities.append(declared.quantity)
        sources.append(Source("z", k, 1))
    for i, declared in enumerate(dae.flat.scope.parameter):
        paths.append(declared.path)
        quantities.append(declared.quantity)
        sources.append(Source("p", assembly.parameter_place[dae.flat.parameter(i)], 1))
    units = [q.unit for q in quantities]
    displays = [q.display for q in quantities]
    descriptions = [q.description for q in quantities]
    for node, (variable, order) in enumerate(dae.nodes.all):
        if order:
            paths.append(dae.nodes.name(node))
            sources.append(source(node, 1))
            units.append(f"{dae.flat.variables[variable].quantity.unit}/s^{order}")
            displays.append(None)
            descriptions.append("")
    a, n_states = assembly.arguments, len(dae.causal.states)
    column = _column(observed)
    function = ca.Function("observed", a.continuous(), [column])
    loose = ca.vertcat(a.yp, a.y[n_states:])
    if any(rule.reaches(x, loose) for x in rule.inputs):
        loose = ca.vertcat(loose, a.e)
    recovery = Recovery(
        paths,
        sources,
        units,
        displays,
        descriptions,
        function,
        _depending(column, loose),
        n_states,
        rule.calls(),
        _depending(column, a.e),
    )
    return recovery, origins_of(dae, assembly, place_of_node)


def _depending(column: SX, on: SX) -> BoolArray:
    """Tell which entries depend on any of some symbols."""
    both = bool(on.numel()) and bool(column.numel())
    return as_bools(ca.which_depends(column, on, 1, True) if both else [False] * column.numel())

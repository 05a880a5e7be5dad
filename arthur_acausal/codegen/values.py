"""Parameters and start values as entries of the vector p, and what computes the dependent ones."""

from __future__ import annotations

from typing import Any

import casadi as ca
from casadi import SX

from arthur_acausal.codegen.assemble import Assembly, StartSlot, elements
from arthur_acausal.codegen.parameters import ParameterInfo, ParameterTable
from arthur_acausal.codegen.tables import StartEntry
from arthur_acausal.errors import ParameterError
from arthur_acausal.graph import strongly_connected
from arthur_acausal.transform.structured import StructuredDAE


def start_value(dae: StructuredDAE, assembly: Assembly, value: Any, path: str) -> SX:
    """Return a start value as an expression of p; parameters in it are looked up."""
    if value is None:
        return SX.nan()
    return SX(value) if not isinstance(value, SX) else parameter_expression(dae, assembly, value, path)


def parameter_expression(dae: StructuredDAE, assembly: Assembly, value: SX, path: str) -> SX:
    """Return an expression of the model's parameter symbols as one of the vector p."""
    symbols = ca.symvar(value)
    if not symbols:
        return value
    p = assembly.parameters
    replaced = []
    for symbol in symbols:
        atom = dae.flat.scope.atom(symbol)
        if atom is None or atom.kind != "parameter":
            raise ParameterError(
                f"{value} contains {symbol}, which is no parameter of this model",
                path=path,
                remedy="compute it from parameters only, or declare a variable and an equation for it",
            )
        replaced.append(p[assembly.parameter_place[dae.flat.parameter(atom.number)]])
    result: SX = ca.substitute(value, ca.vertcat(*symbols), ca.vertcat(*replaced))
    return result


def start_entries(
    dae: StructuredDAE, slots: list[StartSlot], y_place: dict[int, int], first: int
) -> tuple[list[StartEntry], dict[str, tuple[int, int]]]:
    variables = dae.flat.variables
    entries = [
        StartEntry(
            s.path,
            y_place.get(s.node, -1),
            s.sign,
            s.fixed,
            variables[dae.nodes.all[s.node].variable].quantity.unit,
            first + k,
            s.where,
        )
        for k, s in enumerate(slots)
    ]
    by_node: dict[int, int] = {}
    for k, slot in enumerate(slots):
        by_node.setdefault(slot.node, k)
    aliases: dict[str, tuple[int, int]] = {}
    for i, declared in enumerate(variables):
        ref = dae.nodes.of_variable(i)
        if ref.kind == "node" and ref.number in by_node:
            number = by_node[ref.number]
            aliases[declared.path] = (number, ref.sign * slots[number].sign)
    for k, slot in enumerate(slots):
        aliases.setdefault(slot.path, (k, 1))
    for k, discrete in enumerate(dae.flat.scope.discrete):
        aliases[discrete.path] = (len(slots) + k, 1)
        entries.append(StartEntry(discrete.path, k, 0, True, discrete.quantity.unit, first + len(slots) + k))
    return entries, aliases


def parameter_table(dae: StructuredDAE, assembly: Assembly) -> ParameterTable:
    declared, same, place = dae.flat.scope.parameter, dae.flat.parameter_aliases, assembly.parameter_place
    infos = []
    dependent: list[tuple[int, SX]] = []
    for i in place:
        d = declared[i]
        symbolic = isinstance(d.value, SX) and not d.value.is_constant()
        if symbolic:
            dependent.append((place[i], parameter_expression(dae, assembly, d.value, d.path)))
        q = d.quantity
        value = 0.0 if symbolic else float(d.value)
        infos.append(ParameterInfo(d.path, q.unit, value, symbolic, q.min, q.max, q.description, q.display))
    alias = {declared[i].path: declared[dae.flat.parameter(i)].path for i in same}
    number = {info.path: k for k, info in enumerate(infos)}
    return ParameterTable(infos, alias, _dependent_function(assembly, dependent, infos), number)


def _dependent_function(
    assembly: Assembly, dependent: list[tuple[int, SX]], infos: list[ParameterInfo]
) -> ca.Function | None:
    """Return (values, given) -> p, dependent parameters in an order in which each is known when it is needed."""
    if not dependent:
        return None
    whole = assembly.parameters
    at = {s.element_hash(): k for k, s in enumerate(whole)}
    order = {k: j for j, (k, _) in enumerate(dependent)}
    needs = [[order[i] for s in ca.symvar(e) if (i := at[s.element_hash()]) in order] for _, e in dependent]
    values, given = SX.sym("values", len(infos)), SX.sym("given", len(infos))
    result = elements(values)
    chosen = elements(given)
    for component in strongly_connected(needs):
        if len(component) > 1 or component[0] in needs[component[0]]:
            names = ", ".join(infos[dependent[j][0]].path for j in component)
            raise ParameterError(
                f"parameters that depend on each other: {names}", remedy="give one of them a value"
            )
        k, expression = dependent[component[0]]
        symbols = ca.symvar(expression)
        own = ca.substitute(
            expression, ca.vertcat(*symbols), ca.vertcat(*[result[at[s.element_hash()]] for s in symbols])
        )
        result[k] = ca.if_else(chosen[k], result[k], own)
    return ca.Function("parameters", [values, given], [ca.vertcat(*result)])

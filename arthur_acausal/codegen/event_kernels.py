"""What happens at events, as expressions: conditions and values of ``when`` clauses, inputs of sampled blocks."""

from __future__ import annotations

from typing import Any

import casadi as ca
from casadi import SX

from arthur_acausal.codegen.assemble import reinit_target
from arthur_acausal.codegen.tables import Assignment, SampledBlock, WhenClause
from arthur_acausal.transform.rows import Row
from arthur_acausal.transform.structured import StructuredDAE


def placed_row(dae: StructuredDAE, expression: Any, placed: Any) -> Row:
    return dae.nodes.expression(expression, placed.shift, placed.path)


def time_only(g: SX, a: Any) -> bool:
    """Tell whether g depends on time, affinely, and on nothing that changes between events."""
    if any(ca.depends_on(g, x) for x in (a.y, a.yp, a.u, a.e) if x.numel()):
        return False
    return bool(ca.depends_on(g, a.t)) and not ca.depends_on(ca.jacobian(g, a.t), a.t)


def whens_of(
    dae: StructuredDAE, look: Any, y_place: dict[int, int], *, starting: bool
) -> tuple[list[SX], list[SX], list[WhenClause], list[Assignment]]:
    conditions: list[SX] = []
    values: list[SX] = []
    whens: list[WhenClause] = []
    assignments: list[Assignment] = []
    for item in dae.flat.clauses:
        clause, label = item.clause, f"{item.path} {item.clause.label}".strip()
        number = -1
        if clause.condition is not None:
            number = len(whens)
            row = placed_row(dae, clause.condition, item)
            initial = starting and any(ref.kind == "initial" for ref in row.refs)
            whens.append(WhenClause(label or "when", clause.where, clause.earlier, initial, item.path))
            conditions.append(dae.evaluator(row, look))
        for assignment in clause.assignments:
            text = f"{label} ({assignment.where})".lstrip()
            value = dae.evaluator(placed_row(dae, assignment.value, item), look)
            target = assignment.target
            if target is None:
                assignments.append(Assignment("terminate", -1, number, assignment.message, text))
            elif target.kind == "discrete":
                assignments.append(
                    Assignment("discrete", target.number + item.shift.discrete, number, "", text)
                )
            else:
                place, sign = reinit_target(dae, target.number + item.shift.variable, y_place, text)
                value = sign * value
                assignments.append(Assignment("state", place, number, "", text))
            values.append(value)
    return conditions, values, whens, assignments


def samples_of(dae: StructuredDAE, look: Any) -> tuple[list[SampledBlock], list[SX], list[SX]]:
    """Return the sampled blocks, their inputs one after the other, and their periods, then their offsets."""
    blocks: list[SampledBlock] = []
    inputs: list[SX] = []
    for item in dae.flat.samplings:
        s = item.sampling
        outputs, begins = (
            tuple(atom.number + item.shift.discrete for atom in atoms) for atoms in (s.outputs, s.begins)
        )
        since = -1 if s.since is None else s.since.number + item.shift.discrete
        first = len(inputs)
        taken = [*s.inputs, *([] if s.trigger is None else [s.trigger])]
        inputs += [dae.evaluator(placed_row(dae, x, item), look) for x in taken]
        trigger = -1 if s.trigger is None else len(inputs) - 1
        label = f"{item.path} {s.label}".strip() or "sampled()"
        blocks.append(
            SampledBlock(label, s.where, s.function, first, len(s.inputs), outputs, begins, since, trigger)
        )
    times = [
        dae.evaluator(placed_row(dae, x, item), look)
        for which in ("period", "offset")
        for item in dae.flat.samplings
        for x in (getattr(item.sampling, which),)
    ]
    return blocks, inputs, times

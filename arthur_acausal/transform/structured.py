"""``transform``: all passes in order, and the structural report."""

from __future__ import annotations

from dataclasses import dataclass

from arthur_acausal.flatten.system import FlatSystem
from arthur_acausal.transform.alias import Aliases, eliminate_aliases
from arthur_acausal.transform.index import ReducedSystem, reduce_index
from arthur_acausal.transform.linear import LinearAnalysis
from arthur_acausal.transform.rows import Evaluator, Nodes
from arthur_acausal.transform.tear import CausalSystem, causalise


@dataclass(frozen=True, slots=True)
class StructuredDAE:
    """The system after all transformations: what codegen reads."""

    flat: FlatSystem
    aliases: Aliases
    nodes: Nodes
    reduced: ReducedSystem
    causal: CausalSystem
    evaluator: Evaluator


@dataclass(frozen=True, slots=True)
class StructureReport:
    """What `arthur check` prints: counts before and after, states, blocks, index, what was differentiated."""

    model: str
    equations: int
    unknowns: int
    states: list[str]
    aliases: int
    assigned: int
    torn: list[str]
    blocks: list[tuple[int, int]]
    n_blocks: int
    index: int
    differentiated: list[str]
    dummies: list[str]
    inputs: list[str]
    parameters: int
    discretes: int
    relations: int
    messages: list[str]


def transform(flat: FlatSystem, dummies: frozenset[int] | None = None) -> StructuredDAE:
    """Return the structured system; ``dummies``: a set of dummy derivatives chosen by numbers.

    Raises StructureError, naming equations and unknowns, where it is singular."""
    linear = LinearAnalysis()
    evaluator = Evaluator()
    aliases = eliminate_aliases(flat, linear)
    nodes = Nodes(flat, aliases)
    rows = [nodes.row(equation) for equation in aliases.kept]
    reduced = reduce_index(rows, nodes, linear, evaluator, dummies)
    return StructuredDAE(flat, aliases, nodes, reduced, causalise(reduced, nodes), evaluator)


def report(dae: StructuredDAE) -> StructureReport:
    """Return the structural report."""
    flat, causal, name = dae.flat, dae.causal, dae.nodes.name
    messages = [f"an equation gave way to a {text}" for text in dae.reduced.combined]
    if dae.reduced.differentiated:
        messages.append(
            f"{len(dae.reduced.differentiated)} equations were differentiated (index {dae.reduced.index})"
        )
    if flat.inputs:
        number = len(flat.inputs)
        messages.append("1 input comes from outside" if number == 1 else f"{number} inputs come from outside")
    return StructureReport(
        model=flat.name,
        equations=flat.n_equations,
        unknowns=len(flat.variables),
        states=[name(n) for n in causal.states],
        aliases=dae.aliases.count,
        assigned=len(causal.assignments),
        torn=[name(n) for n in causal.torn],
        blocks=causal.blocks,
        n_blocks=causal.n_blocks,
        index=dae.reduced.index,
        differentiated=dae.reduced.differentiated,
        dummies=sorted(name(n) for n in dae.reduced.dummies),
        inputs=[flat.variables[i].path for i in flat.inputs],
        parameters=len(flat.scope.parameter),
        discretes=len(flat.scope.discrete),
        relations=len(flat.relations),
        messages=messages,
    )

"""Which equations, as they are written, a value that is not finite comes from."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from arthur_acausal.codegen.assemble import Assembly
from arthur_acausal.codegen.tables import FloatArray, IntArray
from arthur_acausal.transform.structured import StructuredDAE


@dataclass(frozen=True)
class Origins:
    """The rows of F, then the assignments in order: what each says, and which assignments it uses.

    ``place``: of each assignment, its index among the observed values. What entry k uses is
    ``uses[begin[k]:begin[k + 1]]``, by the numbers of the entries.
    """

    texts: list[str]
    place: IntArray
    begin: IntArray
    uses: IntArray

    def blamed(self, rows: Iterable[int], observed: FloatArray) -> list[str]:
        """Return the equations in which values first cease to be finite, of those that some rows of F are made of."""
        first = len(self.texts) - len(self.place)
        bad = np.concatenate([np.zeros(first, dtype=bool), ~np.isfinite(observed[self.place])])
        waiting = list(rows)
        seen, found = set(waiting), set()
        while waiting:
            entry = waiting.pop()
            used = self.uses[self.begin[entry] : self.begin[entry + 1]]
            guilty = used[bad[used]].tolist()
            if not guilty:
                found.add(entry)
            waiting += [k for k in guilty if k not in seen]
            seen.update(guilty)
        return list(dict.fromkeys(self.texts[k] for k in sorted(found)))


def origins_of(dae: StructuredDAE, assembly: Assembly, place_of_node: Mapping[int, int]) -> Origins:
    """Return the origins; ``place_of_node``: where the value of an eliminated node is among the observed ones."""
    assignments, edges = dae.causal.assignments, dae.reduced.edges
    first = len(assembly.row_labels)
    number = {a.node: first + k for k, a in enumerate(assignments)}
    nodes = [list(edges[r]) for r in dae.causal.residuals]
    nodes += [[dae.nodes.derivative[n]] for n in dae.causal.chained]
    nodes += [[n for n in edges[a.row] if n != a.node] for a in assignments]
    uses = [[number[n] for n in own if n in number] for own in nodes]
    return Origins(
        [*assembly.row_labels, *(dae.reduced.rows[a.row].text for a in assignments)],
        np.array([place_of_node[a.node] for a in assignments], dtype=np.int32),
        np.cumsum([0, *map(len, uses)], dtype=np.int32),
        np.array([k for own in uses for k in own], dtype=np.int32),
    )

"""What a result knows of each variable besides its values."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Kind = Literal["state", "algebraic", "alias", "discrete", "parameter", "constant", "input", "eliminated"]

TIME = "time"  # the axis of every dataset


@dataclass(frozen=True, slots=True)
class Variable:
    """One variable of a model by its path.

    Attributes
    ----------
    path : where it stands in the model, "valves[3].port_a.p".
    unit : coherent SI, "Pa"; "1" where it has no dimension.
    kind : its part in the equations; "alias" equals another variable up to sign, "eliminated" is computed
        explicitly from others.
    description : one line for people, may be empty.
    display : the unit that people like to see it in ("bar"); empty where `unit` serves.
    state : the state whose value it is up to sign, itself for a state; empty for all others.
    sign : +1.0 or -1.0, so that value = sign * state.
    refined : whether it takes unknowns that are solved for at each output, which costs more than all else.
    """

    path: str
    unit: str = "1"
    kind: Kind = "algebraic"
    description: str = ""
    display: str = ""
    state: str = ""
    sign: float = 1.0
    refined: bool = field(default=False, compare=False)  # of a computed solution only

    @property
    def fixed_in_time(self) -> bool:
        """Whether it has one value for the whole run."""
        return self.kind in ("parameter", "constant")

    @property
    def held(self) -> bool:
        """Whether it changes at events only and keeps its value between them."""
        return self.kind in ("discrete", "parameter", "constant")


def dataset_name(path: str) -> str:
    """Name of a variable in files and datasets: its path as it is; ``time`` is the axis's own."""
    return f"{path}_" if path.rstrip("_") == TIME else path

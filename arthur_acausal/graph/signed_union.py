"""Sets of variables that are equal up to sign, and plain connection sets: union-find.

Tarjan and van Leeuwen (1984), J. ACM 31, 245-281 (union by rank, path halving); the sign is carried along
each link.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Any


class Outcome(Enum):
    """What a union did."""

    MERGED = "merged"  # two sets became one
    KNOWN = "known"  # it followed from earlier unions
    ZERO = "zero"  # with earlier unions it says x = -x: the whole set is zero


class SignedUnion:
    """Disjoint sets of the numbers 0 to n - 1 with ``x[i] == sign * x[root]`` within a set, sign +1 or -1."""

    __slots__ = ("_parent", "_rank", "_sign", "_zero")

    def __init__(self, n: int) -> None:
        self._parent = list(range(n))
        self._sign = [1] * n  # relative to the parent
        self._rank = [0] * n
        self._zero = [False] * n  # at roots: all members are zero

    def __len__(self) -> int:
        return len(self._parent)

    def find(self, i: int) -> tuple[int, int]:
        """Return the root of i's set and the sign in ``x[i] == sign * x[root]``."""
        parent, signs = self._parent, self._sign
        sign = 1
        while (above := parent[i]) != i:
            if parent[above] != above:  # halve the path: link i to its grandparent
                signs[i] *= signs[above]
                parent[i] = above = parent[above]
            sign *= signs[i]
            i = above
        return i, sign

    def union(self, i: int, j: int, sign: int = 1) -> Outcome:
        """Record ``x[i] == sign * x[j]``."""
        root_i, sign_i = self.find(i)
        root_j, sign_j = self.find(j)
        relative = sign * sign_i * sign_j
        if root_i == root_j:
            if relative > 0:
                return Outcome.KNOWN
            self._zero[root_i] = True
            return Outcome.ZERO
        if self._rank[root_i] > self._rank[root_j]:
            root_i, root_j = root_j, root_i
        self._parent[root_i] = root_j
        self._sign[root_i] = relative
        self._rank[root_j] += self._rank[root_i] == self._rank[root_j]
        self._zero[root_j] |= self._zero[root_i]
        return Outcome.MERGED

    def is_zero(self, i: int) -> bool:
        """Tell whether i's set holds an ``x == -x``, so that all its members are zero."""
        return self._zero[self.find(i)[0]]

    def sets(self) -> list[list[int]]:
        """Return the sets, members ascending, ordered by their smallest member."""
        groups: dict[int, list[int]] = {}
        for i in range(len(self._parent)):
            groups.setdefault(self.find(i)[0], []).append(i)
        return list(groups.values())

    def prefer(self, key: Callable[[int], Any]) -> None:
        """Make the member with the smallest ``key`` the root of each set (of equals the lowest number)."""
        for members in self.sets():
            old = self.find(members[0])[0]
            best = min(members, key=key)
            sign = self.find(best)[1]
            relative = [self.find(i)[1] * sign for i in members]
            for i, relative_sign in zip(members, relative, strict=True):
                self._parent[i] = best
                self._sign[i] = relative_sign
            self._rank[best] = int(len(members) > 1)
            self._zero[best] = self._zero[old]


class Union:
    """Disjoint sets of the numbers 0 to n - 1."""

    __slots__ = ("_parent", "_rank")

    def __init__(self, n: int) -> None:
        self._parent = list(range(n))
        self._rank = [0] * n

    def __len__(self) -> int:
        return len(self._parent)

    def add(self) -> int:
        """Add a set of one new number and return the number."""
        self._parent.append(len(self._parent))
        self._rank.append(0)
        return len(self._parent) - 1

    def find(self, i: int) -> int:
        """Return the root of i's set."""
        parent = self._parent
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    def union(self, i: int, j: int) -> bool:
        """Merge the sets of i and j; return False if they were one already."""
        root_i, root_j = self.find(i), self.find(j)
        if root_i == root_j:
            return False
        if self._rank[root_i] > self._rank[root_j]:
            root_i, root_j = root_j, root_i
        self._parent[root_i] = root_j
        self._rank[root_j] += self._rank[root_i] == self._rank[root_j]
        return True

    def sets(self) -> list[list[int]]:
        """Return the sets, members ascending, ordered by their smallest member."""
        groups: dict[int, list[int]] = {}
        for i in range(len(self._parent)):
            groups.setdefault(self.find(i), []).append(i)
        return list(groups.values())

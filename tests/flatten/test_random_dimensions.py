"""Random expressions, built with a dimension by rules of their own, pass the check of homogeneity with no other one."""

from __future__ import annotations

from fractions import Fraction
from typing import Any, NamedTuple

import casadi as ca
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from arthur_acausal.flatten.flatten import flatten
from tests.flatten.test_dimensions import Law, equation, holds


class Term(NamedTuple):
    """An expression of a `Things` and the exponents of m, s and kg that it should have."""

    law: Law
    dimension: tuple[Fraction, Fraction, Fraction]


def power_of_units(s: Any, dimension: tuple[Fraction, ...]) -> Any:
    return s.a ** float(dimension[0]) * s.T ** float(dimension[1]) * s.m ** float(dimension[2])


def added(left: Term, right: Term) -> Term:
    """The sum of a term and another one that is brought to its dimension."""
    gap = tuple(x - y for x, y in zip(left.dimension, right.dimension, strict=True))
    return Term(lambda s: left.law(s) + right.law(s) * power_of_units(s, gap), left.dimension)


def multiplied(left: Term, right: Term) -> Term:
    x, y = left.dimension, right.dimension
    return Term(lambda s: left.law(s) * right.law(s), (x[0] + y[0], x[1] + y[1], x[2] + y[2]))


def divided(left: Term, right: Term) -> Term:
    x, y = left.dimension, right.dimension
    return Term(lambda s: left.law(s) / right.law(s), (x[0] - y[0], x[1] - y[1], x[2] - y[2]))


def squared(term: Term) -> Term:
    x = term.dimension
    return Term(lambda s: term.law(s) ** 2, (2 * x[0], 2 * x[1], 2 * x[2]))


def rooted(term: Term) -> Term:
    x = term.dimension
    return Term(lambda s: ca.sqrt(ca.fabs(term.law(s))), (x[0] / 2, x[1] / 2, x[2] / 2))


def clamped(term: Term) -> Term:
    return Term(
        lambda s: ca.fmax(ca.fmin(term.law(s), 3 * power_of_units(s, term.dimension)), 0), term.dimension
    )


def bent(term: Term) -> Term:
    """The hyperbolic tangent of the term made plain."""
    return Term(
        lambda s: ca.tanh(term.law(s) / power_of_units(s, term.dimension)),
        (Fraction(0), Fraction(0), Fraction(0)),
    )


def base(name: str, *dimension: int) -> Term:
    x, y, z = (Fraction(d) for d in dimension)
    return Term(lambda s: getattr(s, name), (x, y, z))


leaves = st.sampled_from(
    [base("a", 1, 0, 0), base("x", 1, 0, 0), base("T", 0, 1, 0), base("m", 0, 0, 1), base("r", 0, 0, 0)]
)
terms = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.builds(added, inner, inner),
        st.builds(multiplied, inner, inner),
        st.builds(divided, inner, inner),
        st.builds(squared, inner),
        st.builds(rooted, inner),
        st.builds(clamped, inner),
        st.builds(bent, inner),
    ),
    max_leaves=8,
)


def unit_text(dimension: tuple[Fraction, ...]) -> str:
    pairs = zip(("m", "s", "kg"), dimension, strict=True)
    return "*".join(f"{unit}^({d.numerator}/{d.denominator})" for unit, d in pairs if d) or "1"


@settings(max_examples=60)
@given(terms, st.integers(0, 2))
def test_random_expressions_have_their_dimension_and_no_other(term: Term, wrong: int) -> None:
    assume(all(abs(d) <= 12 and d.denominator <= 8 for d in term.dimension))
    folded: list[bool] = []

    def law(s: Any) -> Any:
        value = term.law(s)
        folded.append(value.is_constant())
        return value

    flatten(equation(unit_text(term.dimension), law))
    other = list(term.dimension)
    other[wrong] += 1
    if not folded[0]:  # x - x is zero for CasADi, which fits everywhere
        assert not holds(unit_text(tuple(other)), law)


@settings(max_examples=40)
@given(terms, terms)
def test_random_sums_of_different_dimensions_are_refused(left: Term, right: Term) -> None:
    assume(left.dimension != right.dimension)
    assume(all(abs(d) <= 12 and d.denominator <= 8 for d in left.dimension + right.dimension))
    parts: list[bool] = []

    def law(s: Any) -> Any:
        a, b = left.law(s), right.law(s)
        parts.append(a.is_constant() or b.is_constant())
        return a + b

    accepted = holds(unit_text(left.dimension), law)
    assume(not parts[0])
    assert not accepted

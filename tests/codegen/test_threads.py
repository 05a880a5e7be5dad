"""The linear algebra of a simulation runs in one thread, and the user's own as before."""

from __future__ import annotations

from threadpoolctl import threadpool_info

from arthur_acausal.codegen.threads import one_thread


def threads() -> set[int]:
    return {pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"}


@one_thread()
def within() -> set[int]:
    return threads()


def test_one_thread_within_and_as_many_as_before_after_it() -> None:
    before = threads()
    assert within() <= {1}
    assert threads() == before

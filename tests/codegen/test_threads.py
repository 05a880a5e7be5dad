"""The linear algebra of a simulation runs in one thread, and the user's own as before."""

from __future__ import annotations

import subprocess
import sys

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


def test_a_library_that_is_loaded_later_has_one_thread_too() -> None:
    """SciPy brings linear algebra of its own; in a fresh process it is not there when NumPy's is first limited."""
    code = """
import numpy
import subprocess
import sys

from threadpoolctl import threadpool_info
from arthur_acausal.codegen.threads import one_thread
with one_thread():
    pass
with one_thread(scipy=True):
    print(*(pool["num_threads"] for pool in threadpool_info() if pool["user_api"] == "blas"))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=60
    )
    assert set(done.stdout.split()) == {"1"}

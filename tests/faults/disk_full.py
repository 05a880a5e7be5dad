"""The result is written to a device that is full."""

from __future__ import annotations

import resource
import signal

from arthur_acausal import ResultError, simulate
from tests.errors.decay import Decay

ERROR = ResultError
EXPECT = [r"result\.nc", r"cannot write", r"File too large|No space", r"remedy"]


def run() -> None:
    solution = simulate(Decay(), 1.0)
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (4096, limit[1]))
    try:
        solution.save("result.nc")
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
        signal.signal(signal.SIGXFSZ, handler)

"""MuJoCo's own annotations leave out what its compiled parts define."""

from typing import Any

def __getattr__(name: str) -> Any: ...

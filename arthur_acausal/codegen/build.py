"""Libraries of one file in C, made by the system's compiler and kept in the cache."""

from __future__ import annotations

import logging
import subprocess
from pathlib import Path

from arthur_acausal.codegen.cache import default_cache, make_key
from arthur_acausal.codegen.kernel import compiler

LOGGER = logging.getLogger("arthur_acausal")
FLAGS = ("-O2", "-fPIC", "-shared", "-ffp-contract=off", "-Werror=implicit-function-declaration")


def compile_c(source: Path, *words: str, version: str = "") -> Path | None:
    """Return the path of a shared library made of one file in C, None where there is no compiler or it fails.

    It is kept in the cache. External functions may offer what is in it as ``native``.

    Parameters
    ----------
    source : the file. It is compiled so that results have the same bits everywhere.
    words : further ones for the compiler, as ``-I`` and libraries.
    version : of what the file includes; another one compiles anew.
    """
    command = compiler()
    if command is None:
        return None

    def run(path: Path) -> None:
        line = [*command, *FLAGS, str(source), "-o", str(path), *words, "-lm"]
        subprocess.run(line, check=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=60.0)

    try:
        key = make_key("build", *command, *FLAGS, version, *words, source.read_bytes())
        return default_cache().path_of_library(key, run)
    except (OSError, subprocess.SubprocessError) as error:
        LOGGER.info("%s cannot be compiled, Python serves: %s", source.name, error)
        return None

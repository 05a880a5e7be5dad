"""How a command ends when something goes wrong: one message on standard error, and the exit status."""

from __future__ import annotations

import functools
import sys
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext, redirect_stdout
from typing import ParamSpec, TypeVar

import typer

from arthur_acausal.errors import ArthurError

P = ParamSpec("P")
R = TypeVar("R")

FAILED, INTERRUPTED = 1, 130  # 2 is a wrong use of the command line, which typer itself reports


def reported(command: Callable[P, R]) -> Callable[P, R]:
    """Make a command report its errors: those of models and files as text, others with a hint at --debug."""

    @functools.wraps(command)
    def run(*args: P.args, **kwargs: P.kwargs) -> R:
        try:
            return command(*args, **kwargs)
        except ArthurError as error:
            if kwargs.get("debug"):
                traceback.print_exc()
            complain(str(error))
            raise typer.Exit(FAILED) from None
        except KeyboardInterrupt:
            complain("interrupted")
            raise typer.Exit(INTERRUPTED) from None
        except (typer.Exit, typer.Abort, typer.BadParameter, BrokenPipeError):
            raise
        except Exception as error:
            if kwargs.get("debug"):
                traceback.print_exc()
            complain(
                f"{type(error).__name__}: {error}\n  this is a fault in Arthur or in the model's own code",
                hint=not kwargs.get("debug"),
            )
            raise typer.Exit(FAILED) from None

    return run


@contextmanager
def quiet(wanted: bool) -> Iterator[None]:
    """Send to standard error what models print, where standard output is for one object alone."""
    with redirect_stdout(sys.stderr) if wanted else nullcontext():
        yield


def complain(message: str, hint: bool = False) -> None:
    """Print an error to standard error; red where that is a terminal."""
    sys.stdout.flush()
    head, _, rest = message.partition("\n")
    typer.secho(f"error: {head}", fg=typer.colors.RED, bold=True, err=True)
    if rest:
        typer.echo(rest, err=True)
    if hint:
        typer.echo("  --debug shows where it was raised", err=True)


def note(message: str) -> None:
    """Tell something beside the result, on standard error."""
    typer.secho(message, fg=typer.colors.YELLOW, err=True)

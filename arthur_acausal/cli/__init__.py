"""The command line `arthur`."""

from __future__ import annotations


def main() -> None:
    """Run the command that `sys.argv` names, and exit with its status."""
    from arthur_acausal.cli.batch import app  # which also brings the commands of app.py

    app(prog_name="arthur")

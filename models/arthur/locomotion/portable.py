"""A controller's configuration as data, so that it can be made again in another process."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any, get_args, get_origin, get_type_hints

from arthur_acausal import UsageError
from arthur_acausal.models.arthur.locomotion.commands import Constant, Table
from arthur_acausal.models.arthur.locomotion.controller import Configuration

COMMANDS: dict[str, type[Constant | Table]] = {kind.__name__: kind for kind in (Constant, Table)}


def as_data(configuration: Configuration) -> dict[str, Any]:
    """Return a configuration in terms of JSON. Raises UsageError where its commands are a function of the user's."""
    commands = configuration.commands
    if not isinstance(commands, Constant | Table):
        raise UsageError(
            f"the commands {commands!r} cannot be made again in another process",
            cause="they are a function",
            remedy="give them as Constant(...), Table(...) or read_commands(FILE)",
        )
    return asdict(configuration) | {"commands": {"kind": type(commands).__name__, **asdict(commands)}}


def of_data(data: Mapping[str, Any]) -> Configuration:
    """Return the configuration that ``as_data`` has written."""
    given = {
        name: _value(kind, data[name])
        for name, kind in get_type_hints(Configuration).items()
        if name != "commands"
    }
    commands = dict(data["commands"])
    kind = COMMANDS[commands.pop("kind")]
    return Configuration(commands=_value(kind, commands), **given)


def _value(kind: Any, data: Any) -> Any:
    """Return a value of this type: a dataclass, a tuple, or what JSON has itself."""
    if isinstance(kind, type) and is_dataclass(kind):
        hints = get_type_hints(kind)
        return kind(**{name: _value(hints[name], value) for name, value in data.items()})
    if get_origin(kind) is tuple:
        entry = get_args(kind)[0]  # all entries are of one type
        return tuple(_value(entry, value) for value in data)
    return data

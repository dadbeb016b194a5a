# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""What can go wrong, as exceptions."""

from . import _library as lib

_USAGE, _SCENE, _PLUGIN, _FILE, _MEMORY = range(1, 6)


class ImpingeError(Exception):
    """What the library complains of: where, what was given, what is allowed."""


class UsageError(ImpingeError, ValueError):
    """An argument is of the wrong type or out of its range."""


class SceneError(ImpingeError, ValueError):
    """A scene, a type or a parameter is wrong."""


class PluginError(ImpingeError):
    """A plugin broke its promises."""


class FileError(ImpingeError, OSError):
    """A file cannot be read or written."""


_ERRORS = {_USAGE: UsageError, _SCENE: SceneError, _PLUGIN: PluginError, _FILE: FileError}


def check(code: int, error: lib.Error) -> None:
    """Raises the exception of a code that is not success."""
    if code == 0:
        return
    text = error.text.decode("utf-8", "replace")
    if code == _MEMORY:
        raise MemoryError(text)
    raise _ERRORS.get(code, ImpingeError)(text)

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""The command impinge, which draws and simulates."""

import os
import subprocess
import tempfile
from typing import Any, Dict, List, Optional, Tuple

from . import _files
from . import _library as lib
from . import _values as values
from ._find import bundled_environment, find_command
from .errors import FileError, ImpingeError, PluginError, SceneError, UsageError

_UNDECIDED = 3
_ERRORS = {2: UsageError, 4: SceneError, 5: PluginError}
_ANSWERS = (0, 1, _UNDECIDED)

_found: Dict[str, str] = {}  # versions that were asked for, by the path of the command


def _command() -> str:
    path = find_command(lib.library)
    if path is None:
        raise FileError("there is no command impinge beside the library or in PATH; install it, or let "
                        "IMPINGE_COMMAND name it")
    if path not in _found:
        _found[path] = _run([path, "--version"], b"")[1].decode("utf-8", "replace").partition("\n")[0]
    ours = lib.library.imp_version().decode().split()[-1]
    if _found[path].split()[1:2] != [ours]:
        raise UsageError(f"{path} is '{_found[path]}', but the library is version {ours}; install both "
                         "from one source, or let IMPINGE_COMMAND name the right one")
    return path


def _run(line: List[str], text: bytes) -> Tuple[int, bytes]:
    """The exit status and what is printed; an exception for what is no answer."""
    try:
        done = subprocess.run(line, input=text, capture_output=True, check=False,
                              env=bundled_environment(line[0]))
    except OSError as error:
        raise FileError(f"{line[0]}: cannot be run: {error.strerror or error}") from None
    if done.returncode in _ANSWERS:
        return done.returncode, done.stdout
    said = done.stderr.decode("utf-8", "replace").strip() or f"it ended with status {done.returncode}"
    raise _ERRORS.get(done.returncode, ImpingeError)(said)


def _words(options: Dict[str, Any]) -> List[str]:
    """Options of Python as those of the command: `max_pairs=3` as --max-pairs=3."""
    words = []
    for name, value in options.items():
        word = "--" + name.replace("_", "-")
        if value is None or value is False:
            continue
        if value is True:
            words.append(word)
        elif name == "time":
            words.append(f"{word}={','.join(map(repr, values.interval(name, value)))}")
        elif name in _COUNTS:
            words.append(f"{word}={values.count(name, value)}")
        else:
            words.append(f"{word}={values.number(name, value)!r}")
    return words


_COUNTS = ("width", "height", "frames", "slices", "max_pairs", "max_bytes", "max_events")


def write_file(verb: str, text: str, path: str, options: Dict[str, Any]) -> Tuple[bool, bytes]:
    """Lets the command write a file about the scene of a text. Whether it came to its end, and what it
    prints as JSON."""
    words = [_command(), verb, "-", f"--output={path}", "--json", "--progress=none", *_words(options)]
    status, printed = _run(words, text.encode())
    return status != _UNDECIDED, printed


def write_bytes(verb: str, text: str, suffix: str, options: Dict[str, Any]) -> Tuple[bool, bytes, bytes]:
    """As `write_file`; the bytes of the file, and what is printed."""
    with tempfile.TemporaryDirectory(prefix="impinge") as folder:
        path = os.path.join(folder, "out" + suffix)
        complete, printed = write_file(verb, text, path, options)
        return complete, _files.read(path), printed

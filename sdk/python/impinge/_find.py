# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Where libimpinge and the command impinge are.

The library is the one that the environment's IMPINGE_LIBRARY names, or else the one that a wheel brings
along, or that this module was installed or built with, or the one that the dynamic linker or pkg-config finds. The command is the one that
IMPINGE_COMMAND names, or else the one installed or built beside that library, or the one in PATH."""

import ctypes as c
import importlib
import os
import shutil
import subprocess
from typing import Dict, Iterator, Optional

NAME = "libimpinge.so.0"

# What a wheel brings along, as in a build tree: library, plugins, command, data.
_BUNDLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "_bundle")
_BUNDLED = os.path.join(_BUNDLE, ".libs", NAME)


def bundled_plugins(library: c.CDLL) -> Optional[str]:
    """The folder of the plugins that a wheel brings along, if the library is its own."""
    return os.path.join(_BUNDLE, "plugins", ".libs") if library._name == _BUNDLED else None


def bundled_environment(command: str) -> Optional[Dict[str, str]]:
    """The environment in which a command that a wheel brings along finds its libraries; None: any."""
    if os.path.dirname(os.path.realpath(command)) != os.path.realpath(os.path.join(_BUNDLE, "tools")):
        return None
    folders = [os.path.dirname(_BUNDLED), os.environ.get("LD_LIBRARY_PATH", "")]
    return {**os.environ, "LD_LIBRARY_PATH": ":".join(filter(None, folders))}


def _load_needed() -> None:
    """Loads what the library of a wheel needs, which the dynamic linker does not look for there."""
    for name in os.listdir(os.path.dirname(_BUNDLED)):
        if name.startswith("libjansson"):
            c.CDLL(os.path.join(os.path.dirname(_BUNDLED), name), mode=c.RTLD_GLOBAL)


def _installed() -> Optional[str]:
    try:  # written by make install, and by pip from pkg-config's answer
        return str(importlib.import_module("._installed", __package__).LIBRARY)
    except ImportError:
        return None


def _pkg_config() -> Optional[str]:
    try:
        asked = subprocess.run(["pkg-config", "--variable=libdir", "impinge"], check=True,
                               stdin=subprocess.DEVNULL, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return os.path.join(asked.stdout.strip(), NAME)


def _libraries() -> Iterator[Optional[str]]:
    named = os.environ.get("IMPINGE_LIBRARY")
    if named:
        yield named
        return
    if os.path.exists(_BUNDLED):
        _load_needed()
        yield _BUNDLED
    yield _installed()
    yield NAME
    yield _pkg_config()


def open_library() -> c.CDLL:
    """The library, loaded."""
    tried = []
    for path in _libraries():
        if path is None:
            continue
        try:
            return c.CDLL(path)
        except OSError as error:
            tried.append(str(error))
    raise ImportError(f"{'; '.join(tried)}. Install Impinge, or let IMPINGE_LIBRARY name its {NAME}")


class _DlInfo(c.Structure):
    _fields_ = [("file", c.c_char_p), ("base", c.c_void_p), ("symbol", c.c_char_p),
                ("address", c.c_void_p)]


def library_folder(library: c.CDLL) -> Optional[str]:
    """The folder of a library that is loaded; None: the system does not tell."""
    try:
        dladdr = c.CDLL(None).dladdr
    except (OSError, AttributeError):
        return None
    dladdr.argtypes, dladdr.restype = [c.c_void_p, c.POINTER(_DlInfo)], c.c_int
    info = _DlInfo()
    if dladdr(c.cast(library.imp_version, c.c_void_p), c.byref(info)) == 0 or not info.file:
        return None
    return os.path.dirname(os.path.realpath(os.fsdecode(info.file)))


def _commands(library: c.CDLL) -> Iterator[Optional[str]]:
    folder = library_folder(library)
    if folder is not None:
        above = os.path.dirname(folder)
        if os.path.basename(folder) == ".libs":
            yield os.path.join(above, "tools", "impinge")  # where it was built
        for _ in range(2):  # lib, or lib/x86_64-linux-gnu
            yield os.path.join(above, "bin", "impinge")
            above = os.path.dirname(above)
    yield shutil.which("impinge")


def find_command(library: c.CDLL) -> Optional[str]:
    """The path of the command impinge; None: there is none."""
    named = os.environ.get("IMPINGE_COMMAND")
    if named:
        return named
    for path in _commands(library):
        if path is not None and os.path.isfile(path) and os.access(path, os.X_OK):
            return path
    return None

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""The types that scenes are made of."""

import ctypes as c
import os
import threading
from typing import Dict, FrozenSet, Iterator, Optional

from . import _library as lib
from ._find import bundled_plugins


class Registry:
    """The types there are, found once for the whole process."""

    _lock = threading.Lock()
    _handle: Optional[int] = None
    _files: Optional[Dict[str, FrozenSet[str]]] = None

    @classmethod
    def handle(cls) -> int:
        with cls._lock:
            if cls._handle is None:
                cls._handle = lib.library.imp_registry_new(_plugin_path())
                if cls._handle is None:
                    raise MemoryError("out of memory")
            return cls._handle

    @classmethod
    def files_of(cls, type_name: str) -> FrozenSet[str]:
        """The parameters of a type that name files."""
        if cls._files is None:
            files: Dict[str, FrozenSet[str]] = {}
            for info in cls._types():
                files[info.name.decode()] = frozenset(_file_parameters(info))
            cls._files = files
        return cls._files.get(type_name, frozenset())

    @classmethod
    def _types(cls) -> Iterator[lib.TypeInfo]:
        """All types that scenes can use."""
        info, index = lib.TypeInfo(), 0
        while lib.library.imp_registry_type(cls.handle(), index, c.byref(info)):
            if info.shadowed_by is None:
                yield info
            index += 1

    @classmethod
    def after_fork(cls) -> None:
        """In the copy of a process, where the thread that held the lock does not exist."""
        cls._lock = threading.Lock()


def _plugin_path() -> Optional[bytes]:
    """Where a wheel has its plugins: after those of the environment, as installed ones are."""
    bundled = bundled_plugins(lib.library)
    if bundled is None:
        return None
    named = os.environ.get("IMPINGE_PLUGIN_PATH")
    return os.fsencode(f"{named}:{bundled}" if named else bundled)


def _file_parameters(info: lib.TypeInfo) -> Iterator[str]:
    for k in range(info.parameter_count):
        row = lib.Parameter.from_address(info.parameters + k * info.parameter_size)
        if row.flags & lib.PARAMETER_FILE:
            yield row.name.decode()


os.register_at_fork(after_in_child=Registry.after_fork)

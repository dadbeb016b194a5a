# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""A scene of libimpinge, which copies of a Scene share and the last of them frees."""

import ctypes as c
import os
import threading
import weakref
from typing import Any, Callable, Dict, Optional, Set, Tuple

from . import _document as document
from . import _library as lib
from ._registry import Registry
from .errors import check

MakeDocument = Callable[[], document.Document]


def from_text(data: bytes, name: bytes) -> int:
    """The address of the scene of a text. Relative names of files begin at the folder of `name`."""
    error = lib.Error()
    address = lib.library.imp_scene_from_json(Registry.handle(), data, len(data), name, c.byref(error))
    if not address:
        check(error.code, error)
    return int(address)


class Handle:
    """The scene at an address, and how to write it.

    A copy of the process made by fork while a thread is asking the scene finds its trees half-made, and
    locked by a thread that does not exist: there the scene is made anew when it is used."""

    _all: "weakref.WeakSet[Handle]" = weakref.WeakSet()

    def __init__(self, address: int, make_document: MakeDocument,
                 make_address: Optional[Callable[[], int]] = None):
        self._make_document, self._make_address = make_document, make_address
        self._lock = threading.Lock()
        self.users: Set[object] = set()  # queries that are open
        self.changes: Dict[document.Where, document.Change] = {}  # since it was made
        self._take(address)
        Handle._all.add(self)

    def _take(self, address: int) -> None:
        self._address = address
        self._finalizer = weakref.finalize(self, lib.library.imp_scene_free, address)
        # At exit threads may still be asking the scene: its memory is left to the system then.
        self._finalizer.atexit = False

    @property
    def address(self) -> int:
        """Where the scene is; only to be handed to the library while this object lives."""
        with self._lock:
            if not self._finalizer.alive:
                self._take(from_text(self.text().encode(), b"scene") if self._make_address is None
                           else self._make_address())
            return self._address

    def document(self) -> document.Document:
        """The scene as the object of a scene file, names of files absolute."""
        made = self._make_document()
        return document.changed(made, self.changes) if self.changes else made

    def text(self) -> str:
        """The scene as the text of a scene file, on one line."""
        return document.to_text(self.document())

    def names(self) -> Tuple[str, ...]:
        """The names of its bodies."""
        count = lib.library.imp_scene_body_count(self.address)
        return tuple(lib.library.imp_scene_body_name(self.address, k).decode() for k in range(count))

    def __deepcopy__(self, memo: Any) -> "Handle":
        return self

    def __reduce__(self) -> Any:
        raise TypeError("a scene's handle cannot be pickled; pickle the Scene")

    @classmethod
    def after_fork(cls) -> None:
        """In the copy of a process."""
        for handle in list(cls._all):
            handle._lock = threading.Lock()
            if handle.users:
                handle._finalizer.detach()  # nobody can free it
                handle.users.clear()


os.register_at_fork(after_in_child=Handle.after_fork)

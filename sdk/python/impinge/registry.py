# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""The types that scenes are made of."""

import threading
from typing import Optional

from . import _library as lib


class Registry:
    """The types there are, found once for the whole process."""

    _lock = threading.Lock()
    _handle: Optional[int] = None

    @classmethod
    def handle(cls) -> int:
        with cls._lock:
            if cls._handle is None:
                cls._handle = lib.library.imp_registry_new(None)
                if cls._handle is None:
                    raise MemoryError("out of memory")
            return cls._handle

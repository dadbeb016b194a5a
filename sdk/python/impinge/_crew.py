# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Threads that a question borrows: imp_options.parallel."""

import ctypes as c
import itertools
import threading
from typing import Any, List

_Work = c.CFUNCTYPE(None, c.c_void_p, c.c_size_t)
_Parallel = c.CFUNCTYPE(None, c.c_void_p, _Work, c.c_void_p, c.c_size_t)


class Crew:
    """So many threads; `function` is the imp_parallel that lends them, valid while the crew lives."""

    def __init__(self, threads: int):
        self._threads = threads
        self.function = _Parallel(self._run)

    def _run(self, _: Any, work: Any, of: Any, count: int) -> None:
        """Calls work(of, 0) to work(of, count - 1) once each. Where the system has no more threads, those
        that there are do it all."""
        indices = itertools.count()

        def member() -> None:
            for index in indices:
                if index >= count:
                    return
                work(of, index)

        started: List[threading.Thread] = []
        for _number in range(min(self._threads, count) - 1):
            thread = threading.Thread(target=member, daemon=True)
            try:
                thread.start()
            except RuntimeError:
                break
            started.append(thread)
        member()
        for thread in started:
            thread.join()

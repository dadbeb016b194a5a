# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Files that are read and written whole."""

import os
import tempfile

from .errors import FileError


def _refuse(path: str, what: str, error: OSError) -> FileError:
    refused = FileError(f"{path}: cannot be {what}: {error.strerror or error}")
    refused.errno = error.errno
    return refused


def read(path: str) -> bytes:
    """The bytes of a file."""
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise _refuse(path, "read", error) from None


def write(path: str, data: bytes) -> None:
    """Writes a file whole or not at all; what is no regular file (a device, a pipe) is written to."""
    try:
        if os.path.exists(path) and not os.path.isfile(path):
            with open(path, "wb") as file:
                file.write(data)
        else:
            _replace(os.path.realpath(path), data)
    except OSError as error:
        raise _refuse(path, "written", error) from None


def _mode(path: str) -> int:
    """Of the file that is replaced, or of a new one."""
    try:
        return os.stat(path).st_mode & 0o777
    except FileNotFoundError:
        mask = os.umask(0)
        os.umask(mask)
        return 0o666 & ~mask


def _replace(path: str, data: bytes) -> None:
    handle, draft = tempfile.mkstemp(dir=os.path.dirname(path), prefix=os.path.basename(path) + ".")
    try:
        with open(handle, "wb") as file:
            file.write(data)
        os.chmod(draft, _mode(path))
        os.replace(draft, path)
    except BaseException:
        os.unlink(draft)
        raise

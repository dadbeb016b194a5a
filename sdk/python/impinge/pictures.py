# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Pictures, pages and plots, as bytes that notebooks show."""

import html
import os
from dataclasses import dataclass
from typing import Any, Dict, Literal, Optional

from . import _command as command
from . import _files
from . import _values as values

Format = Literal["png", "svg", "html"]

_SHOWN = (".png", ".svg", ".html")  # formats of one file that a notebook shows


@dataclass(frozen=True, repr=False)
class Picture:
    """What `Scene.view` and `Scene.plot` draw: `data`, the bytes of a file, and `format`, "png", "svg" or
    "html". Notebooks show it."""

    data: bytes
    format: Format

    def __bytes__(self) -> bytes:
        return self.data

    def __repr__(self) -> str:
        return f"Picture({self.format}, {len(self.data)} bytes)"

    def save(self, path: values.Path) -> None:
        """Writes the file."""
        _files.write(values.path("path", path), self.data)

    def _repr_png_(self) -> Optional[bytes]:
        return self.data if self.format == "png" else None

    def _repr_svg_(self) -> Optional[str]:
        return self.data.decode() if self.format == "svg" else None

    def _repr_html_(self) -> Optional[str]:
        if self.format != "html":
            return None
        page = html.escape(self.data.decode())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 40em; border: 0"></iframe>'


def draw(verb: str, text: str, path: Optional[values.Path], format: Format,
         options: Dict[str, Any]) -> Optional[Picture]:
    """Writes the file `path`, in the format of its extension, or makes a picture where that is None."""
    if path is not None:
        command.write_file(verb, text, values.path("path", path), options)
        return None
    suffix = f".{format}"
    if suffix not in _SHOWN:
        raise values.refuse("format", format, f"one of {', '.join(s[1:] for s in _SHOWN)}; others need a path")
    return Picture(command.write_bytes(verb, text, suffix, options)[1], format)

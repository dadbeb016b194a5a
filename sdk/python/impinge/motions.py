# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Motions under the laws of impact."""

import json
import os
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional, Sequence, Union

from . import _command as command
from . import _document as document
from . import _files
from . import _values as values
from .errors import SceneError
from .scene import Scene


@dataclass(frozen=True)
class Motion:
    """What `simulate` finds: the `scene` whose maps reproduce the motion; `complete` is False where a budget
    ended it early; `summary` is what `impinge simulate --json` prints, with "events", "energy" and
    "momentum" among others."""

    scene: Scene
    complete: bool
    summary: Dict[str, Any]


def _text(scene: Union[Scene, values.Path, Mapping[str, Any]]) -> str:
    """The text of a scene file, names of files absolute."""
    if isinstance(scene, Scene):
        return scene.to_json()
    if isinstance(scene, Mapping):
        try:
            return document.to_text(document.from_text(json.dumps(scene).encode(), os.getcwd()))
        except (TypeError, ValueError) as error:
            raise SceneError(f"scene: {error}; must be the object of a scene file") from None
    path = values.path("scene", scene)
    try:
        made = document.from_text(_files.read(path), os.path.dirname(os.path.abspath(path)))
    except ValueError as error:
        raise SceneError(f"{path}: {error}") from None
    return document.to_text(made)


def simulate(scene: Union[Scene, values.Path, Mapping[str, Any]], *,
             time: Optional[Sequence[float]] = None, gamma: Optional[float] = None,
             gamma_clear: Optional[float] = None, max_events: Optional[int] = None,
             max_pairs: Optional[int] = None, max_seconds: Optional[float] = None,
             max_bytes: Optional[int] = None, audit: Optional[bool] = None) -> Motion:
    """Moves bodies by the laws of impact, with proof, by the command `impinge simulate`: `scene` is the path
    or the object of a scene file whose bodies may have "mass", "velocity" and so on (see the manual)."""
    options = {"time": time, "gamma": gamma, "gamma_clear": gamma_clear, "max_events": max_events,
               "max_pairs": max_pairs, "max_seconds": max_seconds, "max_bytes": max_bytes,
               "audit": audit}
    complete, data, printed = command.write_bytes("simulate", _text(scene), ".json", options)
    return Motion(Scene.from_json(data.decode()), complete, json.loads(printed))

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""SRDF files as plain objects."""

import math
from dataclasses import dataclass, field
from typing import Dict, List, Mapping, Set, Tuple

from ..errors import SceneError
from ._urdf import Element, Joint, Model, parse


@dataclass
class Semantics:
    """What an SRDF file says: pairs of links that are never tested with each other, each with its reason (""
    if it gives none); the joints of each
    group, parents before children; the named states, by group and name, from joints to positions; the
    frames in which virtual joints put the robot."""

    disabled: Dict[Tuple[str, str], str] = field(default_factory=dict)
    groups: Dict[str, Tuple[str, ...]] = field(default_factory=dict)
    states: Dict[Tuple[str, str], Dict[str, float]] = field(default_factory=dict)
    frames: Set[str] = field(default_factory=set)


class _Reader:
    def __init__(self, path: str, model: Model):
        self._path, self._model = path, model
        self._moving: Dict[str, Joint] = {joint.child: joint for joint in model.joints.values()}
        self._elements: Dict[str, Element] = {}

    def fail(self, where: str, what: str) -> SceneError:
        return SceneError(f"{self._path}: {where}: {what}")

    def name(self, element: Element, key: str, known: Mapping[str, object], where: str) -> str:
        """An attribute that names a link or a joint of the robot."""
        found = element.get(key, "")
        if found not in known:
            kind = "joint" if known is self._model.joints else "link"
            raise self.fail(where, f"got the {kind} {found!r}, which {self._model.file} does not have")
        return found

    def read(self) -> Semantics:
        root, read = parse(self._path), Semantics()
        for element in root.findall("disable_collisions"):
            pair = (self.name(element, "link1", self._model.links, "disable_collisions"),
                    self.name(element, "link2", self._model.links, "disable_collisions"))
            read.disabled[pair] = element.get("reason", "")
        read.frames = {element.get("parent_frame", "") for element in root.findall("virtual_joint")}
        for element in root.findall("group"):
            self._elements[element.get("name", "")] = element
        for group in self._elements:
            joints = self._joints_of(group, ())
            read.groups[group] = tuple(name for name in self._model.joints if name in joints)
        for element in root.findall("group_state"):
            name, group = element.get("name", ""), element.get("group", "")
            if not name or group not in read.groups:
                raise self.fail(f"group_state {name!r}", f"got the group {group!r}, must be one of "
                                                         f"{', '.join(read.groups) or 'none'}")
            read.states[group, name] = self._state(element, f"group_state {name!r}")
        return read

    def _joints_of(self, group: str, within: Tuple[str, ...]) -> Set[str]:
        """Joints that it names, those above links that it names, and those of chains and groups in it."""
        where = f"group {group!r}"
        joints: Set[str] = set()
        if group in within:
            raise self.fail(where, "is a part of itself")
        for element in self._elements[group]:
            if element.tag == "joint":
                joints.add(self.name(element, "name", self._model.joints, where))
            elif element.tag == "link":
                above = self._moving.get(self.name(element, "name", self._model.links, where))
                joints |= {above.name} if above is not None else set()
            elif element.tag == "chain":
                joints |= self._chain(element, where)
            elif element.tag == "group":
                inner = element.get("name", "")
                if inner not in self._elements:
                    raise self.fail(where, f"got the group {inner!r}, which is not there")
                joints |= self._joints_of(inner, (*within, group))
        return joints

    def _chain(self, element: Element, where: str) -> Set[str]:
        base = self.name(element, "base_link", self._model.links, where)
        link = tip = self.name(element, "tip_link", self._model.links, where)
        joints = set()
        while link != base:
            above = self._moving.get(link)
            if above is None:
                raise self.fail(where, f"got a chain to {tip!r}, which is not below {base!r}")
            joints.add(above.name)
            link = above.parent
        return joints

    def _state(self, element: Element, where: str) -> Dict[str, float]:
        state: Dict[str, float] = {}
        for one in element.findall("joint"):
            joint = self._model.joints[self.name(one, "name", self._model.joints, where)]
            try:
                positions = [float(word) for word in one.get("value", "").split()]
            except ValueError:
                positions = []
            count = max(len(joint.variables), 1)  # a fixed joint may have one, which means nothing
            if len(positions) != count or not all(map(math.isfinite, positions)):
                raise self.fail(where, f"joint {joint.name!r}: got {one.get('value')!r}, must be {count} finite "
                                       f"number{'s' if count > 1 else ''}")
            state.update(zip(joint.variables, positions))
        return state


def read_srdf(path: str, model: Model) -> Semantics:
    """What an SRDF file says about a robot."""
    return _Reader(path, model).read()

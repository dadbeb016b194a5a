# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""URDF files as plain objects."""

import math
import os
from dataclasses import dataclass, field
from typing import Dict, List, Mapping, Optional, Set, Tuple
from xml.etree import ElementTree

from .. import _files
from ..errors import SceneError

Vector = Tuple[float, float, float]
Element = ElementTree.Element

KINDS = ("revolute", "continuous", "prismatic", "fixed", "planar", "floating")
_VARIABLES = {"fixed": (), "planar": ("x", "y", "theta"),
              "floating": ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w")}
_XACRO = "{http://www.ros.org/wiki/xacro}", "{http://wiki.ros.org/xacro}", "{http://ros.org/wiki/xacro}"


@dataclass(frozen=True)
class Origin:
    """A pose: turned by roll, pitch and yaw about the fixed x, y and z axis, then shifted."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class Shape:
    """A collision geometry: "box" (its three sides), "cylinder" and "capsule" (radius, length), "sphere"
    (radius) or "mesh" (a file and its scale)."""

    kind: str
    sizes: Tuple[float, ...]
    origin: Origin
    file: str = ""


@dataclass(frozen=True)
class Joint:
    """One joint. A mimic joint follows `factor` times the joint `mimic`, plus `offset`. Angles are in rad.
    Limits of joints that have none are infinite. A planar joint moves in x and y and turns about z, whatever
    its axis says, as in MoveIt; a floating one moves and turns freely."""

    name: str
    kind: str
    parent: str
    child: str
    origin: Origin
    axis: Vector
    lower: float
    upper: float
    mimic: Optional[str] = None
    factor: float = 1.0
    offset: float = 0.0

    @property
    def variables(self) -> Tuple[str, ...]:
        """The names of its positions: its own, or NAME/x and so on as in MoveIt, where it has several."""
        return tuple(f"{self.name}/{part}" for part in _VARIABLES[self.kind]) \
            if self.kind in _VARIABLES else (self.name,)


@dataclass
class Model:
    """What a URDF file says."""

    file: str
    name: str
    links: Dict[str, List[Shape]] = field(default_factory=dict)
    joints: Dict[str, Joint] = field(default_factory=dict)  # parents before children


def parse(path: str) -> Element:
    """The element <robot> of a file of XML."""
    try:
        root = ElementTree.fromstring(_files.read(path))
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise SceneError(f"{path}: {error}; must be XML") from None
    if root.tag != "robot":
        raise SceneError(f"{path}: got the element <{root.tag}>, must be <robot>")
    for element in root.iter():
        if isinstance(element.tag, str) and element.tag.startswith(_XACRO):
            raise SceneError(f"{path}: got <xacro:{element.tag.partition('}')[2]}>, must be plain XML; expand "
                             f"it first: xacro {path} > robot.xml")
    return root


def _find_package(package: str, path: str) -> Optional[str]:
    """The folder of a package: one of that name above the file, or beside a folder above it, or one that
    ROS 2 has installed."""
    folder = os.path.dirname(os.path.abspath(path))
    while True:
        if os.path.basename(folder) == package:
            return folder
        if os.path.isdir(os.path.join(folder, package)):
            return os.path.join(folder, package)
        if folder == os.path.dirname(folder):
            break
        folder = os.path.dirname(folder)
    installed = (os.path.join(prefix, "share", package)
                 for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if prefix)
    return next((folder for folder in installed if os.path.isdir(folder)), None)


class _Reader:
    """Reads elements; errors name the file and the element."""

    def __init__(self, path: str, packages: Mapping[str, str]):
        self._path, self._packages = path, packages

    def fail(self, where: str, what: str) -> SceneError:
        return SceneError(f"{self._path}: {where}: {what}")

    def text(self, element: Element, name: str, where: str) -> str:
        value = element.get(name)
        if not value:
            raise self.fail(where, f"<{element.tag}> has no {name}=\"...\"")
        return value

    def numbers(self, element: Element, name: str, count: int, default: Optional[str],
                where: str) -> Tuple[float, ...]:
        text = element.get(name, default)
        try:
            values = tuple(float(word) for word in (text or "").split())
        except ValueError:
            values = ()
        if len(values) != count or not all(math.isfinite(value) for value in values):
            raise self.fail(where, f"{name}: got {text!r}, must be {count} finite "
                                   f"number{'s' if count > 1 else ''}")
        return values

    def origin(self, element: Element, where: str) -> Origin:
        found = element.find("origin")
        if found is None:
            return Origin()
        x, y, z = self.numbers(found, "xyz", 3, "0 0 0", where)
        roll, pitch, yaw = self.numbers(found, "rpy", 3, "0 0 0", where)
        return Origin((x, y, z), (roll, pitch, yaw))

    def shape(self, collision: Element, where: str) -> Shape:
        geometry = collision.find("geometry")
        if geometry is None or len(geometry) != 1:
            raise self.fail(where, "<collision> must have a <geometry> with one shape")
        shape, origin = geometry[0], self.origin(collision, where)
        named = {"box": [("size", 3)], "sphere": [("radius", 1)],
                 "cylinder": [("radius", 1), ("length", 1)], "capsule": [("radius", 1), ("length", 1)]}
        if shape.tag in named:
            sizes = [x for name, count in named[shape.tag]
                     for x in self.numbers(shape, name, count, None, where)]
            if min(sizes) <= 0:
                raise self.fail(where, f"<{shape.tag}>: got the size {min(sizes)!r}, must be > 0")
            return Shape(shape.tag, tuple(sizes), origin)
        if shape.tag != "mesh":
            raise self.fail(where, f"got the geometry <{shape.tag}>, must be one of box, sphere, "
                                   "cylinder, capsule, mesh")
        scale = self.numbers(shape, "scale", 3, "1 1 1", where)
        if 0 in scale:
            raise self.fail(where, f"<mesh>: got the scale {scale}, must not be 0")
        return Shape("mesh", scale, origin, self.file(self.text(shape, "filename", where), where))

    def file(self, name: str, where: str) -> str:
        """The path of package://PACKAGE/..., file://... or a name relative to the URDF's folder."""
        path = name[len("file://"):] if name.startswith("file://") else name
        if name.startswith("package://"):
            package, _, rest = name[len("package://"):].partition("/")
            folder = self._packages.get(package) or _find_package(package, self._path)
            if folder is None:
                raise self.fail(where, f"got package {package!r}, which is in no folder above the file and not "
                                       f"in AMENT_PREFIX_PATH; say where it is: packages={{{package!r}: "
                                       f"'FOLDER'}} or --package {package}=FOLDER")
            path = os.path.join(folder, rest)
        path = os.path.join(os.path.dirname(os.path.abspath(self._path)), path)
        if not os.path.isfile(path):
            raise self.fail(where, f"the mesh {path} is not there")
        if path.lower().endswith(".dae"):
            raise self.fail(where, f"the mesh {path} is COLLADA, which is not read; convert it, as by assimp "
                                   "export in.dae out.stl")
        return path

    def joint(self, element: Element) -> Joint:
        name = self.text(element, "name", "joint")
        where = f"joint {name!r}"
        kind = self.text(element, "type", where)
        if kind not in KINDS:
            raise self.fail(where, f"got the type {kind!r}, must be one of {', '.join(KINDS)}")
        ends = {}
        for tag in ("parent", "child"):
            found = element.find(tag)
            if found is None:
                raise self.fail(where, f"<{tag}> is missing")
            ends[tag] = self.text(found, "link", where)
        found = element.find("axis")
        x, y, z = (1.0, 0.0, 0.0) if found is None else self.numbers(found, "xyz", 3, None, where)
        if kind not in _VARIABLES and (x, y, z) == (0, 0, 0):
            raise self.fail(where, "got the axis 0 0 0, must be a direction")
        lower, upper = self.limits(element, kind, where)
        mimic, factor, offset = None if kind == "fixed" else element.find("mimic"), 1.0, 0.0
        if mimic is not None and kind in _VARIABLES:
            raise self.fail(where, f"a {kind} joint cannot follow another; leave out <mimic>")
        if mimic is not None:
            factor, = self.numbers(mimic, "multiplier", 1, "1", where)
            offset, = self.numbers(mimic, "offset", 1, "0", where)
        return Joint(name, kind, ends["parent"], ends["child"], self.origin(element, where), (x, y, z),
                     lower, upper, None if mimic is None else self.text(mimic, "joint", where), factor,
                     offset)

    def limits(self, element: Element, kind: str, where: str) -> Tuple[float, float]:
        if kind == "continuous" or kind in _VARIABLES:
            return -math.inf, math.inf
        found = element.find("limit")
        if found is None:
            raise self.fail(where, f"a {kind} joint must have a <limit>")
        lower, = self.numbers(found, "lower", 1, "0", where)
        upper, = self.numbers(found, "upper", 1, "0", where)
        if lower > upper:
            raise self.fail(where, f"got limits from {lower!r} to {upper!r}, must be in this order; swap lower "
                                   "and upper")
        return lower, upper


def read_urdf(path: str, packages: Mapping[str, str]) -> Model:
    """A robot: a tree of links."""
    reader, root = _Reader(path, packages), parse(path)
    model = Model(path, root.get("name", "robot"))
    for link in root.findall("link"):
        name = reader.text(link, "name", "link")
        if name in model.links:
            raise reader.fail(f"link {name!r}", "is there twice; names must be unique")
        model.links[name] = [reader.shape(shape, f"link {name!r}") for shape in link.findall("collision")]
    joints: Dict[str, Joint] = {}
    for element in root.findall("joint"):
        joint = reader.joint(element)
        if joint.name in joints:
            raise reader.fail(f"joint {joint.name!r}", "is there twice; names must be unique")
        joints[joint.name] = joint
    _check_tree(reader, model.links, joints)
    _order(reader, model, joints)
    return model


def _check_tree(reader: _Reader, links: Mapping[str, List[Shape]], joints: Mapping[str, Joint]) -> None:
    moved: Dict[str, str] = {}
    for joint in joints.values():
        where = f"joint {joint.name!r}"
        for link in (joint.parent, joint.child):
            if link not in links:
                raise reader.fail(where, f"got the link {link!r}, which is not there")
        if joint.child in moved:
            raise reader.fail(where, f"link {joint.child!r} is the child of {moved[joint.child]!r} already; "
                                     "links must form a tree")
        moved[joint.child] = joint.name
        _check_mimic(reader, joint, joints)


def _check_mimic(reader: _Reader, joint: Joint, joints: Mapping[str, Joint]) -> None:
    if joint.mimic is None:
        return
    where, followed = f"joint {joint.name!r}", joints.get(joint.mimic)
    if followed is None:
        raise reader.fail(where, f"got the mimic joint {joint.mimic!r}, which is not there")
    if followed is joint:
        raise reader.fail(where, "follows itself; leave out <mimic>")
    if followed.mimic is not None:
        raise reader.fail(where, f"got the mimic joint {joint.mimic!r}, which follows another itself; let it "
                                 f"follow {followed.mimic!r}, with the product of the multipliers")
    if followed.kind in ("planar", "floating"):
        raise reader.fail(where, f"got the mimic joint {joint.mimic!r}, which is {followed.kind}; must be one "
                                 "with one position")


def _order(reader: _Reader, model: Model, joints: Mapping[str, Joint]) -> None:
    """Puts the joints into the model, parents before children."""
    children = {joint.child for joint in joints.values()}
    roots = [link for link in model.links if link not in children]
    if len(roots) > 1:
        raise reader.fail(f"link {roots[1]!r}", f"is the child of no joint, as is {roots[0]!r}; join them, as by a "
                                                "fixed joint, so that there is one root")
    placed: Set[str] = set(roots)
    waiting = dict(joints)
    while waiting:
        ready = [joint for joint in waiting.values() if joint.parent in placed]
        if not ready:
            raise reader.fail(f"joint {next(iter(waiting))!r}", "is in a loop; links must form a tree")
        for joint in ready:
            placed.add(joint.child)
            model.joints[joint.name] = waiting.pop(joint.name)

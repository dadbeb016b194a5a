# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: MIT

"""Robots from URDF: motions of all joints as scenes.

    from impinge import robot
    arm = robot.load("arm.urdf", srdf="arm.srdf")
    scene = arm.scene([0, 1], [[0, 0, 0], [1, 0.5, 0]], world="table.yaml")
    print(scene.solve(), scene.each(required=0.002)[0])

Every link is a body of its name; one without a collision geometry is a frame, which touches nothing.
Bodies are surfaces: what is inside of another body from the start on touches nothing. Lengths are in m,
angles in rad, as URDF has them."""

import os
import weakref
from typing import Any, Dict, Iterable, List, Mapping, Optional, Sequence, Set, Tuple, Union

from .. import _document as document
from .. import _values as values
from .._assembly import Stage, Template, share
from ..errors import SceneError, UsageError
from ..scene import Scene
from ._check import Limits, LinkPair, Links, check_pair
from ._course import Course, Following, maps_of_hinge, maps_of_joint
from ._moveit import Matrix, World, read_world
from ._positions import Positions, Variables
from ._shapes import Pose, pose_of, surface_at
from ._srdf import Semantics, read_srdf
from ._urdf import Joint, Model, Shape, read_urdf

__all__ = ["Joint", "LinkPair", "Matrix", "Robot", "Shape", "World", "load"]

AnyWorld = Union[values.Path, World, Sequence[Mapping[str, Any]]]
Pairs = Iterable[Tuple[str, str]]

_NOTHING = World()


class Robot:
    """A robot that `load` read. `links` are the names of all links, `joints` those joints that move by
    themselves, parents before children; `variables` names their positions, in the order in which `scene`
    takes them: one for each joint, but for planar and floating ones. `groups` are the joints of each group
    of the SRDF file, `states` its named states, as "NAME" and as "GROUP/NAME". Any number of threads may
    make scenes of one robot at once."""

    def __init__(self, model: Model, semantics: Semantics):
        self._model, self._semantics, self._variables = model, semantics, Variables(model)
        self.name = model.name
        self.links: Tuple[str, ...] = tuple(model.links)
        self.joints: Tuple[Joint, ...] = self._variables.joints
        self.variables: Tuple[str, ...] = self._variables.names
        self.groups: Dict[str, Tuple[str, ...]] = dict(semantics.groups)
        self.states: Dict[str, Dict[str, float]] = self._states()
        self._joint_of = {joint.child: joint for joint in model.joints.values()}
        if not any(model.links.values()):
            raise SceneError(f"{model.file}: no link has a <collision>; there is nothing to test")
        self._frames = self._frames_at_rest()
        self._surfaces = {link: [surface_at(shape, self._frames[link]) for shape in shapes]
                          for link, shapes in model.links.items()}
        self._process = 0  # the one that has the surfaces
        self._templates: "weakref.WeakKeyDictionary[World, Template]" = weakref.WeakKeyDictionary()
        self._joined = {pair for link in model.links for pair in self._pair_above(link)}

    def __repr__(self) -> str:
        return f"Robot({self.name!r}, {len(self.links)} links, {len(self.joints)} joints)"

    def scene(self, times: Any, positions: Positions, *, velocities: Optional[Positions] = None,
              accelerations: Optional[Positions] = None, interpolation: str = "splines",
              world: Optional[AnyWorld] = None, allowed: Optional[Pairs] = None,
              errors: Optional[Tuple[float, float]] = None) -> Scene:
        """The motion through `positions` at `times` (two or more, increasing): rows of one number for each
        of `variables`, or a dict from names to columns (or one number, for what rests); what is not named
        stays at 0, or at the nearest limit. "splines" is what joint_trajectory_controller does by default:
        linear between positions, cubic with `velocities`, quintic with `accelerations` too. "linear" and
        "cubic" (a smooth curve through the positions) do without them.

        `world` is the path of a planning scene, what `world` made of one, or bodies as of scene files, each
        with a name; one whose "parent" is a link moves with it. Others are not tested with each other. Links
        that a joint connects are never tested with each other; nor are the pairs `allowed`, which are those
        of the planning scene's matrix if it has one, else those that the SRDF file disables.

        With `errors`, an angle and a length, each joint that turns may be off by that angle either way at all
        times, and each that slides by that length: the scene's parameters are these errors, "JOINT.error", so
        that `solve` and `clearance` answer for all of them at once."""
        self._share()
        template = self._template(world, allowed)
        ranges = {} if errors is None else self._errors(errors)
        courses = self._variables.courses(times, positions, velocities, accelerations, interpolation)
        at = next(iter(courses.values())).times if courses else values.array("times", times)
        head: document.Document = {"time": [float(at[0]), float(at[-1])]}
        if ranges:
            head["parameters"] = {name: list(ends) for name, ends in ranges.items()}
        return template.scene(head, self._maps(courses, ranges), self.name or "robot")

    def world(self, path: values.Path) -> World:
        """The bodies and the allowed collision matrix of a planning scene of MoveIt, in YAML: primitives and
        meshes. It may be used for many scenes."""
        root = next(link for link in self.links if link not in self._joint_of)
        return read_world(values.path("path", path), {"world", root} | self._semantics.frames)

    def state(self, name: str) -> Dict[str, float]:
        """The positions of a named state of the SRDF file."""
        if name not in self.states:
            raise values.refuse("state", name, f"one of {', '.join(sorted(self.states)) or 'none'}")
        return dict(self.states[name])

    # --- All positions ----------------------------------------------------------------------------

    def check_pair(self, a: str, b: str, *, gamma: Optional[float] = None,
                   max_seconds: float = 10) -> LinkPair:
        """Do two links ever touch, over all positions of the joints between them? A search ends as
        undecided after `max_seconds`. Links are surfaces: one inside of another touches nothing."""
        for link in (a, b):
            if link not in self.links:
                raise values.refuse("link", link, f"one of {', '.join(self.links)}")
        self._share()
        disabled = self._semantics.disabled
        reason = disabled.get((a, b), disabled.get((b, a)))
        return check_pair(Links(self._model, self._frames, self._surfaces), (a, b), reason,
                          Limits(gamma, max_seconds))

    def matrix(self, all: bool = False) -> List[Tuple[str, str]]:
        """The pairs of links that the SRDF file disables, or all pairs; without frames."""
        solid = [link for link in self.links if self._model.links[link]]
        pairs = ((a, b) for k, a in enumerate(solid) for b in solid[k + 1:]) if all else \
            (pair for pair in self._semantics.disabled if set(pair) <= set(solid) and pair[0] != pair[1])
        return list(pairs)

    def check_matrix(self, *, all: bool = False, gamma: Optional[float] = None,
                     max_seconds: float = 10) -> List[LinkPair]:
        """Checks each pair of links that the SRDF file disables, or all pairs, over all positions of the
        joints between the two. `max_seconds` is for each pair."""
        return [self.check_pair(a, b, gamma=gamma, max_seconds=max_seconds) for a, b in self.matrix(all)]

    @property
    def rest(self) -> Dict[str, float]:
        """The positions of which nothing is said: 0, or the nearest limit."""
        return {name: self._variables.rest(name) for name in self.variables}

    def own_positions(self, named: Mapping[str, float], where: str = "positions"
                      ) -> Tuple[Dict[str, float], List[str]]:
        """Of positions by name, as others write them, those that `scene` takes: without fixed joints and
        joints that follow others, which must agree with them. The second is what was left out that is not
        0, in words."""
        return self._variables.own(named, where)

    # --- Bodies -----------------------------------------------------------------------------------

    def _share(self) -> None:
        """Reads the meshes once for all scenes; once more in a copy of the process."""
        if self._process != os.getpid():
            for link, surfaces in self._surfaces.items():
                try:
                    share(surfaces)
                except SceneError as error:
                    raise SceneError(f"{self._model.file}: link {link!r}: {error}") from None
            self._process = os.getpid()

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_process": 0, "_templates": None}

    def __setstate__(self, state: Dict[str, Any]) -> None:
        self.__dict__.update(state, _templates=weakref.WeakKeyDictionary())

    def _states(self) -> Dict[str, Dict[str, float]]:
        found: Dict[str, Dict[str, float]] = {}
        names = [name for _, name in self._semantics.states]
        for (group, name), state in self._semantics.states.items():
            own, _ = self._variables.own(state, f"group_state {name!r}")
            found[f"{group}/{name}"] = own
            if names.count(name) == 1:
                found[name] = own
        return found

    def _frames_at_rest(self) -> Dict[str, Pose]:
        """The pose of each link where all joints are at 0."""
        frames = {link: Pose() for link in self.links}
        for joint in self._model.joints.values():  # parents before children
            frames[joint.child] = pose_of(joint.origin).then(frames[joint.parent])
        return frames

    def _errors(self, errors: Tuple[float, float]) -> Dict[str, Tuple[float, float]]:
        """The ranges of the errors of joints that move by themselves."""
        sizes = values.array("errors", errors)
        if sizes.shape != (2,) or not ((sizes >= 0) & (sizes < float("inf"))).all():
            raise values.refuse("errors", errors, "an angle and a length, neither negative")
        ranges: Dict[str, Tuple[float, float]] = {}
        for joint in self.joints:
            if joint.kind in ("planar", "floating"):
                raise UsageError(f"errors: joint {joint.name!r} is {joint.kind}; they are known of joints that turn "
                                 "or slide")
            size = float(sizes[1 if joint.kind == "prismatic" else 0])
            if size > 0:
                ranges[f"{joint.name}.error"] = (-size, size)
        return ranges

    def _error_maps(self, joint: Joint, ranges: Mapping[str, Tuple[float, float]]) -> List[Stage]:
        """The map by which a joint is off; one that follows another is off as that is."""
        name = f"{joint.mimic or joint.name}.error"
        if name not in ranges:
            return []
        factor = 1.0 if joint.mimic is None else joint.factor
        return maps_of_hinge(joint, self._frames[joint.child], Following(name, factor))

    def _maps(self, courses: Mapping[str, Course], ranges: Mapping[str, Tuple[float, float]]
              ) -> Dict[int, List[Stage]]:
        """The maps of links that joints move, by their numbers."""
        made = {}
        for k, link in enumerate(self.links):
            joint = self._joint_of.get(link)
            if joint is not None and joint.kind != "fixed":
                maps = [*maps_of_joint(joint, self._frames[link], courses), *self._error_maps(joint, ranges)]
                if maps:
                    made[k] = maps
        return made

    def _body(self, link: str) -> Dict[str, Any]:
        """A link without the maps of its joint."""
        body: Dict[str, Any] = {"name": link, "surfaces": self._surfaces[link]}
        if link in self._joint_of:
            body["parent"] = self._joint_of[link].parent
        return body

    def _template(self, world: Optional[AnyWorld], allowed: Optional[Pairs]) -> Template:
        """What all scenes in a world have in common, kept as long as a World whose parts nobody changes."""
        around = _NOTHING if world is None else self._around(world)
        made = self._templates.get(around) if allowed is None else None
        if made is not None:
            return made
        bodies: List[Mapping[str, Any]] = [self._body(link) for link in self.links]
        group = self._free_name(around)
        for body in around.bodies:
            bodies.append(self._attached(body) if "parent" in body else {**body, "group": [group]})
        ignored = self._joined | self._allowed(around, allowed) | set(around.touching)
        ignore = [list(pair) for pair in sorted(ignored)]
        if any("parent" not in body for body in around.bodies):
            ignore.append([group, group])
        made = Template(bodies, ignore)
        if allowed is None:
            self._templates[around] = made
        return made

    def _attached(self, body: Mapping[str, Any]) -> Mapping[str, Any]:
        """A body in the frame of its parent; a link, whose maps begin where it rests, or another body."""
        frame = self._frames.get(body["parent"])
        return body if frame is None else {**body, "maps": [*body.get("maps", ()), *frame.maps()]}

    def _pair_above(self, link: str) -> List[Tuple[str, str]]:
        """The link and the nearest one above that is no frame; [] where there is none."""
        joint = self._joint_of.get(link) if self._model.links[link] else None
        while joint is not None and not self._model.links[joint.parent]:
            joint = self._joint_of.get(joint.parent)
        return [] if joint is None else [(link, joint.parent)]

    # --- What is around -----------------------------------------------------------------------------

    def _around(self, world: AnyWorld) -> World:
        if isinstance(world, World) and world in self._templates:  # its names are checked
            return world
        if isinstance(world, (str, os.PathLike)):
            world = self.world(world)
        around = world if isinstance(world, World) else World(list(world))
        names: Set[str] = set(self.links)
        for body in around.bodies:
            if not isinstance(body, Mapping) or not isinstance(body.get("name"), str):
                raise values.refuse("world", body, "bodies as of scene files, each with a name")
            if body["name"] in names:
                raise UsageError(f"world: got the name {body['name']!r} twice, must be one that no link and no other "
                                 "body has")
            names.add(body["name"])
        return around

    def _free_name(self, around: World) -> str:
        """A name for the group of all bodies that are tested with links only."""
        names = {*self.links, *(body["name"] for body in around.bodies)}
        group = "around"
        while group in names:
            group += "_"
        return group

    def _allowed(self, around: World, allowed: Optional[Pairs]) -> Set[Tuple[str, str]]:
        names = {*self.links, *(body["name"] for body in around.bodies)}
        if allowed is None:
            pairs = self._semantics.disabled if around.allowed is None else around.allowed.pairs(sorted(names))
            return {(a, b) for a, b in pairs if a != b}
        found = set()
        for pair in allowed:
            if isinstance(pair, str) or len(tuple(pair)) != 2 or not names.issuperset(pair):
                raise values.refuse("allowed", pair, "a pair of names of links, or of bodies of the world")
            a, b = pair
            found.add((a, b))
        return found


def load(urdf: values.Path, srdf: Optional[values.Path] = None,
         packages: Optional[Mapping[str, str]] = None) -> Robot:
    """The robot of a URDF file. `packages` tells where the packages of its meshes are; without, folders
    above the file are searched. The pairs of links that the SRDF file disables are never tested with each
    other, nor are links that a joint connects."""
    model = read_urdf(values.path("urdf", urdf), dict(packages or {}))
    return Robot(model, Semantics() if srdf is None else read_srdf(values.path("srdf", srdf), model))

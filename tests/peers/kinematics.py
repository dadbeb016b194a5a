# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Robots and planning scenes for peers: read and moved by NumPy, from the formats' specifications, with
nothing of Impinge in it."""

import pathlib
import xml.etree.ElementTree as xml

import numpy
import yaml


def turned(axis, angle):
    """Rodrigues' formula."""
    x, y, z = numpy.array(axis, float) / numpy.linalg.norm(axis)
    k = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    matrix = numpy.eye(4)
    matrix[:3, :3] += numpy.sin(angle) * k + (1 - numpy.cos(angle)) * (k @ k)
    return matrix


def shifted(xyz):
    matrix = numpy.eye(4)
    matrix[:3, 3] = xyz
    return matrix


def numbers(text):
    return [float(word) for word in text.split()]


def origin_of(element):
    found = element.find("origin")
    if found is None:
        return numpy.eye(4)
    r, p, y = numbers(found.get("rpy", "0 0 0"))
    return shifted(numbers(found.get("xyz", "0 0 0"))) @ turned([0, 0, 1], y) @ turned([0, 1, 0], p) @ turned(
        [1, 0, 0], r)


def pose_of(position, orientation):
    x, y, z, w = numpy.array(orientation) / numpy.linalg.norm(orientation)
    matrix = shifted(position)
    matrix[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return matrix


def mesh_text(path, scale):
    """A mesh as the sampler reads it; polygons are fans of triangles."""
    if path.suffix.lower() == ".stl":
        data = path.read_bytes()
        count = int(numpy.frombuffer(data, "<u4", 1, 80)[0])
        assert len(data) == 84 + 50 * count, f"{path} is not binary"
        rows = numpy.frombuffer(data, numpy.dtype([("x", "<f4", (4, 3)), ("rest", "<u2")]), count, 84)
        points = rows["x"][:, 1:].reshape(-1, 3).astype(float)
        triangles = numpy.arange(3 * count).reshape(-1, 3)
    else:
        lines = [line.split() for line in path.read_text().splitlines()]
        points = numpy.array([line[1:4] for line in lines if line[:1] == ["v"]], float)
        faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in lines if line[:1] == ["f"]]
        triangles = numpy.array([[f[0], f[k], f[k + 1]] for f in faces for k in range(1, len(f) - 1)])
    body = [" ".join(map(repr, row)) for row in (points * scale).tolist() + triangles.tolist()]
    return "\n".join([f"mesh {len(points)} {len(triangles)}", *body])


class Robot:
    """Shapes as the sampler reads them, each with its link and its pose in it; and joints."""

    def __init__(self, urdf):
        self.root, self.folder = xml.parse(urdf).getroot(), pathlib.Path(urdf).parent
        self.joints = self.root.findall("joint")
        self.shapes = [(link.get("name"), origin_of(one), self.shape(one.find("geometry")[0]))
                       for link in self.root.findall("link") for one in link.findall("collision")]
        moved = {joint.find("child").get("link"): joint for joint in self.joints}
        self.above = {link: joint.find("parent").get("link") for link, joint in moved.items()}
        self.moved = moved

    def shape(self, one):
        if one.tag == "mesh":
            path = self.folder / one.get("filename").replace("package://", "")
            return mesh_text(path, numbers(one.get("scale", "1 1 1")))
        names = {"box": ["size"], "sphere": ["radius"]}.get(one.tag, ["radius", "length"])
        return " ".join([one.tag, *(one.get(name) for name in names)])

    def frames(self, q):
        """The poses of all links at positions by name; joints of which nothing is said are at 0."""
        poses = {}

        def pose(link):
            if link not in self.moved:
                return numpy.eye(4)
            if link not in poses:
                joint = self.moved[link]
                kind, axis = joint.get("type"), joint.find("axis")
                axis = [1, 0, 0] if axis is None else numbers(axis.get("xyz"))
                mimic, name = joint.find("mimic"), joint.get("name")
                angle = q.get(name, 0)
                if mimic is not None and kind != "fixed":
                    angle = float(mimic.get("multiplier", 1)) * q.get(mimic.get("joint"), 0) + float(
                        mimic.get("offset", 0))
                own = numpy.eye(4)
                if kind in ("revolute", "continuous"):
                    own = turned(axis, angle)
                elif kind == "prismatic":
                    own = shifted(angle * numpy.array(axis) / numpy.linalg.norm(axis))
                poses[link] = pose(self.above[link]) @ origin_of(joint) @ own
            return poses[link]

        return {link.get("name"): pose(link.get("name")) for link in self.root.findall("link")}

    def joined(self):
        """Pairs of links with shapes that only links without shapes part."""
        solid, pairs = {link for link, _, _ in self.shapes}, set()
        for link in solid:
            above = self.above.get(link)
            while above is not None and above not in solid:
                above = self.above.get(above)
            pairs |= {frozenset((link, above))} if above is not None else set()
        return pairs


def world_of(path):
    """Shapes of a planning scene, with their names and poses; and the pairs that its matrix allows."""
    scene, shapes = yaml.load(pathlib.Path(path).read_text(), Loader=yaml.CSafeLoader), []
    for one in scene["world"].get("collision_objects", []):
        outer = pose_of(one["pose"]["position"], one["pose"]["orientation"]) if "pose" in one else numpy.eye(4)
        for primitive, pose in zip(one["primitives"], one["primitive_poses"]):
            sizes = primitive["dimensions"]
            sizes = sizes[::-1] if primitive["type"] == "cylinder" else sizes
            shapes.append((one["id"], outer @ pose_of(pose["position"], pose["orientation"]),
                           " ".join(map(str, [primitive["type"], *sizes]))))
    matrix = scene.get("allowed_collision_matrix", {})
    names = matrix.get("entry_names", [])
    allowed = {frozenset((a, b)) for a, row in zip(names, matrix.get("entry_values", []))
               for b, may in zip(names, row) if may}
    return shapes, allowed

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Every public call with every argument wrong: an error that names the argument, or an answer; never a
crash, a value that wraps, or words of ctypes."""

import inspect
import itertools
import threading

import impinge
import numpy
import pytest

from support import ARM, crowd, endless, flying

masked = numpy.ma.masked_array([1.0, 2.0, 3.0], mask=[False, True, False])


class Unfriendly:
    """Answers every question of Python wrongly."""

    def __repr__(self):
        raise RuntimeError("no text")

    def __float__(self):
        return "no number"

    def __index__(self):
        return "no index"


circle: list = []
circle.append(circle)

HOSTILE = [
    None, True, -1, 0, 7, 2**31, 2**63, 2**64 - 1, 2**64, 10**400, 0.5, -0.5, 1e308, -1e308, 5e-324,
    float("nan"), float("inf"), -float("inf"), 1j, "x", "", "sphere", "a\0b", "\ud800", "x" * 70000,
    b"x", bytearray(8), [], [1], [1, 2], (0, 1), [1, 2, 3], (1, 0), [[1, 2], [3]], ["a", 1],
    [float("nan")] * 3, {}, {"a": 1}, {1: 2}, {"a": "b"}, {"a\0": 1}, object(), object, print,
    Unfriendly(), circle, masked, masked[1], numpy.array(1 + 2j), numpy.array([1j, 2, 3]),
    numpy.array(["a", "b"]), numpy.array([None, None]), numpy.zeros((0, 3)), numpy.zeros((2, 2)),
    numpy.float32(0.5), numpy.int64(-1), numpy.array(2.0), numpy.longdouble(1), numpy.datetime64("now"),
    [2**64, 1, 1], ("sphere", {}), [("translate", {"velocity": "x"})], flying().body("other"), flying(),
]

# Arguments that make each call succeed.
scene = crowd()
CALLS = {
    "Scene": (impinge.Scene, {"path": ARM}),
    "from_file": (impinge.Scene.from_file, {"path": ARM}),
    "from_json": (impinge.Scene.from_json, {"text": '{"bodies": [{"surfaces": [{"type": "sphere"}]}]}'}),
    "from_pair": (impinge.Scene.from_pair, {"a": "sphere", "b": "sphere center=3,0,0"}),
    "eval": (scene.eval, {"body": "wall", "surface": 0, "points": [[0.5, 0.5, 0]]}),
    "solve": (scene.solve, {}),
    "solve_each": (scene.solve_each, {}),
    "refine": (scene.refine, {"gammas": [1e-3, 1e-6]}),
    "clearance": (scene.clearance, {}),
    "each": (scene.each, {}),
    "profile": (scene.profile, {"slices": 3}),
    "mesh": (scene.mesh, {"body": "wall"}),
    "batch": (impinge.batch, {"scenes": [scene]}),
    "Builder": (impinge.Builder, {}),
    "Builder.body": (lambda **given: flying().body(**given), {}),
    "Builder.ignore": (lambda **given: flying().ignore(**given), {"x": "left", "y": "right"}),
    "Body.surface": (lambda **given: flying().body("new").surface(**given), {"type": "sphere"}),
    "Body.map": (lambda **given: flying().body("new").map(**given), {"type": "rotate", "rate": 1}),
}
NAMES = {"Builder.body": ["name", "parent", "group"], "Builder.ignore": ["x", "y"],
         "Body.surface": ["type", "maps", "radius", "center", "label"], "Body.map": ["type", "axis", "rate"]}
GUARDED = (impinge.ImpingeError, TypeError, MemoryError)


def names_of(call: str) -> list:
    return NAMES.get(call) or list(inspect.signature(CALLS[call][0]).parameters)


def run(function, given: dict) -> None:
    answer = function(**given)
    if inspect.isgenerator(answer):
        list(itertools.islice(answer, 3))


@pytest.mark.parametrize("call,name", [(call, name) for call in CALLS for name in names_of(call)])
def test_wrong_arguments_are_refused_by_name(call, name):
    function, good = CALLS[call]
    run(function, good)
    for value in HOSTILE:
        if name == "slices" and isinstance(value, int) and value > 1000000:
            value = 2**64 + value % 7
        try:
            run(function, {**good, "max_pairs": 1000, name: value} if "max_pairs" in names_of(call)
                else {**good, name: value})
        except GUARDED as error:
            text = str(error)
            assert text and "ctypes" not in text and "argument 1" not in text, text
            assert "0x7f" not in text or len(text) < 300, text


@pytest.mark.parametrize("name,value,found", [
    ("max_pairs", -1, "-1"), ("max_pairs", 2**64, "18446744073709551616"), ("max_pairs", 1.5, "1.5"),
    ("max_bytes", -1, "-1"), ("max_bytes", True, "True"), ("max_seconds", "x", "'x'"),
    ("max_seconds", -1, "-1"), ("gamma", 1j, "1j"), ("gamma", masked, "masked_array"),
    ("gamma", float("nan"), "nan"), ("gamma", True, "True"), ("gamma_clear", "x", "'x'"),
    ("time", (0, 1, 2), r"\(0, 1, 2\)"), ("time", "01", "'0'"), ("time", (0, None), "None"),
    ("time", 3, "3"), ("audit", 1, "1"), ("progress", 3, "3")])
def test_options_of_the_wrong_kind_are_named(name, value, found):
    with pytest.raises(impinge.UsageError, match=f"^{name}.*{found}"):
        crowd().solve(**{name: value})


def test_budgets_do_not_wrap():
    assert crowd().solve(max_pairs=2**64 - 1, max_bytes=2**64 - 1).verdict == "contact"
    for wrong in (0, -1, 1025, 2**64, 1.5):
        with pytest.raises(impinge.UsageError, match="^threads: got .*from [01] to 1024"):
            crowd().each(threads=wrong)


@pytest.mark.parametrize("given,message", [
    ({"center": masked}, "center: got a masked array"),
    ({"center": [1, 2j, 3]}, "center: got .* an array of complex128, must be numbers"),
    ({"center": [1, 2, None]}, "center: got .* an array of object"),
    ({"center": [[1], [2, 3]]}, "center: got .*must be numbers in rows of equal length"),
    ({"radius": 1j}, "radius: got .* an array of complex128"),
    ({"radius": "a\0b"}, "radius: got .*without NUL"),
    ({"a\0b": 1}, "name of a parameter: got 'a.x00b', must be a text without NUL"),
    ({"constants": {1: 2}}, "constants: a key: got 1, must be a text"),
    ({"constants": {"a": "b"}}, "constants: a: got 'b', must be a number")])
def test_parameters_are_taken_whole_or_refused(given, message):
    with pytest.raises(impinge.UsageError, match=message):
        impinge.Builder().body("pot").surface("sphere", **given)


def test_names_are_not_cut():
    with pytest.raises(impinge.UsageError, match="name: got 'a.x00b', must be a text without NUL"):
        impinge.Builder().body("a\0b")
    with pytest.raises(impinge.UsageError, match="can be written as UTF-8"):
        impinge.Builder().body("\ud800")


def test_points_have_three_columns():
    scene = crowd()
    for wrong in ([[0, 0], [0, 0], [0, 0]], numpy.zeros((3, 2)), numpy.zeros((1, 2, 3)), 5, [1, 2]):
        with pytest.raises(impinge.UsageError, match=r"points: .*rows of \(u, v, t\)"):
            scene.eval("wall", 0, wrong)
    assert scene.eval("wall", 0, [0, 0, 0]).shape == (1, 3)
    assert scene.eval("wall", 0, numpy.zeros((0, 3))).shape == (0, 3)
    for wrong in (1, -1, 2**64, "0"):
        with pytest.raises(impinge.UsageError, match="^surface: got"):
            scene.eval("wall", wrong, [[0, 0, 0]])


def test_points_beyond_a_domain_are_named():
    scene = impinge.Scene.from_pair("bezier degree=1,1 points=[[0,0,0],[0,1,0],[1,0,0],[1,1,0]]", "sphere")
    with pytest.raises(impinge.ImpingeError) as caught:
        scene.eval("a", 0, [[5, 0, 0]])
    assert "imp_" not in str(caught.value)
    assert "got (u, v, t) = (5, 0, 0), must be in its domain, u in [0, 1], v in" in str(caught.value)


def test_objects_without_a_beginning_are_errors():
    for kind in (impinge.Scene, impinge.Builder, impinge.Body):
        empty = kind.__new__(kind)
        for name, member in inspect.getmembers(kind, inspect.isfunction):
            if name in ("solve", "clearance", "each", "build", "to_json", "__copy__"):
                if name != "__copy__":
                    with pytest.raises(AttributeError):
                        member(empty)
    with pytest.raises(AttributeError):
        impinge.Body(None, 0, "x").map("rotate")
    with pytest.raises(impinge.ImpingeError, match="body"):
        impinge.Body(flying(), 99, "x").map("rotate")
    with pytest.raises(impinge.UsageError, match="parent: got .*must be a Body of this Builder"):
        flying().body("x", parent=flying().body("y"))


def test_a_builder_is_safe_among_threads():
    builder = impinge.Builder()

    def add(k: int):
        for i in range(50):
            builder.body(f"{k} {i}").surface("sphere", center=[3 * i, 3 * k, 0])

    threads = [threading.Thread(target=add, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    built = builder.build()
    assert len(built.bodies) == 200
    assert impinge.Scene.from_json(built.to_json()).bodies == built.bodies


def test_an_iterator_that_is_dropped_leaves_its_scene_usable():
    scene = crowd()
    for _ in range(3):
        next(scene.solve_each())
        scene.solve_each()
        scene.refine([1e-3])
    assert scene.solve().verdict == "contact"


def test_a_sink_may_ask_the_scene_it_is_told_about():
    scene, seen = endless(), []

    def sink(progress):
        seen.append(scene.solve(gamma=1e-9, max_pairs=100).pairs)
        return len(seen) < 2

    assert scene.solve(gamma=1e-9, progress=sink).reason == "cancelled"
    assert all(pairs >= 100 for pairs in seen)

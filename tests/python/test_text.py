# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Scenes as text, copied, pickled, and in other processes."""

import copy
import json
import multiprocessing
import os
import pathlib
import pickle
import signal
import threading

import impinge
import numpy
import pytest

from support import ARM, SOURCE, crowd, endless, flying

SOLVABLE = [SOURCE / "tools" / "data" / name for name in ("arm.json", "blade.json", "pebble.json")]


def answer(scene: impinge.Scene) -> tuple:
    """All of a result that does not depend on the clock."""
    result = scene.solve(max_pairs=2000)
    return (result.verdict, result.t, result.t_lower, result.gap, result.a, result.b, result.normal,
            result.pairs, result.gamma, result.gamma_clear, result.t_start, result.t_end)


def test_a_path_makes_a_scene(tmp_path):
    assert impinge.Scene(ARM).bodies == impinge.Scene.from_file(str(ARM)).bodies
    assert "link5" in impinge.Scene(str(ARM)).bodies
    with pytest.raises(impinge.FileError, match="nowhere.json: cannot be read: No such file") as caught:
        impinge.Scene("nowhere.json")
    assert caught.value.errno == 2
    with pytest.raises(impinge.FileError, match="Is a directory"):
        impinge.Scene(tmp_path)
    for wrong in (5, None, b"", "", "a\0b", 1.5, object()):
        with pytest.raises(impinge.UsageError, match="^path: got .*must be a path"):
            impinge.Scene(wrong)


@pytest.mark.parametrize("path", SOLVABLE, ids=lambda path: path.name)
def test_the_text_of_a_file_s_scene_makes_the_same_scene_anywhere(path, tmp_path, monkeypatch):
    scene = impinge.Scene(path)
    monkeypatch.chdir(tmp_path)
    assert answer(impinge.Scene.from_json(scene.to_json())) == answer(scene)
    scene.save("copy.json")
    assert answer(impinge.Scene(tmp_path / "copy.json")) == answer(scene)
    assert json.loads((tmp_path / "copy.json").read_text()) == json.loads(scene.to_json())
    assert "\n" not in scene.to_json()


def test_the_text_of_a_pair_names_files_from_where_it_was_made(tmp_path, monkeypatch):
    (tmp_path / "made").mkdir()
    (tmp_path / "made" / "a.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    monkeypatch.chdir(tmp_path / "made")
    scene = impinge.Scene.from_pair("mesh file=a.off ! rotate rate=2", "sphere center=0,0,3")
    monkeypatch.chdir(tmp_path)
    text = scene.to_json()
    assert str(tmp_path / "made" / "a.off") in text
    assert answer(impinge.Scene.from_json(text)) == answer(scene)


def test_relative_files_of_a_text_begin_at_the_folder_of_its_name(tmp_path, monkeypatch):
    (tmp_path / "a.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
    text = ('{"define": {"shape": [{"type": "mesh", "file": "a.off"}]},'
            ' "bodies": [{"surfaces": ["shape"]}]}')
    scene = impinge.Scene.from_json(text, name=str(tmp_path / "scene.json"))
    monkeypatch.chdir("/")
    assert json.loads(scene.to_json())["define"]["shape"][0]["file"] == str(tmp_path / "a.off")
    assert json.loads(pickle.loads(pickle.dumps(scene)).to_json()) == json.loads(scene.to_json())


def test_arrays_of_numpy_begin_at_the_folder_of_the_text(tmp_path, monkeypatch):
    points = numpy.eye(4, 3)
    numpy.save(tmp_path / "points.npy", points)
    numpy.savez(tmp_path / "nets.npz", other=numpy.ones(3), points=points)
    answers = []
    for points in ('{"file": "points.npy"}', '{"file": "nets.npz", "array": "points"}'):
        (tmp_path / "scene.json").write_text(
            '{"bodies": [{"surfaces": [{"type": "bezier", "degree": [1, 1], "points": ' + points + '}]},'
            ' {"surfaces": [{"type": "sphere", "center": [3, 0, 0]}]}]}')
        scene = impinge.Scene.from_file(tmp_path / "scene.json")
        monkeypatch.chdir("/")
        answers.append(answer(scene))
        assert answer(impinge.Scene.from_json(scene.to_json())) == answers[0]
        assert answer(pickle.loads(pickle.dumps(scene))) == answers[0]
    assert answers[0] == answers[1]


def test_compressed_arrays_of_numpy_are_read_or_refused_with_the_cure(tmp_path):
    points = numpy.random.default_rng(7).random((3000, 3))
    points[:, 2] = numpy.round(points[:, 2])
    numpy.savez_compressed(tmp_path / "nets.npz", points=points)
    mesh = {"type": "mesh", "faces": [[0, 1, 2], [7, 2000, 2999]]}
    sphere = {"surfaces": [{"type": "sphere", "radius": 0.01, "center": [2, 2, 2]}]}

    def scene(given) -> impinge.Scene:
        body = {"surfaces": [{**mesh, "points": given}]}
        return impinge.Scene.from_json(json.dumps({"bodies": [body, sphere]}))

    packed = {"file": str(tmp_path / "nets.npz"), "array": "points"}
    try:
        assert answer(scene(packed)) == answer(scene(points.tolist()))
    except impinge.SceneError as error:
        assert "write it by numpy.savez" in str(error)


def everything(builder: impinge.Builder, offs: str) -> impinge.Scene:
    """A scene of all that a builder takes."""
    angle = numpy.float64(0.1) + 0.2  # no short decimal number
    arm = builder.body("arm", group=["robot", "metal"])
    arm.surface("sphere", radius=numpy.float32(0.5), center=(-0.0, angle, 1))
    arm.map("rotate", axis=[0, 0, 1], rate=angle)
    hand = builder.body(parent=arm, group="robot")
    hand.surface("bezier", degree=[3, 3], points=numpy.random.default_rng(5).random((16, 3)),
                 maps=[("translate", {"velocity": [0, 0, angle]})])
    builder.body("text").surface("formula", x="u*c", y="v", z="3", domain=[[0, 1], [0, 1]],
                                 constants={"c": angle}).surface("mesh", file=pathlib.Path(offs))
    builder.ignore("robot", "robot")
    return builder.build()


def test_the_text_of_a_built_scene_makes_the_same_scene(tmp_path, monkeypatch):
    (tmp_path / "a.off").write_text("OFF\n3 1 0\n0 0 9\n1 0 9\n0 1 9\n3 0 1 2\n")
    monkeypatch.chdir(tmp_path)
    builder = impinge.Builder(time=(-1, 0.1), gamma=1e-7, gamma_clear=1e-9)
    scene = everything(builder, "a.off")
    monkeypatch.chdir("/")
    again = impinge.Scene.from_json(scene.to_json())
    assert again.bodies == scene.bodies == ("arm", "body1", "text")
    assert answer(again) == answer(scene)
    assert again.to_json() == scene.to_json()
    assert scene.clearance() == again.clearance()
    assert "-0.0" in scene.to_json() and '"radius":0.5,' in scene.to_json()


def test_a_document_does_not_change_with_the_arrays_it_was_made_of():
    points = numpy.zeros((4, 3))
    builder = impinge.Builder()
    builder.body("sheet").surface("bezier", degree=[1, 1], points=points)
    scene = builder.build()
    points[:] = 7
    assert "7" not in scene.to_json()


def test_files_are_saved_whole_through_links_or_not_at_all(tmp_path):
    scene = flying().build()
    (tmp_path / "real.json").write_text("before")
    (tmp_path / "real.json").chmod(0o640)
    (tmp_path / "link.json").symlink_to("real.json")
    scene.save(tmp_path / "link.json")
    assert (tmp_path / "link.json").is_symlink()
    assert (tmp_path / "real.json").stat().st_mode & 0o777 == 0o640
    assert impinge.Scene(tmp_path / "real.json").solve().t == scene.solve().t
    scene.save("/dev/null")
    assert pathlib.Path("/dev/null").is_char_device()
    with pytest.raises(impinge.FileError, match="none/x.json: cannot be written: No such file"):
        scene.save(tmp_path / "none" / "x.json")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["link.json", "real.json"]


# --- Copies -----------------------------------------------------------------------------------


def test_copies_share_a_scene_that_lives_as_long_as_the_last():
    scene = flying().build()
    expected = answer(scene)
    copies = [copy.copy(scene), copy.deepcopy(scene), copy.deepcopy({"scene": [scene]})["scene"][0]]
    del scene
    for one in copies:
        assert type(one) is impinge.Scene and answer(one) == expected
    while copies:
        copies.pop()
        assert all(answer(one) == expected for one in copies)


class Named(impinge.Scene):
    """A class of a user."""

    label = "none"


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_pickle_writes_the_text(protocol):
    for scene in (crowd(), impinge.Scene(ARM), endless()):
        data = pickle.dumps(scene, protocol)
        assert answer(pickle.loads(data)) == answer(scene)
    named = Named(ARM)
    named.label = "mine"
    again = pickle.loads(pickle.dumps(named, protocol))
    assert type(again) is Named and again.label == "mine" and again.bodies == named.bodies


def test_results_are_pickled_as_they_are():
    scene = crowd()
    for found in (scene.solve(), scene.clearance(), scene.each(), scene.profile(3)):
        assert pickle.loads(pickle.dumps(found)) == found


def test_what_cannot_be_copied_says_so():
    builder = flying()
    body = builder.body("late")
    for wrong in (builder, body):
        for way in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="cannot be copied or pickled"):
                way(wrong)
    with pytest.raises(TypeError, match="pickle"):
        pickle.dumps(crowd().solve_each())


# --- Other processes ------------------------------------------------------------------------------


def time_of(scene: impinge.Scene) -> float:
    return scene.solve().t


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_scenes_are_handed_to_pools(method):
    scenes = [flying(-2 - k).build() for k in range(4)]
    with multiprocessing.get_context(method).Pool(2) as pool:
        found = pool.map_async(time_of, scenes).get(timeout=100)
    assert found == [time_of(scene) for scene in scenes]


def in_child(work) -> int:
    """The status with which a copy of this process ends that does the work."""
    child = os.fork()
    if child == 0:
        status = 1
        signal.alarm(60)  # ends a child that hangs
        try:
            status = 0 if work() else 2
        finally:
            os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def test_a_copy_of_the_process_makes_scenes_anew_that_threads_are_asking():
    scene, expected, stop = endless(), endless().solve(gamma=1e-9, max_pairs=3000).t_lower, []
    runs = threading.Event()

    def sink(_):
        runs.set()
        return not stop

    threads = [threading.Thread(target=lambda: scene.solve(gamma=1e-9, progress=sink))
               for _ in range(2)]
    for thread in threads:
        thread.start()
    runs.wait()
    locked = scene._handle.address
    statuses = [in_child(lambda: scene._handle.address != locked and
                         scene.solve(gamma=1e-9, max_pairs=3000).t_lower == expected)
                for _ in range(3)]
    stop.append(True)
    for thread in threads:
        thread.join()
    assert statuses == [0] * 3
    assert in_child(lambda: scene._handle.address == locked) == 0


def test_a_question_that_is_open_goes_on_in_both_processes():
    expected = [result.t for result in crowd().solve_each()]
    scene = crowd()
    generator = scene.solve_each()
    first = next(generator).t
    assert in_child(lambda: [first, *(r.t for r in generator)] == expected
                    and scene.solve().t == expected[0]) == 0
    assert [first, *(r.t for r in generator)] == expected

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""Pictures, plots, simulations and meshes."""

import impinge
import numpy
import pytest

from support import ARM, SOURCE, flying


def test_a_view_is_bytes_that_notebooks_show(tmp_path):
    scene = flying().build()
    lines = scene.view(format="svg", width=200, height=160)
    assert lines.data.startswith(b"<svg") or b"<svg" in lines.data[:200]
    assert "<svg" in lines._repr_svg_() and lines._repr_png_() is None
    page = scene.view(format="html", frames=3, max_seconds=60)
    assert page._repr_html_().startswith("<iframe srcdoc=") and "<script" not in page._repr_html_()
    lines.save(tmp_path / "x.svg")
    assert (tmp_path / "x.svg").read_bytes() == bytes(lines)
    assert scene.view(tmp_path / "y.svg", width=200, height=160) is None
    assert (tmp_path / "y.svg").read_bytes().count(b"<path") == lines.data.count(b"<path")
    assert scene.view(tmp_path / "y.obj", at=0.25) is None
    assert b"\nf " in (tmp_path / "y.obj").read_bytes()


def test_a_plot_is_a_picture():
    assert b"<svg" in flying().build().plot(format="svg", slices=8).data[:200]
    picture = flying().build().plot(format="svg", slices=8, time=(0, 0.25))
    assert "bytes" in repr(picture) and len(repr(picture)) < 80


def test_a_png_has_its_size():
    try:
        picture = flying().build().view(width=120, height=100)
    except impinge.UsageError as error:
        pytest.skip(str(error))  # built without libpng
    assert picture.data[:8] == b"\x89PNG\r\n\x1a\n" and picture._repr_png_() == picture.data
    assert int.from_bytes(picture.data[16:20], "big") == 120


def test_what_the_command_refuses_is_an_exception(tmp_path):
    scene = flying().build()
    with pytest.raises(impinge.UsageError, match="format: got 'gif', must be one of png, svg, html"):
        scene.view(format="gif")
    with pytest.raises(impinge.UsageError, match="width"):
        scene.view(width=-1)
    with pytest.raises(impinge.UsageError, match="zoom: got 'x'"):
        scene.view(zoom="x")
    with pytest.raises(impinge.ImpingeError, match="x.gif"):
        scene.view(tmp_path / "x.gif")
    with pytest.raises(impinge.ImpingeError, match="none"):
        scene.view(tmp_path / "none" / "x.svg")
    assert list(tmp_path.iterdir()) == []


def test_a_command_that_is_not_there_is_told(monkeypatch):
    monkeypatch.setenv("IMPINGE_COMMAND", "/nowhere/impinge")
    with pytest.raises(impinge.FileError, match="/nowhere/impinge: cannot be run: No such file"):
        flying().build().view(format="svg")
    monkeypatch.setenv("IMPINGE_COMMAND", "/bin/echo")
    with pytest.raises(impinge.UsageError, match="/bin/echo is 'echo.*', but the library is version"):
        flying().build().plot(format="svg")


DROP = {"time": [0, 1], "gravity": [0, 0, -10], "gamma": 1e-5, "bodies": [
    {"name": "floor", "surfaces": [{"type": "plane", "origin": [-2, -2, 0], "edge_u": [4, 0, 0],
                                    "edge_v": [0, 4, 0]}]},
    {"name": "ball", "mass": 1, "restitution": 0.5,
     "surfaces": [{"type": "sphere", "radius": 0.5, "center": [0, 0, 1]}]}]}


def test_a_simulation_is_a_scene_that_can_be_asked():
    motion = impinge.simulate(DROP)
    assert motion.complete and motion.summary["impacts"] >= 1
    assert abs(motion.summary["events"][0]["t"] - 0.1 ** 0.5) < 1e-3
    assert motion.scene.solve(gamma=1e-9, gamma_clear=5e-10).verdict == "clear"
    short = impinge.simulate(DROP, max_events=1)
    assert not short.complete and short.summary["reason"] == "max-events"
    assert impinge.simulate(SOURCE / "tools" / "data" / "recoil.json", time=(0, 0.5)).complete


def test_what_cannot_be_simulated_is_refused(tmp_path):
    with pytest.raises(impinge.SceneError, match="object of a scene file"):
        impinge.simulate({"bodies": object()})
    with pytest.raises(impinge.ImpingeError, match="bodies"):
        impinge.simulate({})
    with pytest.raises(impinge.FileError, match="cannot be read"):
        impinge.simulate(tmp_path / "none.json")
    (tmp_path / "bad.json").write_text("{")
    with pytest.raises(impinge.SceneError, match="bad.json"):
        impinge.simulate(tmp_path / "bad.json")


# --- Meshes -------------------------------------------------------------------------------------


def test_a_sphere_is_triangles_near_it():
    scene = flying().build()
    for tolerance in (1e-2, 1e-4):
        mesh = scene.mesh("right", 0.25, tolerance=tolerance)
        corners = mesh.points[mesh.triangles]
        middle = corners.mean(axis=1)
        assert numpy.allclose(numpy.linalg.norm(mesh.points - [1.5, 0, 0], axis=1), 0.5)
        assert numpy.all(numpy.linalg.norm(middle - [1.5, 0, 0], axis=1) > 0.5 - 4 * tolerance)
        area = numpy.linalg.norm(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                                 axis=1).sum() / 2
        assert abs(area - numpy.pi) < 40 * tolerance
    assert len(scene.mesh("right").triangles) > 50


def test_flat_surfaces_and_pieces_are_few_triangles(tmp_path):
    plane = impinge.Scene.from_pair("plane", "sphere center=0,0,9")
    assert len(plane.mesh("a").triangles) == 2
    (tmp_path / "t.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n3 0 2 3\n"
                                    "3 1 2 3\n")
    mesh = impinge.Scene.from_pair(f"mesh file={tmp_path / 't.off'}", "sphere center=0,0,9").mesh("a")
    assert len(mesh.triangles) <= 8 and set(numpy.unique(mesh.points)) <= {0, 0.5, 1}
    with pytest.raises(impinge.UsageError, match="body: got 'c'"):
        plane.mesh("c")
    with pytest.raises(impinge.UsageError, match="tolerance: got 0"):
        plane.mesh("a", tolerance=0)
    assert impinge.Scene(ARM).mesh("link5", 0.5).points.shape[1] == 3

# SPDX-FileCopyrightText: The Impinge authors
# SPDX-License-Identifier: Apache-2.0

"""The Python module, over the library and plugins of the build tree."""

import ctypes
import dataclasses
import os
import pathlib
import pickle
import shutil
import signal
import subprocess
import threading
import time

import impinge
import numpy
import pytest

from support import ARM, crowd, endless, flying


def test_formulas_of_stages_have_their_numbers():
    scene = impinge.Scene.from_pair("sphere radius=0.3 ! rotate rate=2", "box size=1,1,1")
    (sphere, text), (rotate, turn) = scene.formulas("a")
    assert (sphere, rotate) == ("sphere", "rotate")
    assert text.startswith("radius = 0x1.3333333333333p-2; ") and "A = a0" in turn
    assert "corner0 = (-0.5)" in scene.formulas("b", 0, 5)[0][1]
    for surface, piece in ((1, 0), (0, 6)):
        with pytest.raises(impinge.UsageError, match="has none of these numbers"):
            scene.formulas("b", surface, piece)


def test_a_scene_is_built_and_solved():
    result = flying().build().solve()
    assert result.verdict == "contact" and 0.4999 < result.t <= 0.5
    assert result.a.body == "left" and result.b.body == "right"
    assert result.gap <= 1e-6 and result.t == result.t_lower
    assert result.time_left(0.25) == result.t - 0.25
    assert "contact" in repr(result) and result.normal[0] > 0.99


def test_text_and_builder_give_the_same_bits():
    pair = impinge.Scene.from_pair("sphere radius=0.5",
                                   "sphere radius=0.5 center=2,0,0 ! translate velocity=-2,0,0")
    assert pair.solve().t == flying().build().solve().t


def test_a_scene_whose_numbers_change_is_the_scene_that_is_built_so():
    def pair(radius, rate, velocity):
        return impinge.Scene.from_json(
            '{"time":[0,1],"define":{"ball":[{"type":"sphere","radius":%r,"maps":[{"type":"rotate",'
            '"axis":[0,0,1],"rate":%r}]}]},"bodies":[{"name":"a","surfaces":["ball"]},{"name":"b","surfaces":'
            '[{"type":"sphere","radius":1,"center":[3,0.1,0]}],"maps":[{"type":"translate","velocity":%r}]}]}'
            % (radius, rate, velocity))

    def told(scene):
        result = scene.solve()
        return result.t, result.gap, result.a.point, result.stats.pairs

    scene, expected = pair(0.5, 1.0, [-2.0, 0.0, 0.0]), pair(0.75, 2.0, [-1.5, 0.25, 0.0])
    first = told(scene)
    scene.set_values("a", {"radius": 0.75}, surface=0)
    scene.set_values("a", {"axis": [0, 0, 1], "rate": 2}, surface=0, map=0)
    scene.set_values("b", {"velocity": numpy.array([-1.5, 0.25, 0])}, map=0)
    assert told(scene) == told(expected) != first
    again = impinge.Scene.from_json(scene.to_json())
    assert told(again) == told(expected)
    for wrong, words in (({"map": 1}, "has no map 1"), ({"surface": 1}, "has no surface 1"), ({}, "neither a surface"),
                         ({"surface": -1}, "surface")):
        with pytest.raises(impinge.UsageError, match=words):
            scene.set_values("a", {"radius": 1}, **wrong)
    with pytest.raises(impinge.SceneError, match="body 'a': surface 0: radius: got -1"):
        scene.set_values("a", {"radius": -1}, surface=0)
    with pytest.raises(impinge.UsageError, match="parameters: got 3"):
        scene.set_values("a", 3, surface=0)
    assert told(scene) == told(expected)


def test_control_points_go_in_and_points_come_out_as_arrays():
    u, v = numpy.meshgrid(numpy.linspace(-1, 1, 4), numpy.linspace(-1, 1, 4), indexing="ij")
    points = numpy.stack([u, v, 0 * u], axis=-1).reshape(-1, 3)
    builder = impinge.Builder()
    builder.body("sheet").surface("bezier", degree=[3, 3], points=points)
    scene = builder.build()
    x = scene.eval("sheet", 0, [[0, 0, 0], [1, 1, 0], [0.5, 0.5, 0]])
    assert numpy.allclose(x, [[-1, -1, 0], [1, 1, 0], [0, 0, 0]], atol=1e-15)


def test_clearance_is_a_bracket_and_a_profile_is_arrays():
    scene = impinge.Scene.from_pair("sphere", "sphere center=4,0,0 ! translate velocity=-1,0,0")
    clearance = scene.clearance(required=0.9)
    assert clearance.verdict == "holds"
    clearance = scene.clearance(required=0.25)
    assert clearance.verdict == "holds" and clearance.reason == "decided"
    assert clearance.lower >= 0.25 * (1 - 1e-6) and clearance.upper >= 1
    assert [answer.reason for answer in scene.each(required=0.25)] == ["decided"]
    clearance = scene.clearance(required=0.25, tolerance=1e-3)
    assert clearance.reason is None and clearance.lower > 0.999
    clearance = scene.clearance()
    assert clearance.lower <= 1 <= clearance.upper * (1 + 1e-9)
    assert clearance.upper - clearance.lower <= 1e-3 * clearance.upper
    profile = scene.profile(4)
    assert profile.lower.shape == (4,) and numpy.all(profile.lower <= profile.upper)
    assert numpy.all(numpy.abs(profile.upper - [1.75, 1.5, 1.25, 1]) < 2e-3)
    violated = scene.clearance(required=1.5)
    assert violated.verdict == "violated" and abs(violated.t_violated - 0.5) < 1e-3


def test_each_is_sorted_by_tightness():
    builder = impinge.Builder()
    for k, x in enumerate((0, 3, 9)):
        builder.body(f"b{k}").surface("sphere", center=[x, 0, 0])
    pairs = builder.build().each()
    assert [pair.bodies for pair in pairs] == [("b0", "b1"), ("b1", "b2"), ("b0", "b2")]


def row(count):
    builder = impinge.Builder()
    for k in range(count):
        builder.body(f"b{k}").surface("sphere", center=[3 * k, 0, 0])
    return builder.build()


def test_each_leaves_out_what_never_comes_within_a_distance():
    scene = row(2000)  # 1,999,000 pairs of bodies, of which neighbours are 1 apart and others 4
    pairs = scene.each(within=2, max_bytes=50_000_000)
    assert len(pairs) == 1999 and all(0.99 < pair.lower <= 1 <= pair.upper < 1.01 for pair in pairs)
    assert pairs == scene.each(within=2, threads=1)
    assert scene.each(within=0.5) == []
    whole = row(4).each()
    assert [pair for pair in whole if pair.lower < 2] == row(4).each(within=2)
    with pytest.raises(impinge.UsageError, match="within: got 1, must be at least what is required, 2"):
        scene.each(within=1, required=2)


def test_pairs_that_a_limit_leaves_out_are_one_answer():
    start = time.process_time()
    pairs = row(2000).each(max_seconds=0.5, threads=1)
    assert time.process_time() - start < 5
    assert pairs[-1].bodies is None and pairs[-1].reason == "seconds" and pairs[-1].lower == 0
    assert len(pairs) < 1_000_000 and all(pair.bodies for pair in pairs[:-1])


def test_slices_that_a_limit_leaves_out_are_one_element():
    start = time.process_time()
    profile = flying().build().profile(1_000_000, max_seconds=0.5, required=0.1)
    assert time.process_time() - start < 3
    assert 1 < len(profile) < 1_000_000 and profile.t1[-1] == 1 and profile.lower[-1] == 0
    assert profile.verdict[-1] == "undecided" and profile.bodies[-1] is None
    assert (profile.t1[:-1] == profile.t0[1:]).all()
    small = flying().build().profile(1_000_000, max_bytes=20_000_000)
    assert 1 < len(small) < 1_000_000 and small.t1[-1] == 1 and small.verdict[-1] is None


def test_a_batch_keeps_its_order_on_any_number_of_threads():
    speeds = [-2 - 0.125 * k for k in range(12)]
    times = [[r.t for r in impinge.batch((flying(s).build() for s in speeds), threads=n)]
             for n in (1, 4)]
    assert times[0] == times[1] and times[0] == sorted(times[0], reverse=True)


def test_threads_that_a_question_borrows_change_no_answer():
    builder = impinge.Builder()
    for k in range(200):
        builder.body(f"b{k}").surface("sphere", radius=0.4, center=[k % 20, k // 20, 0]).map(
            "rotate", axis=[0, 0, 1], rate=0.01 * k)
    scene = builder.build()
    for ask in (scene.solve, scene.clearance):
        answers = [dataclasses.replace(ask(threads=threads), **{"seconds": 0.0} if ask == scene.solve else {})
                   for threads in (None, 1, 3)]
        assert answers[0] == answers[1] == answers[2]


def test_times_that_are_given_are_judged_instead_of_defaults():
    builder = impinge.Builder()
    for name, times in (("early", [0, 1]), ("late", [2, 3])):
        builder.body(name).surface("sphere").map("keyframes", times=times, positions=[[0, 0, 0], [1, 0, 0]])
    scene = builder.build()
    with pytest.raises(impinge.SceneError, match="early.*up to t = 1"):
        scene.solve()
    with pytest.raises(impinge.SceneError, match="from t = 2 to 3 only") as refused:
        scene.solve(time=(0.25, 0.5))
    assert "early" not in str(refused.value)


def test_a_builder_without_time_has_the_span_of_its_tables():
    builder = impinge.Builder()
    builder.body("a").surface("sphere").map("keyframes", times=[2, 4], positions=[[0, 0, 0], [1, 0, 0]])
    builder.body("b").surface("sphere", center=[9, 0, 0])
    scene = builder.build()
    assert (scene.solve().t_start, scene.solve().t_end) == (2, 4)
    again = impinge.Scene.from_json(scene.to_json())
    assert (again.solve().t_start, again.solve().t_end) == (2, 4)


def test_one_scene_may_be_asked_by_many_threads():
    scene, found = flying().build(), []
    threads = [threading.Thread(target=lambda: found.append(scene.solve().t)) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and len(set(found)) == 1


def test_errors_name_body_and_parameter():
    body = impinge.Builder().body("pot")
    with pytest.raises(impinge.SceneError, match="body 'pot': surface 0: radius: .*-1"):
        body.surface("sphere", radius=-1)
    with pytest.raises(impinge.SceneError, match="center: .*an array of 2"):
        body.surface("sphere", center=[1, 2])
    with pytest.raises(impinge.SceneError, match="center: extent 0 is 0"):
        body.surface("sphere", center=[])
    with pytest.raises(impinge.SceneError, match="nan"):
        body.surface("sphere", center=[1, 2, float("nan")])
    with pytest.raises(impinge.SceneError, match="did you mean 'sphere'"):
        body.surface("spere")
    with pytest.raises(impinge.UsageError, match="4 dimensions"):
        body.surface("bezier", points=numpy.zeros((1, 1, 1, 1)))
    with pytest.raises(impinge.FileError, match="cannot be read"):
        impinge.Scene.from_file("nowhere.json")
    with pytest.raises(impinge.UsageError, match="required"):
        flying().build().clearance(required=0)
    with pytest.raises(impinge.UsageError, match="required: got 'x', must be a number > 0"):
        flying().build().clearance(required="x")
    assert flying().build().clearance(required=numpy.float32(0.5)).verdict is not None
    with pytest.raises(impinge.UsageError, match="gamma"):
        flying().build().solve(gamma=-1)


def test_a_builder_that_is_done_is_refused():
    builder = flying()
    builder.build()
    with pytest.raises(impinge.UsageError, match="has made its scene already"):
        builder.body("late")


def test_parents_groups_and_files_make_an_arm():
    scene = impinge.Scene.from_file(ARM)
    clearance = scene.clearance(required=2, tolerance=1e-3)
    assert clearance.verdict == "holds" and clearance.lower >= 2 * (1 - 1e-6)
    assert {clearance.a.body, clearance.b.body} == {"link5", "fixture"}


def test_each_pair_meets_in_order_of_time_and_what_stays_clear_comes_last():
    results = list(crowd().solve_each())
    assert [r.bodies[1] for r in results] == ["ball1", "ball0", "ball2", "ball3"]
    assert [r.verdict for r in results] == ["contact"] * 3 + ["clear"]
    assert all(abs(r.t - t) < 1e-5 for r, t in zip(results, (0.375, 0.5, 0.625)))
    assert results[0].a.body == "wall" and not results[0].at_rest


def test_each_pair_is_there_as_soon_as_it_is_proved():
    generator = crowd().solve_each()
    assert next(generator).bodies == ("wall", "ball1")
    generator.close()
    cut_short = list(crowd().solve_each(max_pairs=3))
    assert cut_short[-1].verdict == "undecided" and cut_short[-1].bodies is None


def test_finer_answers_come_from_one_search():
    results = list(flying().build().refine([1e-8, 1e-2, 1e-4]))
    assert [r.gamma for r in results] == [1e-2, 1e-4, 1e-8]
    assert results[-1].t == pytest.approx(flying().build().solve(gamma=1e-8).t, abs=1e-8)
    assert list(flying().build().refine([])) == []


def test_a_progress_sink_sees_a_search_advance_and_ends_it():
    seen = []

    def sink(progress):
        seen.append(progress)
        return len(seen) < 2

    result = endless().solve(gamma=1e-9, progress=sink)
    assert result.verdict == "undecided" and result.reason == "cancelled"
    assert len(seen) == 2 and seen[1].pairs > seen[0].pairs and "pairs=" in repr(seen[0])
    assert seen[0].t_lower == 0 and seen[0].upper is None


def test_an_exception_of_a_sink_goes_on_to_the_caller():
    def sink(progress):
        raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        endless().solve(gamma=1e-9, progress=sink)


def test_an_interrupt_ends_a_search():
    # Where the tests run in the background Python finds SIGINT ignored, and leaves it so.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    def sink(progress):
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        endless().solve(gamma=1e-9, progress=sink)
    thread = threading.main_thread().ident
    with pytest.raises(KeyboardInterrupt):  # also while no sink is called
        threading.Thread(target=lambda: signal.pthread_kill(thread, signal.SIGINT)).start()
        endless().solve(gamma=1e-9, max_bytes=1 << 40)  # nothing else ends it
    signal.signal(signal.SIGINT, before)


def test_a_budget_ends_a_search_with_what_is_proved():
    result = endless().solve(gamma=1e-9, max_pairs=500)
    assert result.verdict == "undecided" and result.reason == "pairs" and result.pairs >= 500
    with pytest.raises(TypeError, match="max_pears"):
        endless().solve(max_pears=1)


def test_arrays_of_doubles_are_not_copied():
    from impinge._arguments import argument

    points = numpy.zeros((16, 3))
    address = ctypes.cast(argument("points", points, [], {}).number, ctypes.c_void_p).value
    assert address == points.ctypes.data
    turned = numpy.asfortranarray(points)
    kept = []
    argument("points", turned, kept, {})
    assert kept[0].flags.c_contiguous and kept[0].shape == (16, 3)


def test_a_batch_takes_scenes_as_it_needs_them_and_can_be_closed():
    taken = []

    def scenes():
        for k in range(1000):
            taken.append(k)
            yield flying().build()

    results = impinge.batch(scenes(), threads=2)
    assert next(results).verdict == "contact"
    results.close()
    assert len(taken) < 10


def test_what_is_not_there_is_named():
    scene = flying().build()
    with pytest.raises(impinge.UsageError, match="left, right"):
        scene.eval("middle", 0, [[0, 0, 0]])
    with pytest.raises(impinge.UsageError, match="gamma: got 'wide'"):
        scene.solve(gamma="wide")


def test_everything_public_is_documented_and_typed():
    for name in impinge.__all__:
        assert getattr(impinge, name).__doc__, name
    for kind in (impinge.Scene, impinge.Builder, impinge.Body):
        for name, member in vars(kind).items():
            if callable(member) and not name.startswith("_"):
                assert member.__doc__ and "return" in member.__annotations__, name
    assert (pathlib.Path(impinge.__file__).parent / "py.typed").exists()


def test_who_is_inside_a_solid_body_is_in_contact_at_the_start() -> None:
    builder = impinge.Builder()
    builder.body("pot", solid=True).surface("box", size=[4, 4, 4])
    builder.body("pea").surface("sphere", radius=0.1)
    scene = builder.build()
    for asked in (scene, impinge.Scene.from_json(scene.to_json())):
        result, clearance = asked.solve(), asked.clearance()
        assert result.kind == "inside" and result.t == 0 and result.gap == 0
        assert result.a is not None and result.b is not None and result.a.point == result.b.point
        assert clearance.kind == "inside" and clearance.lower == clearance.upper == 0
    builder = impinge.Builder()
    builder.body("pot").surface("box", size=[4, 4, 4])
    builder.body("pea").surface("sphere", radius=0.1)
    assert builder.build().solve().kind is None


def verified(*words):
    """What impinge-verify says first, and its exit status."""
    command = os.environ.get("IMPINGE_VERIFY") or shutil.which("impinge-verify")
    if command is None or not os.path.exists(command):
        pytest.skip("no impinge-verify")
    done = subprocess.run([command, *map(str, words)], capture_output=True, text=True, check=False)
    return done.stdout.split("\n", 1)[0], done.returncode


def test_certificates_are_written_and_verified(tmp_path):
    scene = flying().build()
    result = scene.solve(gamma=1e-3, proof=tmp_path / "solve.proof")
    assert result.verdict == "contact"
    scene.clearance(required=0.1, time=(0, 0.3), proof=tmp_path / "clearance.proof")
    text = (tmp_path / "solve.proof").read_bytes()
    assert b"\nverdict contact\n" in text and b"\ntype sphere " in text and b"\nscene " not in text
    assert sorted(p.name for p in tmp_path.iterdir()) == ["clearance.proof", "solve.proof"]
    for name in ("solve", "clearance"):
        assert verified(tmp_path / f"{name}.proof") == ("holds", 0)


def test_certificates_are_about_all_values_of_parameters(tmp_path):
    (tmp_path / "scene.json").write_text(
        '{"parameters":{"q":[0,1]},"bodies":[{"name":"a","surfaces":[{"type":"sphere"}],'
        '"maps":[{"type":"translate","velocity":[1,0,0],"clock":"q"}]},'
        '{"name":"b","surfaces":[{"type":"sphere","center":[4,0,0]}]}]}')
    scene = impinge.Scene.from_file(tmp_path / "scene.json")
    assert scene.solve(gamma=1e-3, proof=tmp_path / "solve.proof").verdict == "clear"
    assert scene.clearance(tolerance=0.1, proof=tmp_path / "clearance.proof").lower > 0.8
    for name in ("solve", "clearance"):
        assert b"\nparameter 0x0p+0 0x1p+0 q\n" in (tmp_path / f"{name}.proof").read_bytes()
        assert verified(tmp_path / f"{name}.proof", tmp_path / "scene.json") == ("holds", 0)


def test_certificates_are_receipts_of_the_file_they_are_of(tmp_path):
    flying().build().save(tmp_path / "scene.json")
    scene = impinge.Scene(tmp_path / "scene.json")
    proof = tmp_path / "scene.proof"
    scene.solve(gamma=1e-3, proof=proof)
    assert b"\nscene " in proof.read_bytes()
    impinge.Scene.from_file(tmp_path / "scene.json").solve(gamma=1e-3, proof=tmp_path / "same")
    assert (tmp_path / "same").read_bytes() == proof.read_bytes()
    scene.set_values("left", {"radius": 0.25}, surface=0)
    scene.solve(gamma=1e-3, proof=tmp_path / "changed")
    assert b"\nscene " not in (tmp_path / "changed").read_bytes()
    scene = pickle.loads(pickle.dumps(scene))
    scene.solve(gamma=1e-3, proof=tmp_path / "changed")
    assert b"\nscene " not in (tmp_path / "changed").read_bytes()
    assert verified(proof)[0] == "holds"
    with open(tmp_path / "scene.json", "a", encoding="utf-8") as file:
        file.write("\n")
    assert verified(proof, tmp_path / "scene.json") == ("stale: the scene has changed", 3)


def test_certificates_that_cannot_be_are_refused(tmp_path):
    scene, proof = flying().build(), tmp_path / "kept"
    proof.write_text("mine")
    solid = impinge.Scene.from_json(
        '{"bodies":[{"name":"a","solid":true,"surfaces":[{"type":"sphere"}]},'
        '{"name":"b","surfaces":[{"type":"sphere","center":[3,0,0]}]}]}')
    with pytest.raises(impinge.UsageError, match="a body is solid"):
        solid.solve(proof=proof)
    swept = impinge.Scene.from_json(
        '{"parameters":{"q":[0,1]},"bodies":[{"name":"a","surfaces":[{"type":"sphere"}],'
        '"maps":[{"type":"translate","velocity":[1,0,0],"clock":"q"}]},'
        '{"name":"b","surfaces":[{"type":"sphere","center":[5,0,0]}]}]}')
    with pytest.raises(impinge.UsageError, match="proof"):
        scene.solve(proof=5)
    assert proof.read_text() == "mine"
    with pytest.raises(impinge.FileError, match="cannot be written"):
        scene.solve(gamma=1e-3, proof=tmp_path / "none" / "x")
    swept.at({"q": 0.5}).solve(gamma=1e-3, proof=proof)
    assert proof.read_bytes().startswith(b"impinge certificate 1\n")

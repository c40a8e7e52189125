"""Plans: diagnostics, drawings, changes, files."""

from __future__ import annotations

import copy
import pickle
import subprocess
from pathlib import Path

import pytest

import afp
from conftest import ROOT, interrupted

WRONG = "use carbot\nplan P { start go actor go: Forward(distance = 30) { ForwardSuccessful -> terminate } }\n"
COMMENTED = """use carbot

// A comment above.
plan P {
    start go

    // Goes.
    actor go: Forward(distance = 1 m) {
        ForwardSuccessful -> terminate // the end
    }
}
"""


def test_diagnostics_have_an_error_a_place_and_a_help() -> None:
    plan = afp.Plan(WRONG, "p.afp")
    unit = next(each for each in plan.diagnostics if each.code == "E0203")
    assert (unit.severity, unit.file, unit.line, unit.column) == ("error", "p.afp", 2, 48)
    assert unit.help and "found a bare number" in unit.message
    assert str(unit) == f"p.afp:2:48: error[E0203]: {unit.message}"
    assert not plan.ok and unit in plan.diagnostics and len({unit, unit}) == 1


def test_an_exception_has_the_diagnostics_of_afpc(afpc: str, tmp_path: Path) -> None:
    file = tmp_path / "p.afp"
    file.write_text(WRONG)
    with pytest.raises(afp.PlanError) as raised:
        afp.Simulation(afp.load(file))
    assert [each.code for each in raised.value.diagnostics] == [each.code for each in afp.load(file).diagnostics]
    told = subprocess.run([afpc, "check", str(file)], capture_output=True, text=True, check=False)
    assert str(raised.value) in told.stderr


def test_a_plan_is_shown_in_a_notebook(wall_following: afp.Plan) -> None:
    assert wall_following.name == "WallFollowing" and wall_following.ok
    svg = wall_following._repr_svg_()
    assert svg is not None and svg.startswith("<svg") and "searchFirstWall" in svg
    assert "<svg" in wall_following._repr_html_()
    wrong = afp.Plan(WRONG)
    assert "E0203" in wrong._repr_html_() and "<svg" in wrong._repr_html_() and "wrong" in wrong._repr_svg_()
    assert "digraph" in wall_following.dot() and "<scxml" in wall_following.scxml()
    assert '"WallFollowing"' in wall_following.json()
    with pytest.raises(ValueError, match="there are: auto, light, dark"):
        wall_following.svg(theme="blue")


def test_changes_keep_comments(tmp_path: Path) -> None:
    file = tmp_path / "p.afp"
    file.write_text(COMMENTED)
    plan = afp.load(file)
    plan.rename("go", "ahead")
    plan.bind("ahead", "distance", "2 m")
    plan.add("actor turn: Turn(angle = 90 deg) { TurnSuccessful -> terminate }")
    plan.connect("ahead", "ForwardSuccessful", "turn")
    plan.set_doc("ahead", "Two metres.")
    plan.add("supervise touch: CheckTouchSensor { TouchSensorPressed -> turn }", owner="ahead")
    plan.set_every("ahead.touch", "5 ms")
    plan.rename("P", "Q")
    assert plan.ok, plan.report()
    plan.save()
    text = file.read_text()
    for kept in ("// A comment above.", "// Goes.", "// the end", "/// Two metres.", "start ahead", "plan Q {"):
        assert kept in text
    assert "distance = 2 m" in text and "every 5 ms" in text and "ForwardSuccessful -> turn" in text


def test_a_refused_change_changes_nothing(wall_following: afp.Plan) -> None:
    before = wall_following.text
    with pytest.raises(afp.AfpError, match="nowhere"):
        wall_following.rename("nowhere", "somewhere")
    with pytest.raises(afp.AfpError):
        wall_following.add("actor broken: (")
    with pytest.raises(ValueError, match="is not the path of an item"):
        wall_following.remove("a.b.c")
    assert wall_following.text == before


def test_a_plan_can_be_built(tmp_path: Path) -> None:
    plan = afp.new_plan("Square", use=["carbot"])
    plan.add("in side: length = 50 cm")
    plan.add("actor ahead: Forward(distance = side) { ForwardSuccessful -> corner }")
    plan.add("actor corner: Turn(angle = 90 deg) { TurnSuccessful -> ahead }")
    plan.set_start("ahead")
    plan.check()
    plan.format()
    assert plan.formatted() == plan.text
    with pytest.raises(afp.AfpError, match="give save"):
        plan.save()
    plan.save(tmp_path / "square.afp")
    assert afp.load(tmp_path / "square.afp").text == plan.text
    result = afp.Simulation(plan, set={"side": afp.cm(20)}).run(until=3.0)
    assert result.ending == "time_limit" and result.distance == pytest.approx(0.2, abs=0.01)


def test_extract_and_inline(wall_following: afp.Plan) -> None:
    wall_following.extract(["parallelToWall"], "Align", "align")
    assert sorted(wall_following.plans) == ["Align", "WallFollowing"] and wall_following.ok
    assert "subplan align: Align" in wall_following.text
    wall_following.inline("align")
    assert "subplan" not in wall_following.text
    assert wall_following.ok, wall_following.report()


def test_changes_reach_other_files(tmp_path: Path) -> None:
    (tmp_path / "other.afp").write_text(
        "use carbot\nplan Inner { start go actor go: Forward(distance = 1 m) { ForwardSuccessful -> terminate } }\n"
    )
    main = tmp_path / "main.afp"
    main.write_text('use "other.afp"\nplan Main { start inner subplan inner: Inner { OK -> terminate } }\n')
    plan = afp.load(main)
    assert plan.ok, plan.report()
    plan.rename("inner", "part")
    plan.save()
    assert "start part" in main.read_text()


def test_another_file_is_imported_by_its_quoted_path(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts/explore.afp").write_text("use carbot\nplan Explore { start go actor go: Forward { ForwardSuccessful -> terminate } }\n")
    plan = afp.Plan("plan P { start look subplan look: Explore { OK -> terminate } }\n", tmp_path / "plan.afp")
    assert not plan.ok
    plan.use('"parts/explore.afp"')
    assert plan.ok and plan.text.startswith('use "parts/explore.afp"\n\nplan P')
    with pytest.raises(afp.AfpError, match="is a file, which has no short name"):
        plan.use('"parts/explore.afp"', "e")


def test_missing_files_are_reported() -> None:
    with pytest.raises(FileNotFoundError):
        afp.load("nowhere.afp")
    with pytest.raises(FileNotFoundError, match="cannot read the world"):
        afp.World.load("nowhere.toml")


def test_running_objects_are_not_pickled(wall_following: afp.Plan) -> None:
    for thing in (afp.Simulation(wall_following)._runner, afp.Carbot(afp.World.random(1))):
        with pytest.raises(TypeError, match="cannot be pickled"):
            pickle.dumps(thing)


def test_values_can_be_pickled_and_copied(wall_following: afp.Plan) -> None:
    wall_following.rename("followWall", "along")
    result = afp.Simulation(wall_following, seed=3).run(until=3.0)
    broken = afp.Plan("plan P { start nowhere }", "p.afp")
    with pytest.raises(afp.PlanError) as error:
        broken.check()
    for again in (lambda thing: pickle.loads(pickle.dumps(thing)), copy.copy, copy.deepcopy):
        plan = again(wall_following)
        assert (type(plan), plan.text, plan.path, plan.name) == (
            afp.Plan,
            wall_following.text,
            wall_following.path,
            "WallFollowing",
        )
        assert plan == wall_following
        plan.rename("along", "beside")
        assert plan != wall_following
        assert "along" in wall_following.text and "along" not in plan.text, "a copy is of its own"
        world = again(result._world)
        assert (world.name, world.text, world.path) == (result._world.name, result._world.text, result._world.path)
        assert afp.Simulation(wall_following, world, seed=3).run(until=3.0).trace_hash == result.trace_hash
        told = again(result)
        assert told == result and told.events == result.events and len({told, result}) == 1
        assert [str(event) for event in told.events] == [str(event) for event in result.events]
        assert (told.trace_hash, told.entries, told.timeline) == (result.trace_hash, result.entries, result.timeline)
        assert again(broken.diagnostics[0]) == broken.diagnostics[0]
        why = again(error.value)
        assert (str(why), why.diagnostics) == (str(error.value), broken.diagnostics)


def test_a_verdict_shows_the_failed_claims_and_the_command(tmp_path: Path) -> None:
    go = "use carbot\nplan Go { start go actor go: Forward(distance = 20 cm) { ForwardSuccessful -> terminate } }\n"
    file = tmp_path / "a plan.afp"
    file.write_text(go + 'scenario "it\'s <fast>" for Go {\n    expect end by OK before 100 ms\n}\n', encoding="utf-8")
    verdict = afp.load(file).scenarios[0].run()
    assert not verdict.passed and verdict.command == rf"afpc test '{file}' 'it'\''s <fast>'"
    shown = verdict._repr_html_()
    assert "failed" in shown and "expect end by OK before 100 ms" in shown and "&lt;fast&gt;" in shown
    again = pickle.loads(pickle.dumps(verdict))
    assert again == verdict and again._repr_html_() == shown
    plan = afp.load(file)
    plan.rename("go", "ahead")
    assert plan.scenarios[0].run().command.endswith("  # the plan has unsaved changes")
    passed = afp.load(ROOT / "plans/tests/wall_following.afp").scenarios[0].run()._repr_html_()
    assert "passed" in passed and "<pre>" not in passed


def test_scenarios_are_pickled_with_their_text() -> None:
    plan = afp.load(ROOT / "plans/tests/wall_following.afp")
    for scenario in plan.scenarios[:2]:
        again = pickle.loads(pickle.dumps(scenario))
        assert (again.name, again.plan, again.line) == (scenario.name, scenario.plan, scenario.line)
        assert again == scenario and len({again, scenario}) == 1
    assert plan.scenarios[0] != plan.scenarios[1]


def test_an_invalid_value_does_not_change_the_plan(wall_following: afp.Plan) -> None:
    before = wall_following.text
    for value in (afp.deg(3), 3, True):
        with pytest.raises(TypeError, match="expected a length"):
            wall_following.bind("backupCollision", "distance", value)
    assert wall_following.text == before and wall_following.ok
    wall_following.bind("backupCollision", "distance", "3 deg")
    assert not wall_following.ok, "what is written as text is told by the diagnostics"
    wall_following.bind("backupCollision", "distance", afp.cm(-3))
    assert wall_following.ok and "distance = -0.03 m" in wall_following.text


def test_broken_plans_are_drawn() -> None:
    broken = afp.Plan("use carbot\nplan P { start go actor go: Forward(distance = 3) { ForwardSuccessful -> nowhere } }")
    assert not broken.ok
    assert "Forward" in broken.svg() and "<svg" in broken._repr_html_()


def test_a_long_drawing_is_interrupted_and_does_not_block_others() -> None:
    count = 2000
    ring = "".join(
        f"actor a{i}: Forward(distance = 1 m) {{ ForwardSuccessful -> a{(i + 1) % count} }}\n" for i in range(count)
    )
    plan = afp.Plan(f"use carbot\nplan P {{ start a0\n{ring} }}")
    assert plan.name == "P"
    assert interrupted(plan.svg, after=0.05) < 0.5


def test_every_shipped_plan_is_valid() -> None:
    for file in (ROOT / "plans").glob("*.afp"):
        assert afp.load(file).diagnostics == []


def test_a_plan_keeps_its_line_ends(afpc: str, tmp_path: Path) -> None:
    file, log = tmp_path / "p.afp", tmp_path / "p.mcap"
    written = COMMENTED.replace("\n", "\r\n").encode()
    for text in (written, "\ufeff".encode() + written):
        file.write_bytes(text)
        plan = afp.load(file)
        assert plan.ok and plan.text.encode() == text
        plan.save()
        assert file.read_bytes() == text
        afp.Simulation(plan, log=log).run(until=1.0)
        subprocess.run([afpc, "run", str(file), "--again", str(log), "--svg", "none"], cwd=tmp_path, check=True)
    tools = tmp_path / "tools.afp"
    tools.write_bytes(b"toolbox tools\r\n")
    assert afp.Toolbox.load(tools).text == "toolbox tools\r\n"


def test_a_plan_with_other_line_ends_continues_the_journal_of_afpc(afpc: str, tmp_path: Path) -> None:
    file, table = tmp_path / "p.afp", tmp_path / "runs.csv"
    file.write_bytes(COMMENTED.replace("\n", "\r\n").encode())
    runs = afp.sweep(afp.load(file), seeds=2, until=1.0, out=table)
    assert not any("#" in row["command"] for row in runs)
    subprocess.run([afpc, "sweep", str(file), "--seeds", "0..2", "--until", "1s", "-o", str(table)], cwd=tmp_path, check=True)


def test_a_saved_drawing_equals_the_shown_drawing(tmp_path: Path, wall_following: afp.Plan) -> None:
    wall_following.save_svg(tmp_path / "plan.svg")
    assert (tmp_path / "plan.svg").read_text(encoding="utf-8") == wall_following.svg() == wall_following._repr_svg_()


def test_a_drawing_has_the_icons_of_the_projects_toolbox(tmp_path: Path) -> None:
    icon = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 24 24"><path d="M1 2h3v4z"/></svg>'
    (tmp_path / "icons").mkdir()
    (tmp_path / "icons" / "bow.svg").write_text(icon)
    (tmp_path / "gestures.afp").write_text('toolbox gestures version "1"\nactor Bow { icon "bow" state Bowed }\n')
    (tmp_path / "afp.toml").write_text('[toolboxes]\ngestures = { path = "gestures.afp" }\n')
    text = "use gestures\nplan P { start bow actor bow: Bow { Bowed -> terminate } }\n"
    plan = afp.Plan(text, str(tmp_path / "p.afp"))
    assert plan.ok and "M1 2h3v4z" in plan.svg()
    (tmp_path / "gestures.afp").write_text('toolbox poses version "1"\n')
    with pytest.raises(afp.AfpError, match="does not begin with 'toolbox gestures'"):
        afp.Plan(text, str(tmp_path / "p.afp"))

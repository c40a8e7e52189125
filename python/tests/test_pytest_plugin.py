"""Scenarios as tests of pytest, and the fixtures."""

from __future__ import annotations

from pathlib import Path

import pytest

import afp

pytest_plugins = ["pytester"]

PLAN = """use carbot

plan Go {
    start go
    actor go: Forward(distance = 20 cm) { ForwardSuccessful -> terminate }
}

scenario "gets there" for Go {
    expect end by OK before 5 s
    until 6 s
}

scenario "ends at once" for Go {
    expect end by OK before 100 ms
    until 6 s
}
"""


@pytest.fixture
def project(pytester: pytest.Pytester) -> pytest.Pytester:
    pytester.path.joinpath("go.afp").write_text(PLAN)
    return pytester


def test_scenarios_are_collected_by_name_and_line(project: pytest.Pytester) -> None:
    result = project.runpytest("--collect-only", "-q")
    result.stdout.fnmatch_lines(["go.afp::gets there", "go.afp::ends at once"])
    items, _ = project.inline_genitems("go.afp")
    assert items[1].reportinfo()[1] == PLAN.splitlines().index('scenario "ends at once" for Go {')


def test_a_failure_shows_the_place_the_timeline_and_the_log(project: pytest.Pytester) -> None:
    result = project.runpytest()
    result.assert_outcomes(passed=1, failed=1)
    line = PLAN.splitlines().index("    expect end by OK before 100 ms") + 1
    result.stdout.fnmatch_lines(
        [
            'scenario "ends at once" of the plan Go',
            f"go.afp:{line}:*: expect end by OK before 100 ms",
            "*broken here",
            "  log: *go.afp_ends_at_once-*.mcap",
        ]
    )
    log = next(project.path.glob("target/afp/tests/*.mcap"))
    assert afp.Log(log).events


def test_failures_with_similar_names_have_separate_logs(project: pytest.Pytester) -> None:
    one = PLAN.split("\n\n")[-1]
    others = [one.replace("ends at once", name) for name in ("Is there: at once?", "is_there_at_once")]
    project.path.joinpath("go.afp").write_text("\n\n".join([PLAN, *others]))
    project.runpytest().assert_outcomes(passed=1, failed=3)
    assert len(list(project.path.glob("target/afp/tests/*.mcap"))) == 3


def test_words_select_scenarios(project: pytest.Pytester) -> None:
    project.runpytest("-k", "gets").assert_outcomes(passed=1, deselected=1)
    project.runpytest("-k", "not once and there").assert_outcomes(passed=1, deselected=1)
    project.runpytest("--no-afp").assert_outcomes()


def test_an_invalid_file_is_an_error_with_the_diagnostics(project: pytest.Pytester) -> None:
    project.path.joinpath("wrong.afp").write_text(PLAN.replace("20 cm", "20"))
    result = project.runpytest("wrong.afp")
    result.assert_outcomes(errors=1)
    result.stdout.fnmatch_lines(["*error?E0203?: expected a length, found a bare number", "*wrong.afp:5:*"])


def test_an_invalid_scenario_fails_next_to_the_others(project: pytest.Pytester) -> None:
    project.path.joinpath("go.afp").write_text(PLAN.replace("before 100 ms", "before 100"))
    result = project.runpytest()
    result.assert_outcomes(passed=1, failed=1)
    line = PLAN.splitlines().index("    expect end by OK before 100 ms") + 1
    result.stdout.fnmatch_lines(["*ends at once*", "error?E*", f"*go.afp:{line}:*"])
    project.runpytest("-k", "gets").assert_outcomes(passed=1, deselected=1)


def test_plans_without_scenarios_are_ignored(project: pytest.Pytester) -> None:
    project.path.joinpath("go.afp").write_text(PLAN.split("scenario")[0])
    assert project.runpytest().ret == pytest.ExitCode.NO_TESTS_COLLECTED


def test_components_in_python_come_from_the_conftest(project: pytest.Pytester) -> None:
    project.makeconftest(
        """
        import afp
        tools = afp.Toolbox("tools")

        @tools.actor(states=["Done"])
        async def Wait(robot: afp.Robot, time: afp.Duration):
            while robot.time < time:
                await afp.tick()
            return "Done"

        def pytest_afp_toolboxes(path):
            return [tools]
        """
    )
    text = PLAN.replace("use carbot", "use tools").replace("Forward(distance = 20 cm)", "Wait(time = 2 s)")
    project.path.joinpath("go.afp").write_text(text.replace("ForwardSuccessful", "Done"))
    project.runpytest().assert_outcomes(passed=1, failed=1)


def test_fixtures_find_files_and_report_the_timeline(project: pytest.Pytester) -> None:
    project.makepyfile(
        """
        def test_good(afp_plan, afp_world, afp_simulation):
            simulation = afp_simulation(afp_plan("go.afp"), afp_world("random:3"), seed=2)
            assert simulation.run(until=6.0).ok and simulation.world.path.name == "random:3"

        def test_bad(afp_simulation):
            assert afp_simulation("go.afp").run(until=6.0).ending == "error"
        """
    )
    result = project.runpytest("--no-afp")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["*timeline of <Simulation of Go in *", "*go*ForwardSuccessful*", "log: *simulation-1.mcap"])


def test_workers_share_scenarios(project: pytest.Pytester) -> None:
    pytest.importorskip("xdist")
    project.runpytest_subprocess("-n", "2", "-q").assert_outcomes(passed=1, failed=1)


def test_shipped_scenarios_agree_with_the_engine() -> None:
    plan = afp.load(Path(__file__).resolve().parents[2] / "plans/tests/wall_following.afp")
    scenario = plan.scenarios[0]
    verdict = scenario.run()
    assert verdict.passed and not verdict.broken and verdict.report == ""
    assert verdict.trace_hash == scenario.run().trace_hash

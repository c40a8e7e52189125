"""Sweeps: the grid, resuming, components in Python, tables."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import afp
from afp.sweeps import Spec
from conftest import interrupted

GO = "use carbot\nplan Go { in way: length = 20 cm start go actor go: Forward(distance = way) { ForwardSuccessful -> terminate } }"


def rows(runs: afp.Runs) -> list[dict[str, Any]]:
    return [{**runs[row], "took_s": 0} for row in range(len(runs))]


def test_every_combination_is_a_row_with_its_command() -> None:
    vary = {"way": [afp.cm(10), 0.2, "30cm"]}
    runs = afp.sweep(afp.Plan(GO), ["random:1", "random:2"], range(3, 5), vary, until=5.0, progress=False)
    assert len(runs) == 12 and runs.columns["run"] == list(range(12))
    assert runs.columns["way"][::2] == ["0.1m", "0.2m", "30cm"] * 2
    assert runs.columns["way_si"][:6:2] == [0.1, 0.2, 0.3]
    wanted = "afpc run plan.afp --world random:2 --seed 4 --set way=30cm --until 5s  # the plan has no file"
    assert runs[11]["command"] == wanted
    assert sum(runs.endings.values()) == 12 and sum(group["count"] for group in runs.groups) == 12


def test_a_range_equals_the_range_of_the_command_line() -> None:
    runs = afp.sweep(afp.Plan(GO), vary={"way": "10cm..30cm:10cm"}, until=5.0, progress=False)
    assert runs.columns["way_si"] == [0.1, 0.2, 0.3]


def test_a_row_is_the_run_of_a_simulation(wall_following: afp.Plan) -> None:
    runs = afp.sweep(wall_following, seeds=range(5, 7), vary={"walldist": ["35cm"]}, until=5.0, progress=False)
    alone = afp.Simulation(wall_following, seed=6, set={"walldist": "35cm"}).run(until=5.0)
    assert runs[1]["trace"] == alone.trace_hash


def test_each_run_has_its_presses_and_faults(wall_following: afp.Plan) -> None:
    grid: dict[str, Any] = {
        "presses": [afp.Press("escape", at=0.5)],
        "faults": [afp.Fault("ultrasonic", "frozen", at=0.1, lasting=0.1)],
        "until": 2.0,
    }
    runs = afp.sweep(wall_following, progress=False, **grid)
    assert "--press escape@0.5s --fail ultrasonic.frozen@0.1s..0.2s --until 2s" in runs[0]["command"]
    alone = afp.Simulation(wall_following)
    alone.fail(afp.Fault("ultrasonic", "frozen", at=0.1, lasting=0.1))
    alone.press(afp.Press(at=0.5))
    assert runs[0]["trace"] == alone.run(until=2.0).trace_hash and runs.result(0).trace_hash == runs[0]["trace"]


def test_another_start_makes_another_sweep(wall_following: afp.Plan, tmp_path: Path) -> None:
    world = afp.Simulation(wall_following, "random:1", start=(1.0, 1.2, 0.0)).world
    grid: dict[str, Any] = {"until": 0.5, "progress": False, "out": tmp_path / "runs.csv"}
    afp.sweep(wall_following, world, **grid)
    with pytest.raises(afp.AfpError, match="a world has changed since"):
        afp.sweep(wall_following, afp.Simulation(wall_following, "random:1", start=(1.1, 1.2, 0.0)).world, **grid)


def test_jobs_do_not_change_results_and_progress_is_reported() -> None:
    told: list[tuple[int, int]] = []
    one = afp.sweep(afp.Plan(GO), seeds=6, until=5.0, jobs=1, progress=lambda *it: told.append(it))
    four = afp.sweep(afp.Plan(GO), seeds=6, until=5.0, jobs=4, progress=False)
    assert rows(one) == rows(four)
    assert told[-1] == (6, 6) and told == sorted(told)


def test_invalid_arguments_are_refused() -> None:
    plan = afp.Plan(GO)
    with pytest.raises(KeyError, match="no.*'nothing'"):
        afp.sweep(plan, vary={"nothing": [1]}, progress=False)
    with pytest.raises(TypeError, match="'way' is a length in m, not a quantity in rad"):
        afp.sweep(plan, vary={"way": [2, afp.deg(1)]}, progress=False)
    with pytest.raises(ValueError, match="no backend"):
        afp.sweep(plan, backend="slurm")
    with pytest.raises(ValueError, match="no values"):
        afp.sweep(plan, vary={"way": []})
    with pytest.raises(ValueError, match="give their number"):
        afp.sweep(plan, seeds=0)
    with pytest.raises(ValueError, match="no seeds in range"):
        afp.sweep(plan, seeds=range(5, 2))
    with pytest.raises(ValueError, match="jobs is 0; give"):
        afp.sweep(plan, jobs=0)
    with pytest.raises(TypeError, match="the values of 'way'.*NoneType"):
        afp.sweep(plan, vary={"way": [None]})
    with pytest.raises(TypeError, match="needs a Plan, not a str"):
        afp.sweep("go.afp")  # type: ignore[arg-type]
    with pytest.raises(afp.AfpError, match="a sweep has at most 10000000 runs, not 1000000000000"):
        afp.sweep(plan, seeds=10**12)
    with pytest.raises(afp.PlanError):
        afp.sweep(afp.Plan("plan P {"))


def test_a_stopped_sweep_continues(tmp_path: Path) -> None:
    plan, out = afp.Plan(GO), tmp_path / "runs.csv"

    def stop(done: int, total: int) -> None:
        if done >= 3:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        afp.sweep(plan, seeds=64, until=5.0, jobs=1, progress=stop, out=out)
    kept = out.with_suffix(".csv.journal").read_text().splitlines()
    assert 4 <= len(kept) <= 64
    first: list[int] = []
    runs = afp.sweep(plan, seeds=64, until=5.0, progress=lambda done, total: first.append(done), out=out)
    assert first[0] > 3 and rows(runs) == rows(afp.sweep(plan, seeds=64, until=5.0, progress=False))
    assert len(out.read_text().splitlines()) == 65
    with pytest.raises(afp.AfpError, match="belongs to another sweep"):
        afp.sweep(plan, seeds=65, until=5.0, progress=False, out=out)
    assert len(afp.sweep(plan, seeds=2, until=5.0, progress=False, out=out, restart=True)) == 2


def test_outcomes_of_other_processes_count_once() -> None:
    sweeper = Spec(([None], False), (0, 6), [], 5.0, {}).sweeper(afp.Plan(GO))
    lines = sweeper.lines([0, 1, 2])
    beyond = json.dumps({**json.loads(lines[0]), "run": 6})
    assert sweeper.accept([*lines, lines[0], beyond]) == 3
    assert sweeper.accept(lines) == 0 and sweeper.left() == [3, 4, 5]
    sweeper.run([3])
    assert sweeper.accept(sweeper.lines([3, 4])) == 1 and sweeper.left() == [5]
    assert len(sweeper.columns()["run"][0]) == 5


def test_the_description_of_a_sweep_is_short_for_many_seeds() -> None:
    def identity(last: int) -> str:
        return Spec(([None], False), [*range(0, 30_000, 3), last], [], 5.0, {}).sweeper(afp.Plan(GO)).identity

    assert identity(30_001) == identity(30_001) != identity(30_002)
    assert len(identity(30_001)) < 300


def test_the_command_line_continues_a_sweep_of_python(tmp_path: Path, afpc: str) -> None:
    file, out = tmp_path / "go.afp", tmp_path / "runs.csv"
    file.write_text(GO)
    afp.sweep(afp.load(file), seeds=4, until=5.0, progress=False, out=out)
    command = [afpc, "sweep", str(file), "--seeds", "0..4", "--until", "5s", "-o", str(out), "--json"]
    told = subprocess.run(command, check=True, capture_output=True, text=True)
    assert "all 4 runs are done" in told.stderr
    *rows, account = [json.loads(line) for line in told.stdout.splitlines()]
    assert len(rows) == account["summary"]["runs"] == 4


def test_components_in_python_take_turns() -> None:
    threads: set[int] = set()
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    async def Wait(robot: afp.Robot, time: afp.Duration) -> str:
        threads.add(threading.get_ident())
        while robot.time < time:
            await afp.tick()
        if robot.time > 0.5:
            raise RuntimeError("too late")
        return "Done"

    text = "use tools plan P { in t: duration = 1 s start go actor go: Wait(time = t) { Done -> terminate } }"
    plan = afp.Plan(text, toolboxes=[tools])
    runs = afp.sweep(plan, seeds=4, vary={"t": [0.1, 1]}, jobs=2, until=2.0, progress=False)
    assert runs.columns["ending"] == ["ok"] * 4 + ["error"] * 4
    assert "python-exception" in runs[7]["why"]
    assert threading.get_ident() not in threads


def test_runs_that_never_started_have_no_duration() -> None:
    runs = afp.sweep(afp.Plan(GO), seeds=2, until=0.5, progress=False)
    assert [str(took) for took in runs.columns["contacts_s"]] == ["0.0", "0.0"]


def test_ctrl_c_stops_a_sweep() -> None:
    begun = time.monotonic()
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        afp.sweep(afp.Plan(GO.replace("20 cm", "-0.001 mm").replace("terminate", "go")), seeds=100_000, until=600.0, jobs=2, progress=False)
    assert time.monotonic() - begun < 10.0


def test_ctrl_c_stops_a_sweep_whose_component_hangs() -> None:
    tools = afp.Toolbox("tools")

    @tools.actor(states=["Done"])
    class Hangs:
        def poll(self) -> str:
            while True:
                pass

    plan = afp.Plan("use tools\nplan P { start go actor go: Hangs { Done -> terminate } }", toolboxes=[tools])
    assert interrupted(lambda: afp.sweep(plan, seeds=8, jobs=2, progress=False)) < 5.0


def test_ctrl_c_ends_a_component_that_blocks_outside_of_python() -> None:
    tools = afp.Toolbox("tools")
    blocked = threading.Event()

    @tools.actor(states=["Done"])
    class Sleeps:
        def poll(self) -> str:
            blocked.set()
            time.sleep(30.0)
            return "Done"

    plan = afp.Plan("use tools\nplan P { start go actor go: Sleeps { Done -> terminate Error -> go } }", toolboxes=[tools])
    assert interrupted(lambda: afp.sweep(plan, seeds=8, jobs=2, progress=False)) < 5.0
    assert blocked.is_set()
    assert len(afp.sweep(afp.Plan(GO), seeds=2, until=1.0, progress=False)) == 2, "another sweep is not in its way"


def test_tables(tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    parquet = pytest.importorskip("pyarrow.parquet")
    out = tmp_path / "runs.parquet"
    runs = afp.sweep(afp.Plan(GO), seeds=3, until=5.0, progress=False, out=out)
    table = runs.to_arrow()
    assert table.num_rows == 3 and str(table.schema.field("seed").type) == "uint64"
    assert parquet.read_table(out).to_pydict() == table.to_pydict()
    frame = runs.to_pandas()
    assert list(frame["run"]) == [0, 1, 2] and frame["contacts_s"].dtype == "float64"
    assert "<table>" in runs._repr_html_() and "3 ok" in repr(runs)
    pytest.importorskip("matplotlib").use("agg")
    assert runs.plot("seed", "distance_m").get_ylabel() == "distance [m]"
    with pytest.raises(KeyError, match="no column"):
        runs.plot("nothing")


def test_a_command_notes_its_differences(wall_following: afp.Plan) -> None:
    def command(plan: afp.Plan) -> str:
        runs = afp.sweep(plan, worlds="random:1", until=0.5, progress=False)
        [row] = list(runs)
        return str(row["command"])

    assert "#" not in command(wall_following)
    wall_following.set_entry_value("walldist", afp.cm(31))
    assert command(wall_following).endswith("  # the plan has unsaved changes")
    assert command(afp.Plan(wall_following.text)).endswith("  # the plan has no file")
    tools = afp.Toolbox("tools")
    with_python = afp.Plan(wall_following.text, toolboxes=(tools,))
    assert command(with_python).endswith("  # the plan has components in Python: run it in Python")


def test_the_bar_is_drawn_ten_times_a_second_and_at_the_end() -> None:
    from afp.progress import Bar

    shown: list[tuple[str, bool]] = []
    clock = iter(number / 100 for number in range(10_000))
    bar = Bar(lambda line, last: shown.append((line, last)), lambda: next(clock))
    for done in range(1, 201):
        bar(done, 200)
    bar(-1, 200)
    assert 15 <= len(shown) <= 40
    assert shown[0][0].endswith(" 1 of 200 runs") and shown[-1] == ("█" * 30 + " 200 of 200 runs", True)
    assert [last for _, last in shown[:-1]] == [False] * (len(shown) - 1)

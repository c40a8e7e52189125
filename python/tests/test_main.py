"""`python -m afp` is the command line."""

from __future__ import annotations

import importlib.metadata
import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest


def run(*arguments: str, path: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PATH": path}
    return subprocess.run([sys.executable, "-m", "afp", *arguments], env=environment, capture_output=True, text=True, check=False)


@pytest.mark.skipif(sys.platform == "win32", reason="the program is a shell script")
def test_arguments_and_exit_codes_are_forwarded(tmp_path: Path) -> None:
    program = tmp_path / "afpc"
    program.write_text('#!/bin/sh\necho "$@"\nexit 3\n', encoding="ascii")
    program.chmod(0o755)
    done = run("run", "my plan.afp", path=str(tmp_path))
    assert (done.returncode, done.stdout) == (3, "run my plan.afp\n")


@pytest.mark.skipif(shutil.which("afpc", path=sysconfig.get_path("scripts")) is not None, reason="the command line is installed")
def test_a_package_without_the_command_line_reports_it(tmp_path: Path) -> None:
    done = run("--version", path=str(tmp_path))
    assert done.returncode == 2 and "built without the command line 'afpc'" in done.stderr


def test_the_package_has_its_licences_and_readme() -> None:
    about = importlib.metadata.distribution("action-flow-plans")
    assert about.metadata["License-Expression"] == "MIT OR Apache-2.0"
    assert {"LICENSE-APACHE", "LICENSE-MIT"} <= {file.name for file in about.files or []}
    assert "afp.new_plan" in str(about.metadata.get_payload())

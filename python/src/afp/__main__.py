"""`python -m afp`: the command line `afpc` of this environment."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import sysconfig


def find() -> str | None:
    """The program, next to this Python or on the path."""
    return shutil.which("afpc", path=sysconfig.get_path("scripts")) or shutil.which("afpc")


def main() -> int:
    """Run the command line with the arguments of this program."""
    program = find()
    if program is None:
        print("error: this package was built without the command line 'afpc'", file=sys.stderr)
        print("  help: install a wheel of the project, or run 'cargo install --path crates/afpc --features full'", file=sys.stderr)
        return 2
    if os.name == "posix":
        os.execv(program, ["afpc", *sys.argv[1:]])
    return subprocess.call([program, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())

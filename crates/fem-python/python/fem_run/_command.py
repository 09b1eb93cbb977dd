"""The command ``fem-run`` of this wheel."""

from __future__ import annotations

import sys

from . import _native


def main() -> None:
    """Runs the command line and ends the process."""
    sys.exit(_native.run_command(["fem-run", *sys.argv[1:]]))

"""The repository's cases, and the command of the same wheel."""

import pathlib
import shutil
import subprocess
import sys

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[3]
COARSE = {"mesh.contact_element_size": 90e-6}


@pytest.fixture(scope="session")
def glass():
    return ROOT / "cases" / "glass_0.5ms.toml"


@pytest.fixture(scope="session")
def command():
    beside = pathlib.Path(sys.executable).parent / "fem-run"
    program = str(beside) if beside.exists() else shutil.which("fem-run")

    def run(*words, cwd=None, check=True):
        ran = subprocess.run([program, *map(str, words)], cwd=cwd, capture_output=True, text=True)
        assert not check or ran.returncode == 0, ran.stderr
        return ran

    return run

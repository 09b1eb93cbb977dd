"""What the studies of random scenes share: quiet runs of a case, and rows of a table until the time is over."""

import csv
import json
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

QUANTITIES = [
    "restitution",
    "contact_time_s",
    "peak_force_n",
    "max_approach_m",
    "max_contact_radius_m",
    "peak_pressure_pa",
]
QUIET = ["output.report=false", "output.snapshots=[]"]


def bodies(lower, material, diameter, speed):
    """Returns the tables of a ball that strikes another body from above, m and m/s."""
    return f"""
[[body]]
name = "lower"
{lower}
[[body]]
name = "upper"
sphere = {{ diameter = "{diameter:.5g} m" }}
material = "{material}"
approach_speed = "{speed:.5g} m/s"
"""


def bars(summary, key):
    """Returns the parts of the error bar of a quantity."""
    uncertainty = summary["uncertainty"]
    return uncertainty.get(key) or uncertainty.get(key.rsplit("_", 1)[0]) or {}


def run(program, folder, overrides, longest=150):
    """Returns the summary, or how the run ended without one within so many seconds."""
    sets = [word for override in QUIET + overrides for word in ("--set", override)]
    command = [program, folder / "case.toml", "--out", folder / "out", "--force", "--quiet", *sets]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=longest)
    except subprocess.TimeoutExpired:
        return None, f"longer than {longest} s"
    if done.returncode:
        return None, " ".join(done.stderr.split())[:200]
    return json.loads((folder / "out" / "summary.json").read_text()), ""


def study(scene, compare, head):
    """Writes the rows of `compare(program, folder)` behind what `scene()` drew, for the words PROGRAM SEED MINUTES."""
    program, seed, minutes = sys.argv[1:]
    random.seed(int(seed))
    rows, end = csv.writer(sys.stdout), time.time() + 60 * float(minutes)
    rows.writerow(["scene", *head])
    number = 0
    with tempfile.TemporaryDirectory() as folder:
        while time.time() < end:
            number += 1
            drawn, case = scene()
            (Path(folder) / "case.toml").write_text(case)
            for row in compare(program, Path(folder)):
                rows.writerow([f"{seed}.{number}", *drawn, *row])
            sys.stdout.flush()

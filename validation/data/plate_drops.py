"""Makes plate_drops.csv: the instants at which a polymer ball, dropped from 20 cm, touches a steel plate.

    python3 validation/data/plate_drops.py FEM_RUN > plate_drops.csv

Restitutions and contact times at 24 speeds are those of cases/polymer_drop.toml by the program FEM_RUN. Between the bounces the ball
flies in air: gravity, buoyancy, added mass and the drag of a smooth sphere (Clift & Gauvin 1970), integrated in steps of 20 us.
The instants have normal noise of 30 us.
"""

import csv
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

CASE = Path(__file__).parents[2] / "cases" / "polymer_drop.toml"
DIAMETER, DENSITY, HEIGHT, GRAVITY = 20e-3, 1190.0, 0.2, 9.80665
AIR_DENSITY, AIR_VISCOSITY = 1.204, 1.81e-5
NOISE, N_BOUNCES, STEP, SEED = 30e-6, 16, 20e-6, 1


def impacts(program: str) -> list[tuple[float, float, float]]:
    """Returns speed (m/s), restitution and contact time (s) by the program."""
    speeds = [0.1 * (2.1 / 0.1) ** (k / 23) for k in range(24)]
    with tempfile.TemporaryDirectory() as folder:
        sweep = Path(folder, "sweep.toml")
        sweep.write_text(f'case = "{CASE}"\n[vary]\n"body.1.approach_speed" = {speeds}\n', encoding="utf-8")
        out = Path(folder, "out")
        subprocess.run([program, "sweep", sweep, "--out", out, "--quiet"], check=True, stderr=subprocess.DEVNULL)
        with open(out / "sweep.csv", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    keys = ("body.1.approach_speed", "restitution", "contact_time_s")
    return [tuple(float(row[key]) for key in keys) for row in rows]


def at(speed: float, table: list[tuple[float, float, float]]) -> tuple[float, float]:
    """Interpolates restitution and contact time in the logarithm of the speed."""
    above = next(k for k in range(1, len(table)) if speed <= table[k][0] or k == len(table) - 1)
    (v1, *low), (v2, *high) = table[above - 1], table[above]
    share = math.log(speed / v1) / math.log(v2 / v1)
    return tuple(a + share * (b - a) for a, b in zip(low, high))


def acceleration(speed: float) -> float:
    """Returns the upward velocity's rate of change, m/s^2."""
    ratio = AIR_DENSITY / DENSITY
    reynolds = max(AIR_DENSITY * abs(speed) * DIAMETER / AIR_VISCOSITY, 1e-9)
    drag = 24 / reynolds * (1 + 0.15 * reynolds**0.687) + 0.42 / (1 + 42500 * reynolds**-1.16)
    weight = GRAVITY * (1 - ratio)
    return -(weight + 0.75 * ratio * drag * speed * abs(speed) / DIAMETER) / (1 + 0.5 * ratio)


def fly(height: float, speed: float) -> tuple[float, float]:
    """Returns duration and landing speed of a flight from a height with an upward speed, by the midpoint rule."""
    time = 0.0
    while True:
        middle = speed + 0.5 * STEP * acceleration(speed)
        faster = speed + STEP * acceleration(middle)
        lower = height + STEP * middle
        if lower <= 0.0 and middle < 0.0:
            share = height / (height - lower)
            return time + share * STEP, -(speed + share * (faster - speed))
        time, height, speed = time + STEP, lower, faster


def main() -> None:
    """Prints the table."""
    table, noise = impacts(sys.argv[1]), random.Random(SEED)
    time, speed = fly(HEIGHT, 0.0)
    print("# Made, not measured: cases/polymer_drop.toml from 20 cm in air, with normal noise of 30 us, by plate_drops.py.")
    print("time_s")
    for _ in range(N_BOUNCES):
        print(f"{time + noise.gauss(0.0, NOISE):.6f}")
        restitution, contact_time = at(speed, table)
        flight, speed = fly(0.0, restitution * speed)
        time += contact_time + flight


main()

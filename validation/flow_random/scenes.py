#!/usr/bin/env python3
"""Error bars of random bodies that flow: scenes.py FEM-RUN SEED MINUTES > SEED.csv

Draws scenes until the time is over: sizes, moduli, yield strength, hardening, partner and speed, from 0.5 to 3000 times
that of first yield and at most a twentieth of the speed of sound. Each is run with a tolerance of 3 %, and again with
elements half as large, whose difference is compared with the error bar (`discretisation`). A row has the scene, how
the runs ended, and for each quantity its value, the reference and the bar. scenes.csv
has the rows of seeds 12 and 13, 14 minutes each, of numerics b1333db58a78e95c on a machine of 2 cores.
"""

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
LONGEST = 150


def scene():
    """Returns what was drawn, and the case."""
    modulus, strength_ratio = 10 ** random.uniform(9.5, 11.5), 10 ** random.uniform(1.5, 3)
    nu, density, diameter = random.uniform(0.2, 0.45), random.uniform(1500, 9000), 10 ** random.uniform(-4, -1.3)
    strength, plane = modulus / strength_ratio, modulus / (1 - nu**2)
    first_yield = 5.1 * (strength**5 / (plane**4 * density)) ** 0.5
    speed = min(first_yield * 10 ** random.uniform(-0.3, 3.48), 0.05 * (modulus / density) ** 0.5)
    hardening = random.choice(["perfect", "linear", "swift"])
    rule = {
        "perfect": '"perfect"',
        "linear": f'{{ modulus = "{random.uniform(0, 0.05) * modulus:.5g} Pa" }}',
        "swift": "{ swift = { strain = 0.002, exponent = 0.2 } }",
    }[hardening]
    size = f"sphere = {{ diameter = '{diameter * random.uniform(0.3, 3):.5g} m' }}"
    partner = random.choice(["wall", "elastic block", "flowing block", "twin", "elastic ball", "flowing ball"])
    lower = {
        "wall": "wall = {}",
        "elastic block": "half_space = {}\nmaterial = 'elastic'",
        "flowing block": "half_space = {}\nmaterial = 'metal'",
        "twin": f"sphere = {{ diameter = '{diameter:.5g} m' }}\nmaterial = 'metal'",
        "elastic ball": f"{size}\nmaterial = 'elastic'",
        "flowing ball": f"{size}\nmaterial = 'metal'",
    }[partner]
    case = f"""
material.metal.density = "{density:.5g} kg/m^3"
material.metal.youngs_modulus = "{modulus:.5g} Pa"
material.metal.poissons_ratio = {nu:.4g}
material.metal.flow = {{ yield_strength = "{strength:.5g} Pa", hardening = {rule} }}
material.elastic.density = "4000 kg/m^3"
material.elastic.youngs_modulus = "{modulus * random.uniform(0.5, 8):.5g} Pa"
material.elastic.poissons_ratio = 0.25
accuracy.tolerance = "3 %"
[[body]]
name = "lower"
{lower}
[[body]]
name = "upper"
sphere = {{ diameter = "{diameter:.5g} m" }}
material = "{"elastic" if partner == "flowing block" else "metal"}"
approach_speed = "{speed:.5g} m/s"
"""
    return [partner, hardening, f"{speed / first_yield:.3g}", f"{strength_ratio:.0f}"], case


def run(program, folder, overrides):
    """Returns the summary, or how the run ended without one."""
    sets = [word for override in QUIET + overrides for word in ("--set", override)]
    command = [program, folder / "case.toml", "--out", folder / "out", "--force", "--quiet", *sets]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return None, f"longer than {LONGEST} s"
    if done.returncode:
        return None, " ".join(done.stderr.split())[:200]
    return json.loads((folder / "out" / "summary.json").read_text()), ""


def compare(program, folder):
    ours, why = run(program, folder, [])
    if ours is None:
        return [why]
    size = ours["case"]["mesh"]["contact_element_size"]
    finer, why = run(program, folder, [f"mesh.contact_element_size={size / 2}", "accuracy.tolerance=0.5"])
    if finer is None:
        return ["reference: " + why]
    row, outside = [], []
    for key in QUANTITIES:
        parts = ours["uncertainty"].get(key) or ours["uncertainty"].get(key.rsplit("_", 1)[0]) or {}
        bar = parts.get("discretisation")
        row += [ours[key], finer[key], bar]
        if None not in row[-3:] and abs(ours[key] - finer[key]) > bar:
            outside.append(key)
    return [" ".join(outside) or "inside", f"{ours['energy']['residual_relative']:.1e}", *row]


def main(program, seed, minutes):
    random.seed(int(seed))
    rows, end = csv.writer(sys.stdout), time.time() + 60 * float(minutes)
    values = [f"{key}{part}" for key in QUANTITIES for part in ("", "_reference", "_bar")]
    head = ["scene", "partner", "hardening", "v_over_v_y", "e_over_y", "outcome", "energy_residual", *values]
    rows.writerow(head)
    number = 0
    with tempfile.TemporaryDirectory() as folder:
        while time.time() < end:
            number += 1
            drawn, case = scene()
            (Path(folder) / "case.toml").write_text(case)
            rows.writerow([f"{seed}.{number}", *drawn, *compare(program, Path(folder))])
            sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])

#!/usr/bin/env python3
"""Warnings of default runs, and their remedies followed: warnings.py FEM-RUN > warnings.csv

Each material of the library collides in seven arrangements, with all defaults. Each warning's remedy is followed by the
rule of its kind below, together with those of the run's other warnings, until none is left; a row has the scene, how
many warnings the run had, the kinds, and what was left after the remedies.
"""

import csv
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from scenes import run

ARRANGEMENTS = [
    ("wall", "0.1 m/s", "10 mm"),
    ("wall", "1 m/s", "10 mm"),
    ("block of steel", "0.5 m/s", "10 mm"),
    ("block", "0.2 m/s", "20 mm"),
    ("twin", "0.1 m/s", "10 mm"),
    ("twin", "1 m/s", "3 mm"),
    ("ball of bearing-steel", "0.3 m/s", "10 mm"),
]


def case(material, partner, speed, diameter):
    ball = f"sphere = {{ diameter = '{diameter}' }}"
    shape, _, other = partner.partition(" of ")
    lower = {"wall": "wall = {}", "block": "half_space = {}", "twin": ball, "ball": ball}[shape]
    lower += f"\nmaterial = 'lib:{other or material}'" * (shape != "wall")
    return f"""
[[body]]
name = "lower"
{lower}
[[body]]
name = "ball"
{ball}
material = "lib:{material}"
approach_speed = "{speed}"
"""


def remedies(warning, summary):
    """Returns the overrides that a warning asks for; none for a warning without a rule here."""
    bodies = {body["name"]: body.get("material") for body in summary["case"]["body"]}
    materials = summary["case"]["material"]
    if "the damping of" in warning:
        return [f"{re.search('or (material.*[.]elastic) = true', warning)[1]}=true"]
    if given := re.search("no rate dependence of (.*) is given", warning):
        rate = "flow.rate.johnson_cook={ c = 0, reference_rate = 1 }"
        return [f"material.'{bodies[given[1]]}'.{rate}"]
    if given := re.search(r'set (mesh\.\w+) = "(.*?)"', warning):
        return [f"{given[1]}='{given[2]}'"]
    if "force finite strain on" in warning:
        return ["effects.finite_strain='on'"]
    if "set material.NAME.hyperelastic" in warning:
        return [f"material.'{name}'.hyperelastic='neo-hooke'" for name in materials if "flow" not in materials[name]]
    return []


def main(program):
    listed = subprocess.run([program, "materials"], capture_output=True, text=True, check=True).stdout
    names = [line.split()[0] for line in listed.splitlines()[1:] if line[:1].islower()]
    rows = csv.writer(sys.stdout)
    rows.writerow(["material", "partner", "speed", "diameter", "warnings", "first", "left", "rounds"])
    with tempfile.TemporaryDirectory() as folder:
        for name in names:
            for arrangement in ARRANGEMENTS:
                (Path(folder) / "case.toml").write_text(case(name, *arrangement))
                overrides, rounds, first = [], 0, None
                while True:
                    summary, why = run(program, Path(folder), overrides, 30)
                    warnings = [why] if summary is None else summary["warnings"]
                    first = warnings if first is None else first
                    more = [new for one in warnings if summary for new in remedies(one, summary)]
                    more = [new for new in dict.fromkeys(more) if new not in overrides]
                    if not more or rounds == 5:
                        break
                    overrides, rounds = overrides + more, rounds + 1
                rows.writerow([name, *arrangement, len(first), " | ".join(first), " | ".join(warnings), rounds])
                sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])

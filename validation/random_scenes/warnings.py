#!/usr/bin/env python3
"""Warnings of default runs, and their remedies followed: warnings.py FEM-RUN > warnings.csv

Each material of the library collides in seven arrangements, with all defaults. Each warning's remedy is followed by the
rule of its kind below, together with those of the run's other warnings, until none is left; a row has the scene, how
many warnings the run had, the kinds, and what was left after the remedies.
"""

import csv
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
PERFECT = "{{ yield_strength = '{}' }}"


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
    named = [f"material.'{material}'" for name, material in bodies.items() if material and name in warning.split(": ")[0]]
    materials = summary["case"]["material"]

    def strength(key):
        given = materials[key.split("'")[1]].get("yield_strength", 5e7)
        return f"{given['value'] if isinstance(given, dict) else given} Pa"

    if "which is softer, its material.NAME.yield_strength" in warning:
        softer = bodies[warning.split("plastic flow give ")[1].split(",")[0]]
        return [f"material.'{softer}'.yield_strength='50 MPa'"]
    if "in place of its relaxation" in warning:
        return [
            override
            for k, body in enumerate(summary["case"]["body"])
            if f"material.'{body.get('material')}'" in named
            for override in (f"body.{k}.material='own'", f"material.own={flowing(materials[body['material']])}")
        ]
    if "computes plastic flow" in warning:
        return [f"{key}.flow={PERFECT.format(strength(key))}" for key in named]
    if "set material.NAME.flow.rate" in warning:
        rate = "flow.rate.johnson_cook={ c = 0, reference_rate = 1 }"
        return [f"material.'{name}'.{rate}" for name, material in materials.items() if "flow" in material]
    if 'set mesh.contact_element_size = "' in warning:
        return [f"mesh.contact_element_size='{warning.split('set mesh.contact_element_size = ')[1].split(chr(34))[1]}'"]
    if "set material.NAME.hyperelastic" in warning:
        return [f"material.'{name}'.hyperelastic='neo-hooke'" for name in materials if "flow" not in materials[name]]
    return []


def flowing(material):
    """Returns the table of a material that flows in place of its relaxation."""
    keys = ["density", "youngs_modulus", "shear_modulus", "bulk_modulus", "poissons_ratio", "yield_strength"]
    given = {key: material[key] for key in keys if key in material}
    values = {key: value["value"] if isinstance(value, dict) else value for key, value in given.items()}
    strength = values.pop("yield_strength")
    table = ", ".join(f"{key} = {value}" for key, value in values.items())
    return f"{{ {table}, flow = {PERFECT.format(f'{strength} Pa')} }}"


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

"""Computes plate_map.csv: impacts of elastic balls on elastic plates by explicit elements, beside thin-plate theory.

    python3 validation/data/plate_map.py FEM_RUN [--plates NAME ...] > plate_map.csv

The plates are unbounded and free below. Every impact runs on two meshes, with 6 and 12 elements across the contact radius of
Hertz; the second also has twice as many elements through the plate. The values are those of the finer mesh, and the difference
between both is the error bar. FEM_RUN is the program.

The columns `lambda` and `wave_travel` are Zener's number and the distance that waves of the speed sqrt(E/rho) of the plate travel
in Hertz' contact time, over the thickness. `thin` is the restitution of the model ting with the dashpot of a thin plate.
"""

import argparse
import concurrent.futures
import csv
import json
import math
import os
import subprocess
import sys

ACROSS = [6.0, 12.0]
# Young's modulus (Pa), density (kg/m^3), Poisson's ratio.
MATERIALS = {
    "steel": (210e9, 7800.0, 0.3),
    "steel, nu 0.15": (210e9, 7800.0, 0.15),
    "steel, nu 0.45": (210e9, 7800.0, 0.45),
    "aluminium": (70e9, 2700.0, 0.33),
    "glass": (63e9, 2390.0, 0.24),
    "polymer": (5.4e9, 1190.0, 0.36),
    "carbide": (600e9, 15000.0, 0.22),
}
THICKNESSES = [0.32, 0.4, 0.6, 0.8, 1.0, 1.4, 2.0, 2.8, 4.0, 5.6, 8.0, 11.2, 16.0, 20.0]
FEW = [0.6, 1.0, 2.0, 4.0, 8.0]
DIAMETER = 10e-3


def scenes():
    """Yields ball, plate, thickness over the radius, speed (m/s)."""
    for name in ["steel", "steel, nu 0.15", "steel, nu 0.45"]:
        for thickness in THICKNESSES:
            yield name, name, thickness, 1.0
    pairs = [("carbide", "steel"), ("steel", "aluminium"), ("steel", "glass"), ("glass", "glass"), ("glass", "aluminium")]
    for ball, plate in pairs:
        for speed in [0.1, 1.0]:
            for thickness in FEW:
                yield ball, plate, thickness, speed
    for thickness in FEW:
        yield "glass", "polymer", thickness, 0.1


def hertz(ball, plate, speed):
    """Returns mass, stiffness, contact time and contact radius."""
    radius = 0.5 * DIAMETER
    mass = ball[1] * math.pi * DIAMETER**3 / 6.0
    modulus = 1.0 / sum((1.0 - nu * nu) / young for young, _, nu in [ball, plate])
    stiffness = 4.0 / 3.0 * modulus * math.sqrt(radius)
    approach = (1.25 * mass * speed**2 / stiffness) ** 0.4
    return mass, stiffness, 3.218065 * (mass / stiffness) ** 0.4 * speed**-0.2, math.sqrt(radius * approach)


def case(ball, plate, thickness, speed, model):
    """Returns the text of a case."""
    text = ""
    for name, (young, density, nu) in [("ball", ball), ("plate", plate)]:
        text += f"[material.{name}]\ndensity = {density}\nyoungs_modulus = '{young} Pa'\npoissons_ratio = {nu}\n"
    return text + (
        f'[[body]]\nname = "plate"\nplate = {{ thickness = "{thickness!r} m" }}\nmaterial = "plate"\n'
        f'[[body]]\nname = "ball"\nsphere = {{ diameter = {DIAMETER} }}\nmaterial = "ball"\napproach_speed = {speed}\n'
        f"[output]\nsnapshots = []\n[model]\n{model}\n"
    )


def run(program, text, name, settings=()):
    """Returns the summary of a case."""
    folder = os.path.join(OUT, name.replace("/", "_"))
    command = [program, "-", "--json", "--quiet", "--force", "--out", folder]
    for setting in settings:
        command += ["--set", setting]
    done = subprocess.run(command, input=text, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{name}: {done.stderr}")
    return json.loads(done.stdout)


def row(program, number, scene):
    """Returns a row of the table."""
    ball_name, plate_name, over_radius, speed = scene
    ball, plate = MATERIALS[ball_name], MATERIALS[plate_name]
    thickness = over_radius * 0.5 * DIAMETER
    mass, stiffness, time, radius = hertz(ball, plate, speed)
    young, density, nu = plate
    rigidity = young * thickness**3 / (12.0 * (1.0 - nu * nu))
    mobility = 1.0 / (8.0 * math.sqrt(rigidity * density * thickness))
    text = case(ball, plate, thickness, speed, "fem = {}")
    found = [
        run(program, text, f"{number}_{k}", [f"mesh.contact_element_size={radius / k}", "accuracy.tolerance='10 %'"])
        for k in ACROSS
    ]
    thin = run(program, case(ball, plate, thickness, speed, "ting = {}"), f"{number}_thin", ["effects.plate_bending='on'"])
    coarse, fine = found
    values = {
        "ball": ball_name,
        "plate": plate_name,
        "speed_m_s": speed,
        "nu": nu,
        "thickness_over_radius": over_radius,
        "lambda": mobility * mass * (stiffness / mass) ** 0.4 * speed**0.2,
        "wave_travel": math.sqrt(young / density) * time / thickness,
        "contact_radius_over_thickness": radius / thickness,
        "restitution": fine["restitution"],
        "restitution_error": abs(fine["restitution"] - coarse["restitution"]),
        "thin": thin["restitution"],
        "contact_time_over_hertz": fine["contact_time_s"] / fine["hertz"]["contact_time_s"],
        "contact_time_error": abs(fine["contact_time_s"] - coarse["contact_time_s"]) / fine["hertz"]["contact_time_s"],
        "peak_force_over_hertz": fine["peak_force_n"] / fine["hertz"]["peak_force_n"],
        "peak_force_error": abs(fine["peak_force_n"] - coarse["peak_force_n"]) / fine["hertz"]["peak_force_n"],
        "contact_episodes": fine["contact_episodes"],
        "seconds": sum(each["cost"]["wall_s"] for each in found),
    }
    return {key: value if isinstance(value, str) else f"{value:.6g}" for key, value in values.items()}


def main():
    global OUT
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--plates", nargs="*", help="only these plates")
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--out", default="runs/plate_map", help="folder of the runs")
    arguments = parser.parse_args()
    OUT = arguments.out
    chosen = [scene for scene in scenes() if not arguments.plates or scene[1] in arguments.plates]
    with concurrent.futures.ThreadPoolExecutor(arguments.workers) as pool:
        rows = pool.map(lambda pair: row(arguments.program, *pair), enumerate(chosen))
        for k, values in enumerate(rows):
            writer = csv.DictWriter(sys.stdout, values.keys(), lineterminator="\n")
            if k == 0:
                writer.writeheader()
            writer.writerow(values)
            sys.stdout.flush()


if __name__ == "__main__":
    main()

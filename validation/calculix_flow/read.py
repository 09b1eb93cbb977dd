#!/usr/bin/env python3
"""Numbers of the scenes of felupe_flow from what CalculiX left of a deck.py: read.py SCENE CELLS NAME.dat

The force over time gives restitution, travel of the mass centre and contact time. Plastic work is Y times the
integral of the equivalent plastic strain, which is exact without hardening. The dent is how much the pole has come
closer to the mass centre, in the mean over the time after the contact.
"""

import math
import sys

from deck import RADIUS, SCENES, WEDGE, mesh, volumes


def tables(name):
    """Times, forces and displacements of the pole, and the plastic strain at each point at the end."""
    times, forces, pole, strains, kind = [0.0], [0.0], [0.0], {}, ""
    for line in open(name):
        words = line.split()
        if not words:
            continue
        if "time" in words:
            kind = " ".join(words[:2])
            if kind == "equivalent plastic":
                strains = {}
            elif kind == "displacements (vx,vy,vz)":
                times.append(float(words[-1]))
        elif kind == "displacements (vx,vy,vz)":
            pole.append(float(words[3]))
        elif kind == "total force":
            forces.append(float(words[2]))
        elif kind == "equivalent plastic":
            strains[int(words[0]), int(words[1])] = float(words[2])
    return times, forces, pole, strains


def numbers(scene, cells, name):
    material, speed, _ = SCENES[scene]
    times, forces, pole, strains = tables(name)
    # All of one radian of the ball; an element has two layers of four points.
    mass, parts = material["density"] * 2 / 3 * RADIUS**3, volumes(*mesh(scene, cells))
    energy = 0.5 * mass * speed**2
    forces = [force / math.sin(WEDGE) for force in forces]
    layers = (strains[k // 4 + 1, k % 4 + layer] for k in range(len(parts)) for layer in (1, 5))
    work = material["strength"] * sum(0.5 * p * parts[k // 2] for k, p in enumerate(layers))
    travel, impulse = [0.0], 0.0
    for k in range(1, len(times)):
        dt = times[k] - times[k - 1]
        before, impulse = impulse, impulse + 0.5 * dt * (forces[k] + forces[k - 1])
        travel.append(travel[-1] + dt * (speed - 0.5 * (before + impulse) / mass))
    last = max(k for k, force in enumerate(forces) if force > 0)
    after = range(last + 1, len(times))
    dents = [pole[k] + travel[k] for k in after]
    spans = [times[k] - times[k - 1] for k in after]
    return {
        "restitution": impulse / (mass * speed) - 1,
        "contact time us": 1e3 * times[last],
        "travel um": 1e3 * max(travel),
        "plastic work": work / energy,
        "dent um": 1e3 * sum(d * s for d, s in zip(dents, spans)) / sum(spans),
        "peak force N": 2 * math.pi * max(forces),
        "steps": len(times),
    }


if __name__ == "__main__":
    for name, value in numbers(sys.argv[1], float(sys.argv[2]), sys.argv[3]).items():
        print(f"{name} {value:.6g}")

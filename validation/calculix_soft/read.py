#!/usr/bin/env python3
"""Numbers of a claim from what CalculiX left of an impact.py, or from lines of time and force: read.py SCENE NAME

From the contact force F(t) alone: restitution and approach of the mass centres are its integrals, the width is
that at a tenth of its largest value, and the mean is the largest over a hundredth of that.
"""

import math
import re
import sys

from impact import SCENES, WEDGE


def history(name):
    """Times (ms) and contact forces of the whole body of revolution, N."""
    if not name.endswith(".dat"):
        rows = [tuple(map(float, line.split())) for line in open(name)]
        return [time for time, _ in rows], [force for _, force in rows]
    times, forces, whole = [0.0], [0.0], 360.0 / WEDGE
    lines = iter(open(name))
    time = 0.0
    for line in lines:
        if "force (fx,fy,fz) for set PLATE" in line:
            next(lines)
            times.append(float(line.split()[-1]))
            forces.append(whole * float(next(lines).split()[2]))
        elif "statistics for slave set" in line:
            time = float(line.split()[-1])
        elif "area,  normal force" in line:
            next(lines)
            normal = next(lines).split()[1]
            times.append(time)
            forces.append(0.0 if normal == "NaN" else -whole * float(normal))
    return times, forces


def integral(times, values):
    sums = [0.0]
    for k in range(1, len(times)):
        sums.append(sums[-1] + 0.5 * (values[k] + values[k - 1]) * (times[k] - times[k - 1]))
    return sums


def at(times, values, time):
    """Linear between the times."""
    k = next((k for k in range(1, len(times)) if times[k] >= time), len(times) - 1)
    share = (time - times[k - 1]) / (times[k] - times[k - 1])
    return values[k - 1] + share * (values[k] - values[k - 1])


def numbers(scene, name):
    balls, speed, _ = SCENES[scene]
    masses = [4 / 3 * math.pi * ball.radius**3 * ball.density for ball in balls]
    mass = 1 / sum(1 / m for m in masses)
    times, forces = history(name)
    impulses = integral(times, forces)
    approach = integral(times, [speed - impulse / mass for impulse in impulses])
    tenth = 0.1 * max(forces)
    above = [k for k in range(len(forces)) if forces[k] > tenth]

    def crossing(k):
        share = (tenth - forces[k]) / (forces[k + 1] - forces[k])
        return times[k] + share * (times[k + 1] - times[k])

    width = crossing(above[-1]) - crossing(above[0] - 1)
    window = 0.01 * width
    starts = [0.001 * k * (times[-1] - window) for k in range(1000)]
    means = [(at(times, impulses, t + window) - at(times, impulses, t)) / window for t in starts]
    return {
        "restitution": impulses[-1] / (mass * speed) - 1,
        "approach mm": max(approach),
        "width ms": width,
        "mean force N": max(means),
    }


if __name__ == "__main__":
    for name, value in numbers(*sys.argv[1:]).items():
        print(f"{name} {value:.6g}")

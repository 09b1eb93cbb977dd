"""Computes flow_map.csv: impacts of elastic-plastic spheres by explicit elements, beside Hertz' impact.

    python3 validation/data/flow_map.py FEM_RUN [--scenes NAME ...] [--ratios E*/Y ...] [--speeds FROM TO] > flow_map.csv

Every impact runs on two meshes, with 12 and 24 elements across the contact radius. The restitution converges as 1 + 0.05/k in
k elements, so the values are extrapolated by half of the difference between both meshes, and that half is the error bar. From 300
times the speed of first yield on there is no such trend: the restitution of meshes from 12 to 48 elements scatters by 1.2 %. There
the values are those of the finer mesh, with 48 elements on a wall, and the bars are the difference between both meshes, for the
restitution at least that scatter. Impacts with Swift's law, and those at E*/Y = 5000, have the mesh of the program and its error bars. FEM_RUN is the program. An impact that ends early, because the surface
folds, is left out and reported.
"""

import argparse
import concurrent.futures
import csv
import json
import math
import os
import subprocess
import sys
import tempfile

MESHES, MESHES_OF_FAST_IMPACTS_ON_A_WALL, FAST, SCATTER = [12.0, 24.0], [24.0, 48.0], 300.0, 0.012
MODULUS, DENSITY, DIAMETER = 210e9, 7800.0, 10e-3
SOFTEST = 5000.0
SPEEDS = [1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0]
FINE_SPEEDS = [1.3, 1.7, 2.2, 4.5, 6.5, 17.0, 55.0, 170.0, 550.0]
QUANTITIES = {
    "restitution": "restitution",
    "contact_time": "contact_time_s",
    "peak_force": "peak_force_n",
    "max_approach": "max_approach_m",
    "max_contact_radius": "max_contact_radius_m",
}
# x = E*a/(Y R*), p_m/Y and a^2/(R* delta), as in elastic_plastic_impact.rs: they size the meshes and nothing else.
LOADING = [(2.2, 0.934, 1.0), (3.97, 1.557, 1.048), (7.15, 2.04, 1.207), (22.8, 2.67, 1.688), (76.0, 2.84, 2.241)]


class Body:
    """A ball, a half-space ("block") or a wall, elastic if its strength is None."""

    def __init__(self, shape, strength=1.0, diameter=DIAMETER, modulus=MODULUS, nu=0.3, hardening=0.0, swift=None):
        self.shape, self.strength, self.diameter, self.modulus = shape, strength, diameter, modulus
        self.nu, self.hardening, self.swift = nu, hardening, swift

    def compliance(self):
        return 0.0 if self.shape == "wall" else (1.0 - self.nu**2) / self.modulus

    def curvature(self):
        return 2.0 / self.diameter if self.shape == "ball" else 0.0

    def inverse_mass(self):
        return 6.0 / (math.pi * self.diameter**3 * DENSITY) if self.shape == "ball" else 0.0

    def case(self, name, unit, speed):
        if self.shape == "wall":
            return f'[[body]]\nname = "{name}"\nwall = {{}}\n'
        shape = f"sphere = {{ diameter = {self.diameter!r} }}" if self.shape == "ball" else "half_space = {}"
        text = f"[material.{name}]\ndensity = {DENSITY}\nyoungs_modulus = {self.modulus}\npoissons_ratio = {self.nu}\n"
        if self.strength is not None:
            text += f"[material.{name}.flow]\nyield_strength = {self.strength * unit!r}\n"
            if self.hardening > 0.0:
                text += f"hardening = {{ modulus = {self.hardening * self.modulus!r} }}\n"
            if self.swift:
                text += "hardening = {{ swift = {{ strain = {}, exponent = {} }} }}\n".format(*self.swift)
        text += f'[[body]]\nname = "{name}"\n{shape}\nmaterial = "{name}"\n'
        return text + (f"approach_speed = {speed!r}\n" if speed else "")


def scenes():
    """Yields name, bodies, E*/Y and speeds over that of first yield."""
    wall = Body("wall")
    for ratio in [50.0, 100.0, 230.0, 500.0, 1000.0]:
        yield "wall", wall, Body("ball"), ratio, SPEEDS
    yield "wall", wall, Body("ball"), 1000.0, FINE_SPEEDS
    few = [3.0, 10.0, 100.0, 1000.0]
    for nu in [0.2, 0.4]:
        yield "wall", wall, Body("ball", nu=nu), 230.0, few
    for hardening in [0.01, 0.05, 0.1]:
        yield "wall", wall, Body("ball", hardening=hardening), 230.0, few
    yield "wall", wall, Body("ball"), SOFTEST, [100.0, 1e3, 1e4, 1e5]
    for swift in [(0.002, 0.2), (0.002, 0.5), (0.01, 0.3)]:
        yield "wall", wall, Body("ball", swift=swift), 500.0, [10.0, 100.0, 1000.0]
    yield "wall", wall, Body("ball", swift=(0.0005, 0.3)), 1000.0, [100.0, 3000.0]
    yield "wall", wall, Body("ball", swift=(0.001, 0.1)), 200.0, [30.0, 300.0]
    yield "wall", wall, Body("ball", swift=(0.002, 0.2)), 2000.0, [30.0, 1000.0, 20000.0]
    yield "twins", Body("ball"), Body("ball"), 230.0, few
    yield "radius 3 : 1", Body("ball", diameter=3.0 * DIAMETER), Body("ball"), 230.0, few
    yield "strength 1.5 : 1", Body("ball", strength=1.5), Body("ball"), 230.0, few
    yield "elastic ball", Body("ball", strength=None), Body("ball"), 230.0, few
    yield "modulus 3 : 1", Body("ball", strength=None, modulus=3.0 * MODULUS), Body("ball"), 230.0, few
    yield "elastic ball on block", Body("block"), Body("ball", strength=None), 230.0, few


def largest_von_mises(nu):
    """Returns the largest von Mises stress on the axis of a Hertz contact over p0 (Johnson, eq. 3.45)."""
    depths = (0.001 * k for k in range(1, 1500))
    return max(abs(1.5 / (1.0 + z * z) - (1.0 + nu) * (1.0 - z * math.atan(1.0 / z))) for z in depths)


def loading(x):
    """Returns p_m/Y and a^2/(R* delta) at x."""
    if x <= LOADING[0][0]:
        return LOADING[0][1] * x / LOADING[0][0], 1.0
    for low, high in zip(LOADING, LOADING[1:]):
        if x <= high[0]:
            share = math.log(x / low[0]) / math.log(high[0] / low[0])
            return low[1] + share * (high[1] - low[1]), low[2] + share * (high[2] - low[2])
    return LOADING[-1][1:]


class Impact:
    """The pair of a scene at one speed, with Hertz' impact."""

    def __init__(self, name, first, second, ratio, times):
        self.name, self.first, self.second, self.ratio, self.times = name, first, second, ratio, times
        bodies = [first, second]
        self.modulus = 1.0 / sum(body.compliance() for body in bodies)
        self.radius = 1.0 / sum(body.curvature() for body in bodies)
        self.mass = 1.0 / sum(body.inverse_mass() for body in bodies)
        self.strength = self.modulus / ratio
        self.nu = second.nu
        pressure = self.strength / largest_von_mises(self.nu)
        yields_at = self.radius * (0.5 * math.pi * pressure / self.modulus) ** 2
        work = 8.0 / 15.0 * self.modulus * math.sqrt(self.radius) * yields_at**2.5
        self.speed = times * math.sqrt(2.0 * work / self.mass)
        self.energy = 0.5 * self.mass * self.speed**2
        approach = (15.0 * self.energy / (8.0 * self.modulus * math.sqrt(self.radius))) ** 0.4
        self.hertz = {
            "restitution": 1.0,
            "contact_time": 2.9432750 * approach / self.speed,
            "peak_force": 4.0 / 3.0 * self.modulus * math.sqrt(self.radius) * approach**1.5,
            "max_approach": approach,
            "max_contact_radius": math.sqrt(self.radius * approach),
        }

    def meshes(self):
        """Returns the numbers of elements across the contact radius of both runs; None is the mesh of the program."""
        if self.second.swift or self.ratio == SOFTEST:
            return [None]
        return MESHES_OF_FAST_IMPACTS_ON_A_WALL if self.times >= FAST and self.name == "wall" else MESHES

    def expected_radius(self):
        """Returns the largest contact radius, about, by which the mesh is made."""
        a, work, last = 1e-4 * self.radius, 0.0, (0.0, 0.0)
        while work < self.energy:
            a *= 1.005
            pressure, sink = loading(a * self.ratio / self.radius)
            force = math.pi * a * a * self.strength * pressure * max(0.5, 1.0 - 0.5 * a / self.radius)
            now = (a * a / (self.radius * sink), force)
            work += 0.5 * (now[1] + last[1]) * (now[0] - last[0])
            last = now
        return a

    def run(self, program, elements):
        """Returns the quantities of a run with this number of elements across the contact radius."""
        case = self.first.case("lower", self.strength, 0.0) + self.second.case("upper", self.strength, self.speed)
        if elements:
            case += f"[mesh]\ncontact_element_size = {self.expected_radius() / elements!r}\n"
        case += "[output]\nsnapshots = []\n"
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "case.toml")
            with open(path, "w") as file:
                file.write(case)
            out = os.path.join(folder, "out")
            done = subprocess.run([program, path, "--quiet", "--out", out], capture_output=True, text=True)
            if done.returncode:
                raise RuntimeError(f"{self.name} {self.ratio} {self.times}: {done.stderr}")
            with open(os.path.join(out, "summary.json")) as file:
                summary = json.load(file)
            with open(os.path.join(out, "history.csv")) as file:
                history = list(csv.DictReader(file))
        return self.found(summary, history)

    def found(self, summary, history):
        """Returns the quantities of a summary and a history."""
        found = {key: summary[name] for key, name in QUANTITIES.items()}
        limit = 1e-3 * found["peak_force"]
        touching = [float(row["approach_m"]) for row in history if float(row["contact_force_n"]) > limit]
        found["residual_approach"] = touching[-1]
        dent = max(summary["dent"] or [], key=lambda dent: dent["depth_m"], default=None)
        found["dent_depth"] = dent["depth_m"] if dent else 0.0
        found["dent_crown"] = dent["crown_radius_m"] if dent else math.nan
        found["plastic_strain"] = dent["max_plastic_strain"] if dent else 0.0
        found["locked_in"] = (summary["energy"].get("locked_in_j") or 0.0) / self.energy
        found["seconds"] = summary["cost"]["wall_s"]
        found["bars"] = {key: summary["uncertainty"][name]["discretisation"] for key, name in QUANTITIES.items()}
        return found

    def row(self, coarse, fine=None):
        """Returns the row of both runs, or of one with the mesh of the program."""
        bars = coarse.pop("bars")
        if fine is None:
            return self.row_of(coarse, bars, coarse["seconds"])
        fine.pop("bars")
        share = 0.0 if self.times >= FAST else 0.5
        value = {key: fine[key] + share * (fine[key] - coarse[key]) for key in fine}
        bar = {key: (1.0 - share) * abs(fine[key] - coarse[key]) for key in fine}
        if self.times >= FAST:
            bar["restitution"] = max(bar["restitution"], SCATTER * value["restitution"])
        return self.row_of(value, bar, coarse["seconds"] + fine["seconds"])

    def row_of(self, value, bar, seconds):
        """Returns the row of quantities with their error bars."""
        row = {
            "scene": self.name,
            "nu": self.nu,
            "hardening_over_modulus": self.second.hardening,
            "swift_strain": (self.second.swift or (1.0, 0.0))[0],
            "swift_exponent": (self.second.swift or (1.0, 0.0))[1],
            "modulus_over_strength": self.ratio,
            "speed_over_yield_speed": self.times,
            "speed_m_s": self.speed,
        }
        for key, hertz in self.hertz.items():
            row[f"{key}_over_hertz"] = value[key] / hertz
            row[f"{key}_error"] = bar[key] / hertz
        a, force = value["max_contact_radius"], value["peak_force"]
        row["x"] = a * self.ratio / self.radius
        row["mean_pressure_over_strength"] = force / (math.pi * a * a * self.strength)
        row["radius_squared_over_approach"] = a * a / (self.radius * value["max_approach"])
        row["residual_approach_over_approach"] = value["residual_approach"] / value["max_approach"]
        row["dent_depth_over_approach"] = value["dent_depth"] / value["max_approach"]
        row["dent_crown_over_radius"] = value["dent_crown"] / self.radius
        row["max_plastic_strain"] = value["plastic_strain"]
        row["locked_in_share"] = value["locked_in"]
        row["seconds"] = seconds
        return {key: item if isinstance(item, str) else f"{item:.5g}" for key, item in row.items()}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--scenes", nargs="*")
    parser.add_argument("--ratios", type=float, nargs="*")
    parser.add_argument("--speeds", type=float, nargs=2, default=[0.0, math.inf])
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    given = parser.parse_args()
    impacts = [
        Impact(name, first, second, ratio, times)
        for name, first, second, ratio, speeds in scenes()
        if not given.scenes or name in given.scenes
        if not given.ratios or ratio in given.ratios
        for times in speeds
        if given.speeds[0] <= times <= given.speeds[1]
    ]

    def computed(impact):
        try:
            return impact.row(*(impact.run(given.program, elements) for elements in impact.meshes()))
        except RuntimeError as error:
            print(error, file=sys.stderr)
            return None

    with concurrent.futures.ThreadPoolExecutor(given.jobs) as pool:
        writer = None
        for row in pool.map(computed, impacts):
            if row is None:
                continue
            if writer is None:
                writer = csv.DictWriter(sys.stdout, row, lineterminator="\n")
                writer.writeheader()
            writer.writerow(row)
            sys.stdout.flush()


if __name__ == "__main__":
    main()

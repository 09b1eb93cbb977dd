#!/usr/bin/env python3
"""Error bars of random bodies that flow: flow.py FEM-RUN SEED MINUTES > SEED.csv

Draws scenes until the time is over: sizes, moduli, yield strength, hardening, partner and speed, from 0.5 to 3000 times
that of first yield and at most a twentieth of the speed of sound. Each is run with a tolerance of 3 %, and again with
elements half as large, whose difference is compared with the error bar (`discretisation`). A row has the scene, how
the runs ended, and for each quantity its value, the reference and the bar. flow.csv
has the rows of seed 13, 11 minutes.
"""

import random

from scenes import QUANTITIES, bars, bodies, run, study


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
"""
    case += bodies(lower, "elastic" if partner == "flowing block" else "metal", diameter, speed)
    return [partner, hardening, f"{speed / first_yield:.3g}", f"{strength_ratio:.0f}"], case


def compare(program, folder):
    """Yields the row of a scene."""
    ours, why = run(program, folder, [])
    if ours is None:
        return [[why]]
    size = ours["case"]["mesh"]["contact_element_size"]
    finer, why = run(program, folder, [f"mesh.contact_element_size={size / 2}", "accuracy.tolerance=0.5"])
    if finer is None:
        return [["reference: " + why]]
    row, outside = [], []
    for key in QUANTITIES:
        bar = bars(ours, key).get("discretisation")
        row += [ours[key], finer[key], bar]
        if None not in row[-3:] and abs(ours[key] - finer[key]) > bar:
            outside.append(key)
    return [[" ".join(outside) or "inside", f"{ours['energy']['residual_relative']:.1e}", *row]]


if __name__ == "__main__":
    values = [f"{key}{part}" for key in QUANTITIES for part in ("", "_reference", "_bar")]
    study(scene, compare, ["partner", "hardening", "v_over_v_y", "e_over_y", "outcome", "energy_residual", *values])

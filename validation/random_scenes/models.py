#!/usr/bin/env python3
"""Error bars of three models on random scenes: models.py FEM-RUN SEED MINUTES > SEED.csv

Draws scenes until the time is over: diameters from 1 mm to 10 cm with ratios up to thirty, moduli over four decades,
densities with ratios up to thirty, Poisson's ratios from -0.3 to 0.48, speeds of 1e-6 to 5e-4 of that of waves, up to
three relaxation times. A tenth is on a wall, a tenth on a half-space, a tenth of like bodies. Explicit elements,
condensed bodies and Ting's impact are run by default and compared with explicit elements at a tolerance of 0.2 %,
within the sum of both error bars, those for neglected effects included; condensed bodies are also compared with
their own run at 0.2 %, within the bars of discretisation. A row has the scene, the model, how it ended, and for each quantity its
value, the reference, and the bars of both.
"""

import random

from scenes import QUANTITIES, bars, bodies, run, study

FINE = ["accuracy.tolerance='0.2 %'", "limits.element_updates=1e10"]
COMPARED = [("fem", "fem"), ("condensed", "condensed"), ("condensed", "fem"), ("ting", "fem")]


def material(name, modulus, density):
    nu = random.uniform(-0.3, 0.48)
    terms, left = [], 0.8
    for _ in range(random.choice([0, 0, 1, 1, 2, 3])):
        weight = random.uniform(0, left)
        left -= weight
        terms.append(f'{{ weight = {weight:.4g}, relaxation_time = "{10 ** random.uniform(-7, -1):.4g} s" }}')
    lines = [f'density = "{density:.5g} kg/m^3"', f'youngs_modulus = "{modulus:.5g} Pa"', f"poissons_ratio = {nu:.4g}"]
    # No further loss and no strength are meant, or most restitutions would be bounds.
    lines.append("elastic = true")
    if terms:
        acts_on = random.choice(["all", "shear"])
        lines.append(f'relaxation = {{ acts_on = "{acts_on}", terms = [{", ".join(terms)}] }}')
    return f"[material.{name}]\n" + "\n".join(lines) + "\n"


def scene():
    """Returns what was drawn, and the case."""
    diameter = 10 ** random.uniform(-3, -1.5)
    modulus, density = 10 ** random.uniform(7.5, 11.5), 10 ** random.uniform(2.9, 4)
    speed = (modulus / density) ** 0.5 * 10 ** random.uniform(-6, -3.3)
    partner = random.choice(["wall", "block", "twin", *["ball"] * 7])
    size = diameter * 10 ** random.uniform(-0.5, 1.0)
    lower = {
        "wall": "wall = {}",
        "block": "half_space = {}\nmaterial = 'b'",
        "twin": f"sphere = {{ diameter = '{diameter:.5g} m' }}\nmaterial = 'a'",
        "ball": f"sphere = {{ diameter = '{size:.5g} m' }}\nmaterial = 'b'",
    }[partner]
    other = modulus * 10 ** random.uniform(-1, 1), density * 10 ** random.uniform(-0.5, 0.5)
    case = material("a", modulus, density) + material("b", *other)
    return [partner], case + bodies(lower, "a", diameter, speed)


def compare(program, folder):
    """Yields a row for each comparison of a model with a finer run."""
    runs = {}
    for name in ("fem", "condensed", "ting"):
        runs[name] = run(program, folder, [f"model='{name}'"])
    for name in ("fem", "condensed"):
        runs[name + " fine"] = run(program, folder, [f"model='{name}'", *FINE], 60)
    for model, reference in COMPARED:
        (ours, why), (fine, why_fine) = runs[model], runs[reference + " fine"]
        pair = [model, reference]
        if ours is None or fine is None:
            yield [*pair, why or "reference: " + why_fine]
            continue
        # The finer run of explicit elements may have finite strain, which the other leaves out.
        kinds = ["discretisation"] if pair == ["condensed"] * 2 else ["discretisation", "model"]
        row, outside = [], []
        for key in QUANTITIES:
            both = [[bars(of, key).get(kind) for kind in kinds] for of in (ours, fine)]
            totals = [None if None in parts else sum(parts) for parts in both]
            row += [ours.get(key), fine.get(key), *totals]
            if None not in row[-4:] and abs(row[-4] - row[-3]) > sum(totals):
                outside.append(key)
        yield [*pair, " ".join(outside) or "inside", *row]


if __name__ == "__main__":
    values = [f"{key}{part}" for key in QUANTITIES for part in ("", "_reference", "_bar", "_bar_of_reference")]
    study(scene, compare, ["partner", "model", "compared_with", "outcome", *values])

#!/usr/bin/env python3
"""Input of CalculiX 2.20 for a sphere that is pressed between rigid plates: calculix.py NU CELLS > NAME.inp

R = E = 1. A quarter of the meridian, of 3 CELLS² elements CAX8R, neo-Hooke; one plate comes by 0.6.
`ccx -i NAME` leaves the plate's force over a wedge of 2 degrees in NAME.dat: 180 times that is the
force. CalculiX finds no contact for a face on the axis, so that a hole of 0.004 is left there, and the
radius is √(r² + 0.004²), which keeps all areas.
"""

import cmath
import math
import sys

HOLE = 0.004
PENALTY = 10000
DEPTH = 0.6


def blocks(n):
    """Three blocks of the quarter disc |ζ| ≤ 1, and how they are cut."""
    near, diagonal, side = 0.5, complex(0.4, 0.4), 0.5j

    def bilinear(s, t):
        return near * s * (1 - t) + diagonal * s * t + side * (1 - s) * t

    def around(start, end, angle):
        def place(s, t):
            rim = cmath.exp(1j * (angle + math.pi / 4 * t))
            return (start + (end - start) * t) * (1 - s) + rim * s

        return place

    return [(bilinear, n), (around(near, diagonal, 0), n), (around(diagonal, side, math.pi / 4), n)]


def mesh(n):
    """Nodes (r, y) and elements, corners first, counter-clockwise."""
    numbers, nodes, elements = {}, [], []

    def node(zeta):
        z = 2 * zeta / (1 + zeta)
        key = (round(z.imag, 9), round(z.real, 9))
        if key not in numbers:
            numbers[key] = len(nodes) + 1
            nodes.append((max(z.imag, 0.0), z.real))
        return numbers[key]

    corners = [(0, 0), (0, 1), (1, 1), (1, 0), (0, 0.5), (0.5, 1), (1, 0.5), (0.5, 0)]
    for place, m in blocks(n):
        for i in range(m):
            for j in range(m):
                elements.append([node(place((i + a) / m, (j + b) / m)) for a, b in corners])
    for k, e in enumerate(elements):
        points = [nodes[number - 1] for number in e[:4]]
        turns = zip(points, points[1:] + points[:1])
        if sum(a[0] * b[1] - b[0] * a[1] for a, b in turns) < 0:
            elements[k] = [e[0], e[3], e[2], e[1], e[7], e[6], e[5], e[4]]
    return nodes, elements


def deck(nu, n):
    nodes, elements = mesh(n)
    bulk, shear = 1 / (3 * (1 - 2 * nu)), 1 / (2 * (1 + nu))
    first, plate = len(nodes), len(elements) + 1

    def lies_on(number):
        r, y = nodes[number - 1]
        return abs(r * r + (y - 1) ** 2 - 1) < 1e-7 and y < 1 + 1e-9

    yield "*NODE, NSET=ALL"
    for k, (r, y) in enumerate(nodes):
        yield f"{k + 1}, {math.hypot(r, HOLE):.15g}, {y:.15g}, 0"
    yield "*NODE, NSET=PLATE"
    for k, (r, y) in enumerate([(0.001, -0.5), (2.5, -0.5), (2.5, 0), (0.001, 0)]):
        yield f"{first + k + 1}, {r}, {y}, 0"
    yield "*ELEMENT, TYPE=CAX8R, ELSET=BALL"
    for k, element in enumerate(elements):
        yield ", ".join(map(str, [k + 1] + element))
    yield "*ELEMENT, TYPE=CAX4, ELSET=STEEL"
    yield ", ".join(map(str, [plate] + [first + k for k in (1, 2, 3, 4)]))
    for name, axis, value in (("AXIS", 0, 0), ("EQUATOR", 1, 1)):
        yield f"*NSET, NSET={name}"
        yield from (str(k + 1) for k, p in enumerate(nodes) if abs(p[axis] - value) < 1e-9)
    yield "*SURFACE, NAME=RIND, TYPE=ELEMENT"
    for k, e in enumerate(elements):
        for face, ends in enumerate([(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)]):
            if all(lies_on(e[end]) for end in ends):
                yield f"{k + 1}, S{face + 1}"
    yield "*SURFACE, NAME=TOP, TYPE=ELEMENT"
    yield f"{plate}, S3"
    yield f"""*MATERIAL, NAME=RUBBER
*HYPERELASTIC, NEO HOOKE
{shear / 2:.12g}, {2 / bulk:.12g}
*MATERIAL, NAME=STEEL
*ELASTIC
1000, 0.3
*SOLID SECTION, ELSET=BALL, MATERIAL=RUBBER
*SOLID SECTION, ELSET=STEEL, MATERIAL=STEEL
*SURFACE INTERACTION, NAME=SPRINGS
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{PENALTY}, 1e-6
*CONTACT PAIR, INTERACTION=SPRINGS, TYPE=SURFACE TO SURFACE
RIND, TOP
*BOUNDARY
AXIS, 1, 1
EQUATOR, 2, 2
PLATE, 1, 1
*TIME POINTS, NAME=TWENTY, GENERATE
0.05, 1.0, 0.05
*STEP, NLGEOM, INC=2000
*STATIC
0.01, 1, 1e-6, 0.025
*BOUNDARY
PLATE, 2, 2, {DEPTH}
*NODE PRINT, NSET=PLATE, TOTALS=ONLY, TIME POINTS=TWENTY
RF
*END STEP"""


if __name__ == "__main__":
    for line in deck(float(sys.argv[1]), int(sys.argv[2])):
        print(line)

#!/usr/bin/env python3
"""Input of CalculiX 2.20 for balls that flow on a rigid wall: deck.py SCENE CELLS STEPS > NAME.inp

SCENE is one of SCENES; CELLS is the number of quadratic elements across the contact radius at full flow, a_p =
(4 R W0/(3 π Y))^(1/4); STEPS is the number of steps up to DURATION. Wedges of C3D20R elements about the axis,
multiplicative plasticity with neo-Hookean elasticity, implicit dynamics; units are mm, ms, g (so MPa and N).
`ccx -i NAME` leaves NAME.dat; read.py makes the numbers of the claim from it. As in calculix_soft, a hole is left on
the axis: CalculiX finds no contact for a face there.
"""

import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).parent.parent / "calculix_soft"))
from impact import WEDGE, solid  # noqa: E402

RADIUS = 5.0
TYPE = "C3D8I"


def solid(nodes, elements, n):
    places, numbers = [], {}
    for number, (r, y, _, _) in enumerate(nodes):
        for layer in (1, -1):
            angle = math.radians(0.5 * WEDGE * layer)
            places.append((r * math.cos(angle), r * math.sin(angle), y))
            numbers[number + 1, layer] = n + len(places)
    bricks = [[numbers[k, 1] for k in e] + [numbers[k, -1] for k in e] for e in elements]
    return places, bricks, numbers

STEEL = dict(modulus=210e3, nu=0.3, density=7.8e-3, strength=1000.0)
ALUMINIUM = dict(modulus=70e3, nu=0.33, density=2.7e-3, strength=100.0)
# Material, speed in mm/ms, duration in ms: the contact and one period of the lowest vibration.
SCENES = {
    "steel_10": (STEEL, 0.35, 0.034),
    "steel_100": (STEEL, 3.5, 0.023),
    "steel_1000": (STEEL, 35.0, 0.019),
    "aluminium_10": (ALUMINIUM, 0.015, 0.080),
    "aluminium_100": (ALUMINIUM, 0.15, 0.050),
    "aluminium_1000": (ALUMINIUM, 1.5, 0.036),
}
# Of the contact radius.
HOLE = 0.02
# Sides of the squares of uniform elements at the pole, in contact radii, and at the antipode.
NEAR, FAR = 1.5, 0.5
# Overlap under the pressure 3 Y, in elastic recoveries of a flat punch at that pressure.
OVERLAP = 2e-3
ALPHA = -0.05


def contact_radius(material, speed):
    energy = 2 / 3 * math.pi * RADIUS**3 * material["density"] * speed**2
    return (4 * RADIUS * energy / (3 * math.pi * material["strength"])) ** 0.25


def mesh(cells, contact):
    """Nodes (r, y) and elements of a ball that touches y = 0 from above.

    (y/R - 1) + i r/R = (q - 1)/(q + 1) maps the first quadrant of q to the half disc: the real axis is the axis, the
    imaginary one the surface, and 0 the pole. A square at 0, rings about it and the inverse of a square fill it.
    """
    m = round(NEAR * cells)
    near, far = NEAR * contact / (2 * RADIUS), FAR
    # Rings grow from the element size of the square to a fourth of their radius.
    growths, step, reach = [0.0], 1.0 / m, math.log(1 / (far * near))
    while growths[-1] < reach:
        growths.append(growths[-1] + step)
        step = min(1.25 * step, 0.25)
    growths = [g * reach / growths[-1] for g in growths]
    rings = len(growths) - 1

    def rim(t):
        """A point on the two sides of the unit square that do not touch 0."""
        return complex(1, t / m) if t <= m else complex(2 - t / m, 1)

    def fan(t, s):
        corner, k = rim(t), min(int(s), rings - 1)
        share = (growths[k] + (s - k) * (growths[k + 1] - growths[k])) / reach
        # From near·corner to 1/(far·conj(corner)), whose direction is the same.
        size = (near * abs(corner)) ** (1 - share) / (far * abs(corner)) ** share
        return size * corner / abs(corner)

    blocks = [
        (lambda s, t: near * complex(s, t) / m, m, m),
        (fan, 2 * m, rings),
        (lambda s, t: complex(s, t) and m / (far * complex(s, -t)), m, m),
    ]
    numbers, nodes, elements = {}, [], []

    corners = [(0, 0), (0, 1), (1, 1), (1, 0)]
    for block, (place, m1, m2) in enumerate(blocks):
        for i in range(m1):
            for j in range(m2):
                element = []
                for a, b in corners:
                    s, t = i + a, j + b
                    q = place(s, t)
                    z = 1 + 0j if block == 2 and s == t == 0 else (q - 1) / (q + 1)
                    key = (round(z.imag, 10), round(z.real, 10))
                    if key not in numbers:
                        numbers[key] = len(nodes) + 1
                        r, y = RADIUS * max(z.imag, 0.0), RADIUS * (1 + z.real)
                        nodes.append((math.hypot(r, HOLE * contact), y, abs(abs(z) - 1) < 1e-9, z.imag < 1e-9))
                    element.append(numbers[key])
                elements.append(element)
    for k, e in enumerate(elements):
        points = [nodes[number - 1][:2] for number in e[:4]]
        turns = zip(points, points[1:] + points[:1])
        if sum(a[0] * b[1] - b[0] * a[1] for a, b in turns) < 0:
            elements[k] = [e[0], e[3], e[2], e[1]]
    return nodes, elements


def deck(scene, cells, steps):
    material, speed, duration = SCENES[scene]
    contact = contact_radius(material, speed)
    nodes, elements = mesh(cells, contact)
    places, bricks, numbers = solid(nodes, elements, 0)
    yield "*NODE, NSET=BALL"
    for k, place in enumerate(places):
        yield f"{k + 1}, " + ", ".join(f"{x:.15g}" for x in place)
    yield f"*ELEMENT, TYPE={TYPE}, ELSET=BALL"
    for k, brick in enumerate(bricks):
        yield ", ".join(map(str, [k + 1] + brick))
    yield "*NSET, NSET=AXIS"
    yield from (str(at) for (k, _), at in numbers.items() if nodes[k - 1][3])
    yield "*SURFACE, NAME=RIND, TYPE=ELEMENT"
    for k, e in enumerate(elements):
        for face, ends in enumerate([(0, 1), (1, 2), (2, 3), (3, 0)]):
            own = [nodes[e[end] - 1] for end in ends]
            if all(point[2] for point in own) and own[1][0] < 1.6 * contact:
                yield f"{k + 1}, S{face + 3}"
    pole = min((node[1], k + 1) for k, node in enumerate(nodes) if node[3])[1]
    first = len(places)
    wide, slope = 3 * contact, math.tan(math.radians(WEDGE))
    yield "*NODE, NSET=PLATE"
    inner = 0.5 * HOLE * contact
    plane = [(inner, slope), (wide, slope), (wide, -slope), (inner, -slope)]
    for layer, z in enumerate((-wide, 0)):
        for k, (x, side) in enumerate(plane):
            yield f"{first + 4 * layer + k + 1}, {x:.12g}, {x * side:.12g}, {z:.12g}"
    springs = 3 * material["strength"] / (OVERLAP * punch(material, contact))
    yield f"""*ELEMENT, TYPE=C3D8, ELSET=WALL
{len(bricks) + 1}, {", ".join(str(first + k) for k in (4, 3, 2, 1, 8, 7, 6, 5))}
*SURFACE, NAME=TOP, TYPE=ELEMENT
{len(bricks) + 1}, S2
*NSET, NSET=POLE
{numbers[pole, 0] if (pole, 0) in numbers else numbers[pole, 1]}
*MATERIAL, NAME=METAL
*ELASTIC
{material["modulus"]}, {material["nu"]}
*PLASTIC
{material["strength"]}, 0
{material["strength"]}, 10
*DENSITY
{material["density"]}
*SOLID SECTION, ELSET=BALL, MATERIAL=METAL
*MATERIAL, NAME=FIXED
*ELASTIC
1000, 0.3
*DENSITY
1e-3
*SOLID SECTION, ELSET=WALL, MATERIAL=FIXED
*TRANSFORM, NSET=BALL, TYPE=C
0, 0, 0, 0, 0, 1
*SURFACE INTERACTION, NAME=SPRINGS
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{springs:.8g}, 1e-6
*CONTACT PAIR, INTERACTION=SPRINGS, TYPE=NODE TO SURFACE
RIND, TOP
*BOUNDARY
BALL, 2, 2
AXIS, 1, 1
PLATE, 1, 3
*INITIAL CONDITIONS, TYPE=VELOCITY
BALL, 3, {-speed}
*STEP, NLGEOM, INC=100000
*DYNAMIC, DIRECT, ALPHA={ALPHA}
{duration / steps:.12g}, {duration}
*NODE PRINT, NSET=PLATE, TOTALS=ONLY
RF
*NODE PRINT, NSET=POLE
U
*EL PRINT, ELSET=BALL, TOTALS=ONLY
ELKE, ELSE
*EL PRINT, ELSET=BALL, FREQUENCY=100000
PEEQ
*END STEP"""


def punch(material, contact):
    """The depth to which a rigid flat punch of that radius sinks into the elastic ball under the pressure 3 Y."""
    stiffness = material["modulus"] / (1 - material["nu"] ** 2)
    return 3 * material["strength"] * math.pi * contact / (2 * stiffness)


if __name__ == "__main__":
    for line in deck(sys.argv[1], float(sys.argv[2]), int(sys.argv[3])):
        print(line)

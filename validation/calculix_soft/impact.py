#!/usr/bin/env python3
"""Input of CalculiX 2.20 for rubber balls that collide: impact.py SCENE CELLS STEPS > NAME.inp

SCENE is wall_3 or wall_10 (ball_on_wall.toml at ν = 0.45 and 3 or 10 m/s), wall_49_3 or wall_20_5 (at ν = 0.49 and
3 m/s, 0.2 and 5 m/s), or two_balls (two_balls.toml). Of that the contact does not converge beyond 0.5 to 1.1 ms on
meshes that would tell something, so that this claim has none of it, and felupe_soft has.
Wedges of C3D20R elements about the axis, neo-Hooke, implicit dynamics; units are mm, ms, g (so MPa and N).
`ccx -i NAME` leaves what holds a driven plate, or the velocities of the balls, in NAME.dat; read.py makes
the numbers of the claim from them. CalculiX finds no contact for a face on the axis, so that a hole of 0.004 R is
left there, and the radius is √(r² + hole²), which keeps all areas.
"""

import cmath
import math
import sys

HOLE = 0.004
TOWARDS_POLE = 0.35


def blocks(n):
    """Four blocks of the half disc |ζ| ≤ 1, Im ζ ≥ 0, and how they are cut."""
    corners = [-0.5, complex(-0.4, 0.4), complex(0.4, 0.4), 0.5]

    def inside(s, t):
        a, b, c, d = corners
        return (a * (1 - s) + d * s) * (1 - t) + (b * (1 - s) + c * s) * t

    def around(start, end, angle, turn):
        def place(s, t):
            rim = cmath.exp(1j * (angle - turn * t))
            return (start + (end - start) * t) * (1 - s) + rim * s

        return place

    a, b, c, d = corners
    quarter = math.pi / 4
    return [
        (inside, 2 * n, n),
        (around(a, b, math.pi, quarter), n, n),
        (around(b, c, 3 * quarter, 2 * quarter), n, 2 * n),
        (around(c, d, quarter, quarter), n, n),
    ]


def mesh(n, radius, side):
    """Nodes (r, y) and elements of a ball that touches y = 0 from above (side 1) or below (-1)."""
    numbers, nodes, elements = {}, [], []

    def node(zeta):
        z = (zeta - TOWARDS_POLE) / (1 - TOWARDS_POLE * zeta)
        key = (round(z.imag, 9), round(z.real, 9))
        if key not in numbers:
            numbers[key] = len(nodes) + 1
            r, y = radius * max(z.imag, 0.0), side * radius * (1 + z.real)
            nodes.append((math.hypot(r, HOLE * radius), y, abs(abs(z) - 1) < 1e-9, z.imag < 1e-9))
        return numbers[key]

    corners = [(0, 0), (0, 1), (1, 1), (1, 0), (0, 0.5), (0.5, 1), (1, 0.5), (0.5, 0)]
    for place, m1, m2 in blocks(n):
        for i in range(m1):
            for j in range(m2):
                elements.append([node(place((i + a) / m1, (j + b) / m2)) for a, b in corners])
    for k, e in enumerate(elements):
        points = [nodes[number - 1][:2] for number in e[:4]]
        turns = zip(points, points[1:] + points[:1])
        if sum(a[0] * b[1] - b[0] * a[1] for a, b in turns) < 0:
            elements[k] = [e[0], e[3], e[2], e[1], e[7], e[6], e[5], e[4]]
    return nodes, elements


class Ball:
    def __init__(self, name, radius, side, modulus, nu, density):
        self.name, self.radius, self.side = name, radius, side
        self.modulus, self.nu, self.density = modulus, nu, density


RUBBER = dict(modulus=1.0, nu=0.45, density=1e-3)
NEARLY_INCOMPRESSIBLE = dict(modulus=1.0, nu=0.49, density=1e-3)
COMPRESSIBLE = dict(modulus=1.0, nu=0.2, density=1e-3)
STIFF = dict(modulus=3.0, nu=0.47, density=1.1e-3)
SCENES = {
    "wall_3": ([Ball("BALL", 15.0, 1, **RUBBER)], 3.0, 3.9),
    "wall_10": ([Ball("BALL", 15.0, 1, **RUBBER)], 10.0, 2.9),
    "wall_49_3": ([Ball("BALL", 15.0, 1, **NEARLY_INCOMPRESSIBLE)], 3.0, 3.9),
    "wall_20_5": ([Ball("BALL", 15.0, 1, **COMPRESSIBLE)], 5.0, 3.9),
    "two_balls": (
        [Ball("LARGE", 15.0, -1, **RUBBER), Ball("SMALL", 10.0, 1, **STIFF)],
        5.0,
        3.2,
    ),
}
# Per mm of overlap, MPa.
PENALTY = 30.0
ALPHA = -0.05
# Degrees.
WEDGE = 2.0


def solid(nodes, elements, n):
    """The wedge of a meridian: nodes (x, y, z) of both faces and between corners, and C3D20R elements."""
    places, numbers = [], {}

    def node(number, layer):
        if (number, layer) not in numbers:
            numbers[number, layer] = n + len(places) + 1
            r, y = nodes[number - 1][:2]
            angle = math.radians(0.5 * WEDGE * layer)
            places.append((r * math.cos(angle), r * math.sin(angle), y))
        return numbers[number, layer]

    bricks = []
    for e in elements:
        corners, edges = e[:4], e[4:]
        brick = [node(k, 1) for k in corners] + [node(k, -1) for k in corners]
        brick += [node(k, 1) for k in edges] + [node(k, -1) for k in edges]
        bricks.append(brick + [node(k, 0) for k in corners])
    return places, bricks, {key: value for key, value in numbers.items()}


def deck(scene, n, steps):
    balls, speed, duration = SCENES[scene]
    first_node, first_element, extra = 0, 0, []
    for ball in balls:
        nodes, elements = mesh(n, ball.radius, ball.side)
        places, bricks, numbers = solid(nodes, elements, first_node)
        yield f"*NODE, NSET={ball.name}"
        for k, place in enumerate(places):
            yield f"{first_node + k + 1}, " + ", ".join(f"{x:.15g}" for x in place)
        yield f"*ELEMENT, TYPE=C3D20R, ELSET={ball.name}"
        for k, brick in enumerate(bricks):
            line = list(map(str, [first_element + k + 1] + brick))
            yield ", ".join(line[:11]) + ","
            yield ", ".join(line[11:])
        yield f"*NSET, NSET=AXIS{ball.name}"
        yield from (str(at) for (k, _), at in numbers.items() if nodes[k - 1][3])
        yield f"*SURFACE, NAME=RIND{ball.name}, TYPE=ELEMENT"
        for k, e in enumerate(elements):
            for face, ends in enumerate([(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)]):
                own = [nodes[e[end] - 1] for end in ends]
                if all(point[2] for point in own) and min(abs(p[1]) for p in own) < ball.radius:
                    yield f"{first_element + k + 1}, S{face + 3}"
        bulk, shear = ball.modulus / (3 * (1 - 2 * ball.nu)), ball.modulus / (2 * (1 + ball.nu))
        extra += [
            f"*MATERIAL, NAME={ball.name}",
            "*HYPERELASTIC, NEO HOOKE",
            f"{shear / 2:.12g}, {2 / bulk:.12g}",
            "*DENSITY",
            f"{ball.density:.12g}",
            f"*SOLID SECTION, ELSET={ball.name}, MATERIAL={ball.name}",
        ]
        first_node, first_element = first_node + len(places), first_element + len(elements)
    extra.append(f"*TRANSFORM, NSET={balls[0].name}, TYPE=C\n0, 0, 0, 0, 0, 1")
    if len(balls) == 1:
        yield "*NODE, NSET=PLATE"
        slope = math.tan(math.radians(WEDGE))
        plane = [(0.01, slope), (40, slope), (40, -slope), (0.01, -slope)]
        for layer, z in enumerate((-5, 0)):
            for k, (x, side) in enumerate(plane):
                yield f"{first_node + 4 * layer + k + 1}, {x}, {x * side:.12g}, {z}"
        yield "*ELEMENT, TYPE=C3D8, ELSET=STEEL"
        yield ", ".join(map(str, [first_element + 1] + [first_node + k for k in (4, 3, 2, 1, 8, 7, 6, 5)]))
        yield "*SURFACE, NAME=TOP, TYPE=ELEMENT"
        yield f"{first_element + 1}, S2"
        extra += [
            "*MATERIAL, NAME=STEEL",
            "*ELASTIC",
            "1000, 0.3",
            "*DENSITY",
            "1e-3",
            "*SOLID SECTION, ELSET=STEEL, MATERIAL=STEEL",
        ]
        pair = "RINDBALL, TOP"
    else:
        extra.append(f"*TRANSFORM, NSET={balls[1].name}, TYPE=C\n0, 0, 0, 0, 0, 1")
        pair = "RINDSMALL, RINDLARGE"
    yield from extra
    yield f"""*SURFACE INTERACTION, NAME=SPRINGS
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{PENALTY}, 1e-6
*CONTACT PAIR, INTERACTION=SPRINGS, TYPE=SURFACE TO SURFACE
{pair}
*BOUNDARY"""
    for ball in balls:
        yield f"{ball.name}, 2, 2\nAXIS{ball.name}, 1, 1"
    if len(balls) == 1:
        yield "PLATE, 1, 3"
    moving = balls[0]
    yield f"*INITIAL CONDITIONS, TYPE=VELOCITY\n{moving.name}, 3, {-moving.side * speed}"
    yield f"""*STEP, NLGEOM, INC=100000
*DYNAMIC, DIRECT, ALPHA={ALPHA}
{duration / steps:.12g}, {duration}"""
    if len(balls) == 1:
        yield "*NODE PRINT, NSET=PLATE, TOTALS=ONLY\nRF"
    else:
        yield "*CONTACT PRINT, MASTER=RINDLARGE, SLAVE=RINDSMALL\nCF"
    for ball in balls:
        yield f"*EL PRINT, ELSET={ball.name}, TOTALS=ONLY\nELKE, ELSE"
    yield "*END STEP"


if __name__ == "__main__":
    for line in deck(sys.argv[1], int(sys.argv[2]), int(sys.argv[3])):
        print(line)

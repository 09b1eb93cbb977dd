#!/usr/bin/env python3
"""Input of CalculiX 2.20 for balls that flow on a rigid wall: deck.py SCENE CELLS STEPS [OVERLAP] > NAME.inp

SCENE is one of SCENES, which are those of felupe_flow; CELLS is the number of elements across the contact radius at
full flow, a_p = (4 R W0/(3 π Y))^(1/4); STEPS limits the increments to that share of the duration; OVERLAP is that of
the springs. C3D8 elements of a wedge about the axis, multiplicative plasticity with neo-Hookean elasticity, implicit
dynamics; units are mm, ms, g (so MPa and N). `ccx -i NAME` leaves NAME.dat, of which read.py makes the numbers of
the claim. Of the contacts that CalculiX has, surface to surface leaves a singular matrix as soon as
a dynamic step has a plastic material, and node to surface diverges. So the wall is one-sided springs from the nodes of
the rind to the ground.
"""

import math
import sys

RADIUS = 5.0
STEEL = dict(modulus=210e3, nu=0.3, density=7.8e-3, strength=1000.0)
ALUMINIUM = dict(modulus=70e3, nu=0.33, density=2.7e-3, strength=100.0)
# Material, speed in mm/ms, duration in ms: the contact and a period or two of the lowest vibration. The material of a
# second ball in place of the wall, for balls.py.
SCENES = {
    "steel_10": (STEEL, 0.35, 0.037),
    "steel_100": (STEEL, 3.5, 0.025),
    "steel_1000": (STEEL, 35.0, 0.0195),
    "aluminium_10": (ALUMINIUM, 0.015, 0.071),
    "aluminium_100": (ALUMINIUM, 0.15, 0.046),
    "aluminium_1000": (ALUMINIUM, 1.5, 0.034),
    "pair_100": (ALUMINIUM, 0.23, 0.052, STEEL),
    "pair_1000": (ALUMINIUM, 2.3, 0.04, STEEL),
}
WEDGE = math.radians(2.0)
# Of the contact radius; nodes on the axis would have no wedge.
HOLE = 0.02
# Sides of the squares of uniform elements at the pole, in contact radii, and at the antipode.
NEAR, FAR = 1.5, 0.5
# Of the ground below the wall, in mm, so that the springs keep their direction.
DEEP = 1e4
ALPHA = -0.05


def contact_radius(scene):
    material, speed, _, *other = SCENES[scene]
    density = material["density"] / (1 + sum(material["density"] / one["density"] for one in other))
    energy = 2 / 3 * math.pi * RADIUS**3 * density * speed**2
    return (4 * RADIUS / (1 + len(other)) * energy / (3 * math.pi * material["strength"])) ** 0.25


CORNERS = [(0, 0), (0, 1), (1, 1), (1, 0)]


def mesh(scene, cells, hole=HOLE, places=CORNERS):
    """Nodes (r, y, on the rind) and elements of a ball that touches y = 0 from above.

    An element has its corners and, for `places` beyond those, points between them in the order of the corners.

    (y/R - 1) + i r/R = (q - 1)/(q + 1) maps the first quadrant of q to the half disc: the real axis is the axis, the
    imaginary one the rind, and 0 the pole. A square at 0, rings about it and the inverse of a square fill it.
    """
    contact = contact_radius(scene)
    m = round(NEAR * cells)
    near = NEAR * contact / (2 * RADIUS)
    # The logarithm of the rings' size grows by 1/m, as in the square, up to 1/4.
    growths, step, reach = [0.0], 1.0 / m, math.log(1 / (FAR * near))
    while growths[-1] < reach:
        growths.append(growths[-1] + step)
        step = min(1.25 * step, 0.25)
    shares = [growth / growths[-1] for growth in growths]

    def ring(t, s):
        """From the square's side at its t-th point to the inverse of the other square's; both have one direction."""
        corner, k = complex(1, t / m) if t <= m else complex(2 - t / m, 1), min(int(s), len(shares) - 2)
        length, share = abs(corner), shares[k] + (s - k) * (shares[k + 1] - shares[k])
        return (near * length) ** (1 - share) / (FAR * length) ** share * corner / length

    blocks = [
        (lambda s, t: near * complex(s, t) / m, m, m),
        (ring, 2 * m, len(shares) - 1),
        (lambda s, t: m / (FAR * complex(s, -t)) if s or t else None, m, m),
    ]
    numbers, nodes, elements = {}, [], []

    def node(q):
        z = 1 + 0j if q is None else (q - 1) / (q + 1)
        key = (round(z.imag, 10), round(z.real, 10))
        if key not in numbers:
            numbers[key] = len(nodes)
            r, y = RADIUS * max(z.imag, 0.0), RADIUS * (1 + z.real)
            nodes.append((math.hypot(r, hole * contact), y, abs(abs(z) - 1) < 1e-9))
        return numbers[key]

    for place, m1, m2 in blocks:
        for i in range(m1):
            for j in range(m2):
                e = [node(place(i + a, j + b)) for a, b in places]
                points = [nodes[k] for k in e[:4]]
                turns = zip(points, points[1:] + points[:1])
                turn = sum(a[0] * b[1] - b[0] * a[1] for a, b in turns)
                elements.append(e if turn > 0 else [e[k] for k in (0, 3, 2, 1, 7, 6, 5, 4)[: len(e)]])
    return nodes, elements


def volumes(nodes, elements):
    """Returns the volumes per radian of the four Gauss points of each element's meridian section, mm^3."""
    parts = []
    for e in elements:
        corners = [nodes[k][:2] for k in e]
        for eta in (-(3**-0.5), 3**-0.5):
            for xi in (-(3**-0.5), 3**-0.5):
                shape = [(1 + a * xi) * (1 + b * eta) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                along = [a * (1 + b * eta) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                across = [b * (1 + a * xi) / 4 for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
                r = sum(n * p[0] for n, p in zip(shape, corners))
                dr = [sum(n * p[0] for n, p in zip(slope, corners)) for slope in (along, across)]
                dy = [sum(n * p[1] for n, p in zip(slope, corners)) for slope in (along, across)]
                parts.append(r * (dr[0] * dy[1] - dr[1] * dy[0]))
    return parts


def springs(scene, nodes, first, overlap):
    """One-sided springs between the rind and the wall.

    The pressure 3 Y gives them the share `overlap` of the depth of a rigid flat punch of the contact radius in the
    elastic ball under that pressure, 3 Y π a/(2 E*).
    """
    material = SCENES[scene][0]
    contact, plane = contact_radius(scene), material["modulus"] / (1 - material["nu"] ** 2)
    stiffness = 2 * plane / (math.pi * contact * overlap)
    rind = sorted((y, r, k) for k, (r, y, outside) in enumerate(nodes) if outside)
    for (_, inner, _), (y, r, k), (_, outer, _) in zip([rind[0]] + rind, rind, rind[1:]):
        if r > 1.6 * contact:
            break
        # The integral of the node's hat function over the wedge, half for each of its two layers.
        area = ((r - inner) * (2 * r + inner) + (outer - r) * (2 * r + outer)) / 6 * math.sin(WEDGE) / 2
        for layer in range(2):
            x, z = r * math.cos(WEDGE / 2), r * math.sin(WEDGE / 2) * (1 - 2 * layer)
            ground, first = 2 * len(nodes) + 2 * k + layer + 1, first + 1
            yield f"*NODE, NSET=GROUND\n{ground}, {x:.12g}, {z:.12g}, {y - DEEP:.15g}"
            yield f"*ELEMENT, TYPE=SPRINGA, ELSET=S{k}\n{first}, {ground}, {2 * k + layer + 1}"
        yield f"*SPRING, ELSET=S{k}, NONLINEAR"
        yield f"{-stiffness * area * RADIUS:.12g}, {-y - RADIUS:.12g}\n0, {-y:.12g}\n0, {10 * RADIUS}"


def deck(scene, cells, steps, overlap):
    material, speed, duration = SCENES[scene]
    nodes, elements = mesh(scene, cells)
    # The facets have less volume than the sphere; its mass is right.
    density = material["density"] * 2 / 3 * RADIUS**3 / sum(volumes(nodes, elements))
    yield "*NODE, NSET=BALL"
    for k, (r, y, _) in enumerate(nodes):
        for layer in range(2):
            z = r * math.sin(WEDGE / 2) * (1 - 2 * layer)
            yield f"{2 * k + layer + 1}, {r * math.cos(WEDGE / 2):.12g}, {z:.12g}, {y:.12g}"
    yield "*ELEMENT, TYPE=C3D8, ELSET=BALL"
    for k, e in enumerate(elements):
        yield ", ".join(str(n) for n in [k + 1] + [2 * n + layer + 1 for layer in range(2) for n in e])
    yield from springs(scene, nodes, len(elements), overlap)
    yield "*NSET, NSET=AXIS"
    rim = 1.001 * HOLE * contact_radius(scene)
    yield from (f"{2 * k + 1}, {2 * k + 2}" for k, (r, *_) in enumerate(nodes) if r < rim)
    yield f"""*NSET, NSET=POLE
1
*MATERIAL, NAME=METAL
*ELASTIC
{material["modulus"]}, {material["nu"]}
*PLASTIC
{material["strength"]}, 0
{material["strength"]}, 10
*DENSITY
{density:.12g}
*SOLID SECTION, ELSET=BALL, MATERIAL=METAL
*TRANSFORM, NSET=BALL, TYPE=C
0, 0, 0, 0, 0, 1
*BOUNDARY
GROUND, 1, 3
BALL, 2, 2
AXIS, 1, 1
*INITIAL CONDITIONS, TYPE=VELOCITY
BALL, 3, {-speed}
*STEP, NLGEOM, INC=100000
*DYNAMIC, ALPHA={ALPHA}
{duration / 5000:.8g}, {duration}, {duration / 1e7:.8g}, {duration / steps:.8g}
*NODE PRINT, NSET=GROUND, TOTALS=ONLY
RF
*NODE PRINT, NSET=POLE
U
*END STEP
*STEP, NLGEOM
*DYNAMIC, ALPHA={ALPHA}
{duration / steps:.8g}, {duration / steps:.8g}
*EL PRINT, ELSET=BALL
PEEQ
*END STEP"""


if __name__ == "__main__":
    scene, cells, steps, *overlap = sys.argv[1:]
    for line in deck(scene, float(cells), float(steps), float((overlap or ["0.005"])[0])):
        print(line)

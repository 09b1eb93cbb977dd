#!/usr/bin/env python3
"""Metal balls that hit a rigid wall, by FElupe 11.3: balls.py SCENE CELLS [PENALTY] [STEP] [kirchhoff]

SCENE and mesh are those of ../calculix_flow/deck.py, and the units (mm, ms, g); CELLS is the number of elements across
the contact radius at full flow. FElupe has the elements: axisymmetric quadrilaterals of eight nodes and 2 x 2 Gauss
points. Written here and nowhere else are

- the flow: F = F_e F_p, Hencky's law, von Mises' condition on Cauchy's stress (on Kirchhoff's with `kirchhoff`). The
  trial strain ½ ln(F C_p⁻¹ Fᵀ) has its deviator shortened to the yield surface, which is exact for a step in one
  direction; nothing hardens;
- the steps: leapfrog with a diagonal mass and without any damping, STEP times h/(√6 c) of the smallest edge;
- the wall: springs on the undeformed area at four Gauss points of each edge, PENALTY E*/h. A second ball is there in
  its place, in its own coordinates; springs act along the normal of its nodes' polygon.

It prints the numbers of the claim, from the impulse and the mean displacement. `pip install felupe==11.3.0`
has all that is needed.
"""

import math
import sys
from pathlib import Path

import felupe
import numpy as np
from scipy.sparse import csr_matrix

sys.path.append(str(Path(__file__).parent.parent / "calculix_flow"))

from deck import RADIUS, SCENES, contact_radius, mesh

PLACES = [(0, 0), (0, 1), (1, 1), (1, 0), (0, 0.5), (0.5, 1), (1, 0.5), (0.5, 0)]
EDGES = [(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)]


class Ball:
    """Coordinates are (y, r), as FElupe has them; fields at Gauss points have the shape (points, cells)."""

    def __init__(self, scene, material, cells, penalty):
        self.material = material
        modulus, nu = self.material["modulus"], self.material["nu"]
        self.shear, self.bulk = modulus / (2 * (1 + nu)), modulus / (3 * (1 - 2 * nu))
        nodes, elements = mesh(scene, cells, 0.0, PLACES)
        self.points = np.array([(y, r) for r, y, _ in nodes])
        self.cells = right_handed(np.array(elements), self.points)
        self.axis = self.points[:, 1] < 1e-12
        self.pole = np.argmin(np.hypot(*self.points.T))
        self.integrate()
        self.springs(np.array([outside for *_, outside in nodes]), contact_radius(scene), cells, penalty)
        # C_p⁻¹: yy, rr, yr and hoop.
        self.flowed = np.zeros((4, *self.volumes.shape))
        self.flowed[[0, 1, 3]] = 1.0
        self.work = 0.0

    def integrate(self):
        """Shapes and volumes of the stress, and the mass: the diagonal of the consistent one, scaled by element."""
        grid = felupe.Mesh(self.points, self.cells, "quad8")
        full = felupe.RegionQuadraticQuad(grid)
        reduced = felupe.RegionQuadraticQuad(grid, quadrature=felupe.GaussLegendre(order=1, dim=2))
        (shape, radius), (whole, outer) = self.shapes(reduced), self.shapes(full)
        self.volumes, self.slopes = 2 * math.pi * radius * reduced.dV, np.ascontiguousarray(reduced.dhdX)
        self.hoops = shape[:, :, None] / radius
        parts = np.einsum("aq,bq,qc->cab", whole, whole, 2 * math.pi * outer * full.dV)
        diagonal = np.einsum("caa->ca", parts)
        diagonal *= (parts.sum((1, 2)) / diagonal.sum(1))[:, None]
        self.mass = np.bincount(self.cells.ravel(), diagonal.ravel())
        self.mass *= self.material["density"] * 4 / 3 * math.pi * RADIUS**3 / self.mass.sum()
        places = (self.cells.T.ravel(), np.arange(self.cells.size))
        self.scatter = csr_matrix((np.ones(self.cells.size), places))

    def shapes(self, region):
        shape = region.h.reshape(8, -1)
        return shape, np.einsum("aq,ca->qc", shape, self.points[self.cells][:, :, 1])

    def springs(self, outside, contact, cells, penalty):
        edges = self.cells[:, EDGES].reshape(-1, 3)
        y, r = self.points[edges].transpose(2, 0, 1)
        near = outside[edges].all(1) & (r.max(1) < 1.8 * contact) & (y.max(1) < RADIUS)
        self.edges = edges[near]
        rind = np.unique(self.edges)
        self.rind = rind[np.argsort(self.points[rind, 1])]
        xi, weights = np.polynomial.legendre.leggauss(4)
        self.lagrange = np.array([xi * (xi - 1) / 2, 1 - xi * xi, xi * (xi + 1) / 2])
        slopes = np.array([xi - 0.5, -2 * xi, xi + 0.5])
        ends = self.points[self.edges]
        areas = 2 * math.pi * np.einsum("jq,ej->eq", self.lagrange, ends[:, :, 1]) * weights
        areas *= np.linalg.norm(np.einsum("jq,ejk->eqk", slopes, ends), axis=2)
        plane = self.material["modulus"] / (1 - self.material["nu"] ** 2)
        self.stiffness = penalty * plane * cells / contact * areas

    def stress(self, u, kirchhoff):
        """Returns the nodal forces, and lets the material flow."""
        own = u[self.cells]
        gradient = np.einsum("aJqc,cai->iJqc", self.slopes, own, optimize=True)
        (yy, yr), (ry, rr) = gradient
        yy, rr = yy + 1, rr + 1
        hoop = 1 + np.einsum("aqc,ca->qc", self.hoops, own[:, :, 1], optimize=True)
        plane = yy * rr - yr * ry
        strains, directions = principal(pushed(self.flowed, yy, yr, ry, rr, hoop))
        volume = strains.sum(0)
        deviator = strains - volume / 3
        length = np.sqrt((deviator**2).sum(0))
        strength = self.material["strength"] * (1.0 if kirchhoff else plane * hoop)
        limit = math.sqrt(2 / 3) * strength / (2 * self.shear)
        share = np.minimum(1.0, limit / np.maximum(length, 1e-300))
        if (share < 1).any():
            self.work += math.sqrt(2 / 3) * (length * (1 - share) * strength * self.volumes).sum()
            deviator = deviator * share
            elastic = turned(np.exp(2 * (deviator + volume / 3)), directions)
            inverse = pushed(elastic, rr / plane, -yr / plane, -ry / plane, yy / plane, 1 / hoop)
            self.flowed = np.where(share < 1, inverse, self.flowed)
        t_yy, t_rr, t_yr, t_hoop = self.volumes * turned(2 * self.shear * deviator + self.bulk * volume, directions)
        first = np.array(
            [[t_yy * rr - t_yr * yr, t_yr * yy - t_yy * ry], [t_yr * rr - t_rr * yr, t_rr * yy - t_yr * ry]]
        )
        forces = np.einsum("iJqc,aJqc->aci", first / plane, self.slopes, optimize=True)
        forces[:, :, 1] += np.einsum("qc,aqc->ac", t_hoop / hoop, self.hoops, optimize=True)
        return -(self.scatter @ forces.reshape(-1, 2))

    def press(self, u, forces):
        """Adds the forces of the wall and returns their sum."""
        y = np.einsum("jq,ej->eq", self.lagrange, (self.points + u)[self.edges][:, :, 0])
        springs = self.stiffness * np.maximum(-y, 0.0)
        np.add.at(forces[:, 0], self.edges, np.einsum("jq,eq->ej", self.lagrange, springs))
        return springs.sum()

    def press_on(self, other, own, others):
        """Adds the forces between two balls, each in its own coordinates, and returns their sum along the axis."""
        (place, forces), (rind, reactions) = own, others
        y, r = np.einsum("jq,ejc->ceq", self.lagrange, (self.points + place)[self.edges])
        ends = (other.points + rind)[other.rind]
        k = np.clip(np.searchsorted(ends[:, 1], r) - 1, 0, len(ends) - 2)
        sides = np.diff(ends, axis=0)[k]
        slope, share = sides[..., 0] / sides[..., 1], (r - ends[k, 1]) / sides[..., 1]
        gaps = y + ends[k, 0] + share * sides[..., 0]
        springs = self.stiffness * np.maximum(-gaps, 0.0) / (1 + slope**2)
        for axis, (here, there) in enumerate([(springs, springs), (springs * slope, -springs * slope)]):
            np.add.at(forces[:, axis], self.edges, np.einsum("jq,eq->ej", self.lagrange, here))
            np.add.at(reactions[:, axis], other.rind[k], (1 - share) * there)
            np.add.at(reactions[:, axis], other.rind[k + 1], share * there)
        return springs.sum()


def right_handed(cells, points):
    y, r = points[cells[:, :4]].transpose(2, 0, 1)
    turns = (y * np.roll(r, -1, 1) - np.roll(y, -1, 1) * r).sum(1)
    return np.where((turns > 0)[:, None], cells, cells[:, [0, 3, 2, 1, 7, 6, 5, 4]])


def pushed(tensor, yy, yr, ry, rr, hoop):
    """Returns A T Aᵀ of a symmetric T and A = [[yy, yr], [ry, rr]] with its hoop component."""
    t_yy, t_rr, t_yr, t_hoop = tensor
    first, second = (yy * t_yy + yr * t_yr, yy * t_yr + yr * t_rr), (ry * t_yy + rr * t_yr, ry * t_yr + rr * t_rr)
    return np.array(
        [
            first[0] * yy + first[1] * yr,
            second[0] * ry + second[1] * rr,
            first[0] * ry + first[1] * rr,
            hoop * hoop * t_hoop,
        ]
    )


def principal(tensor):
    """Returns half of the logarithms of the principal values, and cosine and sine of twice the first direction."""
    t_yy, t_rr, t_yr, t_hoop = tensor
    mean, half = (t_yy + t_rr) / 2, (t_yy - t_rr) / 2
    radius = np.hypot(half, t_yr)
    strains = 0.5 * np.log([mean + radius, mean - radius, t_hoop])
    safe = np.where(radius > 0, radius, 1.0)
    return strains, (np.where(radius > 0, half / safe, 1.0), t_yr / safe)


def turned(values, directions):
    """Returns the tensor of principal values and directions."""
    mean, half = (values[0] + values[1]) / 2, (values[0] - values[1]) / 2
    cosine, sine = directions
    return np.array([mean + half * cosine, mean - half * cosine, half * sine, values[2]])


def step_of(ball, share):
    corners = ball.points[ball.cells[:, :4]]
    shortest = np.linalg.norm(corners - np.roll(corners, -1, axis=1), axis=2).min()
    return share * shortest / math.sqrt(6 * (ball.bulk + 4 * ball.shear / 3) / ball.material["density"])


def collide(scene, cells, penalty=20.0, step=0.5, kirchhoff=False):
    material, speed, duration, *others = SCENES[scene]
    balls = [Ball(scene, one, cells, penalty) for one in (material, *others)]
    steps = math.ceil(duration / min(step_of(ball, step) for ball in balls))
    dt, masses = duration / steps, [ball.mass.sum() for ball in balls]
    mass = 1 / sum(1 / one for one in masses)
    moving = [(np.zeros_like(ball.points), np.zeros_like(ball.points)) for ball in balls]
    moving[0][1][:, 0] = -speed
    impulse, travel, last, peak, dents = 0.0, 0.0, 0, 0.0, []
    for k in range(steps):
        forces = [ball.stress(u, kirchhoff) for ball, (u, _) in zip(balls, moving)]
        places = [(u, force) for (u, _), force in zip(moving, forces)]
        force = balls[0].press_on(balls[1], *places) if others else balls[0].press(*places[0])
        for ball, (u, v), inner in zip(balls, moving, forces):
            inner[ball.axis, 1] = 0.0
            v += (dt if k > 0 else 0.5 * dt) * inner / ball.mass[:, None]
            u += dt * v
        impulse += dt * force
        peak = max(peak, force)
        centres = [-(ball.mass @ u[:, 0]) / one for ball, (u, _), one in zip(balls, moving, masses)]
        travel = max(travel, sum(centres))
        if force > 0:
            last, dents = k, []
        else:
            dents.append(moving[0][0][balls[0].pole, 0] + centres[0])
    return {
        "restitution": impulse / (mass * speed) - 1,
        "contact time us": 1e3 * last * dt,
        "travel um": 1e3 * travel,
        "plastic work": sum(ball.work for ball in balls) / (0.5 * mass * speed**2),
        "dent um": 1e3 * sum(dents) / len(dents),
        "peak force N": peak,
    }


if __name__ == "__main__":
    scene, cells, *rest = sys.argv[1:]
    kirchhoff = rest[2:] == ["kirchhoff"]
    for name, value in collide(scene, float(cells), *map(float, rest[:2]), kirchhoff=kirchhoff).items():
        print(f"{name} {value:.6g}")

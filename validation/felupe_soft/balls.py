#!/usr/bin/env python3
"""Rubber balls that collide, by FElupe 11.3: balls.py SCENE CELLS [PENALTY] > NAME.txt

SCENE is one of ../calculix_soft/impact.py, whose balls, blocks and units (mm, ms, g) these are. FElupe has the elements: axisymmetric
biquadratic quadrilaterals of 3 x 3 Gauss points, neo-Hooke G/2 (J^(-2/3) tr b - 3) + K/2 (J - 1)^2, the consistent mass.
Written here and nowhere else are the steps, leapfrog without any damping, and the contact: at four Gauss points of each
edge of one surface a spring on undeformed area to the nearest point of the other surface where it is, a parabola between
three nodes, which takes the opposite force. Lines are time and contact force, of which
../calculix_soft/read.py makes the numbers of the claim. `pip install felupe==11.3.0` has all that is needed.
"""

import math
import sys
from pathlib import Path

import felupe
import numpy as np
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import splu

sys.path.append(str(Path(__file__).parent.parent / "calculix_soft"))

from impact import PENALTY, SCENES, TOWARDS_POLE, blocks

# Of the critical step of the undeformed balls.
STEP_FACTOR = 0.4


def lagrange(x):
    """Shape functions of an edge's nodes at -1, 0, 1 and their slopes and curvatures: (3, points) each."""
    x = np.asarray(x)
    one = np.ones_like(x)
    return (
        np.array([x * (x - 1) / 2, 1 - x * x, x * (x + 1) / 2]),
        np.array([x - 0.5, -2 * x, x + 0.5]),
        np.array([one, -2 * one, one]),
    )


class Body:
    """A ball that touches y = 0 from above (side 1) or below (-1); coordinates are (y, r), as FElupe has them."""

    def __init__(self, ball, n):
        self.points, self.cells = mesh(n, ball.radius, ball.side)
        region = felupe.RegionBiQuadraticQuad(felupe.Mesh(self.points, self.cells, "quad9"))
        self.field = felupe.FieldContainer([felupe.FieldAxisymmetric(region, dim=2)])
        bulk, shear = ball.modulus / (3 * (1 - 2 * ball.nu)), ball.modulus / (2 * (1 + ball.nu))
        self.solid = felupe.SolidBody(felupe.NeoHooke(mu=shear, bulk=bulk), self.field)
        volumes = 2 * math.pi * self.field[0].radius * region.dV
        shape = np.broadcast_to(region.h, (*region.h.shape[:2], len(self.cells)))
        masses = ball.density * np.einsum("aqc,bqc,qc->cab", shape, shape, volumes)
        rows = np.repeat(self.cells, 9, axis=1).ravel()
        columns = np.tile(self.cells, (1, 9)).ravel()
        size = len(self.points)
        self.mass = csr_matrix((masses.ravel(), (rows, columns)), shape=(size, size)).tocsc()
        self.solve = splu(self.mass).solve
        self.axis = self.points[:, 1] < 1e-9
        self.u = np.zeros_like(self.points)
        self.v = np.zeros_like(self.points)
        self.edges = rim(self.points, self.cells, ball.radius, ball.side)
        nodes = self.points[self.edges]
        xi, weights = np.polynomial.legendre.leggauss(4)
        self.n, slopes, _ = lagrange(xi)
        r = np.einsum("jq,ej->eq", self.n, nodes[:, :, 1])
        ds = np.linalg.norm(np.einsum("jq,ejk->eqk", slopes, nodes), axis=2)
        self.areas = (2 * math.pi * r * ds * weights).ravel()

    def at(self):
        return self.points + self.u

    def forces(self):
        self.field[0].values[:] = self.u
        return -self.solid.assemble.vector(self.field).toarray().reshape(-1, 2)

    def accelerate(self, forces, dt):
        acceleration = self.solve(forces)
        acceleration[self.axis, 1] = 0.0
        self.v += dt * acceleration

    def surface(self):
        """Points of the springs."""
        return np.einsum("jq,ejk->eqk", self.n, self.at()[self.edges]).reshape(-1, 2)

    def add_surface(self, forces, at_springs):
        """Forces of springs to the nodes of their edges."""
        parts = np.einsum("jq,eqk->ejk", self.n, at_springs.reshape(len(self.edges), -1, 2))
        np.add.at(forces, self.edges, parts)

    def critical_step(self):
        """2 over the largest frequency, by iteration on the stiffness of FElupe."""
        stiffness = self.solid.assemble.matrix(self.field).tocsr()
        x = np.random.default_rng(1).standard_normal(self.points.shape)
        square = 0.0
        for _ in range(200):
            x[self.axis, 1] = 0.0
            x /= np.linalg.norm(x)
            x_new = self.solve((stiffness @ x.ravel()).reshape(-1, 2))
            square, x = np.linalg.norm(x_new), x_new
        return 2 / math.sqrt(square)


def mesh(n, radius, side):
    """Points (y, r) and cells of nine points, of the map of impact.py without its hole."""
    numbers, points, cells = {}, [], []

    def node(zeta):
        z = (zeta - TOWARDS_POLE) / (1 - TOWARDS_POLE * zeta)
        key = (round(z.imag, 9), round(z.real, 9))
        if key not in numbers:
            numbers[key] = len(points)
            points.append((side * radius * (1 + z.real), radius * max(z.imag, 0.0)))
        return numbers[key]

    places = [(0, 0), (0, 1), (1, 1), (1, 0), (0, 0.5), (0.5, 1), (1, 0.5), (0.5, 0), (0.5, 0.5)]
    for place, m1, m2 in blocks(n):
        for i in range(m1):
            for j in range(m2):
                cells.append([node(place((i + a) / m1, (j + b) / m2)) for a, b in places])
    points, cells = np.array(points), np.array(cells)
    for k, cell in enumerate(cells):
        y, r = points[cell[:4]].T
        if np.sum(y * np.roll(r, -1) - np.roll(y, -1) * r) < 0:
            cells[k] = cell[[0, 3, 2, 1, 7, 6, 5, 4, 8]]
    return points, cells


def rim(points, cells, radius, side):
    """Edges of the half that faces the other body: three points each."""
    edges = []
    for cell in cells:
        for ends in [(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)]:
            edge = cell[list(ends)]
            y, r = points[edge].T
            on_rim = np.abs(np.hypot(y - side * radius, r) - radius) < 1e-7
            if on_rim.all() and np.abs(y).min() < radius:
                edges.append(edge)
    return np.array(edges)


def nearest(surface, nodes):
    """Edge and place on it (-1 to 1) of the nearest point of edges (n, 3, 2)."""
    samples = np.linspace(-1, 1, 9)
    shape, _, _ = lagrange(samples)
    places = np.einsum("jq,ejk->eqk", shape, nodes).reshape(-1, 2)
    squares = (surface[:, None, 0] - places[None, :, 0]) ** 2
    squares += (surface[:, None, 1] - places[None, :, 1]) ** 2
    first = np.argmin(squares, axis=1)
    edge, xi = first // 9, samples[first % 9]
    for _ in range(5):
        shape, slope, curvature = lagrange(xi)
        own = nodes[edge]
        d = surface - np.einsum("jp,pjk->pk", shape, own)
        t = np.einsum("jp,pjk->pk", slope, own)
        c = np.einsum("jp,pjk->pk", curvature, own)
        change = (d * t).sum(1) / np.maximum((t * t).sum(1) - (d * c).sum(1), 1e-12)
        xi = np.clip(xi + change, -1, 1)
    return edge, xi


def press(bodies, forces, penalty):
    """Adds what the springs do and returns the force along y on the last body."""
    body = bodies[-1]
    surface = body.surface()
    if len(bodies) == 1:
        springs = np.zeros_like(surface)
        springs[:, 0] = -penalty * body.areas * np.minimum(surface[:, 0], 0.0)
        body.add_surface(forces[0], springs)
        return springs[:, 0].sum()
    other = bodies[0]
    nodes = other.at()[other.edges]
    edge, xi = nearest(surface, nodes)
    shape, slope, _ = lagrange(xi)
    d = surface - np.einsum("jp,pjk->pk", shape, nodes[edge])
    t = np.einsum("jp,pjk->pk", slope, nodes[edge])
    # The other lies below: outward is where y grows on its axis and r on its equator.
    outward = np.stack([t[:, 1], -t[:, 0]], axis=1)
    outward *= np.where(t[:, 1] >= 0, 1.0, -1.0)[:, None]
    is_inside = (d * outward).sum(1) < 0
    springs = -penalty * (body.areas * is_inside)[:, None] * d
    body.add_surface(forces[-1], springs)
    for j in range(3):
        np.add.at(forces[0], other.edges[edge, j], -shape[j][:, None] * springs)
    return springs[:, 0].sum()


def collide(scene, n, penalty):
    balls, speed, duration = SCENES[scene]
    bodies = [Body(ball, n) for ball in balls]
    bodies[0].v[:, 0] = -balls[0].side * speed
    dt = STEP_FACTOR * min(body.critical_step() for body in bodies)
    steps = math.ceil(duration / dt)
    dt = duration / steps
    for k in range(steps):
        forces = [body.forces() for body in bodies]
        yield k * dt, press(bodies, forces, penalty)
        for body, force in zip(bodies, forces):
            body.accelerate(force, dt if k > 0 else 0.5 * dt)
            body.u += dt * body.v


if __name__ == "__main__":
    penalty = float(sys.argv[3]) if len(sys.argv) > 3 else PENALTY
    for time, force in collide(sys.argv[1], int(sys.argv[2]), penalty):
        print(f"{time:.9g} {force:.9g}")

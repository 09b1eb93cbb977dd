"""The impact of a steel ball on an elastic layer that is free on both faces and has no edge, at 1 m/s.

The layer is exact: its surface displacement under a point force, less the static one of a half-space, which is Hertz' own, is

    D(s) = 1/2pi int k dk [ (U_s(k,s) + U_a(k,s))/2 - (1 - nu)/(mu k) ],
    U_s = al b^2 / ( mu [ q^2 coth(al H) - 4 k^2 al be coth(be H) ] ),    U_a with tanh,
    al^2 = k^2 + s^2/c_p^2,  be^2 = k^2 + s^2/c_s^2,  b^2 = s^2/c_s^2,  q = k^2 + be^2,  H = h/2

(Rayleigh-Lamb; Graff 1975, Wave Motion in Elastic Solids, chapter 8). The ball has its mass, Hertz' contact and the static
compliance of its finite size (Lurie's series, crates/fem-laws/src/finite_size/coefficient.rs), and does not vibrate. The force
follows from the approach by convolution quadrature (Lubich 1988, Numer. Math. 52, 129) with BDF2. Steps below 0.15 us are unstable,
since a point force has no reaction of its own at the shortest times; those of 0.4 and 0.2 us differ by 1e-4 in the restitution.

    python3 layer.py THICKNESS_MM DURATION_US STEPS...
"""

import cmath
import math
import sys

E, NU, RHO, R, SPEED = 210e9, 0.3, 7800.0, 5e-3, 1.0
MU = E / 2 / (1 + NU)
CS2, CP2 = MU / RHO, 2 * MU * (1 - NU) / (1 - 2 * NU) / RHO
MASS = RHO * 4 / 3 * math.pi * R**3
MODULUS = E / 2 / (1 - NU * NU)
STIFFNESS = 4 / 3 * MODULUS * math.sqrt(R)


def size_of_ball():
    """The approach that the ball's finite size adds, per force, at 0.85 of Hertz' contact radius."""
    total = 0.0
    for n in range(200_000):
        if n == 1:
            response = 1.8 * (1 - 2 * NU) / (1 + NU)
        else:
            numerator = 4 * (1 - NU) * n * n + 2 * NU * n - 2 + 4 * NU
            response = (n + 0.5) * numerator / ((n - 1) * (n * n + (1 + 2 * NU) * n + 1 + NU))
        total += response - 4 * (1 - NU) - 2 * (1 - 2 * NU) ** 2 / (n + 0.5)
    logarithm = 2 * (1 - 2 * NU) ** 2
    approach = (15 * MASS * SPEED**2 / 16 / MODULUS / math.sqrt(R)) ** 0.4
    ratio = R / (0.85 * math.sqrt(R * approach))
    c = total - 2 * (1 - 2 * NU) + logarithm * (19 / 12 + math.log(2) + math.log(ratio))
    return (1 + NU) / 4 / math.pi * c / (E * R)


def layer(thickness, points=500, turn=0.35, first=10.0, last=3e4):
    """D(s) for Re s > 0, along a path of wavenumbers that is turned away from the poles."""
    half, end = 0.5 * thickness, math.log(last / first + 1)
    step, turned = end / points, cmath.exp(1j * turn)
    path = []
    for i in range(points):
        stretch = math.exp((i + 0.5) * step)
        path.append((first * (stretch - 1) * turned, first * stretch * step * turned))

    def displacement(s):
        if s.imag < 0:
            return displacement(s.conjugate()).conjugate()
        total, b2 = 0j, s * s / CS2
        for k, weight in path:
            k2 = k * k
            al, be = cmath.sqrt(k2 + s * s / CP2), cmath.sqrt(k2 + b2)
            ta, tb = [cmath.tanh(x * half) if (x * half).real < 20 else 1 for x in (al, be)]
            a, b = (2 * k2 + b2) ** 2, 4 * k2 * al * be
            u = al * b2 / (2 * MU) * (1 / (a / ta - b / tb) + 1 / (a * ta - b * tb))
            total += weight * k / (2 * math.pi) * (u - (1 - NU) / (MU * k))
        return total

    return displacement


def impact(thickness, duration, n):
    """Returns restitution, peak force (N) and contact time (s) with n steps in a duration (s)."""
    dt, size, d, own = duration / n, 2 * n, layer(thickness), size_of_ball()
    radius = 10 ** (-10 / size)
    values = [0j] * size
    for j in range(n + 1):
        z = radius * cmath.exp(2j * math.pi * j / size)
        s = ((1 - z) + 0.5 * (1 - z) ** 2) / dt
        values[j] = d(s) + 1 / (MASS * s * s) + own
        values[-j] = values[j].conjugate()
    weights = []
    for m in range(n + 1):
        turn = cmath.exp(-2j * math.pi * m / size)
        factor, total = 1 + 0j, 0.0
        for value in values:
            total += (value * factor).real
            factor *= turn
        weights.append(total / size * radius**-m)
    force = [0.0]
    for m in range(1, n + 1):
        left = SPEED * m * dt - sum(weights[m - j] * force[j] for j in range(1, m))
        if left <= 0:
            break
        u = left
        for _ in range(60):
            excess = u + weights[0] * STIFFNESS * u**1.5 - left
            u = max(u - excess / (1 + 1.5 * weights[0] * STIFFNESS * math.sqrt(u)), 0.0)
        force.append(STIFFNESS * u**1.5)
    return sum(force) * dt / (MASS * SPEED) - 1, max(force), len(force) * dt


if __name__ == "__main__":
    thickness, duration = float(sys.argv[1]) * 1e-3, float(sys.argv[2]) * 1e-6
    for n in map(int, sys.argv[3:]):
        print(n, *impact(thickness, duration, n))

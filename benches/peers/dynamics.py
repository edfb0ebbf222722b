"""Dynamics of a serial chain over numbers or symbols: the textbook recursions that code generators are usually fed with.

Vectors are lists of three entries, matrices lists of rows. An entry is a float or whatever the code generator computes with;
exact zeros and ones leave nothing behind, so that a generator sees the structure of the arm and not products with zero.

Sources: recursive Newton-Euler and composite rigid bodies as in Featherstone, Rigid Body Dynamics Algorithms, 2008; Coriolis
matrix as in Echeandia and Wensing, Numerical methods to compute the Coriolis matrix and Christoffel symbols for rigid-body
systems, 2021.
"""

import json
import math

# Order of the ten: m mx my mz ixx ixy ixz iyy iyz izz.
PAIRS = {(0, 0): 4, (0, 1): 5, (0, 2): 6, (1, 1): 7, (1, 2): 8, (2, 2): 9}


def number(x):
    return isinstance(x, (int, float))


def add(a, b):
    if number(a) and a == 0:
        return b
    if number(b) and b == 0:
        return a
    return a + b


def mul(a, b):
    for x, y in ((a, b), (b, a)):
        if number(x):
            if x == 0:
                return 0.0
            if x == 1:
                return y
            if x == -1:
                return -y
    return a * b


def neg(a):
    return -a if not (number(a) and a == 0) else 0.0


def total(terms):
    sum_ = 0.0
    for term in terms:
        sum_ = add(sum_, term)
    return sum_


def dot(a, b):
    return total(mul(x, y) for x, y in zip(a, b))


def plus(*vectors):
    return [total(entries) for entries in zip(*vectors)]


def scaled(s, a):
    return [mul(s, x) for x in a]


def minus(a):
    return [neg(x) for x in a]


def cross(a, b):
    return [add(mul(a[1], b[2]), neg(mul(a[2], b[1]))),
            add(mul(a[2], b[0]), neg(mul(a[0], b[2]))),
            add(mul(a[0], b[1]), neg(mul(a[1], b[0])))]


def times(A, b):
    return [dot(row, b) for row in A]


def transpose(A):
    return [list(column) for column in zip(*A)]


def product(A, B):
    columns = transpose(B)
    return [[dot(row, column) for column in columns] for row in A]


def matrix_plus(A, B):
    return [plus(a, b) for a, b in zip(A, B)]


def matrix_scaled(s, A):
    return [scaled(s, row) for row in A]


def skew(a):
    return [[0.0, neg(a[2]), a[1]], [a[2], 0.0, neg(a[0])], [neg(a[1]), a[0], 0.0]]


IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
ZERO = [0.0, 0.0, 0.0]


def matrix_of(inertial):
    return [[inertial[PAIRS[min(r, c), max(r, c)]] for c in range(3)] for r in range(3)]


def split(inertial):
    """Mass, first moments, inertia."""
    return inertial[0], inertial[1:4], matrix_of(inertial)


def inertial_of(m, h, I):
    return [m, *h, I[0][0], I[0][1], I[0][2], I[1][1], I[1][2], I[2][2]]


def moved(inertial, E, p):
    """The ten of a body in another frame, in which its own frame stands at E, p."""
    m, h = inertial[0], times(E, inertial[1:4])
    I = product(product(E, matrix_of(inertial)), transpose(E))
    P, H = skew(p), skew(h)
    shift = matrix_plus(product(P, H), product(H, P))
    shift = matrix_plus(shift, matrix_scaled(m, product(P, P)))
    I = matrix_plus(I, matrix_scaled(-1.0, shift))
    return inertial_of(m, plus(h, scaled(m, p)), I)


class Link:
    """Fixed part before the joint, the joint, fixed part after it; the ten of the body in the frame after all three."""

    def __init__(self, link):
        self.revolute = link["revolute"]
        self.R0, self.p0 = link["before"]["rotation"], link["before"]["translation"]
        self.axis, self.offset = link["axis"], link["offset"]
        self.R1, self.p1 = link["after"]["rotation"], link["after"]["translation"]
        self.inertial = link["inertial"]
        if not self.revolute:
            raise SystemExit("peers are written for revolute joints")

    def turn(self, s, c):
        """Rotation about the axis, of the sine and cosine of the coordinate."""
        so, co = math.sin(self.offset), math.cos(self.offset)
        so, co = (round(x) if abs(x - round(x)) < 1e-12 else x for x in (so, co))
        s, c = add(mul(s, co), mul(c, so)), add(mul(c, co), neg(mul(s, so)))
        k = self.axis
        if sorted(map(abs, k)) != [0, 0, 1]:
            raise SystemExit("peers are written for axes along those of their frames")
        n = [abs(x) for x in k].index(1)
        s = mul(k[n], s)
        R = [row[:] for row in IDENTITY]
        i, j = (n + 1) % 3, (n + 2) % 3
        R[i][i], R[j][j], R[i][j], R[j][i] = c, c, neg(s), s
        return R


class Arm:
    def __init__(self, path):
        data = json.load(open(path))
        self.name, self.gravity, self.base_columns = data["name"], data["gravity"], data["base_columns"]
        self.links = [Link(link) for link in data["links"]]
        self.dof = len(self.links)

    def cut_at_joints(self):
        """The same arm with its frames behind the joints: what a standard DH row has after its joint moves to the next link."""
        R, p = IDENTITY, ZERO
        for link in self.links:
            link.R0, link.p0 = product(R, link.R0), plus(p, times(R, link.p0))
            R, p = link.R1, link.p1
            link.inertial = moved(link.inertial, R, p)
            link.R1, link.p1 = IDENTITY, ZERO
        return self

    def frames(self, sines, cosines):
        """Per link: rotation to the parent, axis in the link, origin before the joint in the parent and after it in the link."""
        frames = []
        for link, s, c in zip(self.links, sines, cosines):
            back = transpose(link.R1)
            E = product(product(link.R0, link.turn(s, c)), link.R1)
            frames.append((E, times(back, link.axis), link.p0, times(back, link.p1)))
        return frames


def motion(arm, frames, dq, ddq, gravity=True):
    """Of each link in its frame: angular velocity and acceleration, acceleration of the origin, and `dw x + w x w x`."""
    w, dw, F = ZERO, ZERO, None
    a = minus(arm.gravity) if gravity else ZERO
    out = []
    for (E, z, p, r), v, dv in zip(frames, dq, ddq):
        T = transpose(E)
        a = times(T, plus(a, times(F, p)) if F else a)
        w0, dw0, zv = times(T, w), times(T, dw), scaled(v, z)
        w, dw = plus(w0, zv), plus(dw0, cross(w0, zv), scaled(dv, z))
        W = skew(w)
        F = matrix_plus(skew(dw), product(W, W))
        a = plus(a, times(F, r))
        out.append((w, dw, a, F))
    return out


def moments(w, dw, F):
    """`I dw + w x I w` of the six unit inertias, in the order of the ten, of sums that `F` has."""
    xx, yy, zz = (mul(x, x) for x in w)
    xy, xz, yz = mul(w[0], w[1]), mul(w[0], w[2]), mul(w[1], w[2])
    return [[dw[0], xz, neg(xy)],
            [neg(F[2][0]), F[2][1], add(xx, neg(yy))],
            [F[1][0], add(zz, neg(xx)), neg(F[1][2])],
            [neg(yz), dw[1], xy],
            [add(yy, neg(zz)), neg(F[0][1]), F[0][2]],
            [yz, neg(xz), dw[2]]]


def to_parent(frame, f, n):
    """A force and a moment about the link's origin, in the parent about its origin."""
    E, _, p, r = frame
    n = plus(n, cross(r, f))
    f, n = times(E, f), times(E, n)
    return f, plus(n, cross(p, f))


def at_joint(frame, f, n):
    """Torque of the joint that carries a force and a moment about the link's origin."""
    _, z, _, r = frame
    return dot(z, plus(n, cross(r, f)))


def inverse_dynamics(arm, frames, dq, ddq, gravity=True):
    wrenches = []
    for link, (w, dw, a, F) in zip(arm.links, motion(arm, frames, dq, ddq, gravity)):
        m, h, inertia = link.inertial[0], link.inertial[1:4], link.inertial[4:]
        f = plus(scaled(m, a), times(F, h))
        n = plus(cross(h, a), *map(scaled, inertia, moments(w, dw, F)))
        wrenches.append((f, n))
    f, n, tau = ZERO, ZERO, []
    for frame, (F, N) in zip(reversed(frames), reversed(wrenches)):
        f, n = plus(f, F), plus(n, N)
        tau.append(at_joint(frame, f, n))
        f, n = to_parent(frame, f, n)
    return tau[::-1]


def gravity(arm, frames):
    """First moments of what a joint carries, and gravity in the frames of the links."""
    g, directions = arm.gravity, []
    for E, _, _, _ in frames:
        g = times(transpose(E), g)
        directions.append(g)
    m, h, tau = 0.0, ZERO, []
    for link, (E, z, p, r), g in zip(reversed(arm.links), reversed(frames), reversed(directions)):
        m, h = add(m, link.inertial[0]), plus(h, link.inertial[1:4])
        h = plus(h, scaled(m, r))
        tau.append(dot(z, cross(g, h)))
        h = plus(times(E, h), scaled(m, p))
    return tau[::-1]


def mass_matrix(arm, frames):
    """Composite rigid bodies; for frames behind the joints."""
    M = [[0.0] * arm.dof for _ in range(arm.dof)]
    composite = [0.0] * 10
    for k in reversed(range(arm.dof)):
        E, z, p, _ = frames[k]
        composite = plus(composite, arm.links[k].inertial)
        f = cross(z, composite[1:4])
        n = times(matrix_of(composite), z)
        M[k][k] = dot(z, n)
        for j in reversed(range(k)):
            f, n = to_parent(frames[j + 1], f, n)
            M[k][j] = M[j][k] = at_joint(frames[j], f, n)
        composite = moved(composite, E, p)
    return M


def second_moments(I):
    """`tr(I) / 2 - I`: of an inertia the integral of `r r'` over the mass."""
    half = mul(0.5, total(I[k][k] for k in range(3)))
    return matrix_plus(matrix_scaled(half, IDENTITY), matrix_scaled(-1.0, I))


def inertia(S):
    """Of second moments."""
    return matrix_plus(matrix_scaled(total(S[k][k] for k in range(3)), IDENTITY), matrix_scaled(-1.0, S))


def moments_in_parent(E, p, m, h, S):
    """First and second moments of a mass in the frame in which its own stands at `E, p`."""
    h, S = times(E, h), product(product(E, S), transpose(E))
    entry = lambda r, c: total([S[r][c], mul(p[r], h[c]), mul(h[r], p[c]), mul(m, mul(p[r], p[c]))])
    return plus(h, scaled(m, p)), [[entry(min(r, c), max(r, c)) for c in range(3)] for r in range(3)]


def coriolis_matrix(arm, frames, dq):
    """Christoffel form, of composite bodies in the frames of the links; for frames behind the joints.

    Of the 6 x 6 matrix `B` of a body (angular part first) with first moments `h`, second moments `S` about the origin and velocity
    `(w, u)` of it, the rows of moments are `[-(w x) S - (h x)(u x), 0]` and those of forces `[-f x, 0]`; `f` is its momentum.
    """
    w, u, bodies = ZERO, ZERO, []
    for link, (E, z, p, _), rate in zip(arm.links, frames, dq):
        T = transpose(E)
        u = times(T, plus(u, cross(w, p)))
        w = plus(times(T, w), scaled(rate, z))
        m, h, I = split(link.inertial)
        S = second_moments(I)
        B = matrix_scaled(-1.0, matrix_plus(product(skew(w), S), product(skew(h), skew(u))))
        bodies.append((m, h, S, B, plus(scaled(m, u), cross(w, h)), cross(w, z), cross(u, z)))
    C = [[0.0] * arm.dof for _ in bodies]
    m, h, S, B, F = 0.0, ZERO, [ZERO] * 3, [ZERO] * 3, ZERO
    for j in reversed(range(arm.dof)):
        (E, z, p, _), (m_j, h_j, S_j, B_j, F_j, dz, ds) = frames[j], bodies[j]
        m, h, S, B, F = m + m_j, plus(h, h_j), matrix_plus(S, S_j), matrix_plus(B, B_j), plus(F, F_j)
        I = inertia(S)
        # Wrenches of the axis' own change, of the axis, and of the axis through the transpose of `B`.
        change = plus(scaled(m, ds), cross(dz, h), cross(z, F)), plus(times(I, dz), cross(h, ds), times(B, z))
        unit = cross(z, h), times(I, z)
        back = ZERO, times(transpose(B), z)
        C[j][j] = dot(z, change[1])
        for i in reversed(range(j)):
            change, unit, back = (to_parent(frames[i + 1], *wrench) for wrench in (change, unit, back))
            z_i, (*_, dz_i, ds_i) = frames[i][1], bodies[i]
            C[i][j] = dot(z_i, change[1])
            C[j][i] = total([dot(ds_i, unit[0]), dot(dz_i, unit[1]), dot(z_i, back[1])])
        F = times(E, F)
        B = matrix_plus(product(product(E, B), transpose(E)), matrix_scaled(-1.0, product(skew(p), skew(F))))
        h, S = moments_in_parent(E, p, m, h, S)
    return C

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
    """Angular velocity, angular acceleration and acceleration of the origin of each link, in its frame."""
    w, dw = ZERO, ZERO
    a = minus(arm.gravity) if gravity else ZERO
    out = []
    for (E, z, p, r), v, dv in zip(frames, dq, ddq):
        T = transpose(E)
        a = times(T, plus(a, cross(dw, p), cross(w, cross(w, p))))
        w0, dw0 = times(T, w), times(T, dw)
        zv = scaled(v, z)
        w, dw = plus(w0, zv), plus(dw0, cross(w0, zv), scaled(dv, z))
        a = plus(a, cross(dw, r), cross(w, cross(w, r)))
        out.append((w, dw, a))
    return out


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
    for link, (w, dw, a) in zip(arm.links, motion(arm, frames, dq, ddq, gravity)):
        m, h, I = link.inertial[0], link.inertial[1:4], matrix_of(link.inertial)
        f = plus(scaled(m, a), cross(dw, h), cross(w, cross(w, h)))
        n = plus(times(I, dw), cross(w, times(I, w)), cross(h, a))
        wrenches.append((f, n))
    f, n, tau = ZERO, ZERO, []
    for frame, (F, N) in zip(reversed(frames), reversed(wrenches)):
        f, n = plus(f, F), plus(n, N)
        tau.append(at_joint(frame, f, n))
        f, n = to_parent(frame, f, n)
    return tau[::-1]


def gravity(arm, frames):
    zeros = [0.0] * arm.dof
    return inverse_dynamics(arm, frames, zeros, zeros)


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


def regressor(arm, frames, dq, ddq):
    Y = [[0.0] * (10 * arm.dof) for _ in range(arm.dof)]
    for k, (w, dw, a) in enumerate(motion(arm, frames, dq, ddq)):
        W, dW = skew(w), skew(dw)
        forces = matrix_plus(dW, product(W, W))
        wrenches = [(a, ZERO)]
        units = transpose(IDENTITY)
        wrenches += [(times(forces, e), cross(e, a)) for e in units]
        for (r, c) in PAIRS:
            I = [[1.0 if (x, y) in ((r, c), (c, r)) else 0.0 for y in range(3)] for x in range(3)]
            wrenches.append((ZERO, plus(times(I, dw), cross(w, times(I, w)))))
        for column, (f, n) in enumerate(wrenches):
            for j in reversed(range(k + 1)):
                Y[j][10 * k + column] = at_joint(frames[j], f, n)
                f, n = to_parent(frames[j], f, n)
    return Y


def base_regressor(arm, frames, dq, ddq):
    Y = regressor(arm, frames, dq, ddq)
    return [[row[k] for k in arm.base_columns] for row in Y]


def six(A, B, C, D):
    return [a + b for a, b in zip(A, B)] + [c + d for c, d in zip(C, D)]


def coriolis_matrix(arm, frames, dq):
    """Christoffel form, all in the base frame; for frames behind the joints. Spatial vectors are (angular, linear)."""
    R, p, v = IDENTITY, ZERO, [0.0] * 6
    zeros = [ZERO] * 3
    joints = []
    for link, (E, z, p0, _), rate in zip(arm.links, frames, dq):
        p = plus(p, times(R, p0))
        R = product(R, E)
        axis = times(R, z)
        J = axis + cross(p, axis)
        v = plus(v, scaled(rate, J))
        w, u = v[:3], v[3:]
        dJ = cross(w, J[:3]) + plus(cross(w, J[3:]), cross(u, J[:3]))
        body = moved(link.inertial, R, p)
        m, h, I = body[0], body[1:4], matrix_of(body)
        H = skew(h)
        inertia = six(I, H, matrix_scaled(-1.0, H), matrix_scaled(m, IDENTITY))
        momentum = times(inertia, v)
        W, U = skew(w), skew(u)
        motion_cross = six(W, zeros, U, W)
        force_cross = matrix_scaled(-1.0, transpose(motion_cross))
        # (momentum x*) x = x x* momentum
        K, L = skew(momentum[:3]), skew(momentum[3:])
        by_momentum = matrix_scaled(-1.0, six(K, L, L, zeros))
        B = matrix_plus(product(force_cross, inertia), by_momentum)
        B = matrix_plus(B, matrix_scaled(-1.0, product(inertia, motion_cross)))
        joints.append((J, dJ, inertia, matrix_scaled(0.5, B)))
    n = arm.dof
    C = [[0.0] * n for _ in range(n)]
    nothing = [[0.0] * 6 for _ in range(6)]
    inertia, B = nothing, nothing
    for j in reversed(range(n)):
        J, dJ, own, own_B = joints[j]
        inertia, B = matrix_plus(inertia, own), matrix_plus(B, own_B)
        F1 = plus(times(inertia, dJ), times(B, J))
        F2, F3 = times(inertia, J), times(transpose(B), J)
        for i in range(j + 1):
            Ji, dJi = joints[i][:2]
            C[i][j] = dot(Ji, F1)
            if i < j:
                C[j][i] = add(dot(dJi, F2), dot(Ji, F3))
    return C

"""Regressors of a chain, `tau = Y pi`, with the ten of each link in the order of `dynamics`, and what follows from them.

An entry is a product of an axis and the wrench of a column, both in the frame of the column's link: so one axis is moved from link
to link where there are ten wrenches to hand back.
"""

import random

import numpy

from dynamics import ZERO, cross, dot, moments, motion, moved, plus, times, transpose


def regressor(arm, frames, dq, ddq):
    n = arm.dof
    Y = [[0.0] * (10 * n) for _ in range(n)]
    # Of each joint, seen from the link: its axis, and the velocity of the link's origin for a unit rate.
    axes = []
    for k, ((E, z, p, r), (w, dw, a, F)) in enumerate(zip(frames, motion(arm, frames, dq, ddq))):
        T = transpose(E)
        before = [(times(T, y), times(T, plus(u, cross(y, p)))) for y, u in axes]
        axes = [(y, plus(u, cross(y, r))) for y, u in [*before, (z, ZERO)]]
        columns = moments(w, dw, F)
        for row, (y, u) in zip(Y, axes):
            firsts = plus(times(transpose(F), u), cross(a, y))
            row[10 * k:10 * k + 10] = [dot(a, u), *firsts, *(dot(y, column) for column in columns)]
    return Y


def to_frames_of(spec):
    """`A` of `Y A = Y'`, where `Y` has frames that are cut at the joints, and `Y'` those of the spec."""
    n = spec.dof
    A = numpy.zeros((10 * n, 10 * n))
    for k, link in enumerate(spec.links):
        for c, unit in enumerate(numpy.eye(10).tolist()):
            A[10 * k:10 * k + 10, 10 * k + c] = moved(unit, link.R1, link.p1)
    return A


class Base:
    """Independent columns of an arm's regressor, `kept`, and `combination` with `Y = Y[:, kept] combination`."""

    # Inertias before first moments before the mass: what falls out are the columns that cost most.
    ORDER = [4, 5, 6, 8, 9, 7, 1, 2, 3, 0]
    STATES = 40
    TOLERANCE = 1e-9

    def __init__(self, arm):
        numbers = random.Random(1)
        some = lambda size: [numbers.uniform(-size, size) for _ in range(arm.dof)]
        rows = []
        for _ in range(self.STATES):
            q = some(3.0)
            frames = arm.frames(numpy.sin(q).tolist(), numpy.cos(q).tolist())
            rows += regressor(arm, frames, some(2.0), some(5.0))
        Y = numpy.array(rows)
        kept, directions = [], []
        for k in (10 * link + c for link in range(arm.dof) for c in self.ORDER):
            left = Y[:, k].copy()
            # Twice, for what rounding leaves the first time.
            for direction in directions * 2:
                left -= direction * (direction @ left)
            size = numpy.linalg.norm(left)
            if size > self.TOLERANCE * max(numpy.linalg.norm(Y[:, k]), 1.0):
                kept.append(k)
                directions.append(left / size)
        self.kept = sorted(kept)
        self.combination = numpy.linalg.lstsq(Y[:, self.kept], Y, rcond=None)[0]
        # Coefficients are products of lengths, sines and cosines: what is smaller is rounding.
        self.combination[abs(self.combination) < self.TOLERANCE] = 0.0


def lump(arm, base):
    """The same torques of fewer parameters: base values in place of the kept ones, zeros in place of the others."""
    inertials = numpy.zeros(10 * arm.dof)
    inertials[base.kept] = base.combination @ numpy.concatenate([link.inertial for link in arm.links])
    for link, ten in zip(arm.links, inertials.reshape(arm.dof, 10).tolist()):
        link.inertial = ten

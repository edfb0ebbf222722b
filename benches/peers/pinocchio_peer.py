"""An arm in numbers for `pinocchio.cpp`: arm.json in, arm.txt out.

Number of joints, gravity, then per joint: axis, placement in the parent (rotation, translation), mass, center of mass, inertia
about it; then the matrix that takes the columns of its regressor to those of the spec's frames.
"""

import sys

from dynamics import Arm, matrix_of
from regressors import to_frames_of

# Pinocchio's order of the ten is `m mx my mz ixx ixy iyy ixz iyz izz`.
ORDER = [0, 1, 2, 3, 4, 5, 7, 6, 8, 9]

arm_file, out = sys.argv[1:]
arm = Arm(arm_file).cut_at_joints()
with open(out + "/arm.txt", "w") as file:
    print(arm.dof, *arm.gravity, file=file)
    for link in arm.links:
        if abs(link.offset) > 0:
            raise SystemExit("the peer is written for joints without offset")
        m, h, I = link.inertial[0], link.inertial[1:4], matrix_of(link.inertial)
        c = [x / m if m else 0.0 for x in h]
        square = sum(x * x for x in c)
        I = [[I[r][k] - m * ((square if r == k else 0.0) - c[r] * c[k]) for k in range(3)] for r in range(3)]
        rows = lambda A: [x for row in A for x in row]
        print(*link.axis, *rows(link.R0), *link.p0, m, *c, *rows(I), file=file)
    columns = [10 * k + c for k in range(arm.dof) for c in ORDER]
    for row in to_frames_of(Arm(arm_file))[columns]:
        print(*row, file=file)

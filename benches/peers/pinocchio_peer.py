"""An arm in numbers for `pinocchio.cpp`: arm.json in, arm.txt out.

Number of joints, gravity, then per joint: axis, placement in the parent (rotation, translation), mass, center of mass, inertia
about it.
"""

import sys

from dynamics import Arm, matrix_of

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

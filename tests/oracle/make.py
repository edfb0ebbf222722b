"""Writes urdf.json: torques of Pinocchio (package `pin`) for the URDFs of the shared material, three states each.

Usage: python make.py SHARED > urdf.json
Joints beside the chain stand at zero and move with the links that carry them, as the import says.
"""
import glob
import json
import os
import sys

import numpy as np
import pinocchio as pin

shared = sys.argv[1]
chains = {"data/tiago/tiago_48_schunk.urdf": ("torso_lift_joint", "arm_7_joint")}
rng = np.random.default_rng(20261121)
cases = []
for path in sorted(glob.glob(f"{shared}/**/*.urdf", recursive=True)):
    name = os.path.relpath(path, shared)
    model = pin.buildModelFromUrdf(path)
    names = list(model.names)[1:]
    if name in chains:
        first, last = chains[name]
        arm = names[names.index("arm_1_joint"):names.index(last) + 1]
        moving = [first, *arm]
        others = [model.getJointId(j) for j in names if j not in moving]
        model = pin.buildReducedModel(model, others, pin.neutral(model))
        names = list(model.names)[1:]
    model.gravity.linear = np.array([0.0, 0.0, -9.81])
    model.armature[:] = 0.0
    model.friction[:] = 0.0
    model.damping[:] = 0.0
    data = model.createData()
    states = []
    for _ in range(3):
        angles, dq, ddq = (rng.uniform(-s, s, model.nv).round(3) for s in (3.0, 2.0, 5.0))
        q = np.concatenate([
            [np.cos(a), np.sin(a)] if joint.nq == 2 else [a]
            for a, joint in zip(angles, list(model.joints)[1:])
        ])
        tau = pin.rnea(model, data, q, dq, ddq)
        states.append({"q": list(angles), "dq": list(dq), "ddq": list(ddq), "tau": list(tau)})
    cases.append({"urdf": name, "joints": names, "states": states})
json.dump(cases, sys.stdout, indent=None)
print()

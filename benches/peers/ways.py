"""The ways in which functions are derived for a code generator: all are timed, and the fastest counts."""

from dataclasses import dataclass
from typing import Callable

import dynamics
import regressors
from dynamics import Arm


@dataclass
class Way:
    arm: Arm
    # Rows, of the arm, its frames, velocities and accelerations.
    derive: Callable
    # Of a regressor: the columns that are wanted, and the matrix that takes them to those of the spec's frames.
    kept: list | None = None
    map: list | None = None

    def rows(self, sines, cosines, dq, ddq):
        rows = self.derive(self.arm, self.arm.frames(sines, cosines), dq, ddq)
        return [[row[k] for k in self.kept] for row in rows] if self.kept else rows


def ways(path):
    """By function. Frames are cut at the joints, which was the cheapest place wherever it was tried."""
    spec, arm, lumped = Arm(path), Arm(path).cut_at_joints(), Arm(path).cut_at_joints()
    base = regressors.Base(arm)
    regressors.lump(lumped, base)
    to_spec = regressors.to_frames_of(spec)

    torque = lambda arm, frames, dq, ddq: [dynamics.inverse_dynamics(arm, frames, dq, ddq)]
    mass = lambda arm, frames, dq, ddq: dynamics.mass_matrix(arm, frames)
    coriolis = lambda arm, frames, dq, ddq: dynamics.coriolis_matrix(arm, frames, dq)
    gravity = lambda arm, frames, dq, ddq: [dynamics.gravity(arm, frames)]
    return {
        "inverse_dynamics": [Way(lumped, torque)],
        "mass_matrix": [Way(lumped, mass), Way(arm, mass)],
        "coriolis_matrix": [Way(lumped, coriolis)],
        "gravity": [Way(lumped, gravity), Way(arm, gravity)],
        "regressor": [Way(arm, regressors.regressor, map=to_spec)],
        "base_regressor": [Way(arm, regressors.regressor, base.kept, (base.combination @ to_spec)[:, spec.base_columns])],
    }

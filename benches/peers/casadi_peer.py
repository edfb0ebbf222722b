"""C code of an arm's dynamics by CasADi: arm.json in, casadi.c out.

Each function twice: of positions, and of their sines and cosines. CasADi eliminates common subexpressions before it writes.
"""

import sys

import casadi as ca

import dynamics
import ways
from table import case, table

arm_file, out = sys.argv[1:]
WAYS = ways.ways(arm_file)
n = dynamics.Arm(arm_file).dof
dq, ddq = ca.SX.sym("dq", n), ca.SX.sym("ddq", n)
entries = lambda x: [x[k] for k in range(n)]


def flat(rows):
    return ca.vertcat(*[ca.SX(x) for row in rows for x in row])


def coriolis_by_slopes(arm, frames, dq_, ddq_):
    """Half the slope of the velocity torque by the velocity."""
    h = flat([dynamics.inverse_dynamics(arm, frames, dq_, [0.0] * n, gravity=False)])
    C = ca.jacobian(h, dq) / 2
    return [[C[i, j] for j in range(n)] for i in range(n)]


WAYS["coriolis_matrix"] += [ways.Way(way.arm, coriolis_by_slopes) for way in WAYS["coriolis_matrix"]]

q, s, c = (ca.SX.sym(name, n) for name in ("q", "s", "c"))
code = ca.CodeGenerator("casadi.c", {"with_header": False, "casadi_int": "int"})
calls, cases = "", []
for given in (False, True):
    sines, cosines, arguments = (s, c, [s, dq, ddq, c]) if given else (ca.sin(q), ca.cos(q), [q, dq, ddq])
    for function, derived in WAYS.items():
        for k, way in enumerate(derived):
            value = flat(way.rows(entries(sines), entries(cosines), entries(dq), entries(ddq)))
            name = f"{function}_{k}" + ("_given" if given else "")
            made = ca.Function(name, arguments, ca.cse([ca.densify(value)]))
            code.add(made)
            calls += f"""
static void call_{name}(const double *q, const double *dq, const double *ddq, const double *c, double *out) {{
    static double work[{max(made.sz_w(), 1)}];
    const double *arguments[4] = {{q, dq, ddq, c}};
    double *results[1] = {{out}};
    {name}(arguments, results, 0, work, 0);
}}
"""
            cases.append(case(function, k, given, made.numel_out(), f"call_{name}", way.map))
code.generate(out + "/")
with open(out + "/casadi.c", "a") as file:
    file.write('\n#include "contender.h"\n' + calls + table(n, cases))

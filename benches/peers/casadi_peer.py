"""C code of an arm's dynamics by CasADi: arm.json in, casadi.c out.

Each function twice: of positions, and of their sines and cosines. CasADi eliminates common subexpressions before it writes.
"""

import sys

import casadi as ca

import dynamics
from dynamics import Arm

arm_file, out = sys.argv[1:]
n = Arm(arm_file).dof
dq, ddq = ca.SX.sym("dq", n), ca.SX.sym("ddq", n)
entries = lambda x: [x[k] for k in range(n)]


def flat(value):
    rows = value if isinstance(value[0], list) else [value]
    return ca.vertcat(*[ca.SX(x) for row in rows for x in row])


def coriolis_by_slopes(arm, frames, dq_):
    """Half the slope of the velocity torque by the velocity."""
    h = flat(dynamics.inverse_dynamics(arm, frames, dq_, [0.0] * n, gravity=False))
    C = ca.jacobian(h, dq) / 2
    return [[C[i, j] for j in range(n)] for i in range(n)]


# Where a function can be derived in several ways the one of fewest operations counts.
WAYS = {
    "inverse_dynamics": [lambda link, joint, fl, fj: dynamics.inverse_dynamics(joint, fj, entries(dq), entries(ddq)),
                         lambda link, joint, fl, fj: dynamics.inverse_dynamics(link, fl, entries(dq), entries(ddq))],
    "mass_matrix": [lambda link, joint, fl, fj: dynamics.mass_matrix(joint, fj)],
    "coriolis_matrix": [lambda link, joint, fl, fj: coriolis_by_slopes(joint, fj, entries(dq)),
                        lambda link, joint, fl, fj: dynamics.coriolis_matrix(joint, fj, entries(dq))],
    "gravity": [lambda link, joint, fl, fj: dynamics.gravity(joint, fj),
                lambda link, joint, fl, fj: dynamics.gravity(link, fl)],
    "regressor": [lambda link, joint, fl, fj: dynamics.regressor(link, fl, entries(dq), entries(ddq))],
    "base_regressor": [lambda link, joint, fl, fj: dynamics.base_regressor(link, fl, entries(dq), entries(ddq))],
}


def functions(sines, cosines, arguments, suffix):
    link, joint = Arm(arm_file), Arm(arm_file).cut_at_joints()
    fl, fj = (arm.frames(entries(sines), entries(cosines)) for arm in (link, joint))
    for name, ways in WAYS.items():
        made = []
        for way in ways:
            [value] = ca.cse([ca.densify(flat(way(link, joint, fl, fj)))])
            made.append(ca.Function(name + suffix, arguments, [value]))
        yield min(made, key=lambda f: f.n_instructions())


q, s, c = (ca.SX.sym(name, n) for name in ("q", "s", "c"))
both = [*functions(ca.sin(q), ca.cos(q), [q, dq, ddq], ""), *functions(s, c, [s, dq, ddq, c], "_given")]
code = ca.CodeGenerator("casadi.c", {"with_header": False, "casadi_int": "int"})
for function in both:
    code.add(function)
code.generate(out + "/")

with open(out + "/casadi.c", "a") as file:
    table = []
    file.write('\n#include "contender.h"\n')
    for f in both:
        name, given = f.name(), f.n_in() == 4
        file.write(f"""
static void call_{name}(const double *q, const double *dq, const double *ddq, const double *c, double *out) {{
    static double work[{max(f.sz_w(), 1)}];
    const double *arguments[4] = {{q, dq, ddq, c}};
    double *results[1] = {{out}};
    {name}(arguments, results, 0, work, 0);
}}
""")
        table.append(f'    {{"{name.replace("_given", "/given")}", {int(given)}, {f.numel_out()}, call_{name}}},\n')
    file.write(f"\nint joints = {n};\nvoid prepare(const char *program) {{ (void)program; }}\nstruct contender contenders[] = {{\n{''.join(table)}    {{0, 0, 0, 0}},\n}};\n")

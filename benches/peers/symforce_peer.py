"""C++ code of an arm's dynamics by SymForce: arm.json in, symforce.cpp out.

Each function twice: of positions, and of their sines and cosines. Common subexpressions and the printer are SymForce's own.
"""

import sys

import symforce

symforce.set_epsilon_to_number(0.0)

import symforce.symbolic as sf
from symforce import codegen
from symforce.values import Values

import dynamics
from dynamics import Arm

arm_file, out = sys.argv[1:]
n = Arm(arm_file).dof


def symbols(name):
    return sf.Matrix(n, 1, [sf.Symbol(f"{name}{k}") for k in range(n)])


def entries(x):
    return [x[k] for k in range(n)]


# Whole numbers print as such, and not as 1.0.
def exact(x):
    return sf.Integer(int(x)) if dynamics.number(x) and x == int(x) else sf.S(x)


q, dq, ddq, s, c = (symbols(name) for name in ("q", "dq", "ddq", "s", "c"))
v, dv = entries(dq), entries(ddq)
FUNCTIONS = {
    "inverse_dynamics": lambda joint, fj, link, fl: dynamics.inverse_dynamics(joint, fj, v, dv),
    "mass_matrix": lambda joint, fj, link, fl: dynamics.mass_matrix(joint, fj),
    "coriolis_matrix": lambda joint, fj, link, fl: dynamics.coriolis_matrix(joint, fj, v),
    "gravity": lambda joint, fj, link, fl: dynamics.gravity(joint, fj),
    "regressor": lambda joint, fj, link, fl: dynamics.regressor(link, fl, v, dv),
    "base_regressor": lambda joint, fj, link, fl: dynamics.base_regressor(link, fl, v, dv),
}

text = "#include <Eigen/Core>\n#include <cmath>\n"
calls, table = "", ""
for given in (False, True):
    link, joint = Arm(arm_file), Arm(arm_file).cut_at_joints()
    sines, cosines = (entries(s), entries(c)) if given else ([sf.sin(x) for x in entries(q)], [sf.cos(x) for x in entries(q)])
    fj, fl = joint.frames(sines, cosines), link.frames(sines, cosines)
    for name, derive in FUNCTIONS.items():
        value = derive(joint, fj, link, fl)
        rows = value if isinstance(value[0], list) else [value]
        count = sum(map(len, rows))
        # A column: its storage is the result row by row.
        flat = sf.Matrix(count, 1, [exact(x) for row in rows for x in row])
        full = name + ("_given" if given else "")
        inputs = Values(q=s if given else q, dq=dq, ddq=ddq, **({"c": c} if given else {}))
        function = codegen.Codegen(inputs, Values(out=flat), codegen.CppConfig(), name=full)
        made = function.generate_function(output_dir=out, skip_directory_nesting=True)
        text += open(made.generated_files[0]).read().replace("#pragma once", "")
        call = "".join(word.capitalize() for word in full.split("_"))
        # In place: a caller who uses Eigen has such matrices, and copies are not the peer's.
        more = "*reinterpret_cast<const Column *>(c), " if given else ""
        calls += f"""
static void call_{full}(const double *q, const double *dq, const double *ddq, const double *c, double *out) {{
    using Column = Eigen::Matrix<double, {n}, 1>;
    auto column = [](const double *x) -> const Column & {{ return *reinterpret_cast<const Column *>(x); }};
    sym::{call}<double>(column(q), column(dq), column(ddq), {more}reinterpret_cast<Eigen::Matrix<double, {count}, 1> *>(out));
}}
"""
        table += f'    {{"{full.replace("_given", "/given")}", {int(given)}, {count}, call_{full}}},\n'

with open(out + "/symforce.cpp", "w") as file:
    file.write(text + '\n#include "contender.h"\n' + calls)
    file.write(f'\nextern "C" {{\nint joints = {n};\nvoid prepare(const char *) {{}}\nstruct contender contenders[] = {{\n{table}    {{0, 0, 0, 0}},\n}};\n}}\n')

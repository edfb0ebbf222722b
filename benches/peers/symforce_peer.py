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
import ways
from table import case, table

arm_file, out = sys.argv[1:]
n = dynamics.Arm(arm_file).dof


def symbols(name):
    return sf.Matrix(n, 1, [sf.Symbol(f"{name}{k}") for k in range(n)])


def entries(x):
    return [x[k] for k in range(n)]


# Whole numbers print as such, and not as 1.0.
def exact(x):
    return sf.Integer(int(x)) if dynamics.number(x) and x == int(x) else sf.S(x)


q, dq, ddq, s, c = (symbols(name) for name in ("q", "dq", "ddq", "s", "c"))
text = "#include <Eigen/Core>\n#include <cmath>\n"
calls, cases = "", []
for given in (False, True):
    sines, cosines = (entries(s), entries(c)) if given else ([sf.sin(x) for x in entries(q)], [sf.cos(x) for x in entries(q)])
    for function, derived in ways.ways(arm_file).items():
        for k, way in enumerate(derived):
            rows = way.rows(sines, cosines, entries(dq), entries(ddq))
            count = sum(map(len, rows))
            # A column: its storage is the result row by row.
            flat = sf.Matrix(count, 1, [exact(x) for row in rows for x in row])
            name = f"{function}_{k}" + ("_given" if given else "")
            inputs = Values(q=s if given else q, dq=dq, ddq=ddq, **({"c": c} if given else {}))
            made = codegen.Codegen(inputs, Values(out=flat), codegen.CppConfig(), name=name)
            made = made.generate_function(output_dir=out, skip_directory_nesting=True)
            text += open(made.generated_files[0]).read().replace("#pragma once", "")
            call = "".join(word.capitalize() for word in name.split("_"))
            # In place: a caller who uses Eigen has such matrices, and copies are not the peer's.
            more = "*reinterpret_cast<const Column *>(c), " if given else ""
            calls += f"""
static void call_{name}(const double *q, const double *dq, const double *ddq, const double *c, double *out) {{
    using Column = Eigen::Matrix<double, {n}, 1>;
    auto column = [](const double *x) -> const Column & {{ return *reinterpret_cast<const Column *>(x); }};
    sym::{call}<double>(column(q), column(dq), column(ddq), {more}reinterpret_cast<Eigen::Matrix<double, {count}, 1> *>(out));
}}
"""
            cases.append(case(function, k, given, count, f"call_{name}", way.map))

with open(out + "/symforce.cpp", "w") as file:
    file.write(text + '\n#include "contender.h"\n' + calls + f'\nextern "C" {{{table(n, cases)}}}\n')

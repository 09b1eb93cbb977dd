#!/usr/bin/env python3
"""Holds the JSON schemas of cases and sweeps against the validator `jsonschema` and against the program.

Both must accept every case and sweep of the repository, as written and as resolved, and every way to write a unit;
both must reject what differs from a good case by one wrong key or value.

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
GOOD = tomllib.loads((ROOT / "cases/glass_0.5ms.toml").read_text())
GLASS = "/material/glass"
ABSENT = object()

# What schema and program both reject: the place of one changed value, and the value.
REJECTED = [
    ("/titel", "x"),
    ("/body", ABSENT),
    ("/body/1", ABSENT),
    ("/body/0/name", ABSENT),
    ("/body/0/sphere", ABSENT),
    ("/body/0/sphere", "22.2 mm"),
    ("/body/0/wall", {}),
    ("/body/0/material", ABSENT),
    ("/body/0/material", "lib:stel"),
    ("/body/0/sphere/diameter", "22.2 s"),
    ("/body/0/sphere/diameter", "22.2 mmm"),
    ("/body/0/sphere/diameter", "22,2 mm"),
    ("/body/0/sphere/diameter", "-22.2 mm"),
    ("/body/0/sphere/diameter", -1),
    ("/body/0/sphere/diameter", "22.2 m/s"),
    ("/body/0/sphere/radius", 1),
    ("/body/0/approach_speed", "0.5 m"),
    ("/body/0/approach_speed", "1e-3 kg/s"),
    ("/body/0/held", "yes"),
    (f"{GLASS}/density", ABSENT),
    (f"{GLASS}/density", "dense"),
    (f"{GLASS}/density", True),
    (f"{GLASS}/density", "2390 kg/m^2"),
    (f"{GLASS}/density", 0),
    (f"{GLASS}/youngs_modulus", "63 gigapascal"),
    (f"{GLASS}/youngs_modulus", "63 N/m"),
    (f"{GLASS}/shear_modulus", "25 GPa"),
    (f"{GLASS}/poissons_ratio", ABSENT),
    (f"{GLASS}/poissons_ratio", 0.5),
    (f"{GLASS}/relaxation/terms/0/relaxation_time", "1 s"),
    (f"{GLASS}/relaxation/terms/0/decay_rate", "2708 s"),
    (f"{GLASS}/relaxation/terms/0/weight", 1.5),
    (f"{GLASS}/relaxation/acts_on", "bulk"),
    ("/model", {"ting": {}, "hertz": {}}),
    ("/model", {}),
    ("/model", "tinge"),
    ("/model/law", {"end": "zero_force"}),
    ("/model/law/tsuji", {"k": 1}),
    ("/model/law/tsuji", {"e": 0.9, "alpha": 0.1}),
    ("/model/law/tsuji", {"e": 1.1}),
    ("/model/law/falcon", {}),
    ("/model/law/linear", {"k": 1e7, "c": 1, "e": 0.9}),
    ("/model/law/linear", {"e": 0.9}),
    ("/contact/method", "sticky"),
    ("/contact/friction", -0.1),
    ("/body/0/spin", "10 m/s"),
    ("/time/step_factor", 1.5),
    ("/mesh/growth", 1),
    ("/stop/bounces", 0),
    ("/accuracy/tolerance/force", 0.1),
    ("/accuracy/tolerance/peak_force", 0.9),
    ("/output/snapshots", ["middle"]),
    ("/effects/gravity", "on"),
]
# Every way to write a unit that the program reads.
ACCEPTED = {
    "/body/0/sphere/diameter": ["22.2 mm", "22.2mm", "14 µm", "1 in", "0.1 ft", "2e-2 m"],
    "/body/0/approach_speed": ["50 cm/s", "1.8 km/h", "1 mph", "0.5 m s^-1", "0.5 m s⁻¹", "0.5 m·s-1"],
    f"{GLASS}/density": ["2390 kg/m^3", "2.39 g/cm³", "2.39 g cm^-3", "2.39 kg/L", "2.39 t/m**3"],
    f"{GLASS}/youngs_modulus": ["63 GPa", "63e9 N/m^2", "63 kN/mm²", "9e6 psi", "63e9 kg/(m s^2)"],
    f"{GLASS}/relaxation/terms/0/decay_rate": ["2708 1/s", "2708 /s", "2.708 kHz", "2708 s^-1", "2.7 1/ms"],
    f"{GLASS}/relaxation/terms/0/weight": ["50 %", "0.5"],
    "/body/0/spin": ["10 rad/s", "60 rpm", "-3 1/s", "90 deg/s", "2 rad/s ± 5 %"],
    "/body/0/impact_angle": ["30 deg", "30°", "0.5 rad", "30 ± 1 deg", "0.5"],
    "/contact/friction": ["0.1 ± 0.02", "10 %"],
    "/limits/memory": ["8 GB", "8 GiB"],
}


def validator(command, of):
    schema = json.loads(subprocess.check_output([command, "schema", of]))
    jsonschema.Draft7Validator.check_schema(schema)
    return jsonschema.Draft7Validator(schema)


def changed(pointer, value):
    """The good case with one value at another place, or without it."""
    case = copy.deepcopy(GOOD)
    *tables, key = pointer.strip("/").split("/")
    at = case
    for part in tables:
        at = at[int(part)] if isinstance(at, list) else at.setdefault(part, {})
    key = int(key) if isinstance(at, list) else key
    if value is ABSENT:
        del at[key]
    else:
        at[key] = value
    return case


def status(command, case):
    """The exit status of `fem-run check`."""
    with tempfile.NamedTemporaryFile("w", suffix=".toml", encoding="utf-8") as file:
        file.write(toml_of(case))
        file.flush()
        return subprocess.run([command, "check", file.name], capture_output=True).returncode


def toml_of(case):
    """TOML of a case, with the values of the top-level keys inline."""

    def inline(value):
        if isinstance(value, dict):
            return "{" + ", ".join(f"{json.dumps(k)} = {inline(v)}" for k, v in value.items()) + "}"
        if isinstance(value, list):
            return "[" + ", ".join(map(inline, value)) + "]"
        return json.dumps(value)

    return "".join(f"{json.dumps(key)} = {inline(value)}\n" for key, value in case.items())


def main(command):
    cases, sweeps = validator(command, "case"), validator(command, "sweep")
    n = {"case": 0, "sweep": 0}
    for path in sorted((ROOT / "cases").glob("*.toml")):
        file = tomllib.loads(path.read_text())
        kind = "case" if "body" in file else "sweep"
        (cases if kind == "case" else sweeps).validate(file)
        n[kind] += 1
        if kind == "case":
            printed = subprocess.check_output([command, "check", "--resolved", str(path)], text=True)
            cases.validate(tomllib.loads(printed))
    assert n["case"] > 10 and n["sweep"] > 1, n
    for model in ("ting", {"law": "hertz"}, {"condensed": {"steps": 400}}):
        cases.validate(GOOD | {"model": model})
    for pointer, value in REJECTED:
        case = changed(pointer, value)
        assert not cases.is_valid(case), f"the schema accepts {pointer} = {value}"
        assert status(command, case) == 2, f"the program accepts {pointer} = {value}"
    for pointer, texts in ACCEPTED.items():
        for text in texts:
            case = changed(pointer, text)
            assert status(command, case) == 0, f"the program rejects {pointer} = {text}"
            cases.validate(case)
    for sweep in ({"case": "a.toml"}, {"vary": {"a": [1]}}, {"case": "a.toml", "vary": {}, "keep": 1}):
        assert not sweeps.is_valid(sweep), f"the schema accepts {sweep}"
    print(f"schemas: {n['case']} cases as written and resolved, {n['sweep']} sweeps, {len(REJECTED)} faults rejected")


if __name__ == "__main__":
    main(sys.argv[1])

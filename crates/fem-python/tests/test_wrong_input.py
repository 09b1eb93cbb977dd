"""Invalid arguments are rejected at once, with their type and what is allowed."""

import subprocess
import sys

import numpy as np
import pytest

import fem_run

KEY = "body.0.approach_speed"


@pytest.fixture(scope="module")
def case(glass):
    return fem_run.Case.load(glass).with_({"model.ting": {}})


def test_a_file_needs_the_units_of_unlikely_numbers(tmp_path, case):
    path = tmp_path / "large.toml"
    path.write_text(case.with_({"body.0.sphere.diameter": 10.0}).to_toml())
    assert '"10.0 m"' in fem_run.Case.load(path).to_toml()
    path.write_text(path.read_text().replace('"10.0 m"', "10.0"))
    with pytest.raises(fem_run.InputError, match='diameter = "10.0 mm"'):
        fem_run.Case.load(path)


@pytest.mark.parametrize(
    ("vary", "words"),
    [
        ({KEY: 0.5}, "is not a list: 0.5"),
        ({KEY: "0.5 m/s"}, "is not a list: '0.5 m/s'"),
        ({"model": {"ting": {}}}, "is not a list"),
        ({KEY: np.float64(0.5)}, "is not a list"),
        ({KEY: np.array(0.5)}, "is not a list"),
        ({KEY: {0.1, 0.2}}, "no order"),
        ({KEY: []}, f"{KEY}: no values"),
        ({}, "the sweep varies no key"),
        ({KEY: [0.5], (KEY, "body.1.approach_speed"): [0.1]}, "is varied twice"),
        ({"body.0": [1], KEY: [0.5]}, "part of the other"),
        ({(KEY, "body.1.approach_speed"): [(1, 2, 3)]}, "has 3 values"),
        ({KEY: [0.5, float("nan")]}, "nan"),
        ({KEY: [[0.5, 1.0]]}, "approach_speed"),
        ({KEY: np.ones((2, 2))}, "approach_speed"),
        ({KEY: [None]}, "None"),
        ({"body.0.approach_sped": [1]}, "did you mean"),
    ],
)
def test_what_a_sweep_cannot_vary(case, vary, words):
    with pytest.raises((fem_run.InputError, TypeError)) as raised:
        fem_run.sweep(case, vary)
    assert words in str(raised.value)


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (lambda case: fem_run.sweep(case, [KEY]), TypeError, "vary is a dict"),
        (lambda case: fem_run.sweep(case, {3: [1]}), TypeError, "dotted path"),
        (lambda case: fem_run.sweep("case.toml", {KEY: [1]}), TypeError, "Case.load"),
        (lambda case: fem_run.sweep(case, {KEY: [1]}, executor=3), TypeError, "executor is a concurrent.futures.Executor"),
        (lambda case: fem_run.sweep(case, {KEY: [1]}, threads=0), fem_run.InputError, "threads is 0"),
        (lambda case: fem_run.sweep(case, {KEY: [1]}, threads="two"), TypeError, "whole number"),
        (lambda case: fem_run.sweep(case, {KEY: [1]}, progress="yes"), TypeError, "progress is True, False"),
        (lambda case: case.run(progress=3), TypeError, "progress is True, False"),
        (lambda case: case.with_([KEY]), TypeError, "changes must be a dict"),
        (lambda case: case.with_({KEY: float("inf")}), fem_run.InputError, "inf"),
        (lambda case: case.with_({KEY: None}), TypeError, "holds no None; leave the key out"),
        (lambda case: case.with_({3: 1}), TypeError, "dotted path"),
        (lambda case: fem_run.Case.load("none.toml"), fem_run.InputError, "no such file"),
        (lambda case: fem_run.Case.load(3), TypeError, "int"),
        (lambda case: fem_run.Case.from_dict([1]), TypeError, "dict of tables"),
        (lambda case: fem_run.Case.from_dict({}), fem_run.InputError, "body"),
        (lambda case: fem_run.Case.from_dict({"body": 3}), fem_run.InputError, "body"),
        (lambda case: fem_run.Case.from_toml(b"x"), TypeError, "str"),
        (lambda case: fem_run.Case.from_toml(""), fem_run.InputError, "body"),
        (lambda case: fem_run.check("case.toml"), TypeError, "Case.load"),
        (lambda case: fem_run.fit("case.toml", {}), TypeError, "Case.load"),
        (lambda case: fem_run.fit(case, 3), TypeError, "data are"),
        (lambda case: fem_run.fit(case, None), fem_run.InputError, "data"),
        (lambda case: fem_run.fit(case, {}), fem_run.InputError, "<data>"),
        (lambda case: fem_run.fit(case, {"speed_m_s": [], "restitution": []}), fem_run.InputError, "no row"),
        (lambda case: fem_run.fit(case, {"speed_m_s": [1, 2], "restitution": [0.9]}), fem_run.InputError, "speed_m_s has 2, restitution has 1"),
        (lambda case: fem_run.fit(case, {"speed_m_s": 1.0, "restitution": 0.9}), fem_run.InputError, "speed_m_s is 1.0"),
        (lambda case: fem_run.fit(case, {"speed_m_s": np.ones((2, 2)), "restitution": [0.9, 0.9]}), fem_run.InputError, "shape (2, 2)"),
        (lambda case: fem_run.fit(case, {"speed_m_s": [1.0], "restitution": [float("nan")]}), fem_run.InputError, ""),
        (lambda case: fem_run.fit(case, {"speed_m_s": [1.0], "restitution": ["much"]}), fem_run.InputError, "much"),
        (lambda case: fem_run.fit(case, {"v": [1.0], "e": [0.9]}, low="ting"), TypeError, "unexpected keyword argument 'low'"),
        (lambda case: fem_run.fit(case, "none.csv"), fem_run.InputError, "no such file"),
        (lambda case: fem_run.fit(case, "."), fem_run.InputError, ".: "),
        (lambda case: fem_run.invert(case, "much"), fem_run.InputError, "much"),
        (lambda case: fem_run.invert(case, float("nan")), fem_run.InputError, "not a number"),
        (lambda case: fem_run.invert(case, None), fem_run.InputError, "restitution"),
        (lambda case: fem_run.export(case, speeds="fast"), fem_run.InputError, "fast"),
        (lambda case: fem_run.calibrate(case, None), fem_run.InputError, "data"),
        (lambda case: fem_run.cradle(), fem_run.InputError, "length"),
        (lambda case: fem_run.cradle(3), TypeError, "data are"),
        (lambda case: fem_run.measure(3), TypeError, "data are"),
        (lambda case: fem_run.measure(None), fem_run.InputError, "<data>"),
        (lambda case: fem_run.materials["unobtainium"], fem_run.InputError, "unobtainium"),
        (lambda case: case.number(3), TypeError, "dotted path"),
        (lambda case: case.run().uncertainty("speed"), KeyError, "there are: restitution"),
        (lambda case: case.run().save(3), TypeError, "int"),
        (lambda case: case.run().loudness, AttributeError, "restitution"),
    ],
)
def test_what_a_function_cannot_take(case, call, error, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(error) as raised:
        call(case)
    assert words in str(raised.value) and "--" not in str(raised.value)


def test_progress_into_a_pipe_is_lines(glass):
    code = f"import fem_run; fem_run.Case.load({str(glass)!r}).with_({{'mesh.contact_element_size': 4e-5}}).run(progress=True)"
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    lines = ran.stderr.splitlines()
    assert "\r" not in ran.stderr and len(lines) <= 10
    assert all(line.endswith(" %") and ": " in line for line in lines)


def test_the_export_names_every_code_that_it_writes(case):
    doc = fem_run.export.__doc__.lower()
    data = {"speed_m_s": [0.1, 0.5, 1.0], "restitution": [0.9, 0.91, 0.92]}
    codes = {snippet["code"] for snippet in fem_run.export(case, data)["snippets"]}
    assert len(codes) > 4 and all(code.lower() in doc for code in codes), codes

"""Cases, results and tables are values: they are pickled, copied, compared and typed."""

import copy
import json
import multiprocessing
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor

import joblib
import numpy as np
import pytest

import fem_run

from conftest import COARSE, ROOT


@pytest.fixture(scope="module")
def case(glass):
    return fem_run.Case.load(glass).with_({"model": {"condensed": {}}, **COARSE})


def run(case):
    return case.run()


def test_a_case_is_its_dict():
    for path in sorted((ROOT / "cases").glob("*.toml")):
        if "sweep" in path.stem:
            continue
        case = fem_run.Case.load(path)
        again = fem_run.Case.from_dict(json.loads(json.dumps(case.to_dict())))
        assert again == case and hash(again) == hash(case) and again.to_dict() == case.to_dict()
        assert again.identity == case.identity, path


def test_cases_are_values(case):
    faster = case.with_({"body.0.approach_speed": 1.0})
    assert faster != case and case != "case"
    assert faster.with_({"title": case.title, "body.0.approach_speed": 0.5}).to_dict()["body"] == case.to_dict()["body"]
    for other in (copy.copy(case), copy.deepcopy(case), pickle.loads(pickle.dumps(case))):
        assert other == case and {case: 1}[other] == 1


def test_results_are_values(case, tmp_path):
    result = case.run()
    assert case.run() == result != case.with_({"body.0.approach_speed": 1.0}).run()
    for other in (copy.copy(result), copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
        assert other == result and hash(other) == hash(result)
        assert other.summary == result.summary
        for mine, own in zip(other.snapshots, result.snapshots, strict=True):
            np.testing.assert_array_equal(mine.point_data["displacement"], own.point_data["displacement"])
    copy.deepcopy(result).save(tmp_path / "copied")
    with pytest.raises(fem_run.InputError, match="pickled cannot be saved"):
        pickle.loads(pickle.dumps(result)).save(tmp_path / "pickled")


def test_tables_are_values(case):
    vary = {"body.0.approach_speed": [0.2, 0.4]}
    table = fem_run.sweep(case, vary)
    assert table == fem_run.sweep(case, vary) == pickle.loads(pickle.dumps(table)) == copy.deepcopy(table)
    assert table != fem_run.sweep(case, {"body.0.approach_speed": [0.2, 0.5]}) and table != {}


def test_other_processes_return_results(case):
    cases = [case.with_({"body.0.approach_speed": speed}) for speed in (0.2, 0.4)]
    own = [case.run() for case in cases]
    assert joblib.Parallel(n_jobs=2)(joblib.delayed(run)(case) for case in cases) == own
    with ProcessPoolExecutor(1, mp_context=multiprocessing.get_context("spawn")) as executor:
        assert list(executor.map(run, cases)) == own


def test_every_key_of_the_summary_is_a_typed_attribute(case):
    shown = set(fem_run.Result.__annotations__)
    assert shown | {"uncertainty"} == set(case.run().summary)


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ('fem_run.fit(case, {}, law="ting", free=["a"], bounds={"n": (0.3, 1.5)}, contact_time=True, robust=True)', None),
        ('fem_run.fit(case, {}, lawe="ting")', "lawe"),
        ('fem_run.fit(case, {}, law="tin")', "tin"),
        ('fem_run.calibrate(case, {}, model="hertz")', "hertz"),
        ("case.run().restitution", None),
        ("case.run().restitutoin", "restitutoin"),
        ("case.run(progres=True)", "progres"),
        ("fem_run.sweep(case, {}, thread=2)", "thread"),
    ],
)
def test_a_type_checker_finds_misspelt_names(line, error, tmp_path):
    path = tmp_path / "user.py"
    path.write_text(f"import fem_run\ncase = fem_run.Case.load('case.toml')\n{line}\n")
    ran = subprocess.run([sys.executable, "-m", "mypy", "--strict", path], capture_output=True, text=True)
    assert (ran.returncode == 0) == (error is None), ran.stdout
    assert error is None or error in ran.stdout

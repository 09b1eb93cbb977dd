"""Whatever computes a sweep, the table is the same."""

import os
import signal
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context

import numpy as np
import pytest

import fem_run

from conftest import COARSE

VARY = {"body.0.approach_speed": np.geomspace(0.1, 1, 5), "material.glass.relaxation.terms.0.weight": [0.5, 1]}


@pytest.fixture(scope="module")
def case(glass):
    return fem_run.Case.load(glass).with_({"model": {"condensed": {}}, **COARSE})


@pytest.fixture(scope="module")
def local(case):
    return fem_run.sweep(case, VARY).to_csv()


@pytest.mark.parametrize("threads", [1, 3])
def test_any_number_of_threads(case, local, threads):
    assert fem_run.sweep(case, VARY, threads=threads).to_csv() == local


def test_threads_of_an_executor(case, local):
    with ThreadPoolExecutor(2) as executor:
        assert fem_run.sweep(case, VARY, executor=executor).to_csv() == local


def test_processes(case, local):
    fractions = []
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        table = fem_run.sweep(case, VARY, executor=executor, progress=fractions.append)
    assert table.to_csv() == local
    assert fractions[-1] == 1.0 and len(fractions) == 10


def test_ctrl_c_leaves_the_members_that_are_done(case, local):
    def report(fraction):
        if fraction > 0.3:
            os.kill(os.getpid(), signal.SIGINT)

    with ThreadPoolExecutor(2) as executor, pytest.raises(fem_run.Interrupted) as raised:
        fem_run.sweep(case, VARY, executor=executor, progress=report)
    done = raised.value.result.to_csv().splitlines()
    assert 1 < len(done) < 11 and set(done) < set(local.splitlines())


def test_a_killed_process_leaves_the_members_that_are_done(case, local):
    """The standard library gives up then."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as executor:

        def report(fraction):
            if fraction > 0.3:
                for process in list(executor._processes.values()):
                    process.kill()

        slow = {"body.0.approach_speed": [*VARY["body.0.approach_speed"], *np.geomspace(1.1, 2, 60)]}
        with pytest.raises(fem_run.RunError, match="the executor broke, BrokenProcessPool.* of 65 members") as raised:
            fem_run.sweep(case, slow, executor=executor, progress=report)
    done = raised.value.result.to_csv().splitlines()
    whole = fem_run.sweep(case, slow).to_csv().splitlines()
    assert 20 <= len(done) < 66 and set(done) < set(whole)
    assert isinstance(raised.value.__cause__, BrokenProcessPool)

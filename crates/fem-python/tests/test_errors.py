"""What is wrong is said in the words of the command, with Python's arguments, file, position and key."""

import os
import pickle
import signal
import threading
import time

import pytest

import fem_run
from fem_run._words import in_python


@pytest.mark.parametrize(
    ("old", "new"),
    [('"63 GPa"', '"63 kg"'), ("poissons_ratio", "poisons_ratio"), ('"glass"', '"glas"'), ("[[body]]", "[[body]")],
)
def test_a_bad_file_raises_what_the_command_prints(glass, command, tmp_path, old, new):
    path = tmp_path / "bad.toml"
    path.write_text(glass.read_text().replace(old, new, 1))
    with pytest.raises(fem_run.InputError) as raised:
        fem_run.Case.load(path)
    ran = command(path, check=False)
    assert ran.returncode == 2
    assert ran.stderr.strip() == f"error: {raised.value}".strip()
    error = raised.value
    assert error.file == str(path) and error.line and error.column
    assert isinstance(error, ValueError)
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


def test_a_bad_change_raises_what_the_command_prints(glass, command):
    case = fem_run.Case.load(glass)
    with pytest.raises(fem_run.InputError) as raised:
        case.with_({"body.0.approach_speed": "1 m"})
    ran = command(glass, '--set=body.0.approach_speed="1 m"', check=False)
    assert in_python(ran.stderr).strip() == f"error: {raised.value}".strip()
    assert raised.value.file == '{"body.0.approach_speed": …}'
    assert raised.value.key == "body.0.approach_speed" and "speed" in raised.value.help
    with pytest.raises(TypeError):
        case.with_({"title": object()})
    # Before any member is computed.
    with pytest.raises(fem_run.InputError, match="not an index"):
        fem_run.sweep(case, {"body.0.approach_speed": [0.5], "body.7.name": ["x"]})


def test_bad_options_and_data_raise_what_the_commands_print(glass, command, tmp_path):
    case = fem_run.Case.load(glass)
    (tmp_path / "e.csv").write_text("speed_m_s,restitution\n0.5,60\n")
    for call, words in [
        (lambda: fem_run.fit(case, tmp_path / "e.csv", law="ting"), ["fit", glass, "--data", tmp_path / "e.csv", "--law", "ting"]),
        (lambda: fem_run.invert(case, 1.5), ["invert", glass, "--restitution", "1.5"]),
        (lambda: fem_run.export(case, tolerance=3), ["export", glass, "--tolerance", "3"]),
    ]:
        with pytest.raises(fem_run.InputError) as raised:
            call()
        ran = command(*words, cwd=tmp_path, check=False)
        assert ran.returncode == 2
        assert in_python(ran.stderr).strip() == f"error: {raised.value}".strip()
    with pytest.raises(fem_run.InputError, match="the laws are"):
        fem_run.fit(case, tmp_path / "e.csv", law="none")
    with pytest.raises(fem_run.InputError, match="did you mean pmma"):
        fem_run.materials["pma"]


def test_a_run_that_fails_keeps_what_there_is(glass, command, tmp_path):
    # Soft and fast: the sphere folds where it is pressed flat.
    changes = {
        "material.glass.youngs_modulus": 1e6,
        "body.0.approach_speed": 60,
        "mesh.contact_element_size": 0.5e-3,
        "model": {"fem": {}},
        "effects.finite_strain": "off",
    }
    case = fem_run.Case.load(glass).with_(changes)
    with pytest.raises(fem_run.RunError) as raised:
        case.run()
    assert not raised.value.result.complete
    assert raised.value.result.stopped_because.split(":")[0] in str(raised.value)
    assert "likely cause" in raised.value.help


def test_ctrl_c_keeps_what_there_is_and_other_threads_go_on(glass):
    case = fem_run.Case.load(glass).with_({"model": {"fem": {}}, "mesh.contact_element_size": 10e-6})
    ticks = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.01):
            ticks.append(time.monotonic())

    fractions = []

    def report(fraction):
        fractions.append(fraction)
        if fraction > 0.02:
            os.kill(os.getpid(), signal.SIGINT)

    ticker = threading.Thread(target=tick)
    ticker.start()
    try:
        with pytest.raises(KeyboardInterrupt) as raised:
            case.run(progress=report)
    finally:
        stop.set()
        ticker.join()
    assert isinstance(raised.value, fem_run.Interrupted)
    assert not raised.value.result.complete
    assert len(raised.value.result.history["time_s"]) > 1
    assert fractions == sorted(fractions) and len(ticks) > 3

    def fault(_):
        raise LookupError("mine")

    with pytest.raises(LookupError):
        case.run(progress=fault)


@pytest.mark.parametrize("element", ["40 um", "4 um"])
def test_ctrl_c_ends_a_sweep_at_once_with_the_members_that_are_done(glass, element):
    # Of the fine mesh no factor is done within a second.
    changes = {"model": {"condensed": {}}, "mesh.contact_element_size": element, "mesh.refined_radius": "0.3 mm"}
    case = fem_run.Case.load(glass).with_(changes)
    sent = []

    def report(fraction):
        if not sent and (fraction > 0.1 or element == "4 um"):
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt) as raised:
        fem_run.sweep(case, {"body.0.approach_speed": [0.1 + 1e-3 * k for k in range(200)]}, threads=2, progress=report)
    assert time.monotonic() - sent[0] < 3
    error = raised.value
    assert isinstance(error, fem_run.Interrupted)
    n_done = len(error.result["restitution"])
    assert f"{n_done} of 200 members are done" in str(error)
    assert (n_done > 0 and (error.result["restitution"] > 0.5).all()) or element == "4 um"

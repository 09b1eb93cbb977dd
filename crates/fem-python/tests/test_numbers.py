"""Numbers are the command's, to the bit."""

import copy
import csv
import html
import json
import os
import pathlib
import pickle
import sys

import numpy as np
import pytest
import pyvista

import fem_run

from conftest import COARSE, ROOT

#: What differs from run to run, or between memory and folder.
OWN = {"cost", "files", "case", "made_from", "source"}


def rest(summary):
    return {key: value for key, value in summary.items() if key not in OWN}


def number(cell):
    """A number may be written in two ways; both read back to the same bits."""
    try:
        return float(cell)
    except ValueError:
        return cell


@pytest.mark.parametrize("model", ["fem", "condensed", "ting", "hertz"])
def test_a_run_is_that_of_the_command(glass, command, tmp_path, model):
    element = COARSE["mesh.contact_element_size"]
    out = tmp_path / "command"
    sets = [f"--set=mesh.contact_element_size={element!r}", f"--set=model.{model}={{}}"]
    command(glass, *sets, "--out", out, "--quiet")
    result = fem_run.Case.load(glass).with_({**COARSE, f"model.{model}": {}}).run()

    expected = json.loads((out / "summary.json").read_text())
    assert rest(result.summary) == rest(expected)
    assert result.summary["case"] == expected["case"]
    assert result.restitution == expected["restitution"]

    with open(out / "history.csv", newline="") as file:
        rows = list(csv.reader(file))
    assert list(result.history) == rows[0]
    columns = np.array([[float(cell or "nan") for cell in row] for row in rows[1:]]).T
    for name, column in zip(rows[0], columns):
        np.testing.assert_array_equal(result.history[name], column)

    # Saved, it is the same folder.
    result.save(tmp_path / "python")
    names = {path.name for path in out.iterdir()}
    assert {path.name for path in (tmp_path / "python").iterdir()} == names
    assert (tmp_path / "python" / "history.csv").read_bytes() == (out / "history.csv").read_bytes()

    grids = sorted(out.glob("*.vtu"), key=lambda path: int(path.stem.split("_")[-2]))
    assert len(grids) == len(result.snapshots) and bool(grids) == (model in ("fem", "condensed"))
    for path, snapshot in zip(grids, result.snapshots):
        assert path.stem.endswith(snapshot.label)
        read, own = pyvista.read(path), snapshot.to_pyvista()
        np.testing.assert_array_equal(own.points, read.points)
        np.testing.assert_array_equal(own.cells, read.cells)
        for of in ("point_data", "cell_data"):
            assert sorted(getattr(own, of).keys()) == sorted(getattr(read, of).keys())
            for name, array in getattr(read, of).items():
                np.testing.assert_array_equal(getattr(own, of)[name], array)


def test_changes_of_the_scene_name_title_and_folder_as_in_the_command(glass, command, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case = fem_run.Case.load(glass).with_({"body.0.approach_speed": "1 m/s", "model": {"ting": {}}})
    assert case.title.endswith(", but approach_speed = 1 m/s")
    command(glass, "--set=model=ting", "--set=body.0.approach_speed=1 m/s", "--quiet")
    folder = case.run().save()
    assert [str(path) for path in pathlib.Path("runs").iterdir()] == [folder]
    assert folder.endswith("-approach_speed=1m_s") and case.folder_name == os.path.basename(folder)



def test_a_sweep_is_that_of_the_command(glass, command, tmp_path):
    (tmp_path / "sweep.toml").write_text(
        f"case = {json.dumps(str(glass))}\n[vary]\n"
        "'body.0.sphere.diameter, body.1.sphere.diameter' = ['12 mm', 0.016]\n"
        "'body.0.approach_speed' = ['20 cm/s', 0.5, 1.0]\n"
    )
    command("sweep", "sweep.toml", "--set=model.condensed={}", "--set=mesh.contact_element_size=90e-6", cwd=tmp_path)
    with open(tmp_path / "runs" / "sweep" / "sweep.csv", newline="") as file:
        rows = list(csv.reader(file))
    case = fem_run.Case.load(glass).with_({"model": {"condensed": {}}, **COARSE})
    both = ("body.0.sphere.diameter", "body.1.sphere.diameter")
    vary = {both: ["12 mm", 0.016], "body.0.approach_speed": ["20 cm/s", 0.5, 1.0]}
    table = fem_run.sweep(case, vary)
    assert list(table) == rows[0]
    own = list(csv.reader(table.to_csv().splitlines()))
    assert [list(map(number, row)) for row in own] == [list(map(number, row)) for row in rows]
    # A pair for both keys.
    pairs = fem_run.sweep(case, {both: [("12 mm", "12 mm")], "body.0.approach_speed": [0.5]})
    assert pairs["restitution"][0] == table["restitution"][1]
    assert list(table.to_pandas().columns) == rows[0]


def test_a_dict_is_a_case(glass):
    glass_table = {
        "density": "2390 kg/m^3",
        "youngs_modulus": "63 GPa",
        "poissons_ratio": 0.244,
        "relaxation": {"acts_on": "all", "terms": [{"weight": 1.0, "decay_rate": "2708 1/s"}]},
    }
    case = fem_run.Case.from_dict(
        {
            "title": None,
            "material": {"glass": glass_table},
            "body": [
                {"name": "striker", "sphere": {"diameter": np.float64(0.0222)}, "material": "glass", "approach_speed": 0.5},
                {"name": "target", "sphere": {"diameter": "15.9 mm"}, "material": "glass"},
            ],
            "model": {"ting": {}},
        }
    )
    other = fem_run.Case.load(glass).with_({"model.ting": {}})
    assert case.run().restitution == other.run().restitution
    assert case.number("body.1.sphere.diameter") == (0.0159, "m")
    again = fem_run.Case.from_toml(case.to_toml())
    assert again.identity == case.identity


def test_laws_are_those_of_the_commands(glass, command, tmp_path):
    case = fem_run.Case.load(glass).with_({"model.ting": {}})
    table = fem_run.sweep(case, {"body.0.approach_speed": np.geomspace(0.1, 1, 6)})
    (tmp_path / "e.csv").write_text(table.to_csv())
    base = [str(glass), "--set=model.ting={}"]
    command("fit", *base, "--data", "e.csv", "--law", "bordbar_hyppanen", "--free", "a,n", "--out", "fit", cwd=tmp_path)
    fitted = fem_run.fit(case, table, law="bordbar_hyppanen", free=["a", "n"])
    expected = json.loads((tmp_path / "fit" / "fit.json").read_text())
    assert fitted["parameters"] == expected["parameters"]

    command("export", *base, "--data", "e.csv", "--out", "export", cwd=tmp_path)
    exported = fem_run.export(case, table.to_pandas())
    assert exported["texts"]
    for name, text in exported["texts"].items():
        assert (tmp_path / "export" / name).read_text() == text

    command("calibrate", *base, "--data", "e.csv", "--model", "ting", "--terms", "2", "--out", "cal", cwd=tmp_path)
    found = fem_run.calibrate(case, tmp_path / "e.csv", model="ting", terms=2)
    written = (tmp_path / "cal" / "relaxation.toml").read_text()
    # The first line names the file as it was given.
    assert found["relaxation_toml"].splitlines()[1:] == written.splitlines()[1:]

    solved = fem_run.invert(case, 0.9, law="tsuji", speed="0.5 m/s")
    (solution,) = solved["solutions"]
    law = case.with_({"model": {"law": {"tsuji": {solution["parameter"]: solution["value"]}}}})
    assert law.run().restitution == pytest.approx(0.9, abs=1e-6)

    swing = fem_run.cradle(length="20 cm", diameters=["22.2 mm", "15.9 mm"], alpha="20 deg", beta="24 deg")
    assert 0.5 < swing["restitution"] < 1.1
    trials = {"alpha_deg": [20.0, 10.0], "beta_deg": [24.0, 11.9]}
    rows = fem_run.cradle(trials, length="20 cm", diameters=["22.2 mm", "15.9 mm"])
    assert rows["restitution"][0] == swing["restitution"] and len(rows["restitution"]) == 2


def test_records_become_data_of_a_fit():
    data = ROOT / "validation" / "data"
    found = fem_run.measure(data / "bounce_times.csv", height="50 cm ± 1 mm")
    table = found.table()
    assert found["kind"] == "bounces" and len(table["restitution"]) == 13
    assert table["restitution"][0] == pytest.approx(0.8874, abs=1e-3) and table["time_s"][0] == 0.35
    assert "contact_time_s" not in table
    assert "13 restitutions" in repr(found) and found._repr_html_().startswith("<svg")
    case = fem_run.Case.load(ROOT / "cases" / "glass_0.5ms.toml")
    assert fem_run.fit(case, table, law="kuwabara_kono")["points"] == 13
    assert fem_run.fit(case, table, code="lethe")["law"] == "tsuji"
    force = fem_run.measure(data / "ball_force.csv", mass="10 g", height=0.03)
    assert (force.table()["contact_time_s"] > 1e-3).all()
    instants = fem_run.measure({"time_s": [0.4, 1.0, 1.54, 2.026]})
    assert instants["impacts"][0]["restitution"] == pytest.approx(0.9)
    with pytest.raises(fem_run.InputError, match="two instants are one flight"):
        fem_run.measure({"when": [0.4, 1.0]}, columns={"time": "when"})


def test_the_library_of_materials():
    assert "pmma" in fem_run.materials and "lib:pmma" in fem_run.materials
    pmma = fem_run.materials["pmma"]
    assert "lib:Plexiglass" in fem_run.materials and fem_run.materials["PMMA"] == pmma
    assert pmma["source"] and pmma["table"]["density"] > 1000
    assert "density" in fem_run.materials.toml("pmma")
    ice = fem_run.materials["ice"]["measured"][0]
    data = {name: ice[name] for name in ("speed_m_s", "restitution")}
    assert ice["source"] and len(data["restitution"]) == 12
    spheres = fem_run.Case.load(ROOT / "cases" / "ice_2cm.toml")
    own, named = (fem_run.fit(spheres, one, law="mishra_murty") for one in (data, f"lib:ice/{ice['name']}"))
    assert named["parameters"][0]["value"] == pytest.approx(own["parameters"][0]["value"], rel=1e-6)
    assert repr(named).startswith("<fem_run.Fit mishra_murty: ") and " ± " in repr(named) and "12 points" in repr(named)
    assert "<table><caption>mishra_murty" in named._repr_html_() and " ± " in named._repr_html_()
    with pytest.raises(fem_run.InputError, match="unobtainium"):
        fem_run.fit(spheres, "lib:unobtainium")
    case = fem_run.Case.from_dict(
        {
            "body": [
                {"name": "floor", "wall": {}},
                {"name": "ball", "sphere": {"diameter": 0.01}, "material": "lib:pmma", "approach_speed": 1},
            ],
            "model": {"ting": {}},
        }
    )
    assert 0 < case.run().restitution < 1


def test_pictures_for_notebooks(glass):
    result = fem_run.Case.load(glass).with_({"model.ting": {}}).run()
    assert "restitution" in result._repr_html_() and "±" in result._repr_html_()
    table = fem_run.sweep(fem_run.Case.load(glass).with_({"model.ting": {}}), {"body.0.approach_speed": [0.5]})
    assert "<table" in table._repr_html_()
    assert "restitution 0.92705 ± 0.00071, contact time 62.86 ± 0.80 µs, peak force 103.5 ± 1.7 N" in repr(result)
    assert "Warnings" not in result._repr_html_() and "complete" not in repr(result)


def test_bounds_have_their_sign():
    balls = [{"name": name, "sphere": {"diameter": 0.01}, "material": "lib:steel"} for name in "ab"]
    balls[0]["approach_speed"] = 5
    result = fem_run.Case.from_dict({"body": balls, "model": {"hertz": {}}}).run()
    assert "restitution at most 1.0000, contact time " in repr(result)
    assert "at most 1.0000" in result._repr_html_()
    assert result.status["restitution"] == "bound" and result.uncertainty("restitution") is None
    slow = fem_run.Case.from_dict({"body": balls, "model": {"hertz": {}}}).with_({"body.0.approach_speed": 1e-3}).run()
    assert slow.status["restitution"] == "bound" and slow.status["peak_force_n"] == "computed"
    with pytest.raises(fem_run.InputError, match="bound"):
        fem_run.fit(
            fem_run.Case.from_dict({"body": balls}),
            fem_run.sweep(fem_run.Case.from_dict({"body": balls, "model": {"hertz": {}}}), {"body.0.approach_speed": [1, 2]}),
            law="tsuji",
        )


def test_plots_of_results_and_tables(glass, monkeypatch):
    from matplotlib import pyplot

    pyplot.switch_backend("Agg")
    case = fem_run.Case.load(glass).with_({"model.ting": {}})
    axes = case.run().plot()
    assert axes.get_xlabel() == "time [µs]" and axes.get_ylabel() == "contact force [N]"
    table = fem_run.sweep(case, {"body.0.approach_speed": ["5 cm/s", "1 m/s"]})
    axes = table.plot()
    assert (axes.get_xlabel(), axes.get_ylabel(), axes.get_xscale()) == ("approach speed [m/s]", "restitution", "log")
    assert table.plot("peak_force_n", axes=axes) is axes and axes.get_ylabel() == "peak force [N]"
    with pytest.raises(KeyError, match="no column of numbers"):
        table.plot("restitutoin")
    fitted = fem_run.fit(case, table, law="kuwabara_kono", compare="tsuji")
    axes = fitted.plot()
    assert axes.get_xlabel() == "speed [m/s]"
    assert [line.get_label() for line in axes.get_lines()][-2:] == ["kuwabara_kono", "tsuji"]
    assert fitted.plot(axes) is axes
    found = fem_run.calibrate(case, table, model="ting", terms=2)
    axes = found.plot()
    assert axes.get_xlabel() == "approach speed [m/s]"
    assert axes.get_lines()[-2].get_label() == "best series"
    assert "Calibration of glass: weights" in repr(found) and "% range" in found._repr_html_()
    for one in (fitted, found):
        assert pickle.loads(pickle.dumps(one)) == one and type(copy.copy(one)) is type(one)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=r"pip install 'fem-run\[plot\]'"):
        table.plot()


def test_a_table_without_pandas_is_shown_as_text(glass, monkeypatch):
    table = fem_run.sweep(fem_run.Case.load(glass).with_({"model.ting": {}}), {"body.0.approach_speed": [0.5]})
    monkeypatch.setitem(sys.modules, "pandas", None)
    assert table._repr_html_() is None


def test_a_notebook_is_warned_where_the_terminal_is():
    """Ting's half-spaces do not know how far they are off so soft a ball."""
    result = fem_run.Case.load(ROOT / "cases" / "soft_sphere.toml").with_({"model.ting": {}}).run()
    assert result.summary["uncertainty"]["restitution"]["model"] is None
    assert result.uncertainty("restitution") is None
    page = result._repr_html_()
    assert "restitution" in page and "± ?" in page
    assert all(html.escape(warning) in page for warning in result.warnings) and len(result.warnings) > 1


def test_moduli_become_the_material_of_a_case(tmp_path):
    # A standard linear solid with weights 0.5 at 1 ms and 10 MPa: E' and E'' in closed form.
    frequency = np.geomspace(1, 1e4, 30)
    x = 2 * np.pi * frequency * 1e-3
    moduli = {"frequency_hz": frequency, "E' [MPa]": 10 * (0.5 + 0.5 * x**2 / (1 + x**2)), "E'' [MPa]": 5 * x / (1 + x**2)}
    found = fem_run.relaxation(moduli, density=1200, poissons_ratio=0.4)
    assert found["instantaneous_modulus_pa"] == pytest.approx(10e6, rel=1e-4)
    assert [(one["weight"], one["relaxation_time_s"]) for one in found["terms"]] == [pytest.approx((0.5, 1e-3), rel=1e-4)]
    assert repr(found).startswith("<fem_run.Relaxation of ") and "1 terms" in repr(found)
    assert found._repr_html_().startswith("<svg")
    named = fem_run.relaxation({"f": frequency, "one": moduli["E' [MPa]"], "two": moduli["E'' [MPa]"]},
                               columns={"storage_modulus_mpa": "one", "loss_modulus_mpa": "two"})  # fmt: skip
    assert named["terms"] == found["terms"]
    rows = np.column_stack(list(moduli.values()))
    (tmp_path / "dma.csv").write_text(",".join(moduli) + "\n" + "\n".join(",".join(map(str, row)) for row in rows.tolist()))
    assert fem_run.relaxation(tmp_path / "dma.csv")["terms"] == found["terms"]
    with pytest.raises(fem_run.InputError, match="one frequency"):
        fem_run.relaxation({name: column[:1] for name, column in moduli.items()})
    # The table that it writes is that of the known solid to a case.
    (tmp_path / "rubber.relaxation.toml").write_text(found["relaxation_toml"])
    case = {
        "material": {"rubber": {"density": 1200, "youngs_modulus": 10e6, "poissons_ratio": 0.4}},
        "body": [
            {"name": "ball", "sphere": {"diameter": 0.02}, "material": "rubber", "approach_speed": 0.1},
            {"name": "floor", "wall": {}},
        ],
        "model": {"ting": {}},
    }
    known, named = copy.deepcopy(case), copy.deepcopy(case)
    known["material"]["rubber"]["relaxation"] = {"acts_on": "all", "terms": [{"weight": 0.5, "relaxation_time": 1e-3}]}
    named["material"]["rubber"]["relaxation"] = {"file": str(tmp_path / "rubber.relaxation.toml")}
    restitutions = [fem_run.Case.from_dict(one).run().restitution for one in (known, named)]
    assert 0.2 < restitutions[0] < 0.9 and restitutions[1] == pytest.approx(restitutions[0], abs=1e-4)

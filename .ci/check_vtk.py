#!/usr/bin/env python3
"""Reads .vtu files with VTK's own reader and with meshio, and fails on the first difference.

    check_vtk.py reference FILE.vtu FILE.json   every array against the values in the JSON, which
                                                tools/src/vtk_reference.rs wrote
    check_vtk.py results DIR                    a result folder of fem-run: the files that its .pvd
                                                lists, their times, names and arrays

Exit status: 0 all is well (one line a file), 1 a check failed, 2 wrong usage.
Needs: pip install vtk meshio
"""

import json
import math
import re
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

VTK_QUAD = 9
SECTIONS = ("point_data", "cell_data", "field_data")
STRESSES = ("sigma_rr", "sigma_yy", "sigma_tt", "sigma_ry", "pressure", "von_mises")
# The arrays of the contract: section -> name -> components. Others are welcome.
CONTRACT = {
    "point_data": {"displacement": 3, "velocity": 3} | dict.fromkeys(STRESSES, 1),
    "cell_data": dict.fromkeys((*STRESSES, "body"), 1),
    "field_data": {"TimeValue": 1},
}


class Failure(Exception):
    """A check failed; the message says where and what."""


def require(condition, message):
    if not condition:
        raise Failure(message)


def table(values):
    """Tuples as rows: both readers' arrays in one shape."""
    values = numpy.asarray(values)
    return values.reshape(len(values), -1)


def read_with_vtk(path):
    """Points, cells and arrays by section, as VTK's own reader sees them."""
    complaints = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.AddObserver("WarningEvent", lambda *_: complaints.append("warning"))
    reader.SetFileName(str(path))
    reader.Update()
    require(not complaints, f"{path}: VTK reports {complaints}")
    grid = reader.GetOutput()
    require(grid.GetNumberOfPoints() > 0, f"{path}: VTK finds no points")
    require(grid.GetNumberOfCells() > 0, f"{path}: VTK finds no cells")
    types = {grid.GetCellType(cell) for cell in range(grid.GetNumberOfCells())}
    require(types == {VTK_QUAD}, f"{path}: VTK finds cell types {sorted(types)}, not only {VTK_QUAD}")
    data = {"points": table(vtk_to_numpy(grid.GetPoints().GetData()))}
    data["cells"] = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
    for section, source in zip(SECTIONS, (grid.GetPointData(), grid.GetCellData(), grid.GetFieldData())):
        arrays = [source.GetAbstractArray(index) for index in range(source.GetNumberOfArrays())]
        data[section] = {array.GetName(): table(vtk_to_numpy(array)) for array in arrays}
    return data


def read_with_meshio(path):
    """The same as meshio sees it."""
    try:
        mesh = meshio.read(path)
    except (Exception, SystemExit) as error:
        raise Failure(f"{path}: meshio fails: {type(error).__name__}: {error}") from error
    kinds = [block.type for block in mesh.cells]
    require(kinds == ["quad"], f"{path}: meshio finds cell blocks {kinds}, not ['quad']")
    data = {"points": table(mesh.points), "cells": mesh.cells[0].data}
    data["point_data"] = {name: table(values) for name, values in mesh.point_data.items()}
    data["cell_data"] = {name: table(values[0]) for name, values in mesh.cell_data.items()}
    data["field_data"] = {name: table(values) for name, values in mesh.field_data.items()}
    return data


def compare(place, found, expected):
    """Shape and every value, exactly: both readers decode the same bytes."""
    require(found.shape == expected.shape, f"{place}: shape {found.shape}, expected {expected.shape}")
    kinds = (numpy.issubdtype(found.dtype, numpy.floating), numpy.issubdtype(expected.dtype, numpy.floating))
    require(kinds[0] == kinds[1], f"{place}: type {found.dtype}, expected {expected.dtype}")
    different = numpy.argwhere(found != expected)
    if len(different):
        where = tuple(int(index) for index in different[0])
        raise Failure(f"{place}: value {found[where]!r} at {where}, expected {expected[where]!r}")


def compare_files(place, found, expected):
    for name in ("points", "cells"):
        compare(f"{place}: {name}", found[name], expected[name])
    for section in SECTIONS:
        names = (sorted(found[section]), sorted(expected[section]))
        require(names[0] == names[1], f"{place}: {section} has {names[0]}, expected {names[1]}")
        for name, values in expected[section].items():
            compare(f"{place}: {section} {name!r}", found[section][name], values)


def describe(path, data):
    arrays = sum(len(data[section]) for section in SECTIONS)
    size = path.stat().st_size
    return f"{path.name}: {len(data['points'])} points, {len(data['cells'])} quads, {arrays} arrays, {size} bytes"


def check_reference(path, json_path):
    try:
        reference = json.loads(json_path.read_text())
        expected = {name: numpy.array(reference[name]) for name in ("points", "cells")}
        for section in SECTIONS:
            expected[section] = {
                name: numpy.array(array["values"]).reshape(-1, array["components"])
                for name, array in reference[section].items()
            }
    except (ValueError, KeyError, TypeError) as error:
        raise Failure(f"{json_path}: not written by fem-tools: {error!r}") from error
    for reader, read in (("VTK", read_with_vtk), ("meshio", read_with_meshio)):
        compare_files(f"{path}: {reader}", read(path), expected)
    readers = f"VTK {vtk.vtkVersion.GetVTKVersion()} and meshio {meshio.__version__}"
    print(f"{describe(path, expected)}: {readers} agree with {json_path.name}")


def read_collection(folder):
    """The stem and the (time, file name) pairs of the folder's one .pvd, checked."""
    collections = sorted(folder.glob("*.pvd"))
    require(len(collections) == 1, f"{folder}: {len(collections)} .pvd files, expected one")
    path = collections[0]
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        raise Failure(f"{path}: no XML: {error}") from error
    require(root.tag == "VTKFile" and root.get("type") == "Collection", f"{path}: not a VTKFile of type Collection")
    snapshots = []
    for entry in root.iterfind("Collection/DataSet"):
        text = entry.get("timestep", "")
        try:
            time = float(text)
        except ValueError:
            time = math.nan
        require(math.isfinite(time), f"{path}: timestep {text!r} is not a finite number")
        name = entry.get("file", "")
        require(name == Path(name).name and name, f"{path}: file {name!r} is not a name in the same folder")
        require(not snapshots or time > snapshots[-1][0], f"{path}: times do not increase at {name} ({text})")
        snapshots.append((time, name))
    require(snapshots, f"{path}: no snapshots")
    check_series(path.with_suffix(".vtu.series"), snapshots)
    return path.stem, snapshots


def check_series(path, snapshots):
    require(path.is_file(), f"{path}: missing beside the .pvd")
    try:
        series = json.loads(path.read_text())
        listed = [(entry["time"], entry["name"]) for entry in series["files"]]
    except (ValueError, KeyError, TypeError) as error:
        raise Failure(f"{path}: no series of files with name and time: {error!r}") from error
    require(listed == snapshots, f"{path}: lists {listed}, the .pvd {snapshots}")


def check_labels(folder, stem, snapshots):
    """<stem>_<k>_<label>.vtu, k in time order, labels not empty, no .vtu that is not listed."""
    last = -1
    labels = set()
    for _, name in snapshots:
        match = re.fullmatch(re.escape(stem) + r"_(\d+)_([A-Za-z0-9][A-Za-z0-9_.+-]*)\.vtu", name)
        require(match, f"{folder}: file name {name!r} is not {stem}_<k>_<label>.vtu")
        require(int(match[1]) > last, f"{folder}: {name}: number {match[1]} does not increase with time")
        # Snapshots by count or by time share a label.
        is_named = match[2] not in ("even", "time")
        require(not is_named or match[2] not in labels, f"{folder}: {name}: label {match[2]!r} twice")
        last = int(match[1])
        labels.add(match[2])
    files = {path.name for path in folder.glob("*.vtu")}
    listed = {name for _, name in snapshots}
    require(files == listed, f"{folder}: the .pvd and the folder differ in {sorted(files ^ listed)}")


def check_contract(path, data):
    for section, arrays in CONTRACT.items():
        for name, components in arrays.items():
            require(name in data[section], f"{path}: {section} has no {name!r}, it has {sorted(data[section])}")
            found = data[section][name].shape[1]
            require(found == components, f"{path}: {section} {name!r} has {found} components, expected {components}")
    for section in SECTIONS:
        for name, values in data[section].items():
            require(numpy.isfinite(values).all(), f"{path}: {section} {name!r} has values that are not finite")
    require(numpy.isfinite(data["points"]).all(), f"{path}: points are not finite")
    require((data["points"][:, 2] == 0).all(), f"{path}: points leave the plane: (r, y, 0) expected")
    for name in ("displacement", "velocity"):
        require((data["point_data"][name][:, 2] == 0).all(), f"{path}: {name} leaves the plane")
    body = data["cell_data"]["body"]
    require((body == numpy.round(body)).all(), f"{path}: cell_data 'body' is not whole numbers")
    cells = data["cells"]
    require(cells.min() >= 0 and cells.max() < len(data["points"]), f"{path}: cells name points that are not there")


def check_results(folder):
    require(folder.is_dir(), f"{folder}: no folder")
    stem, snapshots = read_collection(folder)
    check_labels(folder, stem, snapshots)
    for time, name in snapshots:
        path = folder / name
        data = read_with_vtk(path)
        check_contract(path, data)
        compare_files(f"{path}: meshio against VTK", read_with_meshio(path), data)
        found = data["field_data"]["TimeValue"]
        same = found.shape == (1, 1) and found[0, 0] == time
        require(same, f"{path}: TimeValue {found.tolist()}, the .pvd says {time!r}")
        print(f"{describe(path, data)}, t = {time:.6e} s: ok")


def main(arguments):
    modes = {"reference": (2, check_reference), "results": (1, check_results)}
    if not arguments or arguments[0] not in modes or len(arguments) - 1 != modes[arguments[0]][0]:
        print(__doc__, file=sys.stderr)
        return 2
    try:
        modes[arguments[0]][1](*map(Path, arguments[1:]))
    except (Failure, OSError) as error:
        print(f"check_vtk.py: FAILED: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads what `encase curves -o` writes with VTK's own readers and compares it with the JSON result.

Usage: vtk_reader_test.py ENCASE FILE.curves...
Exit code 77 (skipped) where Python has no VTK: Debian's is for /usr/bin/python3.
"""
import json
import os
import subprocess
import sys
import tempfile

try:
    from vtkmodules.util.vtkConstants import VTK_DOUBLE
    from vtkmodules.vtkFiltersGeneral import vtkCellValidator
    from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataReader, vtkXMLPolyDataReader
    from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
except ImportError as error:
    print("skipped:", error)
    sys.exit(77)

BLOCKS = ["cells", "curves", "points", "critical_regions", "unresolved", "faces", "edges",
          "vertices", "labels"]


def expect(condition, message):
    if not condition:
        raise AssertionError(message)


def expect_equal(value, expected, what):
    expect(value == expected, f"{what}: {value!r}, expected {expected!r}")


def read_blocks(path):
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(path)
    reader.Update()
    result = reader.GetOutput()
    expect_equal(result.GetNumberOfBlocks(), len(BLOCKS), "blocks")
    blocks = {}
    for k in range(len(BLOCKS)):
        name = result.GetMetaData(k).Get(vtkCompositeDataSet.NAME())
        blocks[name] = result.GetBlock(k)
    expect_equal(list(blocks), BLOCKS, "names of blocks")
    return result, blocks


def read_one(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def column(attributes, name):
    array = attributes.GetAbstractArray(name)
    expect(array is not None, f"array {name} is missing")
    return [array.GetValue(k) for k in range(array.GetNumberOfTuples())]


def check_valid(data, what):
    """No cell has too few points, crossing edges or a dent."""
    if data.GetNumberOfCells() == 0:
        return
    validator = vtkCellValidator()
    validator.SetInputData(data)
    validator.Update()
    states = column(validator.GetOutput().GetCellData(), "ValidityState")
    bad = [(k, state) for k, state in enumerate(states) if state != 0]
    expect(not bad, f"{what}: invalid cells (number, state): {bad[:10]}")


def corners_of(data, k):
    points = data.GetCell(k).GetPoints()
    return [points.GetPoint(i) for i in range(points.GetNumberOfPoints())]


def area_along(points):
    """What the way along points adds to the area on its left, if it is continued to the first."""
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(points, points[1:])) / 2


def area(data):
    total = 0.0
    for k in range(data.GetNumberOfCells()):
        corners = corners_of(data, k)
        part = area_along(corners + corners[:1])
        expect(part > 0, f"polygon {k} is not counter-clockwise")
        total += part
    return total


def fraction(text):
    numerator, _, denominator = text.partition("/")
    return int(numerator) / int(denominator or 1)


def region_area(result):
    corners = [[fraction(c) for c in corner] for corner in result["region_used"]["polygon"]]
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(corners, corners[1:] + corners[:1])) / 2


def check_result(directory, result):
    whole, blocks = read_blocks(os.path.join(directory, "result.vtm"))
    for data in [whole, *blocks.values()]:
        if data is None:
            continue
        field = data.GetFieldData()
        expect_equal(column(field, "status"), [result["status"]], "status")
        expect_equal(len(column(field, "input")), len(result["input"]["curves"]), "input")
        expect(column(field, "version")[0].startswith("encase "), "version")
    # The reader gives empty pieces their type back only when it reads them alone.
    blocks = {name: read_one(os.path.join(directory, "result", name + ".vtp")) for name in BLOCKS}

    cells = blocks["cells"]
    expect_equal(cells.GetNumberOfPolys(), len(result["cells"]), "cells")
    expect_equal(cells.GetPoints().GetDataType(), VTK_DOUBLE, "type of points")
    of_cells = cells.GetCellData()
    expect_equal(column(of_cells, "id"), list(range(len(result["cells"]))), "id")
    expect_equal(column(of_cells, "depth"), [c["depth"] for c in result["cells"]], "depth")
    certified = [c["state"] in ("certified", "relaxed") for c in result["cells"]]
    expect_equal(column(of_cells, "certified"), [int(c) for c in certified], "certified")
    crossing = [-1 if c["crossing"] is None else c["crossing"] for c in result["cells"]]
    expect_equal(column(of_cells, "crossing"), crossing, "crossing")
    column(of_cells, "kind"), column(of_cells, "curve"), column(of_cells, "curve_name")
    signs = [of_cells.GetArrayName(k) for k in range(of_cells.GetNumberOfArrays())]
    signs = [name for name in signs if name.startswith("sign_")]
    expect_equal(len(signs), len(result["curves"]), "sign arrays")
    for curve, name in enumerate(signs):
        for k, sign in enumerate(column(of_cells, name)):
            on = any(result["crossings_on_lines"][c]["curve"] == curve
                     for c in result["cells"][k]["word"])
            expect_equal(sign != 0, certified[k] and not on, f"{name} of cell {k} is not 0")
    check_valid(cells, "cells")
    expect(abs(area(cells) / region_area(result) - 1) < 1e-9, "the cells do not fill the region")

    curves = blocks["curves"]
    names = {c["name"] for c in result["curves"]}
    expect(set(column(curves.GetCellData(), "curve_name")) <= names, "names of curves")
    if all(certified):
        drawn = set(column(curves.GetCellData(), "curve"))
        expect_equal(drawn, {b[0] for c in result["cells"] for b in c["branches"]}, "curves")

    points = blocks["points"]
    expect_equal(points.GetNumberOfVerts(), len(result["crossings"]), "crossings")
    for k, c in enumerate(result["crossings"]):
        expect_equal(points.GetPoint(k)[:2], (c["x"], c["y"]), "crossing")
    for name in ["id", "kind", "curve", "second_curve", "curve_name", "cell", "radius", "certified"]:
        column(points.GetPointData(), name)

    critical = blocks["critical_regions"]
    boxes = sum(len(region["boxes"]) for region in result["critical"])
    expect_equal(critical.GetNumberOfPolys(), boxes, "boxes of critical regions")
    places = [p for p in result["degenerate"] + result["undecided"] if p["box"]]
    expect_equal(blocks["unresolved"].GetNumberOfPolys(), len(places), "unresolved boxes")
    check_arrangement(blocks, result)


def check_arrangement(blocks, result):
    faces, edges, vertices = (blocks[name] for name in ["faces", "edges", "vertices"])
    arrangement = result.get("arrangement")
    expect_equal(arrangement is not None, result["status"] == "certified", "arrangement")
    if arrangement is None:
        for data in faces, edges, vertices, blocks["labels"]:
            expect_equal(data.GetNumberOfCells(), 0, "parts of an unknown arrangement")
        return

    expect_equal(edges.GetNumberOfLines(), len(arrangement["edges"]), "edges")
    of_edges = edges.GetCellData()
    curve = [-1 if e["curve"] is None else e["curve"] for e in arrangement["edges"]]
    expect_equal(column(of_edges, "curve"), curve, "curves of edges")
    for k, name in enumerate(["left_face", "right_face"]):
        expect_equal(column(of_edges, name), [e["faces"][k] for e in arrangement["edges"]], name)
    expect_equal(vertices.GetNumberOfVerts(), len(arrangement["vertices"]), "vertices")
    for k, vertex in enumerate(arrangement["vertices"]):
        expect_equal(vertices.GetPoint(k)[:2], (vertex["x"], vertex["y"]), "vertex")
    expect_equal(column(vertices.GetPointData(), "kind_name"),
                 [vertex["kind"] for vertex in arrangement["vertices"]], "kinds of vertices")

    labels = set(column(blocks["labels"].GetPointData(), "label"))
    parts = {f"{key[0]}{k}" for key in ["edges", "vertices"] for k in range(len(arrangement[key]))}
    faces_labelled = {f"f{face['id']}" for face in arrangement["faces"] if face["signs"]}
    expect(parts <= labels <= parts | faces_labelled, "labels")

    of_faces = faces.GetCellData()
    pieces = column(of_faces, "piece")
    expect_equal(sorted(set(pieces)), list(range(len(arrangement["pieces"]))), "pieces of faces")
    expect_equal(column(of_faces, "cell"), [arrangement["pieces"][k][0] for k in pieces], "cells")
    ids = column(of_faces, "id")
    signs = [of_faces.GetArrayName(k) for k in range(of_faces.GetNumberOfArrays())]
    signs = [column(of_faces, name) for name in signs if name.startswith("sign_")]
    areas = {}
    whole = region_area(result)
    for k, face in enumerate(ids):
        expect_equal([s[k] for s in signs], arrangement["faces"][face]["signs"], "signs of a face")
        corners = corners_of(faces, k)
        expect_equal(len(corners), 3, "corners of a triangle")
        part = area_along(corners + corners[:1])
        expect(part > -1e-9 * whole, f"triangle {k} is turned over")
        areas[face] = areas.get(face, 0.0) + part
    # Each face has the area that the polylines around it enclose.
    along = [area_along(corners_of(edges, k)) for k in range(len(curve))]
    for face in arrangement["faces"]:
        if face["id"] == arrangement["outside"]:
            continue
        half_edges = sum(face["holes"], face["outer"])
        expected = sum(along[h // 2] * (-1 if h % 2 else 1) for h in half_edges)
        expect(abs(areas[face["id"]] - expected) <= 1e-9 * whole,
               f"area of face {face['id']}: {areas[face['id']]}, expected {expected}")
        expect(expected > 0, f"face {face['id']} has no area")
    expect(abs(sum(areas.values()) / whole - 1) < 1e-9, "the faces do not fill the region")


def check_history(directory, result):
    steps = []
    with open(os.path.join(directory, "history.pvd"), encoding="ascii") as index:
        for line in index:
            if "<DataSet" in line:
                parts = line.split('"')
                steps.append((int(parts[1]), parts[parts.index(" file=") + 1]))
    cuts = len(result["history"])
    expect_equal(len(steps), min(cuts + 1, 200), "time steps")
    expect_equal((steps[0][0], steps[-1][0]), (0, cuts), "first and last time step")
    for time, name in steps:
        data = read_one(os.path.join(directory, name))
        expect_equal(data.GetNumberOfPolys(), time + 1, f"pieces after {time} cuts")
        expect(abs(area(data) / region_area(result) - 1) < 1e-9, f"area after {time} cuts")
    check_valid(data, "last time step")


def check_file(encase, curves):
    with tempfile.TemporaryDirectory() as work:
        json_file = os.path.join(work, "result.json")
        directory = os.path.join(work, "vtk")
        run = subprocess.run([encase, "curves", curves, "--json", json_file, "-o", directory,
                              "--history", "-q"], stdout=subprocess.DEVNULL, check=False)
        expect(run.returncode in (0, 3, 4), f"exit code {run.returncode}")
        with open(json_file, encoding="utf-8") as file:
            result = json.load(file)
        check_result(directory, result)
        check_history(directory, result)
        print(f"{curves}: {result['status']}, {len(result['cells'])} cells, "
              f"{len(result['crossings'])} crossings")


def main():
    failures = 0
    for curves in sys.argv[2:]:
        try:
            check_file(sys.argv[1], curves)
        except AssertionError as error:
            print(f"{curves}: {error}")
            failures += 1
    sys.exit(1 if failures or len(sys.argv) < 3 else 0)


if __name__ == "__main__":
    main()

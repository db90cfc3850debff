# SPDX-License-Identifier: MIT
"""Shows an encasement in ParaView in sensible colours.

    encase curves examples/clover.curves -o out
    pvpython examples/paraview/open_encasement.py out picture.png
    pvpython examples/paraview/open_encasement.py out picture.png faces

The last one shows the faces of the arrangement in place of the cells.

In ParaView itself (View > Python Shell) the pipeline stays open to play with:

    import sys; sys.argv = ["", "out"]
    exec(open("examples/paraview/open_encasement.py").read())
"""
import os
import sys

from paraview import servermanager
from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, GetScalarBar,
                             QuerySelect, Render, ResetCamera, SaveScreenshot, SetActiveSource, Show,
                             XMLPolyDataReader)

# Okabe and Ito's colours, which people with any colour vision can tell apart.
CURVE_COLOURS = [(0.00, 0.45, 0.70), (0.84, 0.37, 0.00), (0.00, 0.62, 0.45), (0.80, 0.47, 0.65),
                 (0.34, 0.71, 0.91), (0.90, 0.62, 0.00)]
CELL_KINDS = ["empty", "one curve", "crossing", "relaxed", "degenerate", "undecided"]
# By the curves' signs, as in the pictures of `encase curves --svg F --faces`.
FACE_COLOURS = [(0.98, 0.91, 0.78), (0.84, 0.91, 0.96), (0.89, 0.94, 0.85), (0.96, 0.87, 0.90),
                (0.90, 0.88, 0.95), (0.99, 0.96, 0.79), (0.84, 0.94, 0.93), (0.93, 0.93, 0.93)]
SIGN_CODES = [1, 2, 4, 7, 3, 5, 6]
CELL_COLOURS = [(1.00, 1.00, 1.00), (0.91, 0.95, 0.98), (1.00, 0.97, 0.86), (0.92, 0.93, 0.95),
                (0.98, 0.85, 0.84), (0.93, 0.88, 0.97)]


def open_block(directory, name):
    """A block of the result, or None if nothing is in it."""
    path = os.path.join(directory, "result", name + ".vtp")
    reader = XMLPolyDataReader(registrationName=name, FileName=[path])
    reader.UpdatePipeline()
    return reader if reader.GetDataInformation().GetNumberOfCells() > 0 else None


def colour_by(display, array, names, colours):
    """Colours cells by an integer array whose values 0, 1, 2, ... have names."""
    ColorBy(display, ("CELLS", array), separate=True)
    table = GetColorTransferFunction(array, display, separate=True)
    table.InterpretValuesAsCategories = 1
    table.Annotations = [text for k, name in enumerate(names) for text in (str(k), name)]
    table.IndexedColors = [c for k in range(len(names)) for c in colours[k % len(colours)]]
    display.LookupTable = table
    table.IndexedOpacities = [1.0] * len(names)


def face_colours(faces):
    """A colour for each face, the same for equal signs of the curves."""
    attributes = servermanager.Fetch(faces).GetCellData()
    names = [attributes.GetArrayName(k) for k in range(attributes.GetNumberOfArrays())]
    signs = [attributes.GetAbstractArray(name) for name in names if name.startswith("sign_")]
    ids = attributes.GetAbstractArray("id")
    codes = {}
    for k in range(ids.GetNumberOfTuples()):
        code = 0
        for curve, sign in enumerate(signs):
            if sign.GetValue(k) < 0:
                code ^= SIGN_CODES[curve % len(SIGN_CODES)]
        codes[ids.GetValue(k)] = code
    return [FACE_COLOURS[codes.get(k, 0)] for k in range(max(codes) + 1)]


def show_labels(labels, view, height):
    """The names of faces, edges and vertices beside their points."""
    display = Show(labels, view)
    display.SetRepresentationType("Points")
    display.Position = [0.0, 0.0, height]
    display.PointSize = 1.0
    display.ColorArrayName = [None, ""]
    SetActiveSource(labels)
    QuerySelect(QueryString="(id >= 0)", FieldType="POINT")
    display.SelectionPointLabelVisibility = 1
    display.SelectionPointFieldDataArrayName = "label"
    display.SelectionPointLabelColor = [0.1, 0.1, 0.1]
    display.SelectionPointLabelFontSize = 14
    display.SelectionPointSize = 1.0


def show(directory, with_faces):
    view = GetActiveViewOrCreate("RenderView")
    view.InteractionMode = "2D"
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    blocks = {name: open_block(directory, name)
              for name in ["cells", "faces", "critical_regions", "curves", "unresolved", "points",
                           "vertices", "labels"]}
    if with_faces and not blocks["faces"]:
        sys.exit("there are no faces: the result is not certified")

    points = blocks["vertices"] if with_faces else blocks["points"]
    crowded = points and points.GetDataInformation().GetNumberOfCells() > 150
    cells = blocks["cells"]
    bounds = cells.GetDataInformation().GetBounds()
    # Everything lies in the plane z = 0; seen from above, a little height keeps layers in order.
    layer = 1e-2 * max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    curve_names = {}
    if blocks["curves"]:
        attributes = servermanager.Fetch(blocks["curves"]).GetCellData()
        curves, names = (attributes.GetAbstractArray(a) for a in ["curve", "curve_name"])
        for k in range(curves.GetNumberOfTuples()):
            curve_names[curves.GetValue(k)] = names.GetValue(k)
    names = [curve_names.get(k, str(k)) for k in range(max(curve_names, default=-1) + 1)]

    if with_faces:
        display = Show(blocks["faces"], view)
        display.SetRepresentationType("Surface")
        colours = face_colours(blocks["faces"])
        colour_by(display, "id", [f"face {k}" for k in range(len(colours))], colours)
    else:
        display = Show(cells, view)
        display.SetRepresentationType("Surface With Edges")
        display.EdgeColor = [0.6, 0.62, 0.65]
        colour_by(display, "kind", CELL_KINDS, CELL_COLOURS)
    display.Ambient, display.Diffuse = 1.0, 0.0

    if blocks["critical_regions"] and not with_faces:
        display = Show(blocks["critical_regions"], view)
        display.Position = [0.0, 0.0, layer]
        display.Opacity = 0.3
        display.Ambient, display.Diffuse = 1.0, 0.0
        colour_by(display, "curve", names, CURVE_COLOURS)
    if blocks["curves"]:
        display = Show(blocks["curves"], view)
        display.Position = [0.0, 0.0, 2 * layer]
        display.LineWidth = 1.5 if crowded else 3.0
        colour_by(display, "curve", names, CURVE_COLOURS)
        bar = GetScalarBar(display.LookupTable, view)
        bar.Title, bar.ComponentTitle = "curve", ""
        bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
        bar.WindowLocation = "Upper Right Corner"
        bar.ScalarBarLength = 0.1
        bar.ScalarBarThickness = 10
        bar.TitleFontSize = bar.LabelFontSize = 12
        display.SetScalarBarVisibility(view, len(names) <= 12)
    if blocks["unresolved"]:
        display = Show(blocks["unresolved"], view)
        display.Position = [0.0, 0.0, 3 * layer]
        display.SetRepresentationType("Wireframe")
        display.LineWidth = 4.0
        display.ColorArrayName = [None, ""]
        display.AmbientColor = display.DiffuseColor = [0.76, 0.07, 0.12]
    if points:
        display = Show(points, view)
        display.Position = [0.0, 0.0, 4 * layer]
        display.SetRepresentationType("Points")
        display.PointSize = 4.0 if crowded else 9.0
        display.ColorArrayName = [None, ""]
        display.AmbientColor = display.DiffuseColor = [0.1, 0.1, 0.1]

    if with_faces and not crowded:
        show_labels(blocks["labels"], view, 5 * layer)

    ResetCamera(view)
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.56 * max(bounds[1] - bounds[0], bounds[3] - bounds[2])
    Render(view)
    return view


if len(sys.argv) < 2:
    sys.exit("usage: pvpython open_encasement.py DIRECTORY [PICTURE.png [faces]]")
encasement_view = show(sys.argv[1], "faces" in sys.argv[3:])
if len(sys.argv) > 2:
    encasement_view.ViewSize = [1000, 1000]
    SaveScreenshot(sys.argv[2], encasement_view, ImageResolution=[1000, 1000])

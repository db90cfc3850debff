# SPDX-License-Identifier: MIT
"""Shows an encasement of surfaces in ParaView in sensible colours.

    encase surfaces -e "x^2 + y^2 + z^2 = 1" -e "z = x y" --region "box -2 2 -2 2 -2 2" -o out
    pvpython examples/paraview/open_surfaces.py out picture.png
    pvpython examples/paraview/open_surfaces.py out picture.png cells

The last one shows the edges of the cells as well. In ParaView itself (View > Python Shell) the
pipeline stays open to play with:

    import sys; sys.argv = ["", "out"]
    exec(open("examples/paraview/open_surfaces.py").read())
"""
import os
import sys

from paraview.simple import (ColorBy, GetActiveViewOrCreate, GetColorTransferFunction, Render,
                             ResetCamera, SaveScreenshot, Show, XMLPolyDataReader)

# Okabe and Ito's colours, which people with any colour vision can tell apart, lightened.
SURFACE_COLOURS = [(0.45, 0.70, 0.86), (0.93, 0.66, 0.40), (0.45, 0.78, 0.66), (0.89, 0.71, 0.82),
                   (0.66, 0.85, 0.95), (0.95, 0.81, 0.45)]


def open_block(directory, name):
    """A block of the result, or None if nothing is in it."""
    path = os.path.join(directory, "result", name + ".vtp")
    reader = XMLPolyDataReader(registrationName=name, FileName=[path])
    reader.UpdatePipeline()
    return reader if reader.GetDataInformation().GetNumberOfCells() > 0 else None


def paint(display, colour):
    display.ColorArrayName = [None, ""]
    display.AmbientColor = display.DiffuseColor = colour


def show(directory, with_cells):
    view = GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0
    blocks = {name: open_block(directory, name)
              for name in ["cells", "surfaces", "intersection_curves", "points", "unresolved"]}

    if blocks["surfaces"]:
        display = Show(blocks["surfaces"], view)
        ColorBy(display, ("CELLS", "surface"), separate=True)
        last = int(blocks["surfaces"].CellData["surface"].GetRange()[1])
        table = GetColorTransferFunction("surface", display, separate=True)
        table.InterpretValuesAsCategories = 1
        table.Annotations = [text for k in range(last + 1) for text in (str(k), f"surface {k}")]
        table.IndexedColors = [c for k in range(last + 1)
                               for c in SURFACE_COLOURS[k % len(SURFACE_COLOURS)]]
        table.IndexedOpacities = [1.0] * (last + 1)
        display.LookupTable = table
        display.SetScalarBarVisibility(view, False)
        display.Specular = 0.2
    if blocks["intersection_curves"]:
        display = Show(blocks["intersection_curves"], view)
        paint(display, [0.1, 0.1, 0.1])
        display.LineWidth = 4.0
        display.RenderLinesAsTubes = 1
    if blocks["points"]:
        display = Show(blocks["points"], view)
        display.SetRepresentationType("Points")
        paint(display, [0.76, 0.07, 0.12])
        display.PointSize = 14.0
        display.RenderPointsAsSpheres = 1
    if blocks["unresolved"]:
        display = Show(blocks["unresolved"], view)
        display.SetRepresentationType("Surface With Edges")
        paint(display, [0.76, 0.07, 0.12])
    if with_cells:
        display = Show(blocks["cells"], view)
        display.SetRepresentationType("Wireframe")
        paint(display, [0.55, 0.57, 0.6])

    ResetCamera(view)
    view.CameraViewUp = [0.0, 0.0, 1.0]
    focus = list(view.CameraFocalPoint)
    view.CameraPosition = [focus[0] + 6.0, focus[1] - 4.5, focus[2] + 3.5]
    ResetCamera(view)
    Render(view)
    return view


if len(sys.argv) < 2:
    sys.exit("usage: pvpython open_surfaces.py DIRECTORY [PICTURE.png [cells]]")
surfaces_view = show(sys.argv[1], "cells" in sys.argv[3:])
if len(sys.argv) > 2:
    surfaces_view.ViewSize = [1000, 1000]
    SaveScreenshot(sys.argv[2], surfaces_view, ImageResolution=[1000, 1000])

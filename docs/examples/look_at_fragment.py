#!/usr/bin/env python3
"""One fragment of a realization: its numbers from study.h5, beside those of its elements in the fields of `fracas replay --fields DIR`, and a
picture of it in its body, with the ellipsoid of the same second moments.

usage: look_at_fragment.py STUDY/study.h5 POINT/REPLICA DIR [FRAGMENT] [PICTURE.png]

FRAGMENT is a row of the realization's fragments, from 0; without it, the one of the largest mass. h5py and numpy do the numbers, VTK the picture.
"""
import json
import os
import sys

import h5py
import numpy as np


def fragments_of(path, point, replica):
    """Columns of the realization's fragments, in the order of the fields' numbers."""
    with h5py.File(path) as study:
        (row,) = np.flatnonzero((study["realization/point"][:] == point) & (study["realization/replica"][:] == replica))
        begin, end = study["fragment/offset"][row:row + 2]
        return {name: values[begin:end] for name, values in study["fragment"].items() if name != "offset"}


def last_body(folder):
    with open(os.path.join(folder, "body.hdf.series"), encoding="utf-8") as series:
        return os.path.join(folder, json.load(series)["files"][-1]["name"])


def numbers_of(path, fragment):
    """Elements, mass, centre and velocity of a fragment, summed over the nodes of its elements."""
    with h5py.File(path) as file:
        grid = file["VTKHDF"]
        mine = np.flatnonzero(grid["CellData/fragment"][:] == fragment)
        first, corners = grid["Offsets"][:-1][mine], np.diff(grid["Offsets"][:])[0]
        nodes = grid["Connectivity"][:][first[:, None] + np.arange(corners)].ravel()
        mass, place, velocity = (grid[name][:][nodes] for name in ("PointData/mass", "Points", "PointData/velocity"))
        return len(mine), mass.sum(), mass @ place / mass.sum(), mass @ velocity / mass.sum()


def draw(path, fragment, of, picture):
    import vtk

    def actor(data, colour, opacity=1.0, width=1, edges=False):
        mapper = vtk.vtkDataSetMapper()
        mapper.SetInputData(data)
        mapper.ScalarVisibilityOff()
        made = vtk.vtkActor()
        made.SetMapper(mapper)
        look = made.GetProperty()
        look.SetColor(colour)
        look.SetOpacity(opacity)
        look.SetLineWidth(width)
        look.SetEdgeVisibility(edges)
        return made

    reader = vtk.vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    threshold = vtk.vtkThreshold()
    threshold.SetInputConnection(reader.GetOutputPort())
    threshold.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_CELLS, "fragment")
    threshold.SetLowerThreshold(fragment)
    threshold.SetUpperThreshold(fragment)
    threshold.Update()

    ball = vtk.vtkParametricEllipsoid()
    ball.SetXRadius(of["semi_axis_1"])
    ball.SetYRadius(of["semi_axis_2"])
    ball.SetZRadius(max(of["semi_axis_3"], 0.02 * of["semi_axis_1"]))
    source = vtk.vtkParametricFunctionSource()
    source.SetParametricFunction(ball)
    turn = vtk.vtkMatrix4x4()
    for k in range(3):
        for column in range(3):
            turn.SetElement(k, column, of[f"axis_{column + 1}"][k])
        turn.SetElement(k, 3, of["position"][k])
    transform = vtk.vtkTransform()
    transform.SetMatrix(turn)
    placed = vtk.vtkTransformPolyDataFilter()
    placed.SetInputConnection(source.GetOutputPort())
    placed.SetTransform(transform)
    placed.Update()

    scene = vtk.vtkRenderer()
    scene.SetBackground(1, 1, 1)
    scene.AddActor(actor(reader.GetOutput(), (0.80, 0.83, 0.87), 0.45))
    scene.AddActor(actor(threshold.GetOutput(), (0.84, 0.37, 0.0), edges=True))
    scene.AddActor(actor(placed.GetOutput(), (0.0, 0.45, 0.70), 0.18))
    for column in range(3):
        axis = vtk.vtkLineSource()
        step = of[f"semi_axis_{column + 1}"] * of[f"axis_{column + 1}"]
        axis.SetPoint1(*(of["position"] - 1.3 * step))
        axis.SetPoint2(*(of["position"] + 1.3 * step))
        axis.Update()
        scene.AddActor(actor(axis.GetOutput(), (0.0, 0.2, 0.4), width=3))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(1000, 700)
    window.AddRenderer(scene)
    camera, bounds = scene.GetActiveCamera(), threshold.GetOutput().GetBounds()
    middle = np.array(reader.GetOutput().GetCenter())
    toward = of["axis_3"] * (1 if of["axis_3"] @ (of["position"] - middle) >= 0 else -1)  # along the shortest axis, from outside
    camera.SetFocalPoint(*of["position"])
    camera.SetPosition(*(of["position"] + toward))
    camera.SetViewUp(*((0, 1, 0) if abs(toward[2]) > 0.9 else (0, 0, 1)))
    wide = max(bounds[2 * k + 1] - bounds[2 * k] for k in range(3))
    scene.ResetCamera([of["position"][k // 2] + (-0.5 * wide if k % 2 == 0 else 0.5 * wide) for k in range(6)])
    scene.ResetCameraClippingRange()
    window.Render()
    pixels = vtk.vtkWindowToImageFilter()
    pixels.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.SetFileName(picture)
    writer.Write()


def main(path, realization, folder, *rest):
    picture = rest[-1] if rest and rest[-1].endswith(".png") else None
    point, replica = map(int, realization.split("/"))
    columns, body = fragments_of(path, point, replica), last_body(folder)
    chosen = [int(word) for word in rest if word != picture]
    fragment = chosen[0] if chosen else int(np.argmax(columns["mass"]))
    of = {name: values[fragment] for name, values in columns.items()}
    elements, mass, centre, velocity = numbers_of(body, fragment)
    print(f"fragment\t{fragment} of {len(columns['mass'])}")
    print(f"elements\t{of['elements']}\tof the fields\t{elements}")
    print(f"mass [kg]\t{of['mass']:.6g}\tof the fields\t{mass:.6g}")
    print("position [m]\t" + " ".join(f"{x:.4g}" for x in of["position"]) + "\tof the fields\t" + " ".join(f"{x:.4g}" for x in centre))
    print("velocity [m/s]\t" + " ".join(f"{x:.4g}" for x in of["velocity"]) + "\tof the fields\t" + " ".join(f"{x:.4g}" for x in velocity))
    for name, unit in ("volume", "m3"), ("size", "m"), ("extent", "m"), ("crack_area", "m2"):
        print(f"{name} [{unit}]\t{of[name]:.4g}")
    print("semi-axes [m]\t" + " ".join(f"{of[f'semi_axis_{k}']:.4g}" for k in (1, 2, 3)))
    print(f"spin [rad/s]\t{np.linalg.norm(of['spin']):.4g}")
    if picture:
        draw(body, fragment, of, picture)
        print(picture)


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])

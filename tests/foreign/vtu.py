"""Frames of a run in the folder `run` and the mesh `mesh.vtu`, read by meshio and by PyVista, which reads with VTK."""

import csv
import pathlib

import meshio
import numpy
import pyvista


def both(path):
    mesh, grid = meshio.read(path), pyvista.read(path)
    assert numpy.array_equal(mesh.points, grid.points), path
    assert sum(len(block.data) for block in mesh.cells) == grid.n_cells, path
    assert set(mesh.point_data) == set(grid.point_data) and len(mesh.cell_data) == len(grid.cell_data), path
    for name, values in mesh.point_data.items():
        assert numpy.array_equal(values, grid.point_data[name]), (path, name)
    for name, values in mesh.cell_data.items():
        assert numpy.array_equal(numpy.concatenate(values), grid.cell_data[name]), (path, name)
    assert set(mesh.field_data) == set(grid.field_data), path
    return mesh


frames = [both(path) for path in sorted(pathlib.Path("run/frames").glob("*.vtu"))]
rows = list(csv.DictReader(open("run/history.csv")))
last, height = frames[-1], float(rows[-1]["centre_top_dz_mm"])
highest = last.point_data["displacement_mm"][:, 2].max()
assert len(frames) > 3 and abs(highest - height) < 0.05, (highest, height)
assert last.field_data["chamber_kPa air"] == 2.0 and "part_id top" in last.field_data, last.field_data
start, printed = both(pathlib.Path("mesh.vtu")), open("mesh.txt").read()
assert f"{len(last.points)} nodes" in printed and len(start.points) == len(last.points), printed
print(f"{len(frames)} frames of {len(last.points)} points in meshio {meshio.__version__} and PyVista {pyvista.__version__}:")
print(f"highest point {highest:.3f} mm, probe of the run {height:.3f} mm")

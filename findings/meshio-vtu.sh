#!/usr/bin/env bash
# meshio 5.3.5: `meshio.read` of a VTK file with texts in its field data ends the Python process (SystemExit), so that `except Exception`
# does not catch it. The VTK file formats have the type `String`, and VTK writes and reads such arrays. Numbers there are read.
#
#   field data     VTK 9.7.2     meshio 5.3.5
#   Float64        read          read
#   String         read          SystemExit
#
# Way round it: numbers whose names have the text. Ends with 1 where meshio answers otherwise.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -m venv env 2> /dev/null || { echo "skipped: python3 has no venv"; exit 0; }
env/bin/pip install --quiet meshio==5.3.5 vtk==9.7.2 || { echo "skipped: pip does not reach its registry"; exit 0; }
cat > ask.py << 'END'
import meshio
import vtk


def written(name, kind):
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    for place in [(0, 0, 0), (1, 0, 0), (0, 1, 0)]:
        points.InsertNextPoint(place)
    grid.SetPoints(points)
    grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, [0, 1, 2])
    array = kind()
    array.SetName("about")
    array.InsertNextValue("text" if kind is vtk.vtkStringArray else 1.5)
    grid.GetFieldData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(name)
    writer.SetDataModeToBinary()
    writer.SetInputData(grid)
    writer.Write()
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput().GetFieldData().GetAbstractArray("about").GetNumberOfValues()


found = []
for name, kind in [("numbers.vtu", vtk.vtkDoubleArray), ("texts.vtu", vtk.vtkStringArray)]:
    by_vtk = written(name, kind)
    try:
        meshio.read(name)
        by_meshio = "read"
    except (Exception, SystemExit) as fault:
        by_meshio = f"{type(fault).__name__}"
    found.append((by_vtk, by_meshio))
print("values in VTK, answer of meshio:", found)
assert found[0] == (1, "read") and found[1] == (1, "SystemExit"), "meshio answers otherwise: this finding is out of date"
END
env/bin/python ask.py

"""Reads run.pvd and every frame it names with VTK, as ParaView does, and refuses what is empty or not finite.

    python3 tests/read_pvd.py FOLDER/run.pvd
"""

import math
import os
import sys
import xml.etree.ElementTree as xml

import vtk


def main(path):
    times, names = [], []
    for entry in xml.parse(path).getroot().iter("DataSet"):
        times.append(float(entry.get("timestep")))
        names.append(os.path.join(os.path.dirname(path), entry.get("file")))
    assert names, "the series names no frame"
    assert all(a < b for a, b in zip(times, times[1:])), "the times do not rise"
    shape, places = None, []
    for name in names:
        frame = read(name)
        found = (frame.GetNumberOfPoints(), frame.GetNumberOfCells(), arrays(frame))
        assert shape in (None, found), f"{name}: {found} after {shape}"
        assert found[0] > 0 and found[1] > 0 and found[2], f"{name} is empty"
        shape = found
        check_finite(name, frame)
        places.append(frame.GetBounds())
        check_parts(name, frame)
    assert places[0] != places[-1], "nothing moves"
    print(f"{len(names)} frames of {shape[0]} points and {shape[1]} cells from t = {times[0]} to {times[-1]} s")
    print("arrays:", ", ".join(shape[2]))


def read(name):
    assert os.path.exists(name), f"{name} is not there"
    faults = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.AddObserver("ErrorEvent", lambda *_: faults.append(name))
    reader.Update()
    assert not faults, f"VTK does not understand {name}"
    return reader.GetOutput()


def arrays(frame):
    return tuple(
        data.GetArrayName(i)
        for data in (frame.GetPointData(), frame.GetCellData())
        for i in range(data.GetNumberOfArrays())
    )


def check_parts(name, frame):
    field = frame.GetFieldData()
    names = [field.GetArrayName(i) for i in range(field.GetNumberOfArrays())]
    parts = [array for array in names if array.startswith("part_id ")]
    numbers = frame.GetCellData().GetArray("part_id").GetRange()
    assert len(parts) == 1 + numbers[1] and "part_id " not in parts, f"{name}: parts {parts}"


def check_finite(name, frame):
    assert all(math.isfinite(b) for b in frame.GetBounds()), f"{name}: positions are not finite"
    for data in (frame.GetPointData(), frame.GetCellData()):
        for i in range(data.GetNumberOfArrays()):
            array = data.GetArray(i)
            for k in range(array.GetNumberOfComponents()):
                assert all(math.isfinite(v) for v in array.GetRange(k)), f"{name}: {data.GetArrayName(i)}"


if __name__ == "__main__":
    main(sys.argv[1])

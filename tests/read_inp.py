"""Reads an exported robot with meshio, another reader of Abaqus files, and prints what it found in there.

    python3 tests/read_inp.py robot.inp
"""

import json
import sys

import meshio
import numpy


def main(path):
    mesh = meshio.read(path)
    shells = [block for block in mesh.cells if block.type in ("triangle", "quad")]
    areas = {}
    for name, elements in mesh.cell_sets.items():
        own = [numbers for numbers in elements if numbers is not None]
        areas[name] = sum(area(mesh.points, block.data[rows]) for block, rows in zip(mesh.cells, own))
    print(json.dumps({
        "nodes": len(mesh.points),
        "elements": sum(len(block.data) for block in shells),
        "length_mm": 1e3 * float(numpy.ptp(mesh.points[:, 0])),
        "area_mm2": 1e6 * sum(area(mesh.points, block.data) for block in shells),
        "of_parts_mm2": {name: 1e6 * float(a) for name, a in areas.items()},
        "node_sets": sorted(mesh.point_sets),
    }))


def area(points, corners):
    """Of flat elements, by their diagonals or sides."""
    if len(corners) == 0:
        return 0.0
    p = points[corners]
    one, other = (p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]) if p.shape[1] == 3 else (p[:, 2] - p[:, 0], p[:, 3] - p[:, 1])
    return float(0.5 * numpy.linalg.norm(numpy.cross(one, other), axis=1).sum())


if __name__ == "__main__":
    main(sys.argv[1])

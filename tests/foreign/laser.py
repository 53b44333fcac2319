"""DXF and SVG patterns of a folder, compared with the lists of pieces in the JSON of the same names."""

import collections
import json
import pathlib
import xml.etree.ElementTree as xml

import ezdxf
import svgelements

LAYERS = {"weld": "WELD", "lap": "LAP", "tape": "TAPE", "glue": "GLUE", "place": "PLACE", "valley": "FOLD_VALLEY",
          "mountain": "FOLD_MOUNTAIN", "marker": "MARKER"}


def work(pieces):
    """Lines by layer that a machine has to draw; a marker is a cross of two, the arrow of the warp has four."""
    count = collections.Counter(CUT=len(pieces), WARP=4 * len(pieces))
    for mark in (mark for piece in pieces for mark in piece["marks"]):
        count[LAYERS[mark["kind"]]] += 2 if mark["kind"] == "marker" else 1
    return count


for path in sorted(pathlib.Path(".").glob("*.dxf")):
    pieces = json.loads(path.with_suffix(".json").read_text())["pieces"]
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().errors, path
    assert drawing.header["$INSUNITS"] == 4 and drawing.header["$MEASUREMENT"] == 1, path
    lines = drawing.modelspace().query("POLYLINE")
    found = collections.Counter(line.dxf.layer for line in lines)
    scale_bar = found.pop("INFO")
    assert found == work(pieces) and scale_bar == 1, (path, found, work(pieces))
    assert all(text.dxf.layer == "INFO" and "?" not in text.dxf.text for text in drawing.modelspace().query("TEXT")), path
    colours = [drawing.layers.get(name).color for name in [*found, "INFO"]]
    assert len(set(colours)) == len(colours), (path, colours)
    cut = [[point for point in line.points()] for line in lines if line.dxf.layer == "CUT"]
    widths = sorted(max(p.x for p in c) - min(p.x for p in c) for c in cut)
    expected = sorted(p["x_mm"][1] - p["x_mm"][0] + 0.2 for p in pieces)
    assert all(abs(a - b) < 1e-3 for a, b in zip(widths, expected)), (path, widths, expected)

    tags = collections.Counter(element.tag.split("}")[-1] for element in xml.parse(path.with_suffix(".svg")).iter())
    assert tags["svg"] == 1 and not tags["polyline"] and not tags["polygon"], tags
    shapes = [s for s in svgelements.SVG.parse(path.with_suffix(".svg")).elements() if isinstance(s, svgelements.Path)]
    by_colour = collections.Counter(str(shape.stroke) for shape in shapes)
    assert sorted(by_colour.values()) == sorted([*found.values(), 1]), (path, by_colour)
    print(f"{path.stem}: {dict(found)}, {len(set(colours))} colours, cut {widths[-1]:.2f} mm with a kerf of 0.2 mm")

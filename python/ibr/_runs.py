"""Finite element runs and their frames."""

from __future__ import annotations

import base64
import html
import os
import re
import tempfile
import zlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _ibr
from ._calls import Progress, Robot
from ._ibr import Scenario
from ._results import Column, Result, Table, columns_of

if TYPE_CHECKING:
    from ._records import Reading, SimulateKeys
else:
    SimulateKeys = object

_TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "UInt8": "u1", "Int8": "i1"}


class Frame:
    """The deformed robot at one moment.

    `time_s`; `points` (mm), shape (n, 3); `quads` and `triangles`, rows of point numbers; `faces`: all as triangles, for
    matplotlib and meshes; `pressures_kpa` by chamber; `arrays`: everything in the file by its name there.
    """

    def __init__(self, path: Union[str, "os.PathLike[str]"]):
        self.path = Path(path)
        self.arrays = _arrays(self.path)
        self.time_s = float(self.arrays["TimeValue"][0])
        self.points = self.arrays["Points"]
        ends, corners = self.arrays["offsets"], self.arrays["connectivity"]
        sizes = np.diff(ends, prepend=0)
        self.triangles, self.quads = (corners[(ends[sizes == n, None] - n) + np.arange(n)] for n in (3, 4))

    @property
    def faces(self) -> Column:
        """Every element as triangles, shape (m, 3); a quad is two."""
        return np.concatenate([self.triangles, self.quads[:, [0, 1, 2]], self.quads[:, [0, 2, 3]]])

    @property
    def pressures_kpa(self) -> Dict[str, float]:
        """Gauge pressure by chamber (kPa)."""
        start = "chamber_kPa "
        return {name[len(start) :]: float(kpa[0]) for name, kpa in self.arrays.items() if name.startswith(start)}

    def __repr__(self) -> str:
        cells = len(self.triangles) + len(self.quads)
        return f"Frame(t = {self.time_s:.4f} s: {len(self.points)} points, {cells} elements)"


def _arrays(path: Path) -> Dict[str, Column]:
    """The arrays of a frame as the engine writes it: XML with blocks in base64, compressed by zlib."""
    found = {}
    for tag, text in re.findall(r"<DataArray ([^>]*)>([^<]*)<", path.read_text("utf-8")):
        about = {name: html.unescape(value) for name, value in re.findall(r'(\w+)="([^"]*)"', tag)}
        # Before the block are 32 bytes of sizes, in 44 letters.
        values = np.frombuffer(zlib.decompress(base64.b64decode(text[44:])), _TYPES[about["type"]])
        width = int(about.get("NumberOfComponents", 1))
        found[about["Name"]] = values.reshape(-1, width) if width > 1 else values
    return found


class Run(Result, SimulateKeys):
    """A finite element run: the numbers of its summary.json are attributes, its files stand in `folder`."""

    def __init__(self, answer: _ibr.Answer, folder: Path, kept: Any = None):
        super().__init__(answer)
        self.folder = folder
        self._kept = kept

    @staticmethod
    def read(folder: Union[str, "os.PathLike[str]"]) -> "Run":
        """The complete run in a folder."""
        return Run(_ibr.read_run(folder), Path(folder))

    @property
    def frames(self) -> List[Frame]:
        """The deformed robot at every output, by time. With PyVista: `pyvista.read(run.frames[-1].path)`."""
        return [Frame(path) for path in sorted((self.folder / "frames").glob("*.vtu"))]

    @property
    def history(self) -> Dict[str, Column]:
        """Energies, pressures and volumes at every output: the columns of history.csv."""
        table = np.genfromtxt(self.folder / "history.csv", delimiter=",", names=True, deletechars="", ndmin=1)
        return {name: table[name] for name in table.dtype.names or ()}

    @property
    def table(self) -> Mapping[str, Column]:
        """Of a robot, a row per hold: `pressure_kpa`, place of the tip (mm) as in `State.tip_mm`, its angle (degrees)."""
        readings: List[Reading] = [] if self.robot is None else self.robot["readings"]
        return columns_of([_row(reading) for reading in readings])

    def plot(self, axes: Any = None) -> Any:
        """Height of the tip over pressure, on axes of matplotlib."""
        from . import _plot

        return _plot.run(self, axes)

    def _repr_html_(self) -> str:
        picture = next((file for file in ("side.png", "picture.png") if (self.folder / file).exists()), None)
        if picture is None:
            return super()._repr_html_()
        png = base64.b64encode((self.folder / picture).read_bytes()).decode()
        return f'{super()._repr_html_()}<img style="max-width:640px" src="data:image/png;base64,{png}">'

    def _headline(self) -> str:
        return str(self).split("\n\n")[0]


def _row(reading: Reading) -> Dict[str, float]:
    along_m, moved_m = reading["stations_m"][-1], reading["moved_m"][-1]
    return {
        "pressure_kpa": reading["actuator_pa"] * 1e-3,
        "tip_x_mm": (along_m + moved_m[0]) * 1e3,
        "tip_y_mm": moved_m[1] * 1e3,
        "angle_deg": float(np.degrees(reading["tip_angle_rad"])),
    }


def simulate(
    source: Robot,
    folder: Union[str, "os.PathLike[str]", None] = None,
    *,
    changes: Optional[Mapping[str, Any]] = None,
    resume: bool = False,
    force: bool = False,
    end_s: Optional[float] = None,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Run:
    """Runs finite elements.

    `source`: a robot's scenario or a case, or its name (`python -m ibr list cases`). `folder`: where its files go; left out,
    a temporary one that goes with the result. `changes`: keys of `[fem]` (docs/scenario.md), as
    `{"actuator_mesh_mm": 6, "pressures_kpa": [10, 20]}`. `resume`: go on with an interrupted run. `force`: replace a run.
    `end_s`: simulated time. `threads`: 0 is one per core. `progress`: told what is done and which share of all (0 to 1).

    Ctrl-C ends it with a KeyboardInterrupt, and so does what `progress` raises; a checkpoint in `folder` is kept then.
    """
    kept: Optional[tempfile.TemporaryDirectory[str]] = None
    if folder is None:
        kept = tempfile.TemporaryDirectory(prefix="ibr-run-")
        folder = os.path.join(kept.name, "run")
    given = source if isinstance(source, Scenario) else os.fspath(source)
    answer = _ibr.simulate(given, folder, dict(changes or {}), resume, force, end_s, threads, progress)
    return Run(answer, Path(folder), kept)


def sweep(
    study: Union[str, "os.PathLike[str]"],
    folder: Union[str, "os.PathLike[str]", None] = None,
    *,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Table:
    """Many cases of one robot (docs/sweep.md): a dict of columns, with `to_pandas()` and `to_polars()`; a row per case and engine.

    `study`: the path of a study, or its text in TOML. `folder`: where what is computed is kept, so that the same call goes on
    after Ctrl-C and computes nothing twice; left out, nothing is kept. `threads`: 0 is one per core.
    """
    with tempfile.TemporaryDirectory(prefix="ibr-sweep-") as kept:
        return Table(_ibr.sweep(os.fspath(study), os.fspath(folder or kept), threads, progress))

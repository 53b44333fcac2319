"""What is made of a robot or of a fabric: designs, sewing patterns, laws of fabrics; and what there is to choose from."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path as Folder
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Optional, Sequence, Union

from . import _ibr
from ._calls import Progress, Robot, _robot
from ._ibr import Scenario
from ._results import Column, Path, Result, columns_of, save_text

if TYPE_CHECKING:
    from ._records import CharacterizeKeys, DesignKeys, Effect, NamedText, PatternKeys, SetInfo
else:
    CharacterizeKeys = DesignKeys = PatternKeys = object


class Design(Result, DesignKeys):
    """A robot for a target shape: `scenario`, whether the wish is `reached`, `misses` part by part in `table`.

    `chosen`: values of the keys that were free. `p_act_channels_kpa`, `p_body_kpa`: its pressures.
    """

    def __init__(self, answer: Any, scenario: Scenario, picture: str):
        super().__init__(answer)
        #: The robot.
        self.scenario = scenario
        self._picture = picture

    @property
    def table(self) -> Mapping[str, Column]:
        """The wish part by part, and how far it is missed (mm)."""
        return columns_of(self.misses)

    def pictures(self) -> Dict[str, str]:
        """The design over the wish, SVG by name."""
        return {"design": self._picture} if self._picture else {}

    _shown = ("design",)

    def _line(self) -> str:
        chosen = ", ".join(f"{value['key']} = {value['value']}" for value in self.chosen)
        return f"{'reached' if self.reached else 'not reached'}: {chosen}"


class Pattern(Result, PatternKeys):
    """A sewing pattern, true to size. `svg` is the drawing; `pieces` in `table`, sizes in mm."""

    def __init__(self, answer: Any, svg: str, dxf: str):
        super().__init__(answer)
        #: The drawing as SVG, in mm.
        self.svg = svg
        #: The drawing as DXF, in mm.
        self.dxf = dxf

    @property
    def table(self) -> Mapping[str, Column]:
        """The pieces to cut."""
        return columns_of(self.pieces)

    def save(self, path: Path, force: bool = False) -> None:
        """Writes the drawing as .svg or .dxf; a file that was not written here is kept unless `force`."""
        is_dxf = os.fspath(path).lower().endswith(".dxf")
        save_text(self.dxf if is_dxf else self.svg, path, force)

    def _repr_html_(self) -> str:
        return self.svg

    def _line(self) -> str:
        return f"{len(self.pieces)} pieces, welds of {self.weld_mm:g} mm"


class Fabric(Result, CharacterizeKeys):
    """A fabric from tensile tests: `quantities` with their intervals in `table`, `fabric_toml` for cases."""

    @property
    def table(self) -> Mapping[str, Column]:
        """Means over specimens."""
        return columns_of(self.quantities)

    def _line(self) -> str:
        return f"{len(self.specimens)} specimens, {len(self.quantities)} quantities"


def _text(folder: Folder, name: str) -> str:
    file = folder / name
    return file.read_text("utf-8") if file.exists() else ""


def design(
    wish: Path,
    *,
    check: bool = True,
    correct: int = 0,
    threads: int = 0,
    progress: Optional[Progress] = None,
) -> Design:
    """The robot for a target shape (docs/design.md).

    `wish`: the path of a wish, or its text in TOML. `check`: one finite element run of the answer. `correct`: so many further designs at
    most, each corrected by finite elements. `threads`: 0 is one per core. `progress`: as in `diagnose`.
    """
    with tempfile.TemporaryDirectory(prefix="ibr-design-") as kept:
        folder, source = Folder(kept) / "design", os.fspath(wish)
        if "\n" in source:
            source = os.path.join(kept, "wish.toml")
            save_text(os.fspath(wish), source)
        typed = ["design", source, f"--out={folder}", f"--threads={threads}"]
        typed += [f"--correct={correct}"] if correct else [] if check else ["--no-check"]
        answer = _ibr.ask(typed, progress)
        picture = next(iter(sorted(folder.glob("*.svg"), key=lambda file: file.name == "pattern.svg")), None)
        return Design(answer, Scenario.from_toml(_text(folder, "design.toml")), _text(folder, picture.name if picture else ""))


def pattern(
    scenario: Robot, *, weld_mm: Optional[float] = None, allowance_mm: float = 10, kerf_mm: float = 0
) -> Pattern:
    """The sewing pattern of a robot.

    `weld_mm`: width of the welds, else that of the scenario's `weld_width`, else 3. `allowance_mm`: fabric beyond welds and ends.
    `kerf_mm`: width that a cutter removes.
    """
    robot = _robot(scenario)
    with tempfile.TemporaryDirectory(prefix="ibr-pattern-") as kept:
        source, drawn = Folder(kept) / "robot.toml", [Folder(kept) / name for name in ("pattern.svg", "pattern.dxf")]
        source.write_text(robot.text, "utf-8")
        typed = ["pattern", str(source), f"--allowance={allowance_mm}mm", f"--kerf={kerf_mm}mm"]
        typed += [] if weld_mm is None else [f"--weld={weld_mm}mm"]
        answers = [_ibr.ask([*typed, f"--out={file}"]) for file in drawn]
        found = Pattern(answers[0], *[file.read_text("utf-8") for file in drawn])
        found.scenario, found.written = robot.source, []
        return found


def characterize(files: Union[Path, Sequence[Path]], **options: Any) -> Fabric:
    """The law of a fabric from tensile tests (docs/characterize.md).

    `files`: one per specimen. `options`: those of `python -m ibr characterize --help` with units as there and `_` for `-`:
    `characterize(files, width="25mm", length="100mm", name="mine")`.
    """
    typed = [os.fspath(file) for file in ([files] if isinstance(files, (str, os.PathLike)) else files)]
    for option, value in options.items():
        typed.append(f"--{option.replace('_', '-')}" + ("" if value is True else f"={value}"))
    return Fabric(_ibr.ask(["characterize", *typed]))


def _listed(what: str) -> Any:
    return Result(_ibr.ask(["list", what])).to_dict()


def effects() -> List[Effect]:
    """Every physical effect of the catalogue: name, sentence, formula, parameters with units and bounds."""
    found: List[Effect] = _listed("effects")["effects"]
    return found


def robots() -> List[NamedText]:
    """Every robot that `Scenario.named` takes by name."""
    found: List[NamedText] = _listed("robots")["robots"]
    return found


def datasets() -> List[SetInfo]:
    """The embedded data that `data` takes by name."""
    found: List[SetInfo] = Result(_ibr.ask(["data", "list"])).to_dict()["datasets"]
    return found

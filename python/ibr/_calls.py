"""The session: measurements, how far off a model is, what is missing, a better model, other data."""

from __future__ import annotations

import os
from decimal import Decimal
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _ibr
from ._foreign import Predictions, bases_of
from ._ibr import Data, Error, Scenario
from ._results import Column, Path, Result, columns_of, save_text

if TYPE_CHECKING:
    from ._records import AddKeys, CompareKeys, DiagnoseKeys, LadderKeys, ValidateKeys
else:
    AddKeys = CompareKeys = DiagnoseKeys = LadderKeys = ValidateKeys = object

Robot = Union[Scenario, Path]
Measured = Any
Progress = Callable[[str, Optional[float]], object]


def data(source: Measured, *, name: str = "frame", about: Optional[Path] = None) -> Data:
    """Measurements of one robot.

    `source`: an embedded set (`python -m ibr data list`), a CSV file, a folder with markers.csv and about.toml, or a table:
    a pandas or polars frame, a pyarrow table or a dict of columns named as those of markers.csv (run, actuator, t_s,
    p_body_kpa, p_act_kpa, phase, marker, x_mm, y_mm and, if known, z_mm, s_mm, p_act_1_kpa; other units by suffix). Faults of a table named
    `name` count lines as its CSV would: the first row is line 2.
    `about`: of a table, the text or the path of its about.toml.
    """
    if isinstance(source, Data):
        return source
    if isinstance(source, (str, os.PathLike)):
        return Data.read(os.fspath(source))
    return Data.of_columns(_columns(source), name, None if about is None else os.fspath(about))


def _columns(source: Any) -> List[Any]:
    return [(label, _column(label, source[label])) for label in _labels(source)]


def _labels(table: Any) -> List[str]:
    """Names of columns: of pyarrow, of pandas and polars, of a dict."""
    for attribute in ("column_names", "columns"):
        names = getattr(table, attribute, None)
        if names is not None and not callable(names):
            return [str(name) for name in names]
    return [str(name) for name in table]


def _column(label: str, values: Any) -> Any:
    """Numbers as an array of float64 or int64, everything else as texts; an empty cell is NaN or ""."""
    array: NDArray[Any] = np.atleast_1d(np.asarray(values))
    if array.ndim > 1:
        raise Error(f"column {label} has the shape {array.shape}: a column is one value a row")
    if array.dtype.kind == "f":
        return array.astype(np.float64)
    if array.dtype.kind in "iu":
        return array.astype(np.int64)
    cells = array.tolist()
    empty = [value is None or str(value) in ("<NA>", "nan") for value in cells]
    # Decimals, and numbers of pandas and polars with empty cells.
    if all(is_empty or isinstance(value, (int, float, Decimal)) for value, is_empty in zip(cells, empty)) and not all(empty):
        return np.array([np.nan if is_empty else float(value) for value, is_empty in zip(cells, empty)])
    return ["" if is_empty else str(value) for value, is_empty in zip(cells, empty)]


def import_tracks(files: Union[Path, Sequence[Path]], **options: Any) -> Data:
    """Files of a tracking program (DeepLabCut, SLEAP, Motive, Tracker, Kinovea, TrackMate, plain tables) as measurements.

    `files`: one per run. `options`: those of `python -m ibr data import --help`, with units as there and `_` for `-`:
    `import_tracks(["run1.csv"], pressure="log.csv", fps=30, scale="3.1px/mm", base="212,540", actuator="epam")`.
    What was assumed stands in `told`, the beginning of a description in `about_toml`.
    """
    typed = [os.fspath(file) for file in ([files] if isinstance(files, (str, os.PathLike)) else files)]
    for option, value in options.items():
        for one in value if isinstance(value, (list, tuple)) else [value]:
            typed.append(f"--{option.replace('_', '-')}={one}")
    return _ibr.import_tracks(typed)


class Comparison(Result, CompareKeys):
    """A scenario compared with measurements.

    `error_mm`: error beyond noise, root mean square over markers and holds (mm); of all, the noise being unknown, with one run.
    `noise_mm`: noise of the mean of the runs (mm), None if unknown. `where_it_fails`: in plain language.
    `table`: a row per model, hold and marker, measured and predicted, with z where the data have it.
    """

    _shown = ("shapes", "shapes_z", "residual_map", "pressure", "ladder")

    @property
    def names(self) -> List[str]:
        """The models: the scenario as given, then with one effect after the other."""
        return [model["label"] for model in self.models]

    @property
    def error_mm(self) -> float:
        """Error beyond noise of the scenario as given (mm)."""
        beyond = self.overall["systematic_mm"]
        return self.overall["rmse_mm"] if beyond is None else beyond

    @property
    def noise_mm(self) -> Optional[float]:
        """Noise of the mean (mm)."""
        return self.overall["noise_floor_mm"]

    @property
    def verdict(self) -> str:
        """Where the model fails first, in a sentence."""
        return self.where_it_fails[0]["sentence"]

    def plot(self, axes: Any = None) -> Any:
        """Measured and predicted markers on axes of matplotlib; of data with z from two sides, on two axes."""
        from . import _plot

        return _plot.comparison(self, axes)

    def _headline(self) -> str:
        return f"{self.scenario} compared with {self.data}: {self.error_mm:.2f} mm beyond noise\n{self.verdict}"


class Diagnosis(Result, DiagnoseKeys):
    """What is missing in a model.

    `verdict`: "none", "effect" or "out_of_catalog"; None where the data allow none. `names`: effects that
    these data cannot tell apart, best first. `summary`: the story in sentences. `table`: every effect, best first.
    """

    _shown = ("missing_moment", "ranking", "before_after", "residuals_before")

    @property
    def names(self) -> List[str]:
        """What it could be, best first; two effects together are written `a + b`."""
        return self.indistinguishable

    @property
    def table(self) -> Mapping[str, Column]:
        """Every effect, best first."""
        return columns_of(self.ranked)

    def correction(self, pressure_kpa: Any, body_pressure_kpa: Optional[float] = None) -> np.ndarray:
        """What the answer adds to the predictions of `base`: displacements of the markers (mm) at one actuator pressure (kPa),
        shape (markers, 2), or at N, shape (N, markers, 2). `body_pressure_kpa`: the scenario's if left out."""
        act = np.atleast_1d(np.asarray(pressure_kpa, dtype=float))
        robot, _ = self._on()
        body = np.full(act.shape, robot.body_pressure_kpa if body_pressure_kpa is None else body_pressure_kpa)
        moved = self._correction().at(act, body)
        return moved[0] if np.ndim(pressure_kpa) == 0 else moved

    def save_correction(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes the correction as a table (p_body_kpa, p_act_kpa, marker, dx_mm, dy_mm) to a file that is not there yet."""
        text = self._correction().text()
        with open(path, "x", encoding="utf-8") as file:
            file.write(text)

    def _on(self) -> Any:
        found = self.__dict__.get("_base")
        if found is None:
            raise Error("this diagnosis has no base of another simulator: diagnose(scenario, data, base=predictions)")
        return found

    def _correction(self) -> _ibr.Correction:
        robot, measured = self._on()
        return _ibr.Correction.of(robot, self._answer, measured)

    def plot(self, axes: Any = None) -> Any:
        """Error that is left with every effect, on axes of matplotlib."""
        from . import _plot

        return _plot.diagnosis(self, axes)

    def _headline(self) -> str:
        return "\n".join(self.summary)

    def _line(self) -> str:
        return f"{self.dataset}: verdict {self.verdict}" + (f", {' or '.join(self.names)}" if self.names else "")


class Extension(Result, AddKeys):
    """A scenario with one more effect: `scenario`, `effects`, errors on the way in `table`."""

    @property
    def scenario(self) -> Scenario:
        """The new scenario; comments of the old one stay."""
        made: Scenario = self._answer.scenarios()[0][1]
        return made

    @property
    def names(self) -> List[str]:
        """Effects that were added."""
        return [effect["effect"] for effect in self.effects]

    @property
    def table(self) -> Mapping[str, Column]:
        """Errors on the way, the scenario as given first."""
        return columns_of(self.rungs)

    def save(self, path: Path, force: bool = False) -> None:
        """Writes the new scenario, as `Scenario.save`."""
        save_text(self.scenario.text, path, force)

    def _line(self) -> str:
        return f"{self.scenario_file} with {', '.join(self.names)}"


class Ladder(Result, LadderKeys):
    """One effect after the other, as long as a diagnosis finds one: `steps`, errors on the way in `table`, why it `stopped`."""

    @property
    def scenarios(self) -> Dict[str, Scenario]:
        """The scenario after every step, by the name of its file."""
        return dict(self._answer.scenarios())

    @property
    def names(self) -> List[str]:
        """Effects that were added, in their order."""
        return [effect["effect"] for step in self.steps for effect in step["added"]]

    @property
    def table(self) -> Mapping[str, Column]:
        """Errors on the way, the scenario as given first."""
        return columns_of(self.rungs)

    def _line(self) -> str:
        return f"{self.scenario_file} with {', '.join(self.names) or 'nothing more'}; {self.stopped}"


class Validation(Result, ValidateKeys):
    """A scenario with and without what was added to it, on other data; `table` has a row for each."""

    @property
    def verdict(self) -> str:
        """Of the first data: see docs/json.md."""
        return self.datasets[0]["verdict"]

    def _line(self) -> str:
        return ", ".join(f"{one['data']}: {one['verdict']}" for one in self.datasets)

    @property
    def names(self) -> List[str]:
        """Effects that were judged."""
        return self.added

    @property
    def table(self) -> Mapping[str, Column]:
        """A row for each of the data."""
        before = {f"before_{key}": column for key, column in columns_of([d["before"] for d in self.datasets]).items()}
        after = {f"after_{key}": column for key, column in columns_of([d["after"] for d in self.datasets]).items()}
        return {**columns_of(self.datasets), **before, **after}


def _robot(source: Robot) -> Scenario:
    return source if isinstance(source, Scenario) else Scenario.from_toml(os.fspath(source))


def _all(source: Measured, also: Sequence[Measured]) -> List[Data]:
    return [data(one) for one in (source, *also)]


def _asked(
    sigma_mm: Optional[float] = None,
    tolerance_mm: Optional[float] = None,
    refit: bool = False,
    keep_bending: bool = False,
    without: Sequence[str] = (),
) -> Mapping[str, Any]:
    return {
        "sigma_mm": sigma_mm,
        "tolerance_mm": tolerance_mm,
        "refit": refit,
        "keep_bending": keep_bending,
        "without": list(without),
    }


def compare(
    scenario: Robot,
    measured: Measured,
    *,
    effects: Sequence[str] = (),
    sigma_mm: Optional[float] = None,
    calibrate: Optional[str] = None,
) -> Comparison:
    """Compares a scenario with measurements: how far off, and where.

    `effects`: further models, each with one more effect, as `"name"` or `"name:key=value"`. `sigma_mm`: camera noise of one
    coordinate, for a single run. `calibrate`: also fit "bending" or "body-pressure".
    """
    return Comparison(_ibr.compare(_robot(scenario), data(measured), list(effects), sigma_mm, calibrate))


def diagnose(
    scenario: Robot,
    measured: Measured,
    *,
    also: Sequence[Measured] = (),
    sigma_mm: Optional[float] = None,
    tolerance_mm: Optional[float] = None,
    refit: bool = False,
    keep_bending: bool = False,
    without: Sequence[str] = (),
    base: Optional[Predictions] = None,
    progress: Optional[Progress] = None,
) -> Diagnosis:
    """Which physical effect is missing, what cannot be told apart, what to measure next.

    `also`: further data of the same robot, fitted along. `tolerance_mm`: differences up to this are good enough. `refit`: fit
    the scenario's own effects along. `keep_bending`: its bending stiffness was measured. `without`: effects that cannot be
    here. `progress`: told what is done and which share of all (0 to 1, or None).

    `base`: predictions of another simulator, whose missing effect is then searched. A function of the actuator pressure (kPa), or
    of actuator and body pressure, that returns the places of the markers (mm), shape (markers, 2); or a table or CSV file with
    marker, p_act_kpa (or t_s), x_mm, y_mm; one for each set of data. Effects are changes, computed with the scenario.
    """
    asked = _asked(sigma_mm, tolerance_mm, refit, keep_bending, without)
    robot, sets = _robot(scenario), _all(measured, also)
    if base is None:
        return Diagnosis(_ibr.diagnose(robot, sets, asked, progress))
    sets = [one.under(robot, measured) for one, measured in zip(bases_of(base, sets, _columns), sets)]
    found = Diagnosis(_ibr.diagnose(robot, sets, asked, progress))
    found.__dict__["_base"] = robot, sets
    return found


def extend(scenario: Robot, diagnosis: Diagnosis) -> Extension:
    """The scenario with what its diagnosis adds: an effect, or the law that it learned."""
    if not isinstance(diagnosis._answer, _ibr.Answer):
        raise Error("this diagnosis came from another process\nhelp: extend there, and bring back the scenario, or use ibr.add()")
    return Extension(_ibr.extend(_robot(scenario), diagnosis._answer))


def add(
    scenario: Robot,
    effect: str,
    measured: Optional[Measured] = None,
    *,
    also: Sequence[Measured] = (),
    sigma_mm: Optional[float] = None,
    keep_bending: bool = False,
    without: Sequence[str] = (),
    progress: Optional[Progress] = None,
) -> Extension:
    """The scenario with one more effect.

    `effect`: "best" (what a diagnosis adds), "learned" (a law learned from the data), a name (fitted on data; without data
    its typical value), "name=value" or "name:key=value". The other arguments are those of `diagnose`.
    """
    all_data = [] if measured is None else _all(measured, also)
    asked = _asked(sigma_mm=sigma_mm, keep_bending=keep_bending, without=without)
    return Extension(_ibr.add(_robot(scenario), effect, all_data, asked, progress))


def ladder(
    scenario: Robot,
    measured: Measured,
    *,
    also: Sequence[Measured] = (),
    sigma_mm: Optional[float] = None,
    tolerance_mm: Optional[float] = None,
    keep_bending: bool = False,
    without: Sequence[str] = (),
    progress: Optional[Progress] = None,
) -> Ladder:
    """Diagnoses and extends until nothing more is found. The arguments are those of `diagnose`."""
    asked = _asked(sigma_mm, tolerance_mm, False, keep_bending, without)
    return Ladder(_ibr.ladder(_robot(scenario), _all(measured, also), asked, progress))


def validate(
    scenario: Union[Robot, Diagnosis], measured: Measured, *, also: Sequence[Measured] = (), without: Sequence[str] = (),
    sigma_mm: Optional[float] = None, base: Optional[Predictions] = None,
) -> Validation:
    """Does an added effect help on data that it was not fitted to?

    `without`: effects to judge; those that an extension wrote if left out. `base`: predictions of another simulator for these
    data; `scenario` is then the diagnosis of its base, or the file of its correction.
    """
    if base is not None:
        sets = _all(measured, also)
        if isinstance(scenario, Diagnosis):
            name, text = "correction", scenario._correction().text()
        elif isinstance(scenario, Scenario):
            raise Error("with base= the first argument is the diagnosis of that base, or the file of its correction")
        else:
            name, text = os.fspath(scenario), None
        return Validation(_ibr.validate_correction(name, text, sets, bases_of(base, sets, _columns), sigma_mm))
    if isinstance(scenario, Diagnosis):
        raise Error("a diagnosis is validated with base=; otherwise give a scenario, such as ibr.extend(scenario, found).scenario")
    return Validation(_ibr.validate(_robot(scenario), _all(measured, also), list(without), sigma_mm))

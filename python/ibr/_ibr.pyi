"""Native calls. Arrays are numpy float64; pressures kPa, lengths mm, angles degrees, times s."""

from os import PathLike
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._records import PredictedState
from ._states import States

Array = NDArray[np.float64]
Progress = Callable[[str, Optional[float]], object]
Pressure = Union[float, Sequence[float], Array]

VERSION: str

class Error(ValueError):
    """The fault, its place, and what to write instead. `where` is the file and its line or column, `help` what to do; None where
    there is none."""

    where: Optional[str]
    """File and line or column; None where there is none."""
    help: Optional[str]
    """What to do."""

class State:
    """Shape of a robot at one pressure. It pickles, and is equal to a state of an equal robot at the same pressures."""

    @property
    def tip_mm(self) -> Array:
        """Tip of the centre line (mm), x along the undeformed body and y towards the actuator, shape (2,); with strips round the
        body x, y and z, shape (3,)."""
    @property
    def angle_deg(self) -> float:
        """Total bending angle from base to tip (degrees)."""
    @property
    def markers_mm(self) -> Array:
        """Markers as the camera sees them (mm), shape (markers, 2); with strips round the body (markers, 3)."""
    @property
    def curve_mm(self) -> Array:
        """Points of the centre line from base to tip (mm), shape (101, 2); with strips round the body (101, 3)."""
    @property
    def pressure_kpa(self) -> float:
        """Actuator gauge pressure of the first supply channel (kPa)."""
    @property
    def channels_kpa(self) -> Array:
        """Actuator gauge pressure of every supply channel (kPa), shape (4,)."""
    @property
    def body_pressure_kpa(self) -> float:
        """Gauge pressure of the body (kPa)."""
    @property
    def warnings(self) -> List[str]:
        """What to know before believing it: beyond a limit of the actuator, a body that would fold."""
    def to_json(self) -> str:
        """One state of `ibr predict --json`: curvatures, slopes, energy ledger."""
    def to_dict(self) -> PredictedState:
        """The same as a dictionary: keys and units are in docs/json.md."""
    def plot(self, axes: Any = None) -> Any:
        """The shape on axes of matplotlib; returns the axes. With strips round the body two axes, one for each side."""
    def _repr_html_(self) -> str: ...
    @staticmethod
    def _again(robot: Tuple[str, str], pressures: Tuple[Sequence[float], float]) -> "State": ...

class Scenario:
    """A robot: its body, actuators and physical effects, as a text in TOML. It never changes.

    Pressures are gauge pressures in kPa, lengths mm, angles degrees, times seconds. It pickles, compares and hashes by its text.
    """

    @staticmethod
    def named(name: Union[str, PathLike[str]]) -> "Scenario":
        """A robot or study that comes with the package (`python -m ibr list`), or a TOML file."""
    @staticmethod
    def from_toml(source: Union[str, PathLike[str]]) -> "Scenario":
        """A TOML file, or its text."""
    @staticmethod
    def _parsed(name: str, text: str) -> "Scenario": ...
    def replace(self, **changes: Any) -> "Scenario":
        """The same with values of its text set: `body_radius_mm=45` and `body={"radius_mm": 45}` are both `radius_mm` of
        `[body]`; `effects={"friction": {"moment_nm": 0.2}}` sets or adds an effect. Comments stay.

        Numbers that the text has are set without reading it, in microseconds; predictions then equal the new text's to
        rounding."""
    def without(self, *effects: str) -> "Scenario":
        """The same without these effects; `effects` lists what it has."""
    def bare(self) -> "Scenario":
        """The same without any effect and with a bending stiffness of 0 N m2: the textbook's balance."""
    def save(self, path: Union[str, PathLike[str]], force: bool = False) -> None:
        """Writes the text to a file. A file with another content that this process did not write is kept, with an `ExistsError`,
        unless `force`."""
    @property
    def text(self) -> str:
        """Text of the scenario in TOML, comments kept."""
    @property
    def source(self) -> str:
        """File or name as it was asked for."""
    @property
    def name(self) -> str:
        """Name of the robot in the text."""
    @property
    def actuator(self) -> str:
        """Kind of the actuator, for example `epam`."""
    @property
    def effects(self) -> List[str]:
        """Names of the physical effects in the scenario."""
    @property
    def stations_mm(self) -> List[float]:
        """Stations of the markers along the undeformed body (mm)."""
    @property
    def body_pressure_kpa(self) -> float:
        """Gauge pressure of the body where none is given (kPa)."""
    @property
    def has_history(self) -> bool:
        """Whether a state depends on those before it or on time: friction, creep, leaks."""
    def predict(self, pressure_kpa: Pressure, body_pressure_kpa: Optional[float] = None) -> State:
        """Shape at an actuator gauge pressure (kPa), or at one for every supply channel. A robot with history is held there for 5 s,
        from rest."""
    def batch(self, pressure_kpa: ArrayLike, body_pressure_kpa: Optional[ArrayLike] = None, threads: int = 0) -> States:
        """One state per actuator gauge pressure (kPa), shape (N,) or (N, channels), at one body pressure or N. Runs next to Python on so many
        threads, 0 is one per core. A robot with history is refused: its states have an order."""
    def follow(
        self, t_s: ArrayLike, pressure_kpa: ArrayLike, body_pressure_kpa: Optional[ArrayLike] = None
    ) -> States:
        """A protocol from rest at time 0: pressures change at once after the state before, then time passes until `t_s` (s), shape
        (N,), which does not fall. With `[supply]` in the scenario they arrive late."""
    def inverse(
        self,
        *,
        tip_mm: Optional[float] = None,
        angle_deg: Optional[float] = None,
        body_pressure_kpa: Optional[float] = None,
    ) -> State:
        """The state in which the tip has this height y (mm) or the robot this total bend (degrees); its `pressure_kpa` is the answer."""
    def inverse_interval(
        self, *, tip_mm: Optional[float] = None, angle_deg: Optional[float] = None
    ) -> Optional[List[float]]:
        """Least and largest pressure (kPa) for such a target over the `interval` of every assumed or calibrated number of an effect, at
        the scenario's body pressure; None without such numbers, or where no robot reaches the target."""
    def steer(
        self,
        *,
        tip_mm: Optional[Sequence[float]] = None,
        markers_mm: Optional[Sequence[Sequence[float]]] = None,
        now_kpa: Optional[Pressure] = None,
        change_kpa: Optional[float] = None,
        body_pressure_kpa: Optional[float] = None,
    ) -> Tuple[State, float]:
        """Several channels: the state nearest to a tip (x, y) or to places of all markers, and the distance that is left (mm,
        root mean square over markers). `channels_kpa` of the state is the answer. With `now_kpa` no pressure changes by more
        than `change_kpa`."""
    def jacobian(self, pressure_kpa: Pressure, body_pressure_kpa: Optional[float] = None) -> Array:
        """Change of tip x, tip y (mm/kPa) and angle (deg/kPa) with the pressure of each channel, shape (channels, 3); NaN
        where an actuator is flat."""
    def volumes(self, pressure_kpa: Pressure, body_pressure_kpa: Optional[float] = None) -> Tuple[Array, Array]:
        """Gas of every channel and, last, of the body (cm³), shape (channels + 1,), and its slopes: volume (row) by pressure
        (column, cm³/kPa), shape (channels + 1, channels + 1); NaN by the pressure of a flat actuator."""
    def tip_compliance(self, pressure_kpa: Pressure, body_pressure_kpa: Optional[float] = None) -> Array:
        """Displacement of the tip along x, y, z (row) per force on it (column, mm/N), shape (3, 3), at constant pressures; 0
        across the plane of a planar robot. dF/dy is `1 / compliance[1, 1]`."""

class Data:
    """Measurements of one robot: a dataset by name, file or import."""

    @staticmethod
    def read(name: str) -> "Data":
        """A CSV file, a folder with markers.csv and about.toml, or an embedded set."""
    @staticmethod
    def of_columns(columns: List[Tuple[str, Any]], name: str, about: Optional[str] = None) -> "Data":
        """Columns of the marker table; `ibr.data` makes them of any frame."""
    @property
    def name(self) -> str:
        """Name by which the data were asked for."""
    @property
    def actuator(self) -> str:
        """Kind of the actuator, for example `epam`."""
    @property
    def runs(self) -> List[str]:
        """Labels of the runs, in the order of the table."""
    @property
    def markers(self) -> List[str]:
        """Labels of the markers, in the order of the table."""
    @property
    def told(self) -> List[str]:
        """What reading or import assumed, in words."""
    @property
    def about_toml(self) -> Optional[str]:
        """The beginning of an about.toml, of an import."""
    @property
    def table(self) -> Dict[str, Any]:
        """The marker table as columns: `pandas.DataFrame(data.table)`."""

class Base:
    """Another simulator's predictions for data; `ibr.diagnose` makes them of what it gets as `base`."""

    @staticmethod
    def read(name: str) -> "Base": ...
    @staticmethod
    def of_columns(columns: List[Tuple[str, Any]], name: str) -> "Base": ...
    def under(self, scenario: Scenario, data: Data) -> Data: ...

class Correction:
    """What a diagnosis adds to another simulator's predictions."""

    @staticmethod
    def of(scenario: Scenario, diagnosed: "Answer", data: List[Data]) -> "Correction": ...
    def at(self, act_kpa: ArrayLike, body_kpa: ArrayLike) -> Array: ...
    def text(self) -> str: ...

class Answer:
    text: str
    json: str
    warnings: List[str]
    def columns(self) -> Dict[str, Any]: ...
    def files(self) -> Dict[str, bytes]: ...
    def scenarios(self) -> List[Tuple[str, Scenario]]: ...

def program(typed: List[str]) -> int: ...
def ask(typed: List[str], progress: Optional[Progress] = None) -> Answer: ...
def import_tracks(typed: List[str]) -> Data: ...
def compare(
    scenario: Scenario, data: Data, effects: List[str], sigma_mm: Optional[float], calibrate: Optional[str]
) -> Answer: ...
def diagnose(
    scenario: Scenario, data: List[Data], asked: Mapping[str, Any], progress: Optional[Progress] = None
) -> Answer: ...
def extend(scenario: Scenario, diagnosed: Answer) -> Answer: ...
def add(
    scenario: Scenario,
    effect: str,
    data: List[Data],
    asked: Mapping[str, Any],
    progress: Optional[Progress] = None,
) -> Answer: ...
def ladder(
    scenario: Scenario, data: List[Data], asked: Mapping[str, Any], progress: Optional[Progress] = None
) -> Answer: ...
def validate(scenario: Scenario, data: List[Data], without: List[str], sigma_mm: Optional[float]) -> Answer: ...
def validate_correction(
    name: str, text: Optional[str], data: List[Data], bases: List[Base], sigma_mm: Optional[float]
) -> Answer: ...
def simulate(
    source: Union[Scenario, str],
    folder: Union[str, PathLike[str]],
    changes: Mapping[str, Any],
    resume: bool,
    force: bool,
    end_s: Optional[float],
    threads: int,
    progress: Optional[Progress] = None,
) -> Answer: ...
def read_run(folder: Union[str, PathLike[str]]) -> Answer: ...
def sweep(
    study: str, folder: Union[str, PathLike[str]], threads: int, progress: Optional[Progress] = None
) -> Dict[str, Any]: ...

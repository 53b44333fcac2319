"""Many predicted states side by side."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Dict, Optional

import numpy as np
from numpy.typing import NDArray

from ._results import Tabular

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class States(Tabular):
    """Many states in the order of their pressures; pressures are gauge pressures.

    `table` has a row for each: pressures, tip, angle, and markers as `marker_1_x_mm`, from the base.
    """

    pressure_kpa: Array
    """Actuator pressures (kPa), shape (N,); given by channel, shape (N, channels)."""
    body_pressure_kpa: Array
    """Body pressures (kPa), shape (N,)."""
    tips_mm: Array
    """Tips of the centre line, x and y (mm), shape (N, 2); with strips round the body x, y and z, shape (N, 3)."""
    angles_deg: Array
    """Total bending angles (degrees), shape (N,)."""
    markers_mm: Array
    """Markers as the camera sees them (mm), shape (N, markers, 2); with strips round the body (N, markers, 3)."""
    t_s: Optional[Array] = None
    """Times (s), shape (N,), of a walk by `follow`; None of a batch."""

    @property
    def table(self) -> Dict[str, Array]:
        """A row for each state; the columns share memory with the arrays."""
        columns: Dict[str, Array] = {} if self.t_s is None else {"t_s": self.t_s}
        channels = self.pressure_kpa.reshape(len(self), -1)
        for i, kpa in enumerate(channels.T):
            columns["pressure_kpa" if channels.shape[1] == 1 else f"pressure_{i}_kpa"] = kpa
        columns["body_pressure_kpa"] = self.body_pressure_kpa
        axes = "xyz"[: self.tips_mm.shape[1]]
        columns.update({f"tip_{axis}_mm": self.tips_mm[:, i] for i, axis in enumerate(axes)})
        columns["angle_deg"] = self.angles_deg
        for marker in range(self.markers_mm.shape[1]):
            for i, axis in enumerate(axes):
                columns[f"marker_{marker + 1}_{axis}_mm"] = self.markers_mm[:, marker, i]
        return columns

    def __len__(self) -> int:
        return len(self.angles_deg)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, States):
            return NotImplemented
        pairs = ((getattr(self, field.name), getattr(other, field.name)) for field in fields(self))
        return all(a is b or (a is not None and b is not None and np.array_equal(a, b)) for a, b in pairs)

    def __hash__(self) -> int:
        return hash((len(self), self.tips_mm.tobytes()))

    def __repr__(self) -> str:
        if not len(self):
            return "States(none)"
        low, high = self.pressure_kpa.min(), self.pressure_kpa.max()
        return f"States({len(self)} states, {low:g} to {high:g} kPa, {self.markers_mm.shape[1]} markers)"

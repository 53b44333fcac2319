"""Predictions of another simulator as the base of a diagnosis."""

from __future__ import annotations

import inspect
import os
from typing import Any, Callable, Dict, List, Sequence, Tuple, Union

import numpy as np

from . import _ibr
from ._ibr import Base, Data, Error

#: A callable from pressures to markers, a table, or a CSV file.
Predictions = Union[Callable[..., Any], Any]


def bases_of(base: Predictions, measured: Sequence[Data], columns: Callable[[Any], List[Tuple[str, Any]]]) -> List[Base]:
    """The base of every set of data; `columns` makes columns of a frame."""
    if isinstance(base, (list, tuple)):
        if len(base) != len(measured):
            raise Error(f"{len(base)} bases for {len(measured)} sets of data: give one for each, or a function for all")
        return [_base(one, data, columns) for one, data in zip(base, measured)]
    if not callable(base) and len(measured) > 1:
        raise Error(f"one table of predictions for {len(measured)} sets of data: give a list with one for each")
    return [_base(base, data, columns) for data in measured]


def _base(base: Predictions, data: Data, columns: Callable[[Any], List[Tuple[str, Any]]]) -> Base:
    if isinstance(base, (str, os.PathLike)):
        return Base.read(os.fspath(base))
    return Base.of_columns(columns(_called(base, data) if callable(base) else base), "base")


def _called(predict: Callable[..., Any], data: Data) -> Dict[str, Any]:
    """A table of the predictions of a function at the pressures of the data: `predict(pressure_kpa)`, or
    `predict(pressure_kpa, body_pressure_kpa)`, returns the places of the markers (mm), shape (markers, 2)."""
    table = data.table
    names = [name for name in table if name.startswith("p_") and name != "p_gauge_kpa"]
    axes = [name for name in ("x_mm", "y_mm", "z_mm") if name in table]
    holds = np.unique(np.stack([np.asarray(table[name], dtype=float) for name in names], axis=1), axis=0)
    positional = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    taken = [p for p in inspect.signature(predict).parameters.values() if p.kind in positional and p.default is p.empty]
    markers = data.markers
    rows: Dict[str, List[Any]] = {name: [] for name in (*names, "marker", *axes)}
    for hold in holds:
        body, act = hold[names.index("p_body_kpa")], [p for name, p in zip(names, hold) if name != "p_body_kpa"]
        given = [act[0] if len(act) == 1 else np.asarray(act), body][: 2 if len(taken) > 1 else 1]
        places = np.asarray(predict(*given), dtype=float)
        if places.shape != (len(markers), len(axes)):
            raise Error(
                f"the base returns the shape {places.shape} at {[float(p) for p in act]} kPa: return the places of the markers "
                f"{', '.join(markers)} in mm, shape ({len(markers)}, {len(axes)})"
            )
        for marker, place in zip(markers, places):
            for name, value in zip(rows, (*hold, marker, *place)):
                rows[name].append(value)
    return {name: values if name == "marker" else np.asarray(values) for name, values in rows.items()}

"""What results have in common."""

from __future__ import annotations

import json
from typing import Any, Dict, List

import numpy as np

from . import _ibr


class Result:
    """A result as the command tells it: `print(result)` is its text, and every key of its JSON (docs/json.md) an attribute.

    `warnings`: what to know before believing it.
    """

    #: Pictures of the report that a notebook shows, in this order.
    _shown: tuple = ()

    def __init__(self, answer: _ibr.Answer):
        self._answer = answer
        self._keys = json.loads(answer.json)
        self.warnings: List[str] = answer.warnings

    def __getattr__(self, name: str) -> Any:
        keys = self.__dict__.get("_keys", {})
        if name in keys:
            return keys[name]
        raise AttributeError(f"{type(self).__name__} has no {name!r}; it has {', '.join(keys)}")

    def __dir__(self):
        return [*super().__dir__(), *self._keys]

    def __str__(self) -> str:
        return self._answer.text

    def to_dict(self) -> Dict[str, Any]:
        """The JSON of the command as a dictionary."""
        return json.loads(self._answer.json)

    def to_json(self) -> str:
        """The JSON of the command."""
        return json.dumps(self._keys, indent=2, ensure_ascii=False)

    @property
    def table(self) -> Dict[str, np.ndarray]:
        """Its numbers as columns: `pandas.DataFrame(result.table)`."""
        return {name: np.asarray(column) for name, column in self._answer.columns().items()}

    def pictures(self) -> Dict[str, str]:
        """The charts of its report, SVG by name; empty without a report. Drawing takes about a second."""
        files = self._answer.files().items()
        return {name[:-4]: text.decode() for name, text in files if name.endswith(".svg")}

    def to_html(self) -> str:
        """Its report as one self-contained page; empty without a report."""
        return self._answer.files().get("report.html", b"").decode()

    def _repr_html_(self) -> str:
        pictures = self.pictures() if self._shown else {}
        shown = [f'<div style="max-width:520px">{pictures[name]}</div>' for name in self._shown if name in pictures]
        charts = f'<div style="display:flex;flex-wrap:wrap;gap:1em">{"".join(shown)}</div>' if shown else ""
        return f'<pre style="white-space:pre-wrap">{_escaped(self._headline())}</pre>{charts}'

    def _headline(self) -> str:
        return str(self)


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def columns_of(records: List[Dict[str, Any]]) -> Dict[str, np.ndarray]:
    """Records as columns: numbers (None is NaN) and texts; lists and records in them are left out."""
    if not records:
        return {}
    table = {}
    for name in records[0]:
        values = [record.get(name) for record in records]
        if any(isinstance(value, str) for value in values):
            table[name] = np.asarray(["" if value is None else value for value in values])
        elif all(value is None or isinstance(value, (int, float)) for value in values):
            plain = [np.nan if value is None else value for value in values]
            table[name] = np.asarray(plain)
    return table

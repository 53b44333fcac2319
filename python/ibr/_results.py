"""What results have in common, tables, and files that are not replaced without a word."""

from __future__ import annotations

import hashlib
import json
import os
from typing import TYPE_CHECKING, Any, Dict, List, Mapping, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from . import _ibr

if TYPE_CHECKING:
    import pandas
    import polars

Path = Union[str, "os.PathLike[str]"]
Column = NDArray[Any]


class NotFoundError(_ibr.Error, FileNotFoundError):
    """A file, or a name of a robot or of data, that is not there."""


class ExistsError(_ibr.Error, FileExistsError):
    """A file that would be replaced."""


#: What this process wrote last to a path.
_written: Dict[str, str] = {}


def save_text(text: str, path: Path, force: bool = False) -> None:
    """Writes a text; a file with another content that this process did not write is kept unless `force`."""
    name, content = os.path.abspath(path), text.encode()
    if os.path.exists(name) and not force:
        with open(name, "rb") as file:
            old = file.read()
        if old != content and _written.get(name) != hashlib.sha256(old).hexdigest():
            refused = ExistsError(f"{os.fspath(path)} is there, and was not written here\nhelp: give another name, or force=True")
            refused.where, refused.help = os.fspath(path), "give another name, or force=True"
            raise refused
    with open(name, "wb") as file:
        file.write(content)
    _written[name] = hashlib.sha256(content).hexdigest()


class Tabular:
    """Numbers with a name for every column; each name has its unit."""

    @property
    def table(self) -> Mapping[str, Column]:
        """Its numbers as columns."""
        raise NotImplementedError

    def to_pandas(self) -> "pandas.DataFrame":
        """Its table as a frame of pandas."""
        import pandas

        frame: pandas.DataFrame = pandas.DataFrame(dict(self.table))
        return frame

    def to_polars(self) -> "polars.DataFrame":
        """Its table as a frame of polars."""
        import polars

        return polars.DataFrame(dict(self.table))


class Table(Dict[str, Any], Tabular):
    """A table as a dictionary of columns."""

    @property
    def table(self) -> Mapping[str, Column]:
        """Itself."""
        return self


class _Kept:
    """What another process gets of an answer: its texts, numbers and scenarios, and no charts."""

    def __init__(self, answer: Any):
        self.text: str = answer.text
        self.json: str = answer.json
        self.warnings: List[str] = answer.warnings
        self._columns: Dict[str, Any] = answer.columns()
        self._scenarios: List[Tuple[str, _ibr.Scenario]] = answer.scenarios()

    def columns(self) -> Dict[str, Any]:
        return self._columns

    def files(self) -> Dict[str, bytes]:
        return {}

    def scenarios(self) -> List[Tuple[str, _ibr.Scenario]]:
        return self._scenarios


class Result(Tabular):
    """A result as the command prints it: `print(result)` is its text, and every key of its JSON (docs/json.md) an attribute.

    `warnings`: what to know before believing it. It is equal to a result with the same JSON. It pickles with texts, numbers and
    scenarios; its charts stay behind.
    """

    schema: str
    version: float
    #: Pictures of the report that a notebook shows, in this order.
    _shown: Tuple[str, ...] = ()

    def __init__(self, answer: Any):
        self._answer = answer
        self._keys: Dict[str, Any] = json.loads(answer.json)
        self.warnings: List[str] = answer.warnings

    # A key of the JSON; type checkers know its keys by name, and a slip in one is an error.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            keys = self.__dict__.get("_keys", {})
            if name in keys:
                return keys[name]
            raise AttributeError(f"{type(self).__name__} has no {name!r}; it has {', '.join(keys)}")

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._keys]

    def __getstate__(self) -> Dict[str, Any]:
        return {**self.__dict__, "_answer": _Kept(self._answer)}

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and isinstance(other, Result) and self._answer.json == other._answer.json

    def __hash__(self) -> int:
        return hash(self._answer.json)

    def __str__(self) -> str:
        return str(self._answer.text)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self._line()})"

    def to_dict(self) -> Dict[str, Any]:
        """The JSON of the command as a dictionary."""
        found: Dict[str, Any] = json.loads(self._answer.json)
        return found

    def to_json(self) -> str:
        """The JSON of the command."""
        return json.dumps(self._keys, indent=2, ensure_ascii=False)

    @property
    def table(self) -> Mapping[str, Column]:
        """Its numbers as columns."""
        return {name: np.asarray(column) for name, column in self._answer.columns().items()}

    def pictures(self) -> Dict[str, str]:
        """The charts of its report, SVG by name; empty without a report. Drawing takes about a second."""
        files = self._answer.files().items()
        return {name[:-4]: text.decode() for name, text in files if name.endswith(".svg")}

    def to_html(self) -> str:
        """Its report as one self-contained page; empty without a report."""
        return str(self._answer.files().get("report.html", b"").decode())

    def _repr_html_(self) -> str:
        pictures = self.pictures() if self._shown else {}
        shown = [f'<div style="max-width:520px">{pictures[name]}</div>' for name in self._shown if name in pictures]
        charts = f'<div style="display:flex;flex-wrap:wrap;gap:1em">{"".join(shown)}</div>' if shown else ""
        return f'<pre style="white-space:pre-wrap">{_escaped(self._headline())}</pre>{charts}'

    def _headline(self) -> str:
        return str(self)

    def _line(self) -> str:
        """What it is, in a line."""
        return self._headline().strip().split("\n")[0]


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def columns_of(records: Sequence[Mapping[str, Any]]) -> Dict[str, Column]:
    """Records as columns: numbers (None is NaN) and texts; lists and records in them are left out."""
    if not records:
        return {}
    table: Dict[str, Column] = {}
    for name in records[0]:
        values = [record.get(name) for record in records]
        if any(isinstance(value, str) for value in values):
            table[name] = np.asarray(["" if value is None else value for value in values])
        elif all(value is None or isinstance(value, (int, float)) for value in values):
            plain = [np.nan if value is None else value for value in values]
            table[name] = np.asarray(plain)
    return table

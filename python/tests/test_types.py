"""Types are checked as users check them, and what help() prints is what the stubs have."""

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path

import ibr
import pytest
from conftest import ROOT
PACKAGE = Path(ibr.__file__).parent

GOOD = """
import ibr
robot = ibr.Scenario.named("epam")
height_mm: float = float(robot.predict(20).tip_mm[1])
found = ibr.diagnose(robot, "synthetic-epam")
names: list[str] = found.names
error_mm: float = found.base["systematic_mm"]
first: str = found.ranked[0]["effect"]
compared = ibr.compare(robot, "synthetic-epam")
worst: float = compared.overall["rmse_mm"]
tips = robot.batch([10.0, 20.0]).tips_mm
run = ibr.simulate(robot)
steps: float = run.steps
fewer: list[str] = robot.without("chord_arm").effects
reached: bool = ibr.design("wish.toml").reached
frame = robot.batch([10.0]).to_pandas()
"""

# A line, and what the checkers have to say of it.
SLIPS = [
    'ibr.diagnose("epam", "synthetic-epam").verdikt',
    'ibr.diagnose("epam", "synthetic-epam").base["sistematic_mm"]',
    'ibr.compare("epam", "synthetic-epam").overall["rmse"]',
    'ibr.Scenario.named("epam").predict(20).tip',
    'ibr.Scenario.named("epam").batch([1.0]).tip_mm',
    'ibr.ladder("epam", "synthetic-epam").step',
    'ibr.pattern("epam").peaces',
    'ibr.simulate("epam").nods',
    'ibr.Scenario.named("epam").withot("friction")',
]


def checked(tmp_path, text, *command):
    file = tmp_path / "snippet.py"
    file.write_text(text)
    made = subprocess.run([sys.executable, "-m", *command, str(file)], capture_output=True, text=True, cwd=tmp_path)
    return made.returncode, made.stdout + made.stderr, file


COMMANDS = {"mypy": ("mypy", "--strict", "--cache-dir=.mypy"), "pyright": ("pyright", "--pythonpath", sys.executable)}


@pytest.mark.parametrize("checker", COMMANDS)
def test_a_slip_in_a_field_is_an_error(checker, tmp_path):
    pytest.importorskip(checker)
    code, said, _ = checked(tmp_path, GOOD, *COMMANDS[checker])
    assert code == 0, said
    lines = "\n".join(["import ibr", *SLIPS])
    code, said, _ = checked(tmp_path, lines, *COMMANDS[checker])
    found = {int(line) for line in re.findall(r"snippet\.py:(\d+):(?:\d+)?.*error", said)}
    assert code == 1 and found == set(range(2, 2 + len(SLIPS))), said


def test_the_package_and_its_notebooks_are_strict(tmp_path):
    pytest.importorskip("mypy")
    nbformat = pytest.importorskip("nbformat")
    for notebook in sorted((ROOT / "python/notebooks").glob("*.ipynb")):
        cells = [cell.source for cell in nbformat.read(notebook, as_version=4).cells if cell.cell_type == "code"]
        code = "\n".join(line for cell in cells for line in cell.splitlines() if not line.startswith(("%", "!")))
        done, said, _ = checked(tmp_path, code, *COMMANDS["mypy"], "--ignore-missing-imports")
        assert done == 0, f"{notebook.name}\n{said}"
    made = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", "--cache-dir", str(tmp_path), "-p", "ibr"]
    done = subprocess.run(made, capture_output=True, text=True, cwd=tmp_path)
    assert done.returncode == 0, done.stdout


def test_types_of_results_are_those_of_the_json():
    sys.path.insert(0, str(ROOT / "python"))
    import records

    sys.path.pop(0)
    assert (PACKAGE / "_records.pyi").read_text() == records.stub((ROOT / "docs/json.md").read_text())


def test_help_prints_what_the_stubs_have():
    from ibr import _ibr

    def words(text):
        return re.sub(r"\s+", " ", text or "").strip()

    stub = ast.parse((PACKAGE / "_ibr.pyi").read_text())
    compared = 0
    for node in stub.body:
        if not isinstance(node, ast.ClassDef) or node.name not in ("Scenario", "State", "Data", "Error"):
            continue
        native = getattr(_ibr, node.name)
        assert words(native.__doc__) == words(ast.get_docstring(node)), node.name
        for part in node.body:
            told = ast.get_docstring(part) if isinstance(part, ast.FunctionDef) else None
            if told and not part.name.startswith("_"):
                assert words(inspect.getdoc(getattr(native, part.name))) == words(told), f"{node.name}.{part.name}"
                compared += 1
    assert compared > 25

"""The package itself: the command line in it, its size and start, types, documents."""

import ast
import doctest
import json
import os
import re
import subprocess
import sys
from pathlib import Path

import ibr
import pytest
from conftest import ROOT


def test_the_command_line_is_in_it(told):
    typed = [sys.executable, "-m", "ibr", "predict", "epam", "--pressure", "20kPa", "--json"]
    made = subprocess.run(typed, capture_output=True, text=True, check=True)
    assert json.loads(made.stdout) == told("predict", "epam", "--pressure", "20kPa")
    wrong = subprocess.run([sys.executable, "-m", "ibr", "predict", "epan"], capture_output=True, text=True)
    assert wrong.returncode == 3 and "epam" in wrong.stderr


def test_it_is_small_and_starts_quickly():
    wheel = Path(os.environ["IBR_WHEEL"]) if "IBR_WHEEL" in os.environ else pytest.skip("no wheel")
    assert wheel.stat().st_size <= 4_000_000, f"{wheel.stat().st_size} bytes"
    code = "import numpy, time; t = time.perf_counter(); import ibr; print(time.perf_counter() - t)"
    times = [float(subprocess.check_output([sys.executable, "-c", code])) for _ in range(5)]
    assert min(times) <= 0.05, times
    print(f"wheel {wheel.stat().st_size / 1e6:.2f} MB, import {min(times) * 1e3:.0f} ms beside numpy")


def test_stubs_say_what_there_is():
    from ibr import _ibr

    stub = ast.parse((Path(ibr.__file__).parent / "_ibr.pyi").read_text())
    told = {node.name: node for node in stub.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    numbers = {node.target.id for node in stub.body if isinstance(node, ast.AnnAssign)}
    assert {name for name in dir(_ibr) if not name.startswith("_")} == {*told} | numbers
    for name, node in told.items():
        if isinstance(node, ast.ClassDef) and name not in ("Error", "Answer"):
            members = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
            there = {part for part in vars(getattr(_ibr, name)) if not part.startswith("__")}
            assert there <= members and members - {"__len__"} <= there, name


def test_examples_of_the_documents_hold(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    options = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    for document in [ROOT / "docs/python.md", Path(ibr.__file__)]:
        # Without the fences, which would be taken for what is printed.
        text = re.sub(r"^```.*$", "", document.read_text(), flags=re.MULTILINE)
        examples = doctest.DocTestParser().get_doctest(text, {}, document.name, str(document), 0)
        found = doctest.DocTestRunner(optionflags=options).run(examples)
        assert found.attempted > 0 and found.failed == 0, document


def test_the_page_of_the_wheel_runs():
    code = (ROOT / "python/README.md").read_text().split("```python\n")[1].split("```")[0]
    names = {}
    exec(code, names)
    for line in code.splitlines():
        call, comment, shown = line.partition("  # ")
        if comment and shown.startswith(("State", "(")):
            assert repr(eval(call, names)) == shown.strip(), line


@pytest.mark.parametrize("notebook", sorted((ROOT / "python/notebooks").glob("*.ipynb")), ids=lambda path: path.stem)
def test_notebooks_run(notebook, tmp_path):
    for package in ("mujoco", "soromox"):
        if f"pip install {package}" in notebook.read_text(encoding="utf-8"):
            pytest.importorskip(package)
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    made = nbformat.read(notebook, as_version=4)
    nbclient.NotebookClient(made, timeout=120, resources={"metadata": {"path": str(tmp_path)}}).execute()
    if "IBR_NOTEBOOKS" in os.environ:
        nbformat.write(made, Path(os.environ["IBR_NOTEBOOKS"]) / notebook.name)

"""The further verbs of the command line."""

import subprocess
import sys

import ibr
import numpy as np
import pytest
from conftest import ROOT


def test_a_ladder_is_that_of_the_command(told):
    found = ibr.ladder("epam-textbook", "synthetic-epam")
    assert found.to_dict() == told("ladder", "epam-textbook", "synthetic-epam")
    assert found.names[0] == "end_constraint" and found.table["training_mm"][-1] < found.table["training_mm"][0]
    last = [*found.scenarios.values()][-1]
    assert "end_constraint" in last.effects and "end_constraint" in repr(found)
    assert "</html>" in found.to_html()


def test_a_pattern_is_drawn_and_saved(tmp_path, told):
    found = ibr.pattern("epam", kerf_mm=0.2)
    wanted = told("pattern", "epam", "--kerf", "0.2mm", "--out", str(tmp_path / "p.svg"))
    assert found.pieces == wanted["pieces"] and found.svg == (tmp_path / "p.svg").read_text()
    assert "pieces" in repr(found) and len(found.table["name"]) == len(found.pieces)
    found.save(tmp_path / "p.dxf")
    assert "SECTION" in (tmp_path / "p.dxf").read_text()
    with pytest.raises(FileExistsError):
        ibr.pattern("epam", weld_mm=4).save(tmp_path / "p.svg")
    with pytest.raises(ibr.Error, match="kerf"):
        ibr.pattern("epam", kerf_mm=50)


def test_a_fabric_is_that_of_its_tests(tmp_path, told):
    subprocess.run([sys.executable, "-m", "ibr", "characterize", "--example", str(tmp_path)], check=True, capture_output=True)
    files = sorted(tmp_path.glob("*.csv"))
    found = ibr.characterize(files)
    assert found.to_dict() == told("characterize", *map(str, files))
    assert len(found.to_pandas()) == len(found.quantities) and found.provenance == "synthetic"
    with pytest.raises(FileNotFoundError):
        ibr.characterize("nowhere.csv")


def test_a_design_reaches_its_wish(told, tmp_path):
    wish = (ROOT / "docs/design.md").read_text().split("```toml\n")[1].split("```")[0]
    found = ibr.design(wish, check=False)
    assert found.chosen and found.table["miss_mm"].min() >= 0
    state = found.scenario.predict(found.p_act_channels_kpa[0], found.p_body_kpa)
    assert found.reached == (np.hypot(*(state.tip_mm - [310, 110])) < found.tolerance_mm)
    assert "<svg" in found.pictures()["design"] and "actuator.count" in repr(found)
    with pytest.raises(ibr.Error, match="from"):
        ibr.design(wish.replace("from =", "form ="), check=False)

"""The session of examples/session.rs from Python; frames of every kind; numbers of the command."""

import json
import subprocess
import sys

import ibr
import numpy as np
import pytest

pandas = pytest.importorskip("pandas")


def test_a_comparison_is_that_of_the_command(told, tmp_path):
    found = ibr.compare("epam-textbook", "synthetic-epam", effects=["sealed_sides"])
    answer = told("compare", "epam-textbook", "synthetic-epam", "--effect", "sealed_sides", "--out", str(tmp_path))
    assert found.to_dict() == answer
    assert found.error_mm == answer["overall"]["systematic_mm"] > 20
    assert found.names == ["scenario", "+ sealed_sides"]
    frame = pandas.DataFrame(found.table)
    bare = frame[frame.model == "scenario"]
    assert len(bare) == len(answer["holds"]) * len(answer["residual_map"]["markers"])
    cell = answer["residual_map"]["cells"][-1][0]["y"]["mm"]
    last = bare[bare.marker == answer["residual_map"]["markers"][-1]].iloc[0]
    assert last.predicted_y_mm - last.y_mm == pytest.approx(cell, abs=1e-9)
    assert "<svg" in found._repr_html_() and "</html>" in found.to_html()
    assert set(found._shown) - {"shapes_z"} <= {*found.pictures()}


def test_the_session_of_the_readme():
    robot = ibr.Scenario.named("epam-textbook")
    steps = []
    found = ibr.diagnose(robot, "synthetic-epam", progress=lambda what, share: steps.append((what, share)))
    assert found.verdict == "effect" and found.names == found.indistinguishable
    assert steps and all(isinstance(what, str) for what, _ in steps)
    assert "Verdict: an effect is missing" in str(found)
    table = pandas.DataFrame(found.table)
    assert table.effect[0] in found.names and {"gain", "systematic_after_mm"} <= {*table}
    better = ibr.extend(robot, found)
    before, after = ibr.compare(robot, "synthetic-epam"), ibr.compare(better.scenario, "synthetic-epam")
    assert after.error_mm < 0.1 * before.error_mm
    assert better.table["training_mm"].tolist()[-1] == pytest.approx(after.error_mm, abs=0.05)
    other = ibr.validate(better.scenario, "synthetic-epam-two-bodies")
    assert other.verdict == "helps" and other.names == better.names
    html = found._repr_html_()
    assert html.count("<svg") >= 3


def test_a_diagnosis_and_an_effect_are_those_of_the_command(told, tmp_path):
    options = {"keep_bending": True, "without": ["gravity"]}
    found = ibr.diagnose("epam-textbook", "synthetic-epam", **options)
    assert found.to_dict() == told("diagnose", "epam-textbook", "synthetic-epam", "--keep-bending", "--not", "gravity")
    added = ibr.add("epam-textbook", "end_constraint", "synthetic-epam")
    file = tmp_path / "new.toml"
    answer = told("add", "epam-textbook", "end_constraint", "synthetic-epam", "--out", str(file))
    assert {**added.to_dict(), "written": str(file)} == answer
    assert added.scenario.text == file.read_text()


def test_a_model_of_another_simulator_is_diagnosed_and_corrected(tmp_path):
    textbook = ibr.Scenario.named("epam-textbook")
    near, simulator = (textbook.replace(body_bending_stiffness_nm2=nm2) for nm2 in (1.0, 1.2))

    def predict(kpa):
        return simulator.predict(kpa).markers_mm

    found = ibr.diagnose(near, "synthetic-epam", base=predict)
    assert found.verdict == "effect" and "end_constraint" in found.names
    assert found.foreign_bases[0]["from_scenario_mm"] > 1 and "The base is base" in found.summary[0]
    assert found.correction(20).shape == (6, 2) and found.correction([10, 20]).shape == (2, 6, 2)
    table = {name: column for name, column in ibr.data("synthetic-epam").table.items() if name != "p_gauge_kpa"}
    places = np.array([predict(kpa)[int(marker) - 1] for kpa, marker in zip(table["p_act_kpa"], table["marker"])])
    of_table = ibr.diagnose(near, "synthetic-epam", base={**table, "x_mm": places[:, 0], "y_mm": places[:, 1]})
    assert of_table.names == found.names
    file = tmp_path / "correction.csv"
    found.save_correction(file)
    judged = ibr.validate(str(file), "synthetic-epam", base=predict)
    assert judged.to_dict()["datasets"] == ibr.validate(found, "synthetic-epam", base=predict).to_dict()["datasets"]
    assert judged.verdict == "fitted_to_these"
    assert judged.table["after_beyond_noise_mm"][0] < 0.3 * judged.table["before_beyond_noise_mm"][0]
    with pytest.raises(ibr.Error, match="return the places of the markers"):
        ibr.diagnose(near, "synthetic-epam", base=lambda kpa: predict(kpa)[:5])
    with pytest.raises(ibr.Error, match="has no base of another simulator"):
        ibr.diagnose(textbook, "synthetic-epam").correction(20)


def test_an_effect_is_given_or_learned():
    given = ibr.add("epam-textbook", "sealed_sides:share=1")
    assert given.names == ["sealed_sides"] and "sealed_sides" in given.scenario.effects
    learned = ibr.add("epam-textbook", "learned", "synthetic-epam")
    assert "[[formula]]" in learned.scenario.text and learned.names == ["learned"]


def frames():
    columns = ibr.data("synthetic-epam").table
    pandas_frame = pandas.DataFrame(columns)
    yield "dict", columns
    yield "pandas", pandas_frame
    yield "pandas, whole numbers as labels", pandas_frame.assign(run=pandas.factorize(pandas_frame.run)[0] + 1)
    polars = pytest.importorskip("polars")
    yield "polars", polars.DataFrame(columns)


def test_frames_of_every_kind_are_the_same_data():
    wanted = ibr.compare("epam", "synthetic-epam").to_dict()
    about = {}
    for kind, frame in frames():
        found = ibr.compare("epam", ibr.data(frame, name="synthetic-epam")).to_dict()
        about[kind] = {key for key in wanted if found[key] != wanted[key]}
    # A frame brings no about.toml.
    assert all(differ <= {"provenance", "warnings"} for differ in about.values()), about


def test_lost_markers_are_empty_cells():
    frame = pandas.DataFrame(ibr.data("synthetic-epam").table)
    lost = frame.copy()
    lost.loc[lost.index[5], ["x_mm", "y_mm"]] = np.nan
    assert "1 row" in " ".join(ibr.data(lost).told) or ibr.compare("epam", lost).runs == ibr.compare("epam", frame).runs


def test_a_fault_of_a_frame_has_its_row_and_column():
    frame = pandas.DataFrame(ibr.data("synthetic-epam").table)
    with pytest.raises(ibr.Error) as fault:
        ibr.data(frame.rename(columns={"x_mm": "x"}), name="mine")
    assert fault.value.where == "mine:1, column x" and "x_mm" in fault.value.help
    frame["y_mm"] = frame["y_mm"].astype(object)
    frame.loc[frame.index[4], "y_mm"] = "twelve"
    with pytest.raises(ibr.Error) as fault:
        ibr.data(frame, name="mine")
    assert fault.value.where == "mine:6, column y_mm" and "twelve" in str(fault.value)


def test_columns_of_other_lengths_are_refused():
    columns = ibr.data("synthetic-epam").table
    with pytest.raises(ibr.Error, match="column actuator has 1 of"):
        ibr.data({**columns, "actuator": "epam"})
    with pytest.raises(ibr.Error, match="shape"):
        ibr.data({**columns, "x_mm": np.zeros((5, 2))})


def test_a_description_goes_with_a_frame(tmp_path):
    frame = ibr.data("synthetic-epam").table
    with pytest.raises(ibr.Error):
        ibr.data(frame, about="title = 3\n")


def test_tracking_files_become_data(tmp_path):
    made = [sys.executable, "-m", "ibr", "data", "import", "--example", str(tmp_path)]
    subprocess.run(made, check=True, capture_output=True)
    runs = sorted(tmp_path.glob("run*.csv"))
    options = {"pressure": tmp_path / "pressure.csv", "fps": 30, "scale": "3.1px/mm", "base": "212,540"}
    data = ibr.import_tracks(runs, actuator="epam", **options)
    assert len(data.runs) == 3 and "DeepLabCut" in " ".join(data.told) and "[" in data.about_toml
    assert ibr.diagnose("epam-textbook", data).verdict is not None
    with pytest.raises(ibr.Error, match="--scal"):
        ibr.import_tracks(runs, scal="3.1px/mm")


def test_json_is_json():
    found = ibr.compare("epam", "synthetic-epam")
    assert json.loads(found.to_json()) == found.to_dict()
    with pytest.raises(AttributeError, match="overall"):
        found.overal


def test_results_draw_themselves_on_axes():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    robot = ibr.Scenario.named("epam-textbook")
    axes = robot.predict(20).plot()
    assert axes.lines[0].get_xydata().tolist() == robot.predict(20).curve_mm.tolist()
    found = ibr.compare(robot, "synthetic-epam-two-bodies")
    axes = found.plot()
    assert sum(len(line.get_xdata()) for line in axes.lines) == 2 * len(found.table["marker"])
    found = ibr.diagnose(robot, "synthetic-epam")
    axes = found.plot()
    best = axes.patches[-1]
    assert best.get_width() == min(found.table["systematic_after_mm"])

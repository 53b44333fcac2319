"""What Python's users do with any package: pickle, compare, copy, save, print, drop, list, catch, fan out."""

import concurrent.futures
import copy
import multiprocessing
import pathlib
import pickle

import ibr
import numpy as np
import pytest
from conftest import ROOT

ROBOT = ibr.Scenario.named("epam")


def again(value):
    return pickle.loads(pickle.dumps(value))


def tip_at(robot, kpa):
    return robot.predict(kpa).tip_mm.tolist()


ABOUT = str(pathlib.Path(__file__).parents[2] / "data/sets/synthetic-epam/about.toml")


def values():
    yield ROBOT
    yield ROBOT.replace(body_radius_mm=45)
    yield ROBOT.predict(20)
    yield ibr.Scenario.named("epam-two-strips").predict([20, 10])
    yield ROBOT.batch([10, 20])
    yield ROBOT.follow([1, 2], [10, 20])
    yield ibr.data("synthetic-epam")
    yield ibr.data(ibr.data("synthetic-epam").table, name="mine", about=ABOUT)
    yield ibr.compare("epam", "synthetic-epam")
    yield ibr.add("epam-textbook", "sealed_sides:share=1")


@pytest.mark.parametrize("value", values(), ids=lambda value: type(value).__name__)
def test_a_value_is_equal_to_its_pickle_and_its_copy(value):
    for other in (again(value), copy.copy(value), copy.deepcopy(value)):
        assert type(other) is type(value) and other == value and hash(other) == hash(value)
    assert value != 3 and not value == "epam"
    line = repr(value)
    assert "\n" not in line and "object at" not in line and line.startswith(type(value).__name__)


def test_values_that_differ_are_not_equal():
    assert ROBOT != ibr.Scenario.named("cpam") and ROBOT != ROBOT.replace(body_radius_mm=41)
    assert ROBOT.predict(20) != ROBOT.predict(21) and ROBOT.predict(20) == ROBOT.predict(20.0)
    assert ROBOT.batch([10, 20]) != ROBOT.batch([10, 21])
    assert ibr.data("synthetic-epam") != ibr.data("synthetic-epam-two-bodies")
    assert len({ROBOT, ibr.Scenario.named("epam"), ROBOT.replace(body_radius_mm=41)}) == 2


def test_a_result_from_another_process_has_all_but_its_charts():
    found = ibr.diagnose("epam-textbook", "synthetic-epam")
    other = again(found)
    assert other == found and other.verdict == "effect" and str(other) == str(found)
    assert other.table["gain"].tolist() == found.table["gain"].tolist() and other.pictures() == {}
    assert "verdict effect, end_constraint or" in repr(found)
    with pytest.raises(ibr.Error, match="another process"):
        ibr.extend("epam-textbook", other)
    added = ibr.extend("epam-textbook", found)
    assert again(added).scenario == added.scenario


def test_robots_go_to_other_processes():
    robots = [ROBOT.replace(body_radius_mm=40 + i) for i in range(4)]
    wanted = [tip_at(robot, 20) for robot in robots]
    pool = concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn"))
    with pool:
        found = list(pool.map(tip_at, robots, [20] * 4))
    assert np.allclose(found, wanted, rtol=1e-12)


def test_robots_go_through_joblib():
    joblib = pytest.importorskip("joblib")
    robots = [ROBOT.replace(body_radius_mm=40 + i) for i in range(4)]
    found = joblib.Parallel(n_jobs=2)(joblib.delayed(tip_at)(robot, 20) for robot in robots)
    assert np.allclose(found, [tip_at(robot, 20) for robot in robots], rtol=1e-12)
    assert joblib.hash(ROBOT) == joblib.hash(ibr.Scenario.named("epam"))


def test_robots_go_through_dask():
    dask = pytest.importorskip("dask")
    robots = [ROBOT.replace(body_radius_mm=40 + i) for i in range(4)]
    found = dask.compute(*[dask.delayed(tip_at)(robot, 20) for robot in robots], scheduler="processes")
    assert np.allclose(found, [tip_at(robot, 20) for robot in robots], rtol=1e-12)


def test_the_version_is_that_of_the_crate():
    crates = (ROOT / "Cargo.toml").read_text()
    assert f'version = "{ibr.__version__}"' in crates


def test_effects_are_listed_and_dropped():
    assert "chord_arm" in ROBOT.effects
    fewer = ROBOT.without("chord_arm", "fold_energy")
    assert len(fewer.effects) == len(ROBOT.effects) - 2 and "# published: D_IBR = 80 mm" in fewer.text
    bare = ROBOT.bare()
    assert bare.effects == [] and "bending_stiffness_nm2 = 0 " in bare.text
    with pytest.raises(ibr.Error, match="chord_arms") as fault:
        ROBOT.without("chord_arms")
    assert "chord_arm" in fault.value.help
    known = {effect["name"]: effect for effect in ibr.effects()}
    assert set(ROBOT.effects) <= set(known) and known["friction"]["parameters"][0]["unit"]
    assert "epam" in [robot["name"] for robot in ibr.robots()]
    assert "synthetic-epam" in [data["name"] for data in ibr.datasets()]


def test_a_file_of_others_is_not_replaced(tmp_path):
    path = tmp_path / "mine.toml"
    ROBOT.save(path)
    wide = ROBOT.replace(body_radius_mm=45)
    wide.save(path)  # written here before
    assert ibr.Scenario.from_toml(path) == wide
    path.write_text("# edited by hand\n" + wide.text)
    with pytest.raises(FileExistsError) as fault:
        ROBOT.save(path)
    assert isinstance(fault.value, ibr.Error) and fault.value.help and "edited" in path.read_text()
    ROBOT.save(path, force=True)
    assert path.read_text() == ROBOT.text


def test_faults_are_those_of_python_too(tmp_path):
    for wish in (lambda: ibr.Scenario.named("epan"), lambda: ibr.data("nowhere.csv"), lambda: ibr.data(tmp_path / "no")):
        with pytest.raises(FileNotFoundError) as fault:
            wish()
        assert isinstance(fault.value, ibr.Error) and isinstance(fault.value, ValueError)
        assert again(fault.value).help == fault.value.help
    before, after = ROBOT.text.split("radius_mm = 40", 1)
    bad = f"{before}radius_mm = -4{after}"
    with pytest.raises(ibr.Error) as fault:
        ibr.Scenario.from_toml(bad)
    assert not isinstance(fault.value, FileNotFoundError)
    assert again(fault.value).where == fault.value.where == f"scenario:{before.count(chr(10)) + 1}"


@pytest.mark.parametrize("name", ["epam", "cpam", "spam", "fpam", "epam-textbook"])
def test_numbers_set_without_the_text_are_those_of_the_text(name):
    robot = ibr.Scenario.named(name)
    for changes in (
        {"body_radius_mm": 45},
        {"body_radius_mm": 43.5, "actuator": {"width_mm": 55}},
        {"body_pressure_kpa": np.float64(3.0)},
        {"actuator_count": 5, "actuator_length_mm": 50.0},
    ):
        quick = robot.replace(**changes)
        read = ibr.Scenario.from_toml(quick.text)
        assert np.allclose(quick.predict(20).markers_mm, read.predict(20).markers_mm, rtol=1e-12, atol=1e-9)
        assert quick.batch([10, 20]) == read.batch([10, 20])
        assert quick.text == robot.replace(**changes, name=robot.name).text and quick.effects == read.effects
    with pytest.raises(ibr.Error) as fault:
        robot.replace(body_radius_mm=-45)
    assert fault.value.where.startswith(f"{name}:")
    assert robot.replace(body_radius_mm=45).replace(body_radius_mm=40) == robot


def test_batches_are_labelled():
    pandas, polars = pytest.importorskip("pandas"), pytest.importorskip("polars")
    many = ROBOT.batch(np.linspace(0, 30, 7))
    frame = many.to_pandas()
    assert list(frame.columns[:5]) == ["pressure_kpa", "body_pressure_kpa", "tip_x_mm", "tip_y_mm", "angle_deg"]
    assert frame.pressure_kpa.tolist() == np.linspace(0, 30, 7).tolist() and set(frame.body_pressure_kpa) == {2}
    assert frame.marker_6_y_mm.tolist() == many.markers_mm[:, 5, 1].tolist() and len(frame.columns) == 17
    assert polars.DataFrame(frame).equals(many.to_polars())
    two = ibr.Scenario.named("epam-two-strips").follow([1, 2], [[20, 10], [10, 20]]).to_pandas()
    assert list(two.columns[:3]) == ["t_s", "pressure_0_kpa", "pressure_1_kpa"] and "tip_z_mm" in two
    assert isinstance(ibr.compare("epam", "synthetic-epam").to_pandas(), pandas.DataFrame)
    assert "effect" in ibr.diagnose("epam-textbook", "synthetic-epam").to_polars().columns


def test_tables_of_arrow_and_polars_are_data():
    pyarrow, polars = pytest.importorskip("pyarrow"), pytest.importorskip("polars")
    pandas = pytest.importorskip("pandas")
    columns = ibr.data("synthetic-epam").table
    wanted = ibr.data(columns)
    frame = polars.DataFrame(columns)
    assert ibr.data(frame.with_columns(polars.col("actuator", "phase").cast(polars.Categorical))) == wanted
    assert ibr.data(pandas.DataFrame(columns).astype({"actuator": "category", "phase": "category"})) == wanted
    table = pyarrow.table(columns)
    assert ibr.data(table) == wanted and ibr.data(table.to_batches()[0]) == wanted
    coded = table.set_column(1, "actuator", table["actuator"].dictionary_encode())
    assert ibr.data(coded) == wanted
    rounded = frame.with_columns(polars.col("x_mm").cast(polars.Decimal(12, 4)))
    assert np.allclose(ibr.data(rounded).table["x_mm"], columns["x_mm"], atol=1e-4)
    lost = [None, None, *columns["x_mm"][2:].tolist()]
    assert np.isnan(ibr.data(frame.with_columns(x_mm=polars.Series(lost), y_mm=polars.Series([None, None, *columns["y_mm"][2:].tolist()]))).table["x_mm"]).sum() in (0, 2)

"""Robots with strips round the body: x, y and z, to the bit those of the command."""

import ibr
import numpy as np
import pytest

ROBOT = "epam-two-strips"


def test_a_state_has_three_coordinates(told):
    robot = ibr.Scenario.named(ROBOT)
    state = robot.predict([20, 10])
    wanted = told("predict", ROBOT, "--pressure", "20kPa/10kPa")["states"][0]
    assert state.to_dict() == wanted
    assert state.tip_mm.tolist() == [wanted["tip"][key] for key in ("x_mm", "y_mm", "z_mm")]
    assert state.markers_mm.tolist() == [[m[key] for key in ("x_mm", "y_mm", "z_mm")] for m in wanted["markers"]]
    assert state.curve_mm.shape == (101, 3)
    assert np.allclose(state.curve_mm[-1], state.tip_mm, rtol=0, atol=1e-9)
    assert f"{state.tip_mm[2]:.2f}" in repr(state) and state._repr_html_().count("<svg") == 2


def test_many_states_are_the_single_ones():
    robot = ibr.Scenario.named("epam-helix")
    kpa = np.linspace(0, 30, 13)
    singles = [robot.predict(p) for p in kpa]
    for threads in (1, 3):
        many = robot.batch(kpa, threads=threads)
        assert many.tips_mm.tolist() == [s.tip_mm.tolist() for s in singles]
        assert many.markers_mm.tolist() == [s.markers_mm.tolist() for s in singles]
    walked = robot.follow(np.arange(1.0, 14.0), kpa)
    assert walked.markers_mm.shape == (13, 6, 3) and walked.tips_mm.tolist() == many.tips_mm.tolist()


def test_a_robot_turned_by_a_quarter_is_the_planar_one():
    planar = ibr.Scenario.named("epam").replace(effects={})
    base = planar.text.split("[effects")[0]
    planar = ibr.Scenario.from_toml(base)
    turned = planar.replace(actuator_azimuth_deg=90)
    [x, y], [a, b, c] = planar.predict(20).tip_mm, turned.predict(20).tip_mm
    assert np.allclose([a, b, c], [x, 0, y], rtol=0, atol=1e-6)


def test_measurements_in_space_are_compared(tmp_path, told):
    out = tmp_path / "made"
    told("data", "generate", ROBOT, "--protocol", "0/0,20/10,5/25,0/0@2", "--out", str(out))
    measured = ibr.data(str(out))
    assert {"z_mm", "p_act_1_kpa"} <= set(measured.table)
    found = ibr.compare(ROBOT, measured)
    assert "z" in found.residual_map["cells"][0][0]
    assert found.error_mm < 0.5 and found.noise_mm > 0.2 and "mm" in found.verdict
    assert found.overall == told("compare", ROBOT, str(out))["overall"]
    assert {"shapes", "shapes_z"} <= set(found.pictures()) and "Accuracy" in found.to_html()
    again = ibr.compare(ROBOT, measured.table)
    assert np.isclose(again.error_mm, found.error_mm, atol=1e-9)
    assert len(found.table["z_mm"]) == 4 * 6
    fitted = ibr.compare(ROBOT, measured, calibrate="bending")
    assert fitted.models[1]["bending_nm2"] < 0.1
    with pytest.raises(ibr.Error, match="planar"):
        ibr.diagnose("epam", measured)
    assert ibr.diagnose(ROBOT, measured).verdict == "none"


def test_it_is_drawn_from_two_sides():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    axes = ibr.Scenario.named(ROBOT).predict([20, 10]).plot()
    assert len(axes) == 2 and "z" in axes[1].get_ylabel()
    assert ibr.Scenario.named("epam").predict(20).plot().get_ylabel().startswith("y")


def test_what_is_planar_or_out_of_reach_is_refused():
    robot = ibr.Scenario.named(ROBOT)
    for ask in (lambda: robot.steer(tip_mm=(290, 130)), lambda: robot.inverse(tip_mm=150)):
        with pytest.raises(ibr.Error):
            ask()

"""Predictions are those of the command, to the bit; arrays have their shapes; faults say what to write."""

import threading

import ibr
import numpy as np
import pytest


def test_a_state_is_that_of_the_command(told):
    robot = ibr.Scenario.named("epam")
    answer = told("predict", "epam", "--pressure", "10kPa,20kPa,30kPa")["states"]
    assert [robot.predict(kpa).to_dict() for kpa in (10, 20, 30)] == answer
    state, wanted = robot.predict(20), answer[1]
    assert state.tip_mm.tolist() == [wanted["tip"]["x_mm"], wanted["tip"]["y_mm"]]
    assert state.angle_deg == wanted["tip"]["angle_deg"]
    assert state.markers_mm.tolist() == [[m["x_mm"], m["y_mm"]] for m in wanted["markers"]]
    assert (state.pressure_kpa, state.body_pressure_kpa) == (20, 2)


def test_a_centre_line_goes_from_the_base_to_the_tip():
    state = ibr.Scenario.named("spam").predict(25)
    assert state.curve_mm.shape == (101, 2)
    assert state.curve_mm[0].tolist() == [0, 0]
    assert np.allclose(state.curve_mm[-1], state.tip_mm, rtol=0, atol=1e-9)


def test_many_states_are_the_single_ones_whatever_the_threads():
    robot = ibr.Scenario.named("cpam")
    kpa = np.linspace(0, 30, 101)
    for threads in (1, 2, 7):
        many = robot.batch(kpa, threads=threads)
        assert len(many) == 101
        assert many.markers_mm.shape == (101, len(robot.stations_mm), 2)
        singles = [robot.predict(p) for p in kpa]
        assert many.tips_mm.tolist() == [s.tip_mm.tolist() for s in singles]
        assert many.angles_deg.tolist() == [s.angle_deg for s in singles]
        assert many.markers_mm.tolist() == [s.markers_mm.tolist() for s in singles]


def test_every_state_may_have_its_own_body_pressure():
    robot = ibr.Scenario.named("epam")
    many = robot.batch([10, 20], body_pressure_kpa=[2, 3])
    assert many.tips_mm[1].tolist() == robot.predict(20, body_pressure_kpa=3).tip_mm.tolist()
    assert many.tips_mm[0].tolist() == robot.predict(10).tip_mm.tolist()


def test_the_inverse_meets_its_target():
    robot = ibr.Scenario.named("epam")
    assert abs(robot.inverse(tip_mm=100).tip_mm[1] - 100) < 1e-6
    assert abs(robot.inverse(angle_deg=30).angle_deg - 30) < 1e-6


def test_several_channels_are_steered_together():
    zone = "\n[[zone]]\nfrom_mm = 180\nto_mm = 360\nchannel = 1\n"
    robot = ibr.Scenario.from_toml(ibr.Scenario.named("epam-textbook").text + zone)
    state, miss_mm = robot.steer(tip_mm=(290, 130))
    assert miss_mm < 1e-6 and np.allclose(state.tip_mm, (290, 130), atol=1e-6)
    assert state.channels_kpa[0] != state.channels_kpa[1]
    again = robot.predict(state.channels_kpa)
    assert again.tip_mm.tolist() == state.tip_mm.tolist()
    markers, miss_mm = robot.steer(markers_mm=robot.predict([12, 5]).markers_mm)
    assert miss_mm < 1e-6 and np.allclose(markers.channels_kpa[:2], (12, 5), atol=1e-3)
    near, miss_mm = robot.steer(tip_mm=(290, 130), now_kpa=[1, 1], change_kpa=0.5)
    assert near.channels_kpa[:2].max() <= 1.5 and miss_mm > 1
    with pytest.raises(ibr.Error, match="one aim"):
        robot.steer()


def test_slopes_are_those_of_differences_and_of_the_command(told):
    robot = ibr.Scenario.named("epam")
    slopes = robot.jacobian(20)
    assert slopes.shape == (4, 3)
    low, high = robot.predict(19.99), robot.predict(20.01)
    chord = [*(high.tip_mm - low.tip_mm), high.angle_deg - low.angle_deg]
    assert np.allclose(slopes.sum(axis=0), np.array(chord) / 0.02, rtol=1e-4)
    wanted = told("predict", "epam", "--pressure", "20kPa")["states"][0]["jacobian"][0]
    assert slopes[0].tolist() == [wanted["x_mm_per_kpa"], wanted["y_mm_per_kpa"], wanted["angle_deg_per_kpa"]]


def test_a_robot_with_history_is_followed(told):
    robot = ibr.Scenario.named("epam").replace(effects={"friction": {"moment_nm": 0.2}})
    assert robot.has_history
    path = robot.follow([5, 10, 15], [10, 30, 10])
    assert path.tips_mm[2, 1] > path.tips_mm[0, 1] + 1, "on the way back it stays more bent"
    typed = ("predict", "epam", "--effect", "friction:moment_nm=0.2", "--pressure", "10kPa,30kPa,10kPa")
    tips = [[s["tip"]["x_mm"], s["tip"]["y_mm"]] for s in told(*typed)["states"]]
    assert np.allclose(path.tips_mm, tips, rtol=0, atol=1e-9)
    assert robot.predict(10).tip_mm.tolist() == path.tips_mm[0].tolist()
    with pytest.raises(ibr.Error, match="follow"):
        robot.batch([10, 30])


def test_values_are_set_by_table_and_key():
    robot = ibr.Scenario.named("epam")
    wide = robot.replace(body_radius_mm=45, actuator={"width_mm": 62.5}, name="wide")
    assert wide.name == "wide" and "radius_mm = 45" in wide.text and "width_mm = 62.5" in wide.text
    assert wide.predict(20).tip_mm[1] != robot.predict(20).tip_mm[1]
    assert ibr.Scenario.from_toml(wide.text).predict(20).tip_mm.tolist() == wide.predict(20).tip_mm.tolist()
    assert robot.replace(markers_s_mm=np.array([100.0, 200.0])).stations_mm == [100, 200]


@pytest.mark.parametrize(
    "wish, said",
    [
        (lambda: ibr.Scenario.named("epan"), "epam"),
        (lambda: ibr.Scenario.named("epam").predict(-1), "actuator pressure must be from 0"),
        (lambda: ibr.Scenario.named("epam").predict(float("nan")), "write a number"),
        (lambda: ibr.Scenario.named("epam").predict([1] * 5), "4 supply channels"),
        (lambda: ibr.Scenario.named("epam").predict([10, 20]), "channel 1"),
        (lambda: ibr.Scenario.named("epam").batch([10, 2000]), "state 1 of the batch"),
        (lambda: ibr.Scenario.named("epam").batch(np.zeros((2, 5))), r"\(N, channels\)"),
        (lambda: ibr.Scenario.named("epam").batch([1, 2, 3], [1, 2]), "2 body pressures for 3"),
        (lambda: ibr.Scenario.named("epam").inverse(tip_mm=1000), "out of reach"),
        (lambda: ibr.Scenario.named("epam").inverse(), "tip_mm=100"),
        (lambda: ibr.Scenario.named("epam").follow([1], [1, 2]), "1 times for 2"),
        (lambda: ibr.Scenario.named("epam").follow([2, 1], [1, 2]), "is before 2 s"),
        (lambda: ibr.Scenario.named("epam").replace(body_radius_mn=40), "radius_mm"),
    ],
)
def test_a_fault_says_what_to_write(wish, said):
    with pytest.raises(ibr.Error, match=said) as fault:
        wish()
    assert isinstance(fault.value, ValueError)


def test_a_fault_of_a_file_has_its_place(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text(ibr.Scenario.named("epam").text.replace("radius_mm", "radius_nm", 1))
    line = 1 + next(i for i, text in enumerate(file.read_text().splitlines()) if "radius_nm" in text)
    with pytest.raises(ibr.Error) as fault:
        ibr.Scenario.from_toml(file)
    assert fault.value.where == f"{file}:{line}"
    assert str(fault.value).startswith(f"{file}:{line}: ") and "radius_nm" in str(fault.value)
    assert fault.value.help and fault.value.help in str(fault.value)


def test_python_goes_on_beside_a_batch():
    robot, done, counted = ibr.Scenario.named("epam"), threading.Event(), 0
    kpa = np.linspace(0, 30, 2_000_000)
    work = threading.Thread(target=lambda: (robot.batch(kpa, threads=1), done.set()))
    work.start()
    while not done.wait(0.005):
        counted += 1
    work.join()
    assert counted > 20, f"Python came to {counted} times"

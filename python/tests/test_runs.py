"""Finite element runs from Python: the command's numbers, frames as arrays, Ctrl-C."""

import _thread
import os
import signal
import subprocess
import sys
import threading
import time

import ibr
import numpy as np
import pytest

SMALL = {"actuator_mesh_mm": 12, "body_mesh_mm": 12, "body_ramp_s": 0.01, "actuator_ramp_s": 0.04, "pressures_kpa": [10]}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    shares = []
    run = ibr.simulate("epam", tmp_path_factory.mktemp("fe") / "run", changes=SMALL, progress=lambda _, s: shares.append(s))
    assert shares and shares[-1] == 1.0
    return run


def test_frames_are_arrays(run):
    first, last = run.frames[0], run.frames[-1]
    assert last.points.shape == (run.nodes, 3) and last.faces.shape[1] == 3
    assert len(last.triangles) + len(last.quads) == run.elements
    assert last.faces.max() < run.nodes and last.time_s == pytest.approx(run.time_s)
    assert np.abs(last.points - first.points).max() > 5, "nothing moved"
    assert max(last.pressures_kpa.values()) == pytest.approx(10, abs=0.5)
    assert run.table["pressure_kpa"].tolist()[-1] == 10 and run.table["tip_y_mm"][-1] > 5
    assert len(run.history["time_s"]) == len(run.frames)


def test_frames_are_what_vtk_reads(run):
    pyvista = pytest.importorskip("pyvista")
    frame = run.frames[-1]
    grid = pyvista.read(frame.path)
    assert np.array_equal(grid.points, frame.points) and grid.n_cells == run.elements
    assert np.array_equal(grid["von_mises_MPa"], frame.arrays["von_mises_MPa"])


def test_a_complete_run_is_read_again(run):
    again = ibr.Run.read(run.folder)
    assert again.steps == run.steps and again.table["tip_y_mm"].tolist() == run.table["tip_y_mm"].tolist()
    with pytest.raises(ibr.Error, match="force"):
        ibr.simulate("epam", run.folder, changes={**SMALL, "pressures_kpa": [20]})


def test_a_run_without_a_folder_keeps_its_frames_while_it_lives():
    run = ibr.simulate("epam", changes=SMALL, end_s=0.005)
    folder = run.folder
    assert len(run.frames) > 1 and folder.exists()
    del run
    assert not folder.exists()


def test_a_wrong_key_has_its_line():
    with pytest.raises(ibr.Error, match="actuator_mesh_mm") as fault:
        ibr.simulate("epam", changes={"actuator_mesh": 4})
    assert fault.value.where.startswith("epam:")


def test_what_progress_raises_ends_a_run_that_goes_on_later(run, tmp_path):
    class Enough(Exception):
        pass

    def stop(_, share):
        if share > 0.3:
            raise Enough

    with pytest.raises(Enough):
        ibr.simulate("epam", tmp_path / "run", changes=SMALL, progress=stop)
    resumed = ibr.simulate("epam", tmp_path / "run", changes=SMALL, resume=True)
    assert resumed.table["tip_y_mm"].tolist() == run.table["tip_y_mm"].tolist(), "the same bits"


def test_ctrl_c_ends_a_run_that_goes_on_later(run, tmp_path):
    """A finer mesh would take a minute; this one is stopped while it runs and goes on to the same bits."""
    begun = threading.Event()
    threading.Thread(target=lambda: (begun.wait(), _thread.interrupt_main())).start()
    slow = {**SMALL, "actuator_ramp_s": 2}
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        ibr.simulate("epam", tmp_path / "run", changes=slow, progress=lambda *_: begun.set())
    assert time.perf_counter() - start < 20
    with pytest.raises(ibr.Error, match="resume"):
        ibr.simulate("epam", tmp_path / "run", changes=slow)


def test_a_signal_ends_a_script(tmp_path):
    start = time.perf_counter()
    script = f"import ibr; ibr.simulate('epam', {str(tmp_path / 'run')!r}, progress=lambda *_: print('on', flush=True))"
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    child.stdout.readline()
    os.kill(child.pid, signal.SIGINT)
    _, said = child.communicate(timeout=60)
    assert child.returncode != 0 and "KeyboardInterrupt" in said and "panicked" not in said
    assert time.perf_counter() - start < 20


STUDY = """
scenario = "epam"
outputs = ["tip"]
[[vary]]
key = "actuator.length_mm"
values = [40, 50]
[[vary]]
key = "pressure_kpa"
values = [10, 20, 30]
"""


def test_a_sweep_is_the_prediction_of_every_robot(tmp_path):
    shares = []
    table = ibr.sweep(STUDY, tmp_path / "s", progress=lambda _, share: shares.append(share))
    assert shares[-1] == 1.0 and table["status"] == ["ok"] * 6
    for i, (length, kpa) in enumerate(zip(table["actuator.length_mm"], table["pressure_kpa"])):
        state = ibr.Scenario.named("epam").replace(actuator_length_mm=length).predict(kpa)
        assert table["tip_y_mm"][i] == pytest.approx(state.tip_mm[1], abs=1e-9)
    assert ibr.sweep(STUDY, tmp_path / "s")["tip_y_mm"].tolist() == table["tip_y_mm"].tolist()


def test_a_sweep_of_strips_round_the_body_has_a_third_coordinate(tmp_path):
    study = 'scenario = "epam-two-strips"\n[[vary]]\nkey = "pressure_kpa.0"\nvalues = [10, 20]\n' \
        '[[vary]]\nkey = "pressure_kpa.1"\nvalues = [20]\n'
    table = ibr.sweep(study, tmp_path / "s")
    assert "pressure_kpa" not in table and table["pressure_kpa.1"].tolist() == [20, 20]
    assert table["tip_y_mm"][1] == pytest.approx(table["tip_z_mm"][1]) and table["tip_z_mm"][0] > table["tip_y_mm"][0]


def test_a_wrong_study_has_its_line():
    with pytest.raises(ibr.Error, match="epan") as caught:
        ibr.sweep(STUDY.replace('"epam"', '"epan"'))
    assert caught.value.help

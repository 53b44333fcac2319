"""MJCF and URDF files of a folder in MuJoCo, compared with the predictions that have their names."""

import json
import pathlib
import sys

# This file has the name of the package that it uses.
sys.path.pop(0)
import mujoco  # noqa: E402

LIMIT_MM = 0.2
SETTLED_S = 2.0


def apart(place, answer):
    return max(abs(1e3 * place[0] - answer["x_mm"]), abs(1e3 * place[1] - answer["y_mm"]))


def mjcf(path):
    """How far the tip is from the prediction at the working point, and after settling from the straight robot."""
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_forward(model, data)
    angles, there = data.qpos.copy(), data.site("tip").xpos.copy()
    pressures = data.ctrl.copy()
    return angles, there, settled(model, data, pressures)


def settled(model, data, pressures):
    """The tip after a time at these pressures, from the straight robot."""
    mujoco.mj_resetData(model, data)
    data.ctrl[:] = pressures
    while data.time < SETTLED_S:
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return data.site("tip").xpos.copy()


def urdf(path, angles):
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    data.qpos[:] = angles
    mujoco.mj_forward(model, data)
    return data.body("tip").xpos.copy()


worst = {}
for path in sorted(pathlib.Path(".").glob("*.xml")):
    answer = json.loads(path.with_suffix(".json").read_text())["states"][0]["tip"]
    angles, there, rest = mjcf(path)
    places = {"working point": there, "settled": rest, "URDF": urdf(path.with_suffix(".urdf"), angles)}
    for what, place in places.items():
        key = (path.stem.split("-")[0], what)
        worst[key] = max(worst.get(key, 0.0), apart(place, answer))
for (robot, what), mm in worst.items():
    print(f"{robot:6} {what:14} {mm:.4f} mm")
for robot in ["spam", "cpam", "epam", "fpam"]:
    model = mujoco.MjModel.from_xml_path(f"{robot}-20.xml")
    for kpa in [10, 30]:
        answer = json.loads(pathlib.Path(f"{robot}-{kpa}.json").read_text())["states"][0]["tip"]
        print(f"{robot:6} exported at 20 kPa, at {kpa} kPa {apart(settled(model, mujoco.MjData(model), kpa), answer):.1f} mm off")
assert len(worst) == 15 and max(worst.values()) <= LIMIT_MM, "MuJoCo's tip is elsewhere"

"""The units plain.fmu and line.fmu in FMPy, compared with the streams plain.csv and line.csv."""

import csv
import shutil

import fmpy
import fmpy.validation
from fmpy.fmi3 import FMU3Slave

LIMIT_MM = 0.05
NAMES = {"tip_x_mm": "x_mm", "tip_y_mm": "y_mm", "angle_deg": "angle_deg", "p_arrived_kpa": "p0_kpa"}


def stepped(path, pressures):
    """Outputs of a unit after every step; a pressure acts from the time before on, as in the stream."""
    about = fmpy.read_model_description(path)
    folder = fmpy.extract(path)
    reference = {variable.name: variable.valueReference for variable in about.modelVariables}
    unit = FMU3Slave(guid=about.guid, unzipDirectory=folder, instanceName="one",
                     modelIdentifier=about.coSimulation.modelIdentifier)
    unit.instantiate()
    unit.enterInitializationMode(startTime=0.0)
    unit.exitInitializationMode()
    for k, pressure in enumerate(pressures):
        unit.setFloat64([reference["p_act_kpa"]], [pressure])
        if k > 0:
            unit.doStep(currentCommunicationPoint=(k - 1) / 100, communicationStepSize=0.01)
        yield unit.getFloat64([reference[name] for name in NAMES])
    unit.terminate()
    unit.freeInstance()
    shutil.rmtree(folder)


at_rest = None
for robot in ["plain", "line"]:
    faults = fmpy.validation.validate_fmu(f"{robot}.fmu")
    assert not faults, faults
    ran = fmpy.simulate_fmu(f"{robot}.fmu", stop_time=10.0, step_size=0.01, start_values={"p_act_kpa": 30.0})
    rows = list(csv.DictReader(line for line in open(f"{robot}.csv") if not line.startswith("#")))
    pressures = [0.0 if k < 20 else 30.0 if k < 60 else 12.0 for k in range(101)]
    answers = list(stepped(f"{robot}.fmu", pressures))
    assert len(rows) == len(answers) == 101
    worst = {name: max(abs(a[i] - float(row[column])) for a, row in zip(answers, rows))
             for i, (name, column) in enumerate(NAMES.items())}
    print(f"{robot}: largest differences from the stream:", ", ".join(f"{name} {v:.4f}" for name, v in worst.items()))
    assert max(worst.values()) < LIMIT_MM
    # Ten seconds at 30 kPa: the line has let all of it through.
    at_rest = at_rest or max(answer[1] for answer in answers)
    assert at_rest > 100.0 and abs(ran["tip_y_mm"][-1] - at_rest) < 0.01, (ran["tip_y_mm"][-1], at_rest)

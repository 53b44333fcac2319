"""Models of pneumatic bending actuators on inflated-beam robots, held against measurements.

    >>> import ibr
    >>> robot = ibr.Scenario.named("epam")
    >>> robot.predict(pressure_kpa=20)
    State(20.000 kPa: tip 303.07, 114.46 mm, 41.38 deg)

Pressures are gauge pressures in kPa, lengths mm, angles degrees, times seconds; x runs along the undeformed body from
its base, y towards the actuator. Where a scenario is asked for, a name, a path or a TOML text does; where data are, what
`data` takes. Every fault is an `Error` that says where it is and what to write. `python -m ibr` is the command line.
"""

from ._ibr import Data, Error, Scenario, State, States
from ._calls import (
    Comparison,
    Diagnosis,
    Extension,
    Validation,
    add,
    compare,
    data,
    diagnose,
    extend,
    import_tracks,
    validate,
)
from ._runs import Frame, Run, simulate, sweep

__all__ = [
    "Comparison", "Data", "Diagnosis", "Error", "Extension", "Frame", "Run", "Scenario", "State",
    "States", "Validation", "add", "compare", "data", "diagnose", "extend", "import_tracks", "simulate", "sweep",
    "validate",
]

Error.where = None
Error.help = None

"""Models of pneumatic bending actuators on inflated-beam robots, compared with measurements.

    >>> import ibr
    >>> robot = ibr.Scenario.named("epam")
    >>> robot.predict(pressure_kpa=20)
    State(20.000 kPa: tip 298.17, 120.00 mm, 43.85 deg)

Pressures are gauge pressures in kPa, lengths mm, angles degrees, times seconds; x runs along the undeformed body from
its base, y towards the actuator. Where a scenario is asked for, a name, a path or a TOML text does; where data are, what
`data` takes. Every fault is an `Error`, which is a ValueError, and says where it is and what to write; what is not there is a
FileNotFoundError too. `python -m ibr` is the command line.
"""

from ._calls import (
    Comparison,
    Diagnosis,
    Extension,
    Ladder,
    Validation,
    add,
    compare,
    data,
    diagnose,
    extend,
    import_tracks,
    ladder,
    validate,
)
from ._ibr import VERSION as __version__
from ._ibr import Data, Error, Scenario, State
from ._made import Design, Fabric, Pattern, characterize, datasets, design, effects, pattern, robots
from ._results import ExistsError, NotFoundError, Table
from ._runs import Frame, Run, simulate, sweep
from ._states import States

__all__ = [
    "Comparison", "Data", "Design", "Diagnosis", "Error", "ExistsError", "Extension", "Fabric", "Frame", "Ladder",
    "NotFoundError", "Pattern", "Run", "Scenario", "State", "States", "Table", "Validation", "__version__", "add",
    "characterize", "compare", "data", "datasets", "design", "diagnose", "effects", "extend", "import_tracks", "ladder",
    "pattern", "robots", "simulate", "sweep", "validate",
]

Error.where = None
Error.help = None
for _class in (Error, NotFoundError, ExistsError):
    _class.__module__ = "ibr"

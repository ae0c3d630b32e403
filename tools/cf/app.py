"""app.py - the names of the app's parameters and logs that these commands rely on, and are they there?"""

from .craft import Craft
from .errors import Failed
from .monitor import WATCHED

WEIGHTS = tuple(f"ceil.w{i}" for i in range(1, 8))
LEARNED = tuple(f"rls.w{i}" for i in range(1, 8))
OVER_GROUND = tuple(f"ground.w{i}" for i in range(1, 8))  # belong to the same set
STORED = (*WEIGHTS, *OVER_GROUND, "ceil.wSum")  # the sum comes last: only weights that were stored as a whole have it
FROM_NOTHING = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)  # a thrust ratio of 1 at any distance
COMMIT_TYPED, COMMIT_LEARNED = 1, 2  # ceil.commit
MODE_FIXED, MODE_LIVE = 1, 2  # ceil.mode
CONTROLLER = 6  # stabilizer.controller: the out-of-tree one
DECKS_ALL = 3  # ceil.decks

NO_APP = "this Crazyflie does not run the app; flash the app first, make firmware and make cload"

PARAMS = (
    *STORED,
    "ceil.commit",
    "ceil.mode",
    "ceil.min",
    "ceil.near",
    "ceil.blindMax",
    "ceil.shadow",
    "indiPos.mass",
    "indiPos.tauMot",
    "stabilizer.controller",
    "kalman.resetEstimation",
)
IDENTIFY = ("indiIn.step", "indi.total", "indiIn.az", "indiSet.z", "pm.vbat")  # rows of actuator.py
LOGS = (*LEARNED, *IDENTIFY, *(name for block in WATCHED for name in block.types))


def check(vehicle: Craft) -> None:
    """Failed: the Crazyflie runs another firmware."""
    params, logs = vehicle.params(), vehicle.logs()
    missing = [f"parameter {name}" for name in PARAMS if name not in params]
    missing += [f"log {name}" for name in LOGS if name not in logs]
    if missing:
        raise Failed(f"{missing[0]} is not there: {NO_APP}")

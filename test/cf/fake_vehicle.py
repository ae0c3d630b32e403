"""fake_vehicle.py - a Crazyflie with the app, as far as it can be seen over the radio: where it is, and its values.

Not physics: it goes where it is told to. Time is virtual; it passes in advance(). A test puts things wrong with
`on_step`, which is called every STEP_S with the vehicle.
"""

import math
from collections.abc import Callable

import declared

STEP_S = 0.05
WATCHDOG_S = 1.0
SENSOR_FLOOR_MM, NO_ECHO_MM = 40, 32767
ARMED, CAN_FLY, FLYING, TUMBLED, LOCKED = 1 << 1, 1 << 3, 1 << 4, 1 << 5, 1 << 6
LEARNED = (1.25, 0.5, -0.125, 0.0625, -0.25, -0.5, -0.75)  # exact in a float


class FakeVehicle:
    def __init__(self, names: declared.Declared, ceiling_m: float = 1.5) -> None:
        self.param_rows = names.params + declared.STOCK.params
        self.log_rows = names.logs + declared.STOCK.logs
        self.param = {row.name: row.initial for row in self.param_rows}
        self.logged = {row.name: 0.0 for row in self.log_rows}
        self.wrong: dict[str, float] = {}  # log values that lie, or tell of a fault
        self.stored: dict[str, float] = {}
        self.sent: list[tuple] = []  # what flew: ("take off", z, s), ("go to", ...), ("land", ...), ("stop",)
        self.writes: list[tuple[str, float]] = []
        self.fed = 0
        self.ceiling_m, self.time_s = ceiling_m, 0.0
        self.x_m, self.y_m, self.z_m, self.yaw_deg = 0.1, -0.2, 0.0, 30.0
        self._from_m = self._to_m = 0.0
        self._from_s, self._way_s = 0.0, 1.0
        self.flying = self.locked = self.landing = False
        self.taught = self.commits = self.refused = 0
        self.theta = [1.0] + 6 * [0.0]
        self.on_step: Callable[[FakeVehicle], None] = lambda _: None
        self.store_fails: set[str] = set()
        self.param["ceil.shadow"] = 0  # its user has seen enough of the shadow
        self.publish()

    @property
    def gap_m(self) -> float:
        return self.ceiling_m - self.z_m

    # --- what is asked of it ---------------------------------------------------------------------------------

    def write(self, name: str, value: float) -> None:
        self.writes.append((name, value))
        self.param[name] = value

    def judge(self) -> None:
        """What the app does a millisecond after a write."""
        weights = [self.param[f"ceil.w{i}"] for i in range(1, 8)]
        which, self.param["ceil.commit"] = self.param.get("ceil.commit", 0), 0
        learning = self.param.get("ceil.mode") == 2 and self.flying
        if which == 2 and not learning:
            for i, value in enumerate(self.theta):
                self.param[f"ceil.w{i + 1}"] = value
            self.commits += 1
        elif which == 1 and not learning and all(abs(w) <= 5 for w in weights):
            self.theta = weights
            self.commits += 1
            self.taught = 0
        elif which:
            self.refused += 1
        self.param["ceil.wSum"] = 1000 + self.commits  # another one for another set
        if not 0 <= self.param.get("ceil.min", 0) <= 0.5:
            self.param["ceil.min"] = declared_initial(self.param_rows, "ceil.min")

    def way(self, kind: str, z_m: float, duration_s: float, *more: float) -> None:
        self.sent.append((kind, round(z_m, 4), round(duration_s, 3), *more))
        self._from_m, self._to_m, self._from_s, self._way_s = self.z_m, z_m, self.time_s, duration_s
        self.landing = kind == "land"
        self.flying = not self.locked

    def stop(self) -> None:
        self.sent.append(("stop",))
        self.flying = False

    def emergency_stop(self) -> None:
        self.sent.append(("cut",))
        self.flying, self.locked, self.z_m = False, True, 0.0
        self.wrong["supervisor.info"] = ARMED | LOCKED

    def feed(self) -> None:
        self.fed += 1

    # --- time ------------------------------------------------------------------------------------------------

    def advance(self) -> None:
        self.time_s += STEP_S
        share = min((self.time_s - self._from_s) / self._way_s, 1.0)
        if self.flying:
            self.z_m = self._from_m + share * (self._to_m - self._from_m)
            if self.landing and share >= 1.0:
                self.flying = False
            if self.param.get("ceil.mode") == 2 and self.gap_m < 0.105:
                self.taught += round(100 * STEP_S)
                self.theta = list(LEARNED)
        self.on_step(self)
        self.publish()

    def publish(self) -> None:
        seen = self.flying and self.gap_m < 0.5
        bits = ARMED | CAN_FLY | (FLYING if self.flying else 0) | (LOCKED if self.locked else 0)
        now = {
            "stateEstimate.x": self.x_m,
            "stateEstimate.y": self.y_m,
            "stateEstimate.z": self.z_m,
            "stateEstimate.yaw": self.yaw_deg,
            "ceil.known": seen,
            "ceil.zc": self.gap_m if seen else 0.0,
            "ceil.height": self.ceiling_m if seen else math.nan,
            "ceil.decks": 3,
            "ceil.commits": self.commits,
            "ceil.noCommit": self.refused,
            "rls.taught": self.taught,
            "range.up": max(round(1000 * self.gap_m), SENSOR_FLOOR_MM),
            "pm.vbat": 4.1,
            "supervisor.info": bits,
        } | {f"rls.w{i + 1}": self.theta[i] for i in range(7)}
        self.logged.update({name: value for name, value in (now | self.wrong).items() if name in self.logged})


def declared_initial(rows: tuple[declared.Row, ...], name: str) -> float:
    return next(row.initial for row in rows if row.name == name)

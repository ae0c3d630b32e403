"""flight.py - up to the ceiling, from gap to gap, and down again, through the high-level commander.

Gaps are from the propellers to the ceiling. The ceiling's height is the app's own (ceil.height, latched beyond
20 cm), in the frame of the height that is commanded. Whatever goes wrong in the air: it lands, then says why.
"""

import math
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Event

from . import preflight
from .craft import Craft
from .errors import Failed, LinkLost, Stopped
from .monitor import Monitor
from .reasons import ACTIONS, GUARD, RETREAT, words
from .stop_key import stop_key
from .terminal import progress, say

APPROACH_M = 0.40  # the first hover: the ceiling is in sight, and far
FAR_M = 0.20  # the far hover (thesis section 5.3)
LOWEST_M = 0.30  # no hover nearer to the floor
CLIMB_MPS, NEAR_MPS, SINK_MPS = 0.3, 0.1, 0.3  # mean speeds of the high-level commander's smooth paths
LOST_S = 1.0  # a range sensor or a ceiling that is missing for so long is lost
STEADY_M = 0.05  # the latched height may change by this during a flight
PERIOD_S = 0.05
ENDS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
PM_LOW = 3  # pm.state: low power; higher values are worse


@dataclass(frozen=True)
class Plan:
    gaps_m: tuple[float, ...]  # after the far hover
    hold_s: float  # at each gap
    battery_V: float  # minimum before take-off


@contextmanager
def deferred() -> Iterator[list[int]]:
    """Ctrl-C interrupts nothing: it is noted, for who looks."""
    ends: list[int] = []
    old = {kind: signal.signal(kind, lambda kind, _: ends.append(kind)) for kind in ENDS}
    try:
        yield ends
    finally:
        for kind, handler in old.items():
            signal.signal(kind, handler)


class Flight:
    def __init__(self, vehicle: Craft, now: Monitor, plan: Plan, ends: list[int], pressed: Event) -> None:
        """ends: not empty once somebody wants it down. pressed: the motors were cut by hand."""
        self._pressed = pressed
        self._vehicle, self._now, self._plan, self._ends = vehicle, now, plan, ends
        self._floor_m = now["stateEstimate.z"]
        self._x_m, self._y_m = now["stateEstimate.x"], now["stateEstimate.y"]
        self._yaw_rad = preflight.yaw_rad(now)
        self._z_m = self._floor_m  # commanded
        self._ceiling_m = math.nan  # as first seen
        self._well_s = {"range": vehicle.now(), "ceiling": vehicle.now()}

    # --- watching --------------------------------------------------------------------------------------------

    def _old(self, what: str, well: bool) -> bool:
        """True once it has not been well for LOST_S."""
        if well:
            self._well_s[what] = self._vehicle.now()
        return self._vehicle.now() - self._well_s[what] > LOST_S

    def _trouble(self) -> str:
        now = self._now
        if now["guard.action"] >= RETREAT:
            action = ACTIONS[min(int(now["guard.action"]), len(ACTIONS) - 1)]
            return f"the app does its own ({action}): {words(int(now['guard.now'] or now['guard.latched']), GUARD)}"
        if now.bit(preflight.TUMBLED) or now.bit(preflight.CRASHED) or now.bit(preflight.LOCKED):
            return "the Crazyflie has crashed"
        if now["pm.state"] >= PM_LOW:
            return f"the battery is low ({now['pm.vbat']:.2f} V)"
        if self._old("range", int(now["range.up"]) in preflight.RANGE_MM):
            return "the range sensor is lost"
        if self._old("ceiling", bool(now["ceil.known"]) or math.isnan(self._ceiling_m)):
            return "the ceiling is not seen any more"
        if abs(now["ceil.height"] - self._ceiling_m) > STEADY_M:
            return f"the ceiling's height went from {self._ceiling_m:.3f} to {now['ceil.height']:.3f} m"
        return ""

    def _cut(self) -> None:
        if self._pressed.is_set():
            raise Stopped("stopped by hand: the motors were cut, and it fell from where it was")

    def _sees_ceiling(self) -> bool:
        return bool(self._now["ceil.known"]) and math.isfinite(self._now["ceil.height"])

    def wait(self, duration_s: float, what: str, done: Callable[[], bool] = lambda: False) -> bool:
        """Watches for so long, or until done. Failed: something is wrong. LinkLost: nobody there."""
        end_s = self._vehicle.now() + duration_s
        while self._vehicle.now() < end_s:
            if done():
                return True
            now = self._now
            near = f"{100 * now['ceil.zc']:.1f} cm to the ceiling" if now["ceil.known"] else "no ceiling"
            left_s = end_s - self._vehicle.now()
            progress(f"{what}: z {now['stateEstimate.z']:.3f} m, {near}, {now['pm.vbat']:.2f} V, {left_s:.0f} s left")
            self._vehicle.sleep(PERIOD_S)
            self._cut()
            if self._ends:
                raise KeyboardInterrupt
            for line in self._vehicle.said():
                say(f"console: {line}")
            now.alive()
            trouble = self._trouble()
            if trouble:
                raise Failed(trouble)
        return done()

    # --- the way ---------------------------------------------------------------------------------------------

    def up(self) -> None:
        """Take-off, until the app has latched the ceiling's height; then the far hover."""
        ceiling_m = preflight.height_m(self._now)
        approach_m = max(ceiling_m - APPROACH_M, self._floor_m + LOWEST_M)
        duration_s = max((approach_m - self._floor_m) / CLIMB_MPS, 2.0)
        say(f"take-off to {approach_m:.2f} m; the ceiling is {ceiling_m:.2f} m above the floor")
        self._vehicle.feed(True)
        self._vehicle.take_off(approach_m, duration_s)
        self._z_m = approach_m
        self.wait(duration_s, "take-off")
        if not self.wait(5.0, "looking for the ceiling", self._sees_ceiling):
            raise Failed("the ceiling is not seen (ceil.known)")
        self.wait(2.0, "latching the ceiling's height")
        self._ceiling_m = self._now["ceil.height"]
        if abs(self._ceiling_m - ceiling_m) > 3 * STEADY_M:
            raise Failed(f"the ceiling is at {ceiling_m:.2f} m from the floor, at {self._ceiling_m:.2f} m from the air")
        self.to(FAR_M)

    def to(self, gap_m: float) -> None:
        """To this gap, and stays there for hold_s."""
        z_m = self._now["ceil.height"] - gap_m
        duration_s = max(abs(z_m - self._z_m) / NEAR_MPS, 1.5)
        say(f"{100 * gap_m:g} cm below the ceiling: z {z_m:.3f} m in {duration_s:.1f} s, then {self._plan.hold_s:g} s")
        self._vehicle.go_to(self._x_m, self._y_m, z_m, self._yaw_rad, duration_s)
        self._z_m = z_m
        self.wait(duration_s + self._plan.hold_s, f"{100 * gap_m:g} cm")

    def hop(self, by_m: float, duration_s: float, rest_s: float, what: str) -> None:
        """So much higher, and stays there for rest_s."""
        self._z_m += by_m
        self._vehicle.go_to(self._x_m, self._y_m, self._z_m, self._yaw_rad, duration_s)
        self.wait(duration_s + rest_s, what)

    def land(self) -> None:
        """Down, and motors off. LinkLost: unseen, or not at all."""
        high_m = max(self._z_m, self._now["stateEstimate.z"]) - self._floor_m  # the commanded height is always a number
        duration_s = max(2.0, high_m / SINK_MPS)
        say(f"landing in {duration_s:.1f} s")
        try:
            self._vehicle.land(self._floor_m, duration_s)
            seen = self._until_down(duration_s)
            self._vehicle.stop()
            self._vehicle.sleep(0.5)
        except LinkLost as lost:
            raise LinkLost(f"{lost}: the app lands it where it is, then the firmware's watchdog locks it") from None
        if not seen:
            raise LinkLost("no log packets came while it was told to land: look where it is")

    def _until_down(self, duration_s: float) -> bool:
        """Waits, with the watchdog fed. False: nothing came back, but what was sent may have arrived."""
        seen = True
        end_s = self._vehicle.now() + duration_s + 3.0
        while self._vehicle.now() < end_s and (not seen or self._now.bit(preflight.FLYING)):
            progress(f"landing: z {self._now['stateEstimate.z']:.3f} m")
            self._vehicle.sleep(PERIOD_S)
            self._cut()
            self._vehicle.alive()
            seen = self._now.fresh()
        self._cut()
        return seen


def fly(vehicle: Craft, now: Monitor, plan: Plan, then: Callable[[Flight], None] = lambda _: None) -> None:
    """The whole way, and after the gaps what else. Failed, KeyboardInterrupt: it has landed. LinkLost: it may have.
    Stopped: it fell."""
    with stop_key(vehicle) as pressed:
        preflight.arm(vehicle, now)
        _fly(vehicle, now, plan, then, pressed)


def _fly(vehicle: Craft, now: Monitor, plan: Plan, then: Callable[[Flight], None], pressed: Event) -> None:
    with deferred() as ends:
        flight = Flight(vehicle, now, plan, ends, pressed)
        try:
            flight.up()
            for gap_m in plan.gaps_m:
                flight.to(gap_m)
            then(flight)
        except Stopped:
            raise
        except BaseException as why:
            say(f"{str(why) or 'interrupted'}")
            flight.land()
            raise
        flight.land()

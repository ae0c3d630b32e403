"""dry.py - prints what would be sent, and plays a vehicle to which nothing happens but what is asked for.

Needs no library, no radio and no time.
"""

import math
from typing import Any

from .app import DECKS_ALL, WEIGHTS
from .blocks import Block
from .craft import Param, Take
from .terminal import say

FLYING, ARMED, CAN_FLY = 1 << 4, 1 << 1, 1 << 3  # supervisor.info
FAR_M = 0.5  # ceil.far
TAUGHT_HZ = 100


class _Any(dict):
    """Every name is there."""

    absent: object

    def __contains__(self, name: object) -> bool:
        return True

    def __missing__(self, name: str):
        return self.absent


class AnyParam(_Any):
    absent = Param("float", True, True, 0.0)


class AnyLog(_Any):
    absent = "float"


class DryVehicle:
    def __init__(self, ceiling_m: float) -> None:
        self._ceiling_m, self._time_s = ceiling_m, 0.0
        self._z_m = self._from_m = self._to_m = 0.0
        self._from_s, self._way_s = 0.0, 1.0
        self._flying = self._fed = False
        self._streams: list[tuple[Block, Take]] = []
        self._counts = {"ceil.commits": 0, "ceil.noCommit": 0, "rls.taught": 0}
        self._values = dict.fromkeys(WEIGHTS, 0.0) | {
            "stabilizer.controller": 6,
            "ceil.mode": 1,
            "ceil.min": 0.02,
            "ceil.near": 0.05,
            "ceil.blindMax": 3.0,
        }

    def _would(self, text: str) -> None:
        say(f"{self._time_s:6.1f} s  {text}")

    # --- time ------------------------------------------------------------------------------------------------

    def now(self) -> float:
        return self._time_s

    def sleep(self, duration_s: float) -> None:
        self._time_s += duration_s
        share = min((self._time_s - self._from_s) / self._way_s, 1.0)
        self._z_m = self._from_m + share * (self._to_m - self._from_m)
        if self._z_m <= 0.0 and share >= 1.0:
            self._flying = False
        if self._flying and self._ceiling_m - self._z_m < 0.101:
            self._counts["rls.taught"] += round(TAUGHT_HZ * duration_s)
        for block, take in self._streams:
            take(block.name, round(1000 * self._time_s), {name: self._log(name) for name in block.types})

    def _log(self, name: str) -> float:
        gap_m = self._ceiling_m - self._z_m
        seen = self._flying and gap_m < FAR_M
        told = {
            "stateEstimate.z": self._z_m,
            "range.up": max(round(1000 * gap_m), 40),
            "ceil.known": int(seen),
            "ceil.zc": gap_m if seen else 0.0,
            "ceil.height": self._ceiling_m if seen else math.nan,
            "ceil.decks": DECKS_ALL,
            "pm.vbat": 4.1,
            "supervisor.info": ARMED | CAN_FLY | (FLYING if self._flying else 0),
        } | self._counts
        if name.startswith("rls.w"):
            return self._values["ceil." + name[4:]]
        return told.get(name, 0)

    # --- as craft.Craft -------------------------------------------------------------------------------------

    def alive(self) -> None:
        pass

    def close(self) -> None:
        pass

    def said(self) -> list[str]:
        return []

    def params(self) -> AnyParam:
        return AnyParam()

    def logs(self) -> AnyLog:
        return AnyLog()

    def get(self, name: str) -> float:
        return self._values.get(name, 0.0)

    def set(self, name: str, value: float) -> None:
        self._would(f"set {name} = {value:.7g}")
        self._values[name] = value
        if name == "ceil.commit":
            self._counts["ceil.commits"] += 1
            self._values[name] = 0

    def store(self, name: str) -> None:
        self._would(f"store {name}")

    def stream(self, block: Block, take: Take) -> Any:
        self._would(f"log {' '.join(block.types)} every {block.period_ms} ms")
        self._streams.append((block, take))
        return self._streams[-1]

    def quiet(self, stream: Any) -> None:
        self._streams.remove(stream)

    def arm(self) -> None:
        self._would("arm")

    def _way(self, z_m: float, duration_s: float) -> None:
        self._from_m, self._to_m, self._from_s, self._way_s = self._z_m, z_m, self._time_s, duration_s
        self._flying = True

    def take_off(self, z_m: float, duration_s: float) -> None:
        self._would(f"take off to z {z_m:.3f} m in {duration_s:.1f} s")
        self._way(z_m, duration_s)

    def go_to(self, x_m: float, y_m: float, z_m: float, yaw_rad: float, duration_s: float) -> None:
        self._would(f"go to x {x_m:.3f} y {y_m:.3f} z {z_m:.3f} m, yaw {yaw_rad:.2f} rad in {duration_s:.1f} s")
        self._way(z_m, duration_s)

    def land(self, z_m: float, duration_s: float) -> None:
        self._would(f"land at z {z_m:.3f} m in {duration_s:.1f} s")
        self._way(z_m, duration_s)

    def stop(self) -> None:
        self._would("stop the motors")

    def cut(self) -> None:
        self._would("cut the motors")

    def feed(self, on: bool) -> None:
        self._would("feed the watchdog five times a second" if on else "feed the watchdog no more")
        self._fed = on

    def fed(self) -> bool:
        return self._fed

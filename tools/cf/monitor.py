"""monitor.py - what the vehicle says of itself, ten times a second: the last values, and how old they are."""

from .blocks import Block
from .craft import Craft
from .errors import LinkLost

PERIOD_MS = 100
STALE_S = 1.0  # without a packet for this long the link is taken as lost
WATCHED = (
    Block(
        "watch1",
        PERIOD_MS,
        {
            "stateEstimate.z": "float",
            "ceil.height": "float",
            "ceil.zc": "float",
            "pm.vbat": "float",
            "guard.now": "uint32_t",
            "range.up": "uint16_t",
            "ceil.known": "uint8_t",
            "guard.action": "uint8_t",
            "pm.state": "int8_t",
        },
    ),
    Block(
        "watch2",
        PERIOD_MS,
        {
            "stateEstimate.x": "float",
            "stateEstimate.y": "float",
            "stateEstimate.yaw": "float",
            "rls.taught": "uint32_t",
            "guard.notFlyable": "uint32_t",
            "supervisor.info": "uint16_t",
            "ceil.decks": "uint8_t",
        },
    ),
    Block("watch3", PERIOD_MS, {"guard.latched": "uint32_t", "ceil.commits": "uint32_t", "ceil.noCommit": "uint32_t"}),
)


class Monitor:
    def __init__(self, vehicle: Craft) -> None:
        self._vehicle = vehicle
        self._values: dict[str, float] = {}
        self._came_s = {block.name: vehicle.now() for block in WATCHED}
        self._streams = [vehicle.stream(block, self._take) for block in WATCHED]
        end_s = vehicle.now() + STALE_S
        while len(self._values) < sum(len(block.types) for block in WATCHED):
            vehicle.sleep(0.05)
            if vehicle.now() > end_s:
                raise LinkLost("no log packets come")

    def _take(self, block: str, _stamp_ms: int, values: dict[str, float]) -> None:
        self._values.update(values)
        self._came_s[block] = self._vehicle.now()

    def __getitem__(self, name: str) -> float:
        return self._values[name]

    def bit(self, number: int) -> bool:
        """Of supervisor.info."""
        return bool(int(self._values["supervisor.info"]) >> number & 1)

    def fresh(self) -> bool:
        """Each block came within STALE_S."""
        return self._vehicle.now() - min(self._came_s.values()) <= STALE_S

    def alive(self) -> None:
        """LinkLost: nothing came for STALE_S."""
        self._vehicle.alive()
        if not self.fresh():
            raise LinkLost(f"the link is lost (no log packet for {STALE_S:g} s)")

    def close(self) -> None:
        for stream in self._streams:
            self._vehicle.quiet(stream)

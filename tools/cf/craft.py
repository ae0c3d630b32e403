"""craft.py - what the commands ask of a Crazyflie. vehicle.py is one over a link, dry.py one that only says it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from .blocks import Block


@dataclass(frozen=True)
class Param:
    kind: str  # uint8_t ... float
    writable: bool
    persistent: bool
    value: float


Take = Callable[[str, int, dict[str, float]], None]  # block, time stamp in ms, values


class Craft(Protocol):
    """Each call that needs an answer waits for it, and raises LinkLost where none comes."""

    def now(self) -> float:
        """Seconds."""

    def sleep(self, duration_s: float) -> None: ...

    def alive(self) -> None:
        """Raises LinkLost where the link is lost."""

    def said(self) -> list[str]:
        """Lines of its console since the last call."""

    # --- parameters and logs
    def params(self) -> Mapping[str, Param]: ...

    def get(self, name: str) -> float:
        """Asks the vehicle, not a memory of it."""

    def set(self, name: str, value: float) -> None: ...

    def store(self, name: str) -> None:
        """Keeps the value of a persistent parameter when the power goes. Failed: it could not."""

    def logs(self) -> Mapping[str, str]:
        """Type of each log variable."""

    def stream(self, block: Block, take: Take) -> Any:
        """Starts a log block; take is called for each packet, by another thread. The result is for quiet()."""

    def quiet(self, stream: Any) -> None:
        """Stops a log block. Does nothing where the link is lost."""

    # --- flight: heights are those of the estimator
    def arm(self) -> None: ...

    def take_off(self, z_m: float, duration_s: float) -> None: ...

    def go_to(self, x_m: float, y_m: float, z_m: float, yaw_rad: float, duration_s: float) -> None: ...

    def land(self, z_m: float, duration_s: float) -> None: ...

    def stop(self) -> None: ...

    def cut(self) -> None:
        """Stops the motors at once, also in the air; the Crazyflie must be restarted. Of any thread; never raises."""

    def feed(self, on: bool) -> None:
        """Feeds the firmware's watchdog from now on, or no more. Once it starves, whether this program died or the
        link was lost, the app lands (src/firmware/radio.h) and the Crazyflie must be restarted."""

    def fed(self) -> bool: ...

    def close(self) -> None: ...

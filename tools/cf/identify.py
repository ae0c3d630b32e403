"""identify.py - hops of 2.5 cm for 20 s, 20 cm below the ceiling: how late the motors follow, as parameters of the app."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from . import app, preflight
from .blocks import Block
from .craft import Craft
from .errors import Failed
from .flight import Flight, Plan, fly
from .ladder import recorded, watched
from .monitor import Monitor
from .terminal import say

HOP_M = 0.025  # a fifth of the weight, up and down: with more, thrust is no longer a straight line
HOP_S, REST_S = 0.35, 0.45  # as fast as the lag; until it has settled
HOPS = 12
HOVER_S = 1.0  # before the hops
HEIGHT_DELAY_MAX_S = 0.0145  # upper bound of height.delay
BLOCK = Block(
    "identify", 10, {name: "uint32_t" if name == "indiIn.step" else "float" for name in app.IDENTIFY}
)


@dataclass
class _Seen:
    """Packets as they come, and in which hop."""

    record: Callable[..., None]
    hop: int = -1
    rows: list[tuple[float, ...]] = field(default_factory=list)

    def take(self, block: str, stamp_ms: int, values: dict[str, float]) -> None:
        self.record(block, stamp_ms, values)
        if self.hop >= 0:
            self.rows.append((*(values[name] for name in app.IDENTIFY), self.hop))


def _hops(flight: Flight, seen: _Seen) -> None:
    say(f"{HOPS} hops of {100 * HOP_M:g} cm")
    for hop in range(HOPS):
        seen.hop = hop
        for by_m in (-HOP_M, HOP_M):
            flight.hop(by_m, HOP_S, REST_S, f"hop {hop + 1} of {HOPS}")
    seen.hop = -1


def libraries() -> None:
    """Failed: what the fit needs is not there; better before the flight than after it."""
    try:
        from . import actuator  # noqa: F401
    except ImportError as why:
        raise Failed(f"{why.name} is missing: make setup-cf, then out/cf/bin/python tools/cf.py ...") from None


def hop_rows(vehicle: Craft, plan: Plan, log: Path | None) -> list[tuple[float, ...]]:
    """Flies, and gives what came while it hopped."""
    app.check(vehicle)
    if vehicle.get("ceil.shadow"):
        raise Failed("ceil.shadow is 1: the stock controller flies, and what the app commands is not flown; allowed is 0")
    with recorded(vehicle, log, BLOCK) as record:
        seen = _Seen(record)
        now = Monitor(vehicle)
        preflight.reset_estimator(vehicle)
        preflight.check(vehicle, now, plan.battery_V)
        stream = vehicle.stream(BLOCK, seen.take)
        with watched(vehicle):
            fly(vehicle, now, plan, lambda flight: _hops(flight, seen))
        vehicle.quiet(stream)
    return seen.rows


def tell(vehicle: Craft, rows: list[tuple[float, ...]]) -> None:
    """What the rows say, and what to set. Failed: nothing."""
    from . import actuator  # numpy and scipy: a dry run needs neither

    of = actuator.identify(actuator.rows_of(rows))
    say(f"motor lag   {1000 * of.lag_s.value:6.1f} +- {1000 * of.lag_s.error:.1f} ms")
    say(f"motor delay {1000 * of.delay_s.value:6.1f} +- {1000 * of.delay_s.error:.1f} ms")
    say(f"the thrust moves {1000 * of.mass_kg.value:.1f} +- {1000 * of.mass_kg.error:.1f} g "
        f"(indiPos.mass is {1000 * vehicle.get('indiPos.mass'):.1f} g)")
    say(f"cf params set indiPos.tauMot={of.lag_s.value:.3f}    # is {vehicle.get('indiPos.tauMot'):g}")
    delay_s = max(of.delay_s.value, 0.0)
    if delay_s > HEIGHT_DELAY_MAX_S:
        say(f"height.own 1 is not for this vehicle: height.delay goes to {1000 * HEIGHT_DELAY_MAX_S:g} ms")
    else:
        say(f"cf params set height.tauMot={of.lag_s.value:.3f} height.delay={delay_s:.4f}    # of the own height filter")

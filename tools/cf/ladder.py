"""ladder.py - learn and test-flight: what they change before a flight, what they fly, what they keep."""

import math
from contextlib import contextmanager
from pathlib import Path

from . import app, blocks, preflight
from .craft import Craft
from .errors import Failed, LinkLost, Refused
from .flight import FAR_M, NEAR_MPS, Plan, fly, deferred
from .monitor import Monitor
from .record import Record
from .terminal import say
from .weights import set_weights, store_weights, take_learned

CONFIGS = Path(__file__).resolve().parent.parent / "cfclient"
LEARN_M = (0.10, 0.08, 0.06, 0.04, 0.02)  # thesis section 5.3
TAUGHT_MIN = 500  # samples, at 100 per second; fewer do not make a curve
SAME_M = 1e-4  # float parameters are not exact
STOCK_NEAREST_M = 0.06  # in README's flights the stock controller touches at 5 cm in each, at 6 cm in none


@contextmanager
def changed(vehicle: Craft, values: dict[str, float]):
    """Parameters as they are to be for a flight; afterwards as they were, unless the link is lost."""
    old = {name: vehicle.get(name) for name in values}
    try:
        for name, value in values.items():
            vehicle.set(name, value)
        yield
    finally:
        with deferred():
            try:
                for name, value in old.items():
                    vehicle.set(name, value)
            except LinkLost:
                names = ", ".join(f"{name} (was {value:g})" for name, value in old.items())
                say(f"not put back, until the Crazyflie is restarted: {names}")


@contextmanager
def recorded(vehicle: Craft, file: Path | None, *of_caller: blocks.Block):
    """Everything that the cfclient configurations name, into a file, and what the caller streams: what it gets is to be
    called with those packets."""
    if not file:
        yield lambda *_: None
        return
    chosen = blocks.read(CONFIGS / "flying") + blocks.read(CONFIGS / "learning")
    record, streams, whole = Record("--log", file, [*chosen, *of_caller]), [], True
    try:
        streams += [vehicle.stream(block, record.take) for block in chosen]
        yield record.take
    except LinkLost:
        whole = False
        raise
    finally:
        with deferred():
            for stream in streams:
                vehicle.quiet(stream)
            name = record.end(whole)
            if name:
                say(f"{record.rows} rows in {name}" + (f" ({record.trouble})" if record.trouble else ""))


@contextmanager
def watched(vehicle: Craft):
    """The firmware's watchdog is fed from take-off on; once nobody feeds it, it locks the Crazyflie."""
    try:
        yield
    finally:
        if vehicle.fed():
            vehicle.feed(False)
            say("restart the Crazyflie before the next flight: its watchdog locks it when a flight is over")


def blind_s(vehicle: Craft, plan: Plan) -> dict[str, float]:
    """Below the range sensor's floor the app gives up after ceil.blindMax; this plan stays there for longer."""
    near_m = vehicle.get("ceil.near") + 0.01
    ways = [plan.hold_s + FAR_M / NEAR_MPS for gap_m in plan.gaps_m if gap_m <= near_m]
    need_s = math.ceil(sum(ways) + 5.0)
    return {"ceil.blindMax": need_s} if need_s > vehicle.get("ceil.blindMax") else {}


def learn(vehicle: Craft, plan: Plan, log: Path | None) -> None:
    app.check(vehicle)
    if vehicle.get("ceil.shadow"):
        raise Failed("ceil.shadow is 1: the stock controller flies, which the ceiling captures; allowed is 0")
    keep_out_m = vehicle.get("ceil.min")
    gaps_m = tuple(gap for gap in LEARN_M if gap >= keep_out_m - SAME_M)
    if not gaps_m:
        raise Refused(f"ceil.min is {keep_out_m:g} m: nothing to learn; allowed are up to {LEARN_M[0]:g} m")
    if gaps_m != LEARN_M:
        say(f"stops at {100 * gaps_m[-1]:g} cm: the keep-out, ceil.min, is {100 * keep_out_m:g} cm")
    plan = Plan(gaps_m, plan.hold_s, plan.battery_V)
    with recorded(vehicle, log):
        now = Monitor(vehicle)
        preflight.reset_estimator(vehicle)
        preflight.check(vehicle, now, plan.battery_V)
        with watched(vehicle):
            _learn(vehicle, now, plan)
            with deferred():
                store_weights(vehicle)


def _learn(vehicle: Craft, now: Monitor, plan: Plan) -> None:
    """Flies with nothing learned, and takes what was; the weights of before where that fails."""
    old = tuple(vehicle.get(name) for name in app.WEIGHTS)
    try:
        with changed(vehicle, {"ceil.mode": app.MODE_LIVE, **blind_s(vehicle, plan)}):
            set_weights(vehicle, now, app.FROM_NOTHING)
            vehicle.sleep(0.3)  # until the count is the one after the commit
            taught = now["rls.taught"]
            fly(vehicle, now, plan)
        taught = now["rls.taught"] - taught
        if taught < TAUGHT_MIN:
            raise Failed(f"{taught:g} samples taught the curve; allowed are {TAUGHT_MIN} and more")
        with deferred():
            take_learned(vehicle, now)
    except LinkLost:
        raise
    except BaseException:
        with deferred():
            set_weights(vehicle, now, old)
        say("the weights are those of before the flight")
        raise


def test_flight(vehicle: Craft, plan: Plan, log: Path | None) -> None:
    app.check(vehicle)
    keep_out_m = vehicle.get("ceil.min")
    shadow = bool(vehicle.get("ceil.shadow"))
    least_m = max(keep_out_m, STOCK_NEAREST_M) if shadow else keep_out_m
    for gap_m in plan.gaps_m:
        if gap_m < least_m - SAME_M:
            why = "with ceil.shadow 1 the stock controller flies" if shadow else "the keep-out, ceil.min"
            raise Refused(
                f"--gaps {100 * gap_m:g}: nearer than {100 * least_m:g} cm ({why}); "
                f"allowed are {100 * least_m:g} to {100 * FAR_M:g} cm"
            )
    with recorded(vehicle, log):
        now = Monitor(vehicle)
        preflight.reset_estimator(vehicle)
        preflight.check(vehicle, now, plan.battery_V)
        with watched(vehicle), changed(vehicle, blind_s(vehicle, plan)):
            fly(vehicle, now, plan)
    say(f"flown; latched reasons of the guard: {int(now['guard.latched']):#x}")

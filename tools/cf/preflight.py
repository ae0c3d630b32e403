"""preflight.py - may it fly? Everything that speaks against it, before anything turns."""

import math

from . import app
from .craft import Craft
from .errors import Failed
from .monitor import Monitor
from .reasons import DECKS, FLYABLE, words

CEILING_M = (0.6, 3.0)  # height of the ceiling over the vehicle on the floor
RANGE_MM = range(1, 4000)  # range.up outside of it is no distance
SETTLE_S = 2.0  # for the estimator after its reset
FLOOR_M = 0.1  # on the floor the height is this near to zero
CAN_BE_ARMED, ARMED, CAN_FLY, FLYING, TUMBLED, LOCKED, CRASHED = 0, 1, 3, 4, 5, 6, 7  # supervisor.info
PM_ON_BATTERY = 0  # pm.state


def reset_estimator(vehicle: Craft) -> None:
    vehicle.set("kalman.resetEstimation", 1)
    vehicle.sleep(0.1)
    vehicle.set("kalman.resetEstimation", 0)
    vehicle.sleep(SETTLE_S)


def _of_the_vehicle(now: Monitor, battery_V: float) -> list[str]:
    wrong = []
    missing = app.DECKS_ALL & ~int(now["ceil.decks"])
    if missing:
        wrong.append(f"missing: {words(missing, DECKS)}")
    if now["guard.notFlyable"]:
        wrong.append(f"not flyable: {words(int(now['guard.notFlyable']), FLYABLE)}")
    if now.bit(LOCKED):
        wrong.append("the Crazyflie is locked: restart it")
    elif now.bit(CRASHED) or now.bit(TUMBLED):
        wrong.append("the Crazyflie lies on its side, or has crashed: set it upright and restart it")
    elif not (now.bit(CAN_FLY) or now.bit(CAN_BE_ARMED)):
        wrong.append("the Crazyflie's supervisor says that it cannot fly")
    if now.bit(FLYING):
        wrong.append("the motors run already")
    if now["pm.state"] != PM_ON_BATTERY:
        wrong.append("the battery is being charged, or is low")
    if now["pm.vbat"] < battery_V:
        wrong.append(f"the battery has {now['pm.vbat']:.2f} V; allowed is {battery_V:.2f} V and more")
    return wrong


def _of_the_room(now: Monitor) -> list[str]:
    wrong = []
    if not abs(now["stateEstimate.z"]) <= FLOOR_M:
        wrong.append(f"the estimator's height on the floor is {now['stateEstimate.z']:.2f} m, not 0")
    above_m = now["range.up"] / 1000.0
    if int(now["range.up"]) not in RANGE_MM:
        wrong.append("the ceiling is not seen (range.up)")
    elif not CEILING_M[0] <= above_m <= CEILING_M[1]:
        wrong.append(f"the ceiling is {above_m:.2f} m above; allowed are {CEILING_M[0]:g} to {CEILING_M[1]:g} m")
    return wrong


def check(vehicle: Craft, now: Monitor, battery_V: float) -> None:
    """Failed: everything that speaks against flying."""
    wrong = _of_the_vehicle(now, battery_V) + _of_the_room(now)
    controller = vehicle.get("stabilizer.controller")
    if controller != app.CONTROLLER:
        wrong.append(
            f"stabilizer.controller is {controller:g}: the app does not fly; allowed is {app.CONTROLLER}"
        )
    if wrong:
        raise Failed("does not fly: " + "; ".join(wrong))


def arm(vehicle: Craft, now: Monitor) -> None:
    """Those that do not arm themselves. Failed: it does not want to."""
    if now.bit(ARMED):
        return
    vehicle.arm()
    end_s = vehicle.now() + 5.0
    while not now.bit(CAN_FLY):
        vehicle.sleep(0.05)
        now.alive()
        if vehicle.now() > end_s:
            raise Failed("does not fly: arming was refused")


def height_m(now: Monitor) -> float:
    """The ceiling's height as it is seen from the floor, good to a few centimetres."""
    return now["stateEstimate.z"] + now["range.up"] / 1000.0


def yaw_rad(now: Monitor) -> float:
    return math.radians(now["stateEstimate.yaw"])

"""weights.py - the seven weights of the curve: as a whole into the app, out of it, and stored."""

import math

from . import app, blocks
from .craft import Craft
from .errors import Failed, LinkLost
from .monitor import Monitor
from .terminal import say


def commit(vehicle: Craft, now: Monitor, which: int) -> None:
    """ceil.commit, and waits until the app has taken it. Failed: it refused."""
    done, refused = now["ceil.commits"], now["ceil.noCommit"]
    vehicle.set("ceil.commit", which)
    end_s = vehicle.now() + 2.0
    while now["ceil.commits"] == done:
        vehicle.sleep(0.05)
        now.alive()
        if now["ceil.noCommit"] != refused or vehicle.now() > end_s:
            raise Failed(f"the app refused ceil.commit {which}: weights out of -5 to 5, or it is learning")


def set_weights(vehicle: Craft, now: Monitor, weights: tuple[float, ...]) -> None:
    for name, value in zip(app.WEIGHTS, weights):
        vehicle.set(name, value)
    commit(vehicle, now, app.COMMIT_TYPED)


def read_once(vehicle: Craft, names: tuple[str, ...]) -> list[float]:
    """Log variables as they are now."""
    got: dict[str, float] = {}
    streams = [
        vehicle.stream(block, lambda _b, _t, values: got.update(values))
        for block in blocks.pack(list(names), vehicle.logs(), 100)
    ]
    end_s = vehicle.now() + 2.0
    while len(got) < len(names):
        vehicle.sleep(0.05)
        vehicle.alive()
        if vehicle.now() > end_s:
            raise LinkLost("no log packets come")
    for stream in streams:
        vehicle.quiet(stream)
    return [got[name] for name in names]


def take_learned(vehicle: Craft, now: Monitor) -> None:
    """The learned weights become those that fly."""
    learned = read_once(vehicle, app.LEARNED)
    if not all(math.isfinite(w) for w in learned):
        raise Failed("the learned weights are not finite")
    commit(vehicle, now, app.COMMIT_LEARNED)
    for name, wanted in zip(app.WEIGHTS, learned):
        value = vehicle.get(name)
        if abs(value - wanted) > 1e-6:
            raise Failed(f"{name} is {value:.7g} after the commit, but {wanted:.7g} was learned")
        say(f"{name} = {value:.7g}")


def store_weights(vehicle: Craft) -> None:
    for i, name in enumerate(app.STORED):
        try:
            vehicle.store(name)
        except Failed as why:
            left = " ".join(app.STORED[i:])
            raise Failed(f"{why}; the learned weights fly, but until these are stored too the shipped ones come "
                         f"with the power: params store {left}") from None
    say("the weights are stored; they fly with ceil.mode 1")

"""vehicle.py - a Crazyflie (craft.py) through the stock library, cflib."""

import logging
import time
from collections.abc import Callable
from threading import Event, Thread
from typing import Any

from .blocks import Block
from .craft import Param, Take
from .errors import Failed, LinkLost, Refused
from .terminal import progress

ANSWER_S = 3.0  # the longest that an answer may take
CONNECT_S = 30.0
CUTS, CUT_S = 3, 0.01  # an emergency stop is not answered, so that it is sent again
FEED_S = 0.2  # the firmware's watchdog stops the motors after 1 s
URIS = "allowed are radio://0/80/2M/E7E7E7E7E7, usb://0, udp://HOST:PORT and what else cflib knows"


class Vehicle:
    now = staticmethod(time.monotonic)
    sleep = staticmethod(time.sleep)

    def __init__(self, uri: str) -> None:
        """Connects, and reads all names and all parameters."""
        try:
            import cflib.crtp
            from cflib.crazyflie import Crazyflie
        except ImportError:
            raise Failed(
                "cflib is missing: make setup-cf, then out/cf/bin/python tools/cf.py ...; or pip install cflib"
            ) from None
        logging.getLogger("cflib").setLevel(logging.CRITICAL)
        if not cflib.crtp.CLASSES:
            cflib.crtp.init_drivers()
        self.lost = ""
        self._console = ""
        self._fed: Event | None = None
        self._streams: list[Any] = []
        self._cf = Crazyflie()
        self._cf.console.receivedChar.add_callback(self._hear)
        self._connect(uri)

    def _connect(self, uri: str) -> None:
        ready, failed = Event(), []
        self._cf.fully_connected.add_callback(lambda _: ready.set())
        self._cf.connection_failed.add_callback(lambda _, why: failed.append(str(why)))
        self._cf.connection_lost.add_callback(self._on_lost)
        self._cf.open_link(uri)
        end_s = time.monotonic() + CONNECT_S
        try:
            while not ready.wait(0.1):
                progress(f"connecting to {uri}, {end_s - time.monotonic():.0f} s left")
                if failed and "malformed" in failed[0]:
                    raise Refused(f"--uri {uri}: no such link; {URIS}")
                if failed or self.lost:
                    raise LinkLost(f"{uri}: {(failed + [self.lost])[0].splitlines()[0]}")
                if time.monotonic() > end_s:
                    raise LinkLost(f"{uri}: no Crazyflie answers")
        except BaseException:
            self._cf.close_link()
            raise

    def _on_lost(self, uri: str, why: str) -> None:
        self.lost = str(why).splitlines()[0] if why else "lost"

    def _hear(self, text: str) -> None:
        self._console += text

    def said(self) -> list[str]:
        *lines, self._console = self._console.split("\n")
        return lines

    def alive(self) -> None:
        if self.lost:
            raise LinkLost(f"the link is lost ({self.lost})")

    def _wait(self, event: Event, what: str) -> None:
        end_s = time.monotonic() + ANSWER_S
        while not event.wait(0.02):
            self.alive()
            if time.monotonic() > end_s:
                raise LinkLost(f"no answer: {what}")

    def close(self) -> None:
        self.feed(False)
        self._cf.close_link()

    # --- parameters and logs ---------------------------------------------------------------------------------

    def params(self) -> dict[str, Param]:
        self.alive()
        found = {}
        for group, rows in self._cf.param.toc.toc.items():
            for name, row in rows.items():
                value = float(self._cf.param.values[group][name])
                whole = row.ctype not in ("float", "double", "FP16")
                found[f"{group}.{name}"] = Param(
                    row.ctype, row.access == row.RW_ACCESS, row.is_persistent(), int(value) if whole else value
                )
        return found

    def _answer(self, name: str, ask: Callable[[], None]) -> float:
        """The value that the vehicle says a parameter has, after ask()."""
        self.alive()
        group, short = name.split(".")
        said, come = [], Event()

        def take(_: str, value: str) -> None:
            said.append(float(value))
            come.set()

        self._cf.param.add_update_callback(group=group, name=short, cb=take)
        try:
            ask()
            self._wait(come, name)
        finally:
            self._cf.param.remove_update_callback(group=group, name=short, cb=take)
        return said[-1]

    def get(self, name: str) -> float:
        return self._answer(name, lambda: self._cf.param.request_param_update(name))

    def set(self, name: str, value: float) -> None:
        self._answer(name, lambda: self._cf.param.set_value(name, value))

    def store(self, name: str) -> None:
        self.alive()
        good, come = [], Event()

        def take(_: str, success: bool) -> None:
            good.append(success)
            come.set()

        self._cf.param.persistent_store(name, take)
        self._wait(come, f"store {name}")
        if not good[-1]:
            raise Failed(f"{name}: the Crazyflie could not store it")

    def logs(self) -> dict[str, str]:
        self.alive()
        toc = self._cf.log.toc.toc
        return {f"{group}.{name}": row.ctype for group, rows in toc.items() for name, row in rows.items()}

    def stream(self, block: Block, take: Take) -> Any:
        from cflib.crazyflie.log import LogConfig

        self.alive()
        config = LogConfig(block.name, block.period_ms)
        for name, kind in block.types.items():
            config.add_variable(name, kind)
        refused = []
        config.error_cb.add_callback(lambda _, why: refused.append(why))
        config.data_received_cb.add_callback(lambda stamp_ms, values, _: take(block.name, stamp_ms, values))
        started = Event()
        config.started_cb.add_callback(lambda *_: started.set())
        self._cf.log.add_config(config)
        config.start()
        end_s = time.monotonic() + ANSWER_S
        while not started.wait(0.02) and not refused:
            self.alive()
            if time.monotonic() > end_s:
                raise LinkLost(f"no answer: log block {block.name}")
        if refused:
            raise Failed(f"log block {block.name}: {refused[0]}")
        self._streams.append(config)
        return config

    def quiet(self, stream: Any) -> None:
        self._streams.remove(stream)
        if not self.lost:
            stream.stop()
            stream.delete()

    # --- flight ----------------------------------------------------------------------------------------------

    def arm(self) -> None:
        self.alive()
        self._cf.supervisor.send_arming_request(True)

    def take_off(self, z_m: float, duration_s: float) -> None:
        self.alive()
        self._cf.high_level_commander.takeoff(z_m, duration_s, yaw=None)

    def go_to(self, x_m: float, y_m: float, z_m: float, yaw_rad: float, duration_s: float) -> None:
        self.alive()
        self._cf.high_level_commander.go_to(x_m, y_m, z_m, yaw_rad, duration_s)

    def land(self, z_m: float, duration_s: float) -> None:
        self.alive()
        self._cf.high_level_commander.land(z_m, duration_s, yaw=None)

    def stop(self) -> None:
        self.alive()
        self._cf.high_level_commander.stop()

    def cut(self) -> None:
        for _ in range(CUTS):
            try:
                self._cf.supervisor.send_emergency_stop()
            except Exception:  # the link is lost: the watchdog stops the motors
                return
            time.sleep(CUT_S)

    def feed(self, on: bool) -> None:
        if self._fed:
            self._fed.set()
        self._fed = None
        if on:
            self._fed = Event()
            Thread(target=self._feed, args=(self._fed,), daemon=True).start()

    def fed(self) -> bool:
        return self._fed is not None

    def _feed(self, enough: Event) -> None:
        while not enough.is_set() and not self.lost:
            self._cf.supervisor.send_emergency_stop_watchdog()
            enough.wait(FEED_S)


"""What tests at the desk share: a desk that is on, and the stock library connected to it. Nothing of either is patched."""

import contextlib
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DESK = ROOT / os.environ.get("O", "out") / "desk"
PORT = 19871  # not the one that a person's own desk has

try:
    import cflib.crtp
    from cflib.crazyflie import Crazyflie
    from cflib.crazyflie.log import LogConfig
    from cflib.crazyflie.syncCrazyflie import SyncCrazyflie
    from cflib.crazyflie.syncLogger import SyncLogger
    from cflib.crtp.udpdriver import UdpDriver
except ImportError:
    cflib = None


@contextlib.contextmanager
def desk(*options: object, port: int = PORT):
    """A desk that is on, and its URI."""
    command = [DESK, "--port", port, "--page", 0, *options]
    running = subprocess.Popen(list(map(str, command)), stdout=subprocess.PIPE, text=True)
    try:
        assert running.stdout.readline().startswith("A simulated Crazyflie"), "the desk does not start"
        yield f"udp://127.0.0.1:{port}"
    finally:
        running.terminate()
        running.communicate(timeout=10)


@unittest.skipUnless(cflib and DESK.exists(), "no cflib, or no out/desk")
class AtTheDesk(unittest.TestCase):
    OPTIONS: tuple = ()

    def setUp(self) -> None:
        cflib.crtp.CLASSES[:] = [UdpDriver]
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.uri = self.enterContext(desk(*self.OPTIONS))

    @contextlib.contextmanager
    def flown(self):
        with SyncCrazyflie(self.uri, cf=Crazyflie(rw_cache=str(self.folder))) as connected:
            connected.wait_for_params()
            yield connected

    def logged(self, connected, seconds: float, *names: str, period_ms: int = 100) -> list[dict]:
        block = LogConfig("block", period_ms)
        for name in names:
            block.add_variable(name)
        rows = []
        with SyncLogger(connected, block) as logger:
            for stamp_ms, values, _ in logger:
                rows.append(values | {"ms": stamp_ms})
                if rows[-1]["ms"] - rows[0]["ms"] >= 1000 * seconds:
                    return rows
        return rows

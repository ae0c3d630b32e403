"""What tests at the desk share: a desk that is on, and the stock library connected to it. Nothing of either is patched."""

import contextlib
import os
import socket
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DESK = ROOT / os.environ.get("O", "out") / "desk"

try:
    import cflib.crtp
    from cflib.crazyflie import Crazyflie
    from cflib.crazyflie.log import LogConfig
    from cflib.crazyflie.syncCrazyflie import SyncCrazyflie
    from cflib.crazyflie.syncLogger import SyncLogger
    from cflib.crtp.udpdriver import UdpDriver
except ImportError:
    cflib = None


def free_port(kind: socket.SocketKind = socket.SOCK_DGRAM) -> int:
    """Of this machine, one that nobody listens on."""
    with socket.socket(socket.AF_INET, kind) as taken:
        taken.bind(("127.0.0.1", 0))
        return taken.getsockname()[1]


def start(*options: object) -> subprocess.Popen:
    """A desk that is on; who starts it ends it."""
    running = subprocess.Popen(list(map(str, [DESK, *options])), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert running.stdout.readline().startswith("A simulated Crazyflie"), running.communicate(timeout=10)
    return running


@contextlib.contextmanager
def desk(*options: object):
    """A desk that is on, and its URI."""
    port = free_port()
    running = start("--port", port, "--page", 0, *options)
    try:
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

    def cf(self, *words: object, status: int = 0) -> str:
        """A command of tools/cf.py, and what it says."""
        ran = subprocess.run(self.typed(*words), capture_output=True, text=True, timeout=200, cwd=self.folder)
        self.assertEqual(ran.returncode, status, ran.stderr)
        return ran.stdout if status == 0 else ran.stderr

    def typed(self, *words: object) -> list[str]:
        return list(map(str, [sys.executable, "-u", ROOT / "tools" / "cf.py", "--uri", self.uri, *words]))

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

"""An hour's flight with every twentieth packet lost, for a client that asks until it is answered, as a radio does."""

import math
import os
import re
import socket
import struct
import tempfile
import time
import unittest
from pathlib import Path

from desk_rig import DESK, cflib, free_port, start

if cflib:
    from desk_rig import Crazyflie, SyncCrazyflie, UdpDriver

FLOWN_S = 3600 if os.environ.get("TEST_LONG") else 120  # simulated
SPEED, LOSS = 20, 0.05
PERIOD_MS = 50
ROUND_S = 30  # simulated, from one round of commands to the next
WAIT_S, TRIES = 0.05, 40  # for an answer, before it is asked again
BLOCK, FLOAT = 1, 7
LOGGED = bytes((0x5E, BLOCK))
HEIGHT_M = 0.5


class Radio:
    """Asks until it is answered, and notes what is logged meanwhile."""

    def __init__(self, port: int) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.connect(("127.0.0.1", port))
        self.rows: list[tuple[float, ...]] = []  # ms, then the values
        self.asked = self.repeated = 0

    def hear(self, until_s: float, head: bytes = b"") -> bytes:
        """The first packet that begins with head; nothing by then: none came."""
        while (left_s := until_s - time.monotonic()) > 0:
            self.socket.settimeout(left_s)
            try:
                came = self.socket.recv(64)
            except TimeoutError:
                break
            if came.startswith(LOGGED):
                self.rows.append((int.from_bytes(came[2:5], "little"), *struct.unpack("<3f", came[5:])))
            elif head and came.startswith(head):
                return came
        return b""

    def ask(self, head: bytes, sent: bytes) -> bytes:
        """What the packet is answered, from head on."""
        self.asked += 1
        for _ in range(TRIES):
            self.socket.send(sent)
            if came := self.hear(time.monotonic() + WAIT_S, head):
                return came
            self.repeated += 1
        raise AssertionError(f"{sent.hex()} is never answered")


def memory_kB(pid: int) -> int:
    return int(re.search(r"VmRSS:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[1])


@unittest.skipUnless(cflib and DESK.exists(), "no cflib, or no out/desk")
class Hour(unittest.TestCase):
    def setUp(self) -> None:
        cflib.crtp.CLASSES[:] = [UdpDriver]
        port = free_port()
        self.desk = start("--port", port, "--page", 0, "--speed", SPEED)
        self.addCleanup(self.desk.communicate, timeout=10)
        self.addCleanup(self.desk.terminate)
        # The numbers, by the library, before anything is lost: it never repeats.
        with tempfile.TemporaryDirectory() as cache, SyncCrazyflie(
            f"udp://127.0.0.1:{port}", cf=Crazyflie(rw_cache=cache)
        ) as connected:
            connected.wait_for_params()
            connected.cf.param.set_value("desk.loss", LOSS)
            number = lambda toc, name: struct.pack("<H", toc.get_element_by_complete_name(name).ident)
            self.param = {name: number(connected.cf.param.toc, name) for name in ("desk.battery", "indiPos.kpz")}
            self.log = [number(connected.cf.log.toc, name) for name in ("desk.x", "desk.z", "supervisor.info")]
        self.radio = Radio(port)
        self.addCleanup(self.radio.socket.close)

    def set(self, name: str, value: float) -> None:
        number, bits = self.param[name], struct.pack("<f", value)
        self.assertEqual(self.radio.ask(b"\x2e" + number, b"\x2e" + number + bits)[3:], bits)

    def get(self, name: str) -> float:
        number = self.param[name]
        return struct.unpack("<f", self.radio.ask(b"\x2d" + number, b"\x2d" + number)[4:])[0]

    def begin(self) -> None:
        """A session, its block, and the take-off."""
        self.radio.ask(b"\xfd", b"\xfd\x00")
        self.radio.ask(b"\x5d\x05", b"\x5d\x05")
        variables = b"".join(bytes((FLOAT,)) + number for number in self.log)
        for command in (b"\x06" + bytes((BLOCK,)) + variables, b"\x03" + bytes((BLOCK, PERIOD_MS // 10))):
            self.radio.ask(b"\x5d" + command[:1], b"\x5d" + command)
        self.radio.ask(b"\x8c\x07", b"\x8c\x07\x00" + struct.pack("<ffBf", HEIGHT_M, 0.0, 1, 2.0))

    def fly(self, round_: int) -> None:
        """There and back, on a battery that is full again; then the air until the next round."""
        until_s = time.monotonic() + ROUND_S / SPEED
        self.set("desk.battery", 1.0)
        self.set("indiPos.kpz", 1.5 + 0.001 * round_)
        goal = struct.pack("<BBBfffff", 0, 0, 0, 0.3 * (round_ % 2), 0.0, HEIGHT_M, 0.0, 3.0)
        self.radio.ask(b"\x8c\x0c", b"\x8c\x0c" + goal)
        while time.monotonic() < until_s:
            self.radio.ask(b"\xfc\x07", b"\xfc\x07")
            self.radio.hear(min(until_s, time.monotonic() + 0.1))

    def test_nothing_leaks_nothing_drifts_and_what_was_answered_holds(self) -> None:
        self.begin()
        rounds = FLOWN_S // ROUND_S
        self.fly(0)
        began_s, first, memory = time.monotonic(), len(self.radio.rows), memory_kB(self.desk.pid)
        for round_ in range(1, rounds + 1):
            self.fly(round_)
            self.assertAlmostEqual(self.get("indiPos.kpz"), 1.5 + 0.001 * round_, places=5)
        wall_s, grown = time.monotonic() - began_s, memory_kB(self.desk.pid) - memory
        rows = self.radio.rows[first:]
        flown_s = (rows[-1][0] - rows[0][0]) / 1000
        came = (len(rows) - 1) * PERIOD_MS / 1000 / flown_s
        steps_ms = {after[0] - before[0] for before, after in zip(rows, rows[1:])}
        print(f"{flown_s:.0f} s flown in {wall_s:.1f} s, {100 * came:.1f} % of the logs came, ", end="")
        print(f"{self.radio.repeated} of {self.radio.asked} requests asked again, {grown} kB more memory")
        self.assertLess(grown, 300)
        # By its own clock no step is lost or made up, whatever the air did with the packet.
        self.assertEqual({step_ms % PERIOD_MS for step_ms in steps_ms}, {0})
        self.assertGreater(min(steps_ms), 0)
        self.assertLess(flown_s, SPEED * (wall_s + 0.5))
        self.assertGreater(flown_s, 0.9 * FLOWN_S)
        self.assertAlmostEqual(came, 1 - LOSS, delta=4 * math.sqrt(LOSS / len(rows)) + 0.005)
        flying = [int(info) >> 4 & 1 for _, _, _, info in rows]
        self.assertEqual(set(flying), {1})
        self.assertTrue(all(abs(z - 0.017 - HEIGHT_M) < 0.1 for _, _, z, _ in rows))


if __name__ == "__main__":
    unittest.main()

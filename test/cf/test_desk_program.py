"""The desk as a program: what it refuses, how it ends, what it leaves behind, and what strays in from elsewhere."""

import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request
from pathlib import Path

from desk_rig import DESK, ROOT, AtTheDesk, desk, free_port, start

BEGINS, SCANS, ECHOES = b"\xfd\x00", b"\xff", b"\xfc\x07"


def dial(port: int) -> socket.socket:
    """A client of the test's own, without a library."""
    client = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    client.settimeout(5)
    client.connect(("127.0.0.1", port))
    return client


def port_of(uri: str) -> int:
    return int(uri.rsplit(":", 1)[1])


class AsPrinted(AtTheDesk):
    def test_what_it_prints_to_try_works_as_printed(self) -> None:
        port, page = free_port(), free_port(socket.SOCK_STREAM)
        running = start("--port", port, "--page", page)
        self.addCleanup(running.communicate, timeout=10)
        self.addCleanup(running.terminate)
        typed = []
        while (line := running.stdout.readline()) != "Ctrl-C ends it.\n":
            self.assertTrue(line, "it says nothing of Ctrl-C")
            typed += re.findall(r"^  out/cf/bin/python (.*?)(?: +#.*)?$", line)
        self.assertEqual([line.split()[0] for line in typed], ["tools/cf/hop.py", "tools/cf.py", "tools/cf.py"])
        self.assertTrue(typed[-1].endswith(" learn"))
        typed[-1] += " --dry-run"  # test_desk_flights flies it
        highest_m = 0.0
        for line in typed:
            trying = subprocess.Popen([sys.executable, *line.split()], cwd=ROOT, stdout=subprocess.DEVNULL)
            while trying.poll() is None:
                with urllib.request.urlopen(f"http://127.0.0.1:{page}/state", timeout=5) as answer:
                    highest_m = max(highest_m, json.load(answer)["drones"][0]["pos_m"][2])
                time.sleep(0.05)
            self.assertEqual(trying.returncode, 0, line)
        self.assertAlmostEqual(highest_m, 0.5, delta=0.1)


@unittest.skipUnless(DESK.exists(), "no out/desk")
class Program(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.port = free_port()

    def refused(self, says: str, *words: object) -> None:
        ran = subprocess.run(list(map(str, [DESK, *words])), capture_output=True, text=True, timeout=20)
        self.assertEqual((ran.returncode, ran.stderr.count("\n")), (2, 1), ran.stderr)
        self.assertIn(says, ran.stderr)

    def test_wrong_input_ends_it_with_one_line(self) -> None:
        with desk() as uri, socket.socket() as page:
            page.bind(("127.0.0.1", 0))
            page.listen()
            self.refused("in use; another --port, or is it", "--port", port_of(uri), "--page", 0)
            self.refused("in use; another --page (0: none)", "--port", self.port, "--page", page.getsockname()[1])
        for says, *words in (
            ("--port 0: allowed is a whole number from 1 to 65535", "--port", 0),
            ("--page 65536: allowed is a whole number from 0 to 65535", "--page", 65536),
            ("--address here: allowed is an IPv4 address", "--address", "here"),
            ("--address 192.0.2.1: this machine has no such address", "--address", "192.0.2.1"),
            ("--address 192.0.2.1: this machine has no such address", "--address", "192.0.2.1", "--page", 0),
            ("--speed 0: allowed", "--speed", 0),
            ("--speed x=1: allowed", "--speed", "x=1"),
            ("--link: allowed is loss=SHARE,delay=SECONDS", "--link", ""),
            ("--link: allowed is loss=SHARE,delay=SECONDS", "--link", 200 * "loss=0,"),
            ("--link los=1: allowed is loss=SHARE,delay=SECONDS", "--link", "los=1"),
            ("--link loss=2: allowed is a number from 0 to 0.9", "--link", "loss=2"),
            ("--link delay=: allowed is a number from 0 to 1", "--link", "loss=0.1,delay="),
            ("no-such.toml", "no-such.toml"),
            ("--drones 11: allowed", "--drones", 11),
        ):
            with self.subTest(words=words):
                self.refused(says, *words)

    def check_whole(self, number: int) -> None:
        names, *rows = (self.folder / f"{number}.csv").read_text().splitlines()
        self.assertGreater(len(rows), 100)
        self.assertEqual({row.count(",") for row in rows}, {names.count(",")})
        # Boot, and what came; to the end of the last line.
        self.assertRegex((self.folder / f"{number}.commands").read_text(), r"\n\d+ fd00\n$")

    def test_each_signal_that_ends_it_leaves_whole_logs_of_each_drone(self) -> None:
        for kind in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(kind=kind):
                running = start("--port", self.port, "--page", 0, "--drones", 3, "--log", self.folder)
                self.addCleanup(running.kill)
                for i in range(3):
                    with dial(self.port + i) as client:
                        client.send(BEGINS)
                        while not client.recv(64).startswith(b"\xfdBitcraze Crazyflie"):
                            pass  # the console of its start
                time.sleep(0.5)
                running.send_signal(kind)
                _, said = running.communicate(timeout=10)
                self.assertEqual((running.returncode, said), (0, ""))
                for i in range(3):
                    self.check_whole(i)

    def test_who_ignores_hang_ups_goes_on_doing_so(self) -> None:
        command = ["nohup", str(DESK), "--port", str(self.port), "--page", "0"]
        running = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        running.stdout.readline()
        running.send_signal(signal.SIGHUP)
        time.sleep(0.3)
        self.assertIsNone(running.poll())
        running.terminate()
        running.communicate(timeout=10)

    @unittest.skipUnless(os.access("/dev/full", os.W_OK), "no /dev/full")
    def test_a_disk_that_is_full_ends_it_with_one_line(self) -> None:
        (self.folder / "0.commands").symlink_to("/dev/full")
        running = start("--port", self.port, "--page", 0, "--log", self.folder)
        _, said = running.communicate(timeout=10)  # by itself
        wanted = f"desk: {self.folder}/0.commands: cannot be written: it is not whole\n"
        self.assertEqual((running.returncode, said), (1, wanted))

    def test_of_all_addresses_it_says_those_that_work(self) -> None:
        page = free_port(socket.SOCK_STREAM)
        running = start("--address", "0.0.0.0", "--port", self.port, "--page", page)
        self.addCleanup(running.communicate, timeout=10)
        self.addCleanup(running.terminate)
        url = f"http://127.0.0.1:{page}/"
        with urllib.request.urlopen(f"{url}state", timeout=5) as answer:
            self.assertIn(f"udp://127.0.0.1:{self.port}".encode(), answer.read())
        with self.assertRaises(urllib.error.HTTPError) as refused:
            urllib.request.urlopen(f"http://0.0.0.0:{page}/", timeout=5)
        with refused.exception:
            self.assertIn(f"allowed: 127.0.0.1:{page}", refused.exception.read().decode())


class Strays(AtTheDesk):
    def test_what_strays_in_takes_nothing_from_a_client(self) -> None:
        with self.flown() as connected, dial(port_of(self.uri)) as other:
            for sent in (b"", ECHOES, bytes(100)):
                other.send(sent)
            other.send(SCANS)
            self.assertEqual(other.recv(64), SCANS)
            rows = self.logged(connected, 1.0, "desk.z", period_ms=10)
            self.assertGreater(len(rows), 80)
            other.settimeout(0.2)
            self.assertRaises(TimeoutError, other.recv, 64)

    def test_one_session_after_the_other_begins_at_once(self) -> None:
        for _ in range(3):
            began_s = time.monotonic()
            with self.flown() as connected:
                self.assertLess(time.monotonic() - began_s, 2.0)
                self.assertGreater(len(self.logged(connected, 0.2, "desk.z", period_ms=10)), 10)


class Slow(AtTheDesk):
    OPTIONS = ("--link", "delay=0.002")

    def test_what_the_link_does_stays_so_after_a_restart(self) -> None:
        with self.flown() as connected:
            param = connected.cf.param
            self.assertAlmostEqual(float(param.get_value("desk.delay")), 0.002, places=6)
            param.set_value("desk.delay", 0.0)
            param.set_value("desk.restart", 1)
            time.sleep(1.0)
            self.assertAlmostEqual(float(param.get_value("desk.delay")), 0.002, places=6)


if __name__ == "__main__":
    unittest.main()

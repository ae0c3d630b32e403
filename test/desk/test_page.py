"""test_page.py - the page of the desk in a browser: what it shows, what it sets, and that it says when the desk has gone."""

import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.request
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1] / "cf"))
import browser
from desk_rig import free_port

DESK = Path(os.environ.get("PROGRAMS", "out/release/bin")) / "desk"
SIZES = (("wide", 1280, 800, False), ("narrow", 420, 800, True))
SHOWN = "document.querySelectorAll('#controls .control').length > 0"
# Each of them has something on it: more than one colour.
PAINTED = """[...document.querySelectorAll('canvas')].every((c) => {
  const p = new Uint32Array(c.getContext('2d').getImageData(0, 0, c.width, c.height).data.buffer);
  return p.some((colour) => colour !== p[0]); })"""


class Desk:
    """The program, on ports that are free."""

    def __init__(self) -> None:
        self.port = free_port()
        command = [DESK, "--port", str(self.port), "--page", str(free_port(socket.SOCK_STREAM))]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        said = ""
        while not (found := re.search(r"http://127\.0\.0\.1:\d+/", said)):
            line = self.process.stdout.readline()
            if not line:
                raise RuntimeError(f"the desk does not say where its page is: {said}")
            said += line
        self.url = found[0]
        threading.Thread(target=self.process.stdout.read, daemon=True).start()

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.terminate()
        self.process.wait(10)
        self.process.stdout.close()

    def state(self) -> dict:
        with urllib.request.urlopen(self.url + "state", timeout=5) as answer:
            return json.load(answer)


def take_off(desk: Desk, cache: str) -> object:
    """Hovers below the ceiling, flown by the app; the link, to be closed."""
    import cflib.crtp
    from cflib.crazyflie import Crazyflie
    from cflib.crazyflie.syncCrazyflie import SyncCrazyflie

    cflib.crtp.init_drivers()
    link = SyncCrazyflie(f"udp://127.0.0.1:{desk.port}", cf=Crazyflie(rw_cache=cache))
    link.open_link()
    link.wait_for_params()
    link.cf.param.set_value("ceil.shadow", 0)
    link.cf.supervisor.send_arming_request(True)
    time.sleep(1.0)
    link.cf.high_level_commander.takeoff(1.0, 2.0)
    return link


def contrast(a: str, b: str) -> float:
    """Of two colours #rrggbb, as the Web Content Accessibility Guidelines 2 define it: 1 to 21."""

    def light(colour: str) -> float:
        parts = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    dark, bright = sorted((light(a), light(b)))
    return (bright + 0.05) / (dark + 0.05)


class TestColours(unittest.TestCase):
    def test_text_and_lines_can_be_told_from_their_ground_in_both_schemes(self) -> None:
        schemes = re.findall(r":root \{(.*?)\}", Path("sim/desk/page.html").read_text(encoding="utf-8"), re.DOTALL)
        self.assertEqual(len(schemes), 2)
        # The guidelines ask 4.5 of text, and 3 of lines and edges of what can be pressed.
        text = [("ink", "paper"), ("ink", "ground"), ("quiet", "paper"), ("bad", "bad-paper"), ("on-accent", "accent")]
        text += [("ceiling", "paper"), ("quiet", "bad-paper")]
        lines = [(f"l{i}", "paper") for i in range(7)] + [("accent", "paper"), ("bad", "paper")]
        for scheme in schemes:
            colour = dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", scheme))
            for least, pairs in ((4.5, text), (3.0, lines)):
                for a, b in pairs:
                    with self.subTest(f"{a} on {b}"):
                        self.assertGreaterEqual(contrast(colour[a], colour[b]), least)


class TestPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        path = browser.program()
        if not path:
            raise unittest.SkipTest("no Chromium")
        if not DESK.exists():
            raise unittest.SkipTest(f"no {DESK}")
        cls.browser = browser.Browser(path)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self) -> None:
        self.desk = Desk()
        self.addCleanup(self.desk.close)
        # The page of the test before asks no more, and has had its say.
        self.browser.open("about:blank")
        self.browser.wait("location.href === 'about:blank'")
        self.browser.complaints.clear()

    def show(self, width: int, height: int, dark: bool) -> None:
        self.browser.size(width, height, dark)
        self.browser.open(self.desk.url)
        self.browser.wait(SHOWN)

    def click(self, selector: str) -> None:
        """As a hand does: where it is, in sight."""
        where = f"document.querySelector({json.dumps(selector)})"
        self.browser.value(f"{where}.scrollIntoView({{block: 'center'}})")
        box = self.browser.value(f"(({{x, y, width, height}}) => [x, y, width, height])({where}.getBoundingClientRect())")
        self.browser.click(box[0] + box[2] / 2, box[1] + box[3] / 2)

    def test_it_shows_what_the_desk_says_at_either_size(self) -> None:
        for name, width, height, dark in SIZES:
            with self.subTest(name):
                self.show(width, height, dark)
                self.browser.wait(PAINTED)
                # Its words are written five times a second, of what comes twenty times.
                drone, text = self.browser.value("show(), [drone(), document.body.innerText]")
                for row in drone["desk"]:
                    self.assertIn(row["what"].lower(), text.lower())
                self.assertIn(drone["uri"], text)
                self.assertIn(drone["state"], text)
                self.assertIn("0 in the air, 0 for want of room", text)
                self.assertIn("0 not understood, 0 from elsewhere", text)
                self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), width)
                # What can be pressed is large enough and within the page.
                for x, right, high in self.browser.value(
                    "[...document.querySelectorAll('button, input')].map((e) => e.getBoundingClientRect())"
                    ".map((b) => [b.x, b.right, b.height])"
                ):
                    self.assertTrue(x >= 0 and right <= width and high >= 16, (x, right, high))
                self.assertEqual(self.browser.complaints, [])

    def test_the_keyboard_reaches_and_sets_what_the_mouse_does(self) -> None:
        self.show(1280, 800, False)
        self.browser.value("document.body.focus()")
        for _ in range(60):
            self.browser.key("Tab")
            if self.browser.value("document.activeElement.textContent").lower().startswith("cover"):
                break
        self.browser.key("Enter")
        until = time.monotonic() + 5
        while not self.covered() and time.monotonic() < until:
            time.sleep(0.1)
        self.assertTrue(self.covered())

    def parameter(self, name: str) -> float:
        return next(row["value"] for row in self.desk.state()["drones"][0]["desk"] if row["name"] == name)

    def covered(self) -> bool:
        return self.parameter("cover") == 1

    def test_a_number_that_is_refused_says_what_is_allowed(self) -> None:
        self.show(1280, 800, False)
        before = self.parameter("ceiling")
        self.browser.value(
            "((e) => { e.value = '1e6'; e.dispatchEvent(new Event('change')); })(document.getElementById('set-ceiling'))"
        )
        said = self.browser.wait("document.getElementById('set-ceiling').closest('.control').querySelector('p').textContent")
        self.assertIn("allowed", said)
        self.assertEqual(self.parameter("ceiling"), before)

    def test_covering_the_range_sensor_shows_the_guards_reason(self) -> None:
        cache = tempfile.TemporaryDirectory()
        self.addCleanup(cache.cleanup)
        try:
            link = take_off(self.desk, cache.name)
        except ImportError:
            self.skipTest("no cflib")
        self.addCleanup(link.close_link)
        self.show(1280, 800, False)
        # A ceiling that is not known yet cannot be contradicted.
        self.browser.wait("state.drones[0].height_m > 0.95 && known(state.drones[0].zc_m)", 20)
        self.assertEqual(self.browser.value("document.getElementById('now').textContent"), "says nothing")
        self.click("#switches button")
        said = self.browser.wait("document.querySelector('#guard.says #now')?.textContent", 20)
        self.assertRegex(said, "range|ceiling")
        self.assertTrue(self.covered())
        self.assertEqual(self.browser.complaints, [])

    def test_it_says_that_the_desk_has_gone(self) -> None:
        self.show(1280, 800, False)
        self.assertEqual(self.browser.value("document.getElementById('lost').textContent"), "")
        self.desk.close()
        self.browser.wait("document.getElementById('lost').textContent.startsWith('No connection')")
        self.assertTrue(self.browser.value("document.querySelector('#switches button').matches(':disabled')"))


if __name__ == "__main__":
    sys.exit(unittest.main())

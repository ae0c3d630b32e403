"""browser.py - a Chromium without a window, told what to do over two pipes by its own protocol (Chrome DevTools)."""

import base64
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome")
START_S, ANSWER_S = 60.0, 20.0


def program() -> str | None:
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """One page. What went wrong in it, and what it wrote to its console, gathers in `complaints`."""

    def __init__(self, path: str) -> None:
        self.complaints: list[str] = []
        self.home = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        # It reads from its descriptor 3 and writes to 4.
        to_it, self.write = os.pipe()
        self.read, from_it = os.pipe()
        # Only root has to be told that there is no sandbox for it.
        more = ["--no-sandbox"] if os.getuid() == 0 else []
        command = [path, "--headless=new", "--remote-debugging-pipe", "--disable-gpu", "--disable-dev-shm-usage", *more]
        command += ["--no-first-run", f"--user-data-dir={self.home.name}", "about:blank"]
        inside = ["sh", "-c", f'exec "$@" 3<&{to_it} 4>&{from_it}', "sh", *command]
        silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.process = subprocess.Popen(inside, pass_fds=(to_it, from_it), **silent)
        os.close(to_it)
        os.close(from_it)
        self.bytes, self.sent, self.session = b"", 0, None
        page = self.call("Target.createTarget", START_S, url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def close(self) -> None:
        os.close(self.write)
        os.close(self.read)
        self.process.terminate()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.home.cleanup()

    def _next(self, until: float) -> dict:
        while b"\0" not in self.bytes:
            if not select.select([self.read], [], [], max(0.0, until - time.monotonic()))[0]:
                raise TimeoutError("the browser does not answer")
            more = os.read(self.read, 1 << 16)
            if not more:
                raise EOFError("the browser has ended")
            self.bytes += more
        one, self.bytes = self.bytes.split(b"\0", 1)
        return json.loads(one)

    def _note(self, event: dict) -> None:
        said = event.get("params", {})
        if event.get("method") == "Runtime.exceptionThrown":
            self.complaints.append(json.dumps(said["exceptionDetails"]))
        elif event.get("method") == "Runtime.consoleAPICalled":
            self.complaints.append(json.dumps(said["args"]))
        elif event.get("method") == "Log.entryAdded":
            self.complaints.append(f"{said['entry']['text']} {said['entry'].get('url', '')}")

    def call(self, method: str, within_s: float = ANSWER_S, **params: object) -> dict:
        self.sent += 1
        message = {"id": self.sent, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.write, json.dumps(message).encode() + b"\0")
        until = time.monotonic() + within_s
        while True:
            answer = self._next(until)
            if answer.get("id") == self.sent:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']['message']}")
                return answer["result"]
            self._note(answer)

    def size(self, width: int, height: int, dark: bool = False) -> None:
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.call("Emulation.setEmulatedMedia", features=[scheme])

    def open(self, url: str) -> None:
        self.call("Page.navigate", url=url)

    def value(self, expression: str) -> object:
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait(self, expression: str, within_s: float = ANSWER_S) -> object:
        """Until the expression is true in the page; what it is then."""
        until = time.monotonic() + within_s
        while not (found := self.value(expression)):
            if time.monotonic() > until:
                raise TimeoutError(f"not true within {within_s:g} s: {expression}")
            time.sleep(0.1)
        return found

    def click(self, x: float, y: float) -> None:
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def key(self, key: str) -> None:
        text = {"Enter": "\r", " ": " "}.get(key, key if len(key) == 1 else "")
        code = {"Enter": 13, "Tab": 9, "ArrowLeft": 37, " ": 32}.get(key, 0)
        self.call("Input.dispatchKeyEvent", type="keyDown", key=key, text=text, windowsVirtualKeyCode=code)
        self.call("Input.dispatchKeyEvent", type="keyUp", key=key, windowsVirtualKeyCode=code)

    def picture(self, path: Path) -> None:
        data = self.call("Page.captureScreenshot", format="png", captureBeyondViewport=True)["data"]
        path.write_bytes(base64.b64decode(data))

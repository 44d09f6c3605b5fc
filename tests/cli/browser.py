"""Drives a headless Chromium through its debugging pipe, with the standard library alone."""
import base64
import contextlib
import json
import os
import shutil
import subprocess
import tempfile

CHROMIUM = shutil.which("chromium")
# The processor draws the pictures, so no test depends on a graphics card.
SWITCHES = ["--headless", "--no-sandbox", "--disable-dev-shm-usage", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--no-first-run", "--hide-scrollbars", "--remote-debugging-pipe"]


class Browser:
    """One page of a browser: `with Browser() as page: page.open(path); page.press("k"); page.ask("document.title")`."""

    def __init__(self, *switches, width=1280, height=800):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        commands, self.write = os.pipe()
        self.read, answers = os.pipe()
        # The browser reads commands from file 3 and writes answers to file 4; a shell opens both.
        words = [CHROMIUM, *SWITCHES, *switches, f"--window-size={width},{height}", f"--user-data-dir={self.profile.name}", "about:blank"]
        self.process = subprocess.Popen(["/bin/bash", "-c", f'exec 3<&{commands} 4>&{answers}; exec "$0" "$@"', *words],
                                        pass_fds=(commands, answers), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(commands)
        os.close(answers)
        self.number, self.session, self.rest, self.logged = 0, None, b"", []
        target = next(t for t in self.send("Target.getTargets")["targetInfos"] if t["type"] == "page")["targetId"]
        self.session = self.send("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ["Page", "Runtime", "Log"]:
            self.send(domain + ".enable")
        self.set(width=width, height=height)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.session = None
        with contextlib.suppress(EOFError, OSError):
            self.send("Browser.close")
        self.process.wait(30)
        os.close(self.write)
        os.close(self.read)
        self.profile.cleanup()

    def receive(self):
        while b"\0" not in self.rest:
            more = os.read(self.read, 1 << 20)
            if not more:
                raise EOFError("the browser is gone")
            self.rest += more
        message, self.rest = self.rest.split(b"\0", 1)
        message = json.loads(message)
        if message.get("method") == "Runtime.exceptionThrown":
            self.logged.append(message["params"]["exceptionDetails"].get("exception", {}).get("description", str(message)))
        if message.get("method") == "Log.entryAdded" and message["params"]["entry"]["level"] == "error":
            self.logged.append(message["params"]["entry"]["text"])
        return message

    def send(self, method, **params):
        self.number += 1
        message = {"id": self.number, "method": method, "params": params}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.write, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self.number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]

    def set(self, width=1280, height=800, media="", **features):
        """Sets the window's size and the media features that the page sees, such as prefers_color_scheme="dark"."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.send("Emulation.setEmulatedMedia", media=media,
                  features=[{"name": name.replace("_", "-"), "value": value} for name, value in features.items()])

    def open(self, path, width=None, scheme="light", media="", forced=False, script=True):
        """Shows a file. With a width, also sets colour scheme and forced colours; otherwise keeps the earlier
        settings."""
        if width is not None:
            self.set(width, 900, media, prefers_color_scheme=scheme, forced_colors="active" if forced else "none")
        self.send("Emulation.setScriptExecutionDisabled", value=not script)
        self.send("Page.navigate", url=path.resolve().as_uri())
        while self.receive().get("method") != "Page.loadEventFired":
            pass

    def ask(self, expression):
        """Returns the value of an expression; waits for a promise."""
        answer = self.send("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(answer["exceptionDetails"]["exception"].get("description", str(answer)))
        return answer["result"].get("value")

    def wait(self, expression):
        """Waits until an expression is true, for at most a minute."""
        self.ask(f"""new Promise((resolve, reject) => {{ const end = performance.now() + 6e4; const look = () => ({expression}) ? resolve() :
                 performance.now() > end ? reject(Error('never came true: ' + {json.dumps(expression)})) : setTimeout(look, 20); look(); }})""")

    def press(self, key, shift=False):
        codes = {"Enter": (13, "\r"), "Escape": (27, ""), "Tab": (9, ""), "ArrowLeft": (37, ""), "ArrowRight": (39, ""), "ArrowUp": (38, ""),
                 "ArrowDown": (40, ""), "Home": (36, ""), "End": (35, ""), " ": (32, " ")}
        code, text = codes[key] if key in codes else (ord(key.upper()), key)
        common = {"key": key, "windowsVirtualKeyCode": code, "modifiers": 8 if shift else 0}
        self.send("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.send("Input.dispatchKeyEvent", type="keyUp", **common)

    def shoot(self, path):
        path.write_bytes(base64.b64decode(self.send("Page.captureScreenshot")["data"]))

# What the tests of frame_check's pages share: a headless Chromium, and suites whose frames are files.
import base64
import json
import os
import re
import shutil
import subprocess
import sys
import time
import urllib.error
import urllib.request

failures = 0


def expect(what, is_so, seen=""):
    global failures
    if not is_so:
        failures += 1
        print(f"FAILED: {what} {seen}")


def end():
    sys.exit(1 if failures else 0)


def require_chromium():
    """Exit code 77 where there is none: ctest says that the test was skipped."""
    if not shutil.which("chromedriver") or not shutil.which("chromium"):
        print("SKIPPED: there is no chromium and chromedriver here; apt-get install chromium chromium-driver")
        sys.exit(77)


def people():
    """The environment of a person: no continuous integration."""
    return {key: value for key, value in os.environ.items() if key not in ("CI", "GITHUB_ACTIONS")}


class Browser:
    """A session of W3C WebDriver. Names do not resolve in it: a report that asked for anything would fail.
    Screenshots for people to look at are left in the folder `output`."""

    def __init__(self, output):
        os.makedirs(output, exist_ok=True)
        self.output = output
        self.driver = subprocess.Popen(["chromedriver", "--port=0"], stdout=subprocess.PIPE, text=True)
        for line in self.driver.stdout:
            if started := re.search(r"successfully on port (\d+)", line):
                break
        self.address = f"http://127.0.0.1:{started[1]}"
        options = {"args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                            "--window-size=1440,1000", "--force-device-scale-factor=1",
                            "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"]}
        wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
        session = self.call("POST", "/session", {"capabilities": {"alwaysMatch": wanted}})
        self.address += "/session/" + session["sessionId"]

    def call(self, method, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.address + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            sys.exit(f"{path}: {error.read().decode()[:600]}")

    def open(self, address):
        self.call("POST", "/url", {"url": "about:blank"})
        self.call("POST", "/url", {"url": address})

    def value(self, script):
        return self.call("POST", "/execute/sync", {"script": "return " + script, "args": []})

    def wait(self, condition, seconds=20):
        end = time.time() + seconds
        while time.time() < end:
            if self.value(condition):
                return True
            time.sleep(0.02)
        expect(f"within {seconds} s: {condition}", False, self.messages())
        return False

    def press(self, keys):
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self.call("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def pointer(self, *actions):
        self.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": list(actions)}]})

    def wheel(self, x, y, by):
        self.call("POST", "/actions", {"actions": [{"type": "wheel", "id": "wheel", "actions": [
            {"type": "scroll", "x": x, "y": y, "deltaX": 0, "deltaY": by}]}]})

    def screenshot(self, name):
        with open(os.path.join(self.output, name + ".png"), "wb") as file:
            file.write(base64.b64decode(self.call("GET", "/screenshot")))

    def messages(self):
        """Errors since the last call; reading the stage back, as this test does, earns advice that is none."""
        return [one["message"] for one in self.call("POST", "/se/log", {"type": "browser"}) if one["level"] == "SEVERE"]

    def close(self):
        self.call("DELETE", "")
        self.driver.terminate()
        self.driver.wait()


class Suite:
    """Cases whose frames cp draws from drawn/, blessed from one set of pictures and then given another."""

    def __init__(self, frame_check, folder):
        self.frame_check = frame_check
        self.folder = folder
        for name in ("cases", "drawn"):
            os.makedirs(os.path.join(folder, name))
        with open(os.path.join(folder, "suite.json"), "w") as file:
            json.dump({"command": ["cp", os.path.join(folder, "drawn", "{name}.png"), "{out}"],
                       "renderer": ["echo", "a copying machine"]}, file)

    def add(self, name, reference, settings):
        shutil.copy(reference, os.path.join(self.folder, "drawn", name + ".png"))
        with open(os.path.join(self.folder, "cases", name + ".json"), "w") as file:
            json.dump(settings, file)

    def draw(self, name, picture):
        shutil.copy(picture, os.path.join(self.folder, "drawn", name + ".png"))

    def run(self, *arguments):
        return subprocess.run([self.frame_check, "--suite", os.path.join(self.folder, "cases"), *arguments], env=people(),
                              text=True, stdout=subprocess.PIPE)

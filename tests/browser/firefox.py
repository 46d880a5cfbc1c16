"""Firefox without a screen, spoken to by Marionette, its protocol of remote control. Needs nothing but Python.

with Firefox() as browser:
    browser.open(file, width=1280)
    browser.evaluate("document.title")
"""

import base64
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time


class FirefoxError(Exception):
    pass


class Firefox:
    def __init__(self, program="firefox-esr"):
        self.folder = tempfile.mkdtemp()
        profile = os.path.join(self.folder, "profile")
        os.mkdir(profile)
        with open(os.path.join(profile, "user.js"), "w", encoding="utf-8") as preferences:
            preferences.write('user_pref("marionette.port", 0);\nuser_pref("browser.shell.checkDefaultBrowser", false);\n'
                              'user_pref("datareporting.policy.dataSubmissionEnabled", false);\n')
        self.log = open(os.path.join(self.folder, "log"), "w", encoding="utf-8")
        self.process = subprocess.Popen([program, "--marionette", "--headless", "--no-remote", "--profile", profile, "about:blank"],
                                        env={**os.environ, "HOME": self.folder}, stdin=subprocess.DEVNULL, stdout=self.log, stderr=self.log)
        self.number = 0
        self.connection = socket.create_connection(("127.0.0.1", self.port(profile)), 60)
        self.connection.settimeout(120)
        self.buffer = b""
        self.receive()  # its greeting
        self.call("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {"pageLoadStrategy": "normal"}}})
        self.call("WebDriver:SetTimeouts", {"script": 100_000})

    # The port that it chose, which it writes to its profile.
    def port(self, profile):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and self.process.poll() is None:
            try:
                with open(os.path.join(profile, "MarionetteActivePort"), encoding="utf-8") as file:
                    return int(file.read())
            except (FileNotFoundError, ValueError):
                time.sleep(0.1)
        with open(os.path.join(self.folder, "log"), encoding="utf-8") as log:
            raise FirefoxError("Firefox does not answer: " + log.read()[-2000:])

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        try:
            self.call("Marionette:Quit", {"flags": ["eForceQuit"]})
        except (FirefoxError, OSError):
            pass
        self.connection.close()
        try:
            self.process.wait(10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        self.log.close()
        shutil.rmtree(self.folder, ignore_errors=True)

    # A message is its length, a colon, and JSON.
    def receive(self):
        while b":" not in self.buffer:
            self.more()
        length, self.buffer = self.buffer.split(b":", 1)
        while len(self.buffer) < int(length):
            self.more()
        message, self.buffer = self.buffer[:int(length)], self.buffer[int(length):]
        return json.loads(message)

    def more(self):
        part = self.connection.recv(1 << 20)
        if not part:
            raise FirefoxError("Firefox ended")
        self.buffer += part

    def call(self, command, parameters=None):
        self.number += 1
        text = json.dumps([0, self.number, command, parameters or {}]).encode()
        self.connection.sendall(str(len(text)).encode() + b":" + text)
        _, _, error, result = self.receive()
        if error:
            raise FirefoxError(command + ": " + error["message"])
        return result

    def open(self, file, width=1280, height=900):
        self.call("WebDriver:SetWindowRect", {"width": width, "height": height})
        self.call("WebDriver:Navigate", {"url": "about:blank"})  # or a new #… would not load the page again
        self.call("WebDriver:Navigate", {"url": "file://" + os.path.abspath(file)})

    # The value of an expression, or what a promise gives.
    def evaluate(self, expression):
        script = ("const done = arguments[arguments.length - 1]; Promise.resolve().then(() => (" + expression + "))"
                  ".then((value) => done({value}), (error) => done({error: String(error)}));")
        answer = self.call("WebDriver:ExecuteAsyncScript", {"script": script, "args": [], "newSandbox": False, "sandbox": None})["value"]
        if "error" in answer:
            raise FirefoxError(answer["error"])
        return answer.get("value")

    def screenshot(self, file):
        picture = self.call("WebDriver:TakeScreenshot", {"full": False, "hash": False})["value"]
        with open(file, "wb") as stream:
            stream.write(base64.b64decode(picture))

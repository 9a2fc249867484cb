#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# Kate with the settings of docs/editors/kate.md, used with keys on an X server without a screen. In: an empty folder, which
# gets a project, Kate's own settings and the log of the server. Out: a line for each step; exit code 1 when one fails,
# with a picture of the screen where the command `import` is installed. Needs kate, xvfb, xdotool and openbox. Called by
# tools/long.sh kate.
#   tests/lsp/kate.py FOLDER RUNG
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SECONDS = float(os.environ.get("RUNG_EDITOR_SECONDS", "60"))

MAIN = """FUNCTION_BLOCK Ramp
VAR_INPUT step : REAL; END_VAR
VAR_OUTPUT y : REAL; END_VAR
y := y + step;
END_FUNCTION_BLOCK
PROGRAM Main
VAR ramp : Ramp; n : INT; END_VAR
ramp(step := 1.0);
n := m;
END_PROGRAM
"""
OTHER = "PROGRAM Other\nVAR ramp : Ramp; END_VAR\nramp(step := 2.0);\nEND_PROGRAM\n"


class Kate:
    def __init__(self, folder, rung):
        self.folder, self.log = folder, folder / "lsp.log"
        self.project = folder / "plant"
        self.environment = {**os.environ, "HOME": str(folder), "LANG": "C.UTF-8"}
        for name, below in {"CONFIG": ".config", "DATA": ".local/share", "CACHE": ".cache", "STATE": ".state"}.items():
            self.environment[f"XDG_{name}_HOME"] = str(folder / below)
        self.environment["XDG_RUNTIME_DIR"] = str(folder / "run")
        self.environment["PATH"] = f"{folder}/bin:{os.environ['PATH']}"
        self.write_files(rung)
        self.processes = []
        self.start_screen()
        self.start("openbox")
        self.start("kate", "--startanon", "--block", "main.st")

    def write_files(self, rung):
        page = (SOURCE / "docs/editors/kate.md").read_text()
        texts = {
            "plant/main.st": MAIN,
            "plant/other.st": OTHER,
            "plant/rung.project": "[project]\n",
            "bin/rung": f'#!/bin/sh\nexec {rung} "$@" --log {self.log}\n',
            ".config/kate/lspclient/settings.json": re.search(r"```json settings.json\n(.*?)```", page, re.S)[1],
            ".config/katerc": "[Kate Plugins]\nlspclientplugin=true\n",
        }
        for name, text in texts.items():
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text(text)
        (self.folder / "bin/rung").chmod(0o755)
        (self.folder / "run").mkdir(mode=0o700)
        modes = self.folder / ".local/share/org.kde.syntax-highlighting/syntax"
        modes.mkdir(parents=True)
        shutil.copy(SOURCE / "tools/editors/kate/iecst.xml", modes)

    # The server chooses a free number and says it.
    def start_screen(self):
        read, write = os.pipe()
        command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"]
        self.processes.append(subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL))
        os.close(write)
        with os.fdopen(read) as said:
            self.environment["DISPLAY"] = ":" + said.readline().strip()

    def start(self, *command):
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        self.processes.append(subprocess.Popen(command, cwd=self.project, env=self.environment, **quiet))

    def stop(self):
        for process in reversed(self.processes):
            process.terminate()
            process.wait()

    # ---- what a user does

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *words], env=self.environment, capture_output=True, text=True)

    def keys(self, *keys):
        for key in keys:
            self.xdotool("key", key)
            time.sleep(0.3)

    def type(self, text):
        self.xdotool("type", "--delay", "30", text)
        time.sleep(0.3)

    def window(self, title):
        def find():
            found = self.xdotool("search", "--onlyvisible", "--name", title).stdout.split()
            return found[0] if found else None
        number = until(f"a window `{title}`", find)
        self.xdotool("windowfocus", "--sync", number)
        time.sleep(0.5)

    def go_to(self, line, column=1):
        self.keys("ctrl+g")
        self.type(str(line))
        self.keys("Return", "Home", *["Right"] * (column - 1))

    def command(self, title):
        self.keys("ctrl+alt+i")
        time.sleep(1)
        self.type(title)
        time.sleep(0.5)
        self.keys("Return")

    # ---- what is seen

    def on_disk(self, name, text):
        return until(f"`{text}` in {name}", lambda: text in (self.project / name).read_text())

    def said(self, pattern, after=0):
        def find():
            log = self.log.read_text() if self.log.exists() else ""
            return re.search(pattern, log[after:])
        return until(f"{pattern} in the log", find)

    def said_so_far(self):
        return len(self.log.read_text())

    def diagnostics(self, pattern, after=0):
        # Of main.st, and newer than what was said before.
        return self.said(r'-> \{[^\n]*"textDocument/publishDiagnostics"[^\n]*' + pattern, after)


def until(what, test):
    end = time.monotonic() + SECONDS
    while True:
        result = test()
        if result:
            return result
        if time.monotonic() > end:
            raise RuntimeError(f"not seen: {what}")
        time.sleep(0.1)


# ---- the steps

def starts(kate):
    kate.window("LSP server start requested")  # Kate asks once for each command
    kate.keys("Return")
    kate.said(r"<- \{[^\n]*textDocument/didOpen")
    kate.window("main.st")


def error_appears(kate):
    kate.diagnostics(r"E0401")


def error_goes(kate):
    before = kate.said_so_far()
    kate.go_to(9)
    kate.keys("shift+End")
    kate.type("n := 1;")
    kate.diagnostics(r'"diagnostics":\[\]', before)
    kate.keys("ctrl+s")
    kate.on_disk("main.st", "n := 1;")


# Kate applies all that is offered, so there is only one.
def fix_applies(kate):
    before = kate.said_so_far()
    kate.go_to(9)
    kate.keys("End", "BackSpace")
    kate.diagnostics(r"expected `;`", before)
    kate.keys("Left")
    kate.command("Quick Fix")
    time.sleep(1)
    kate.keys("ctrl+s")
    kate.on_disk("main.st", "n := 1;\nEND_PROGRAM")


def completes(kate):
    before = kate.said_so_far()
    kate.go_to(9)
    kate.keys("End", "Return")
    kate.type("ramp.st")
    kate.keys("ctrl+space")
    kate.said(r'"id":\d+,"result":[^\n]*"label":"step"', before)
    time.sleep(1)
    kate.keys("Return", "ctrl+s")
    kate.on_disk("main.st", "\nramp.step\n")
    kate.keys("ctrl+k", "ctrl+s")
    until("the line is gone", lambda: "\nramp.step" not in (kate.project / "main.st").read_text())


def goes_to_definition(kate):
    before = kate.said_so_far()
    kate.go_to(8)
    kate.command("Go to Definition")
    kate.said(r"<- \{[^\n]*textDocument/definition", before)
    time.sleep(1)
    kate.type("x")
    kate.keys("ctrl+s")
    kate.on_disk("main.st", "VAR xramp : Ramp")
    kate.keys("ctrl+z", "ctrl+s")
    kate.on_disk("main.st", "VAR ramp : Ramp")


def renames(kate):
    kate.go_to(2, 11)
    kate.keys("F2")
    kate.window("Rename")
    kate.keys("ctrl+a")
    kate.type("slope")
    kate.keys("Return")
    time.sleep(1)
    kate.keys("ctrl+l")  # saves all
    kate.on_disk("main.st", "ramp(slope := 1.0)")
    kate.on_disk("other.st", "ramp(slope := 2.0)")


def formats(kate):
    kate.go_to(9)
    kate.keys("shift+End")
    kate.type("n:=n+1;")
    kate.keys("ctrl+t", "f")
    time.sleep(1)
    kate.keys("ctrl+s")
    kate.on_disk("main.st", "n := n + 1;")


def main():
    folder, rung = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    kate = Kate(folder, rung)
    failed = 0
    try:
        for step in (starts, error_appears, error_goes, fix_applies, completes, goes_to_definition, renames, formats):
            name = step.__name__.replace("_", " ")
            try:
                step(kate)
                print(f"ok    {name}")
            except RuntimeError as error:
                failed += 1
                print(f"FAIL  {name}: {error}")
                picture = ["import", "-window", "root", str(folder / f"failed-{failed}.png")]
                if shutil.which("import"):
                    subprocess.run(picture, env=kate.environment, check=False)
                kate.keys("Escape")
    finally:
        kate.stop()
    sys.exit(failed > 0)


main()

# SPDX-License-Identifier: Apache-2.0
"""A virtual screen, pictures of it, and the viewer in its window, driven by keys and mouse."""
import os
import shutil
import subprocess
import time
from pathlib import Path

TOOLS = {"Xvfb": "xvfb", "xdotool": "xdotool", "import": "imagemagick", "convert": "imagemagick"}
# Without a GPU, next to other work, a frame may take seconds.
PATIENCE_S = 40.0


def missing_packages():
    return sorted({package for tool, package in TOOLS.items() if shutil.which(tool) is None})


class Screen:
    """An X server of its own. -displayfd makes it choose a free number and say when it is ready."""

    def __enter__(self):
        reading, writing = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x800x24", "-nolisten", "tcp"],
            pass_fds=[writing], stderr=subprocess.DEVNULL)
        os.close(writing)
        with os.fdopen(reading) as pipe:
            number = pipe.readline().strip()
        if not number:
            raise RuntimeError("Xvfb did not start")
        os.environ["DISPLAY"] = ":" + number
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()


class Picture:
    """Eight-bit RGB, rows from the top."""

    def __init__(self, width, height, rgb):
        assert len(rgb) == width * height * 3, f"{len(rgb)} bytes are no {width}x{height} picture"
        self.width, self.height, self.rgb = width, height, rgb

    @staticmethod
    def read(path, width, height):
        raw = subprocess.run(["convert", str(path), "-depth", "8", "rgb:-"], check=True, stdout=subprocess.PIPE)
        return Picture(width, height, raw.stdout)

    def region(self, x0, y0, x1, y1):
        rows = (self.rgb[(y * self.width + x0) * 3:(y * self.width + x1) * 3] for y in range(y0, y1))
        return Picture(x1 - x0, y1 - y0, b"".join(rows))

    def mean(self, channel=None):
        values = self.rgb if channel is None else self.rgb[channel::3]
        return sum(values) / len(values)

    def difference(self, other):
        """Mean absolute difference, 0 to 255."""
        return sum(map(abs, map(int.__sub__, self.rgb, other.rgb))) / len(self.rgb)

    def worst(self, other):
        return max(map(abs, map(int.__sub__, self.rgb, other.rgb)))

    def same_as(self, other):
        """Two programs rounding the same values to 8 bits: no more than one step apart anywhere."""
        return self.worst(other) <= 1


class Viewer:
    WIDTH, HEIGHT = 480, 360  # at first

    def __init__(self, bounce, scene, folder, *options):
        self.process = subprocess.Popen(
            [bounce, "view", str(scene), "--size", f"{self.WIDTH}x{self.HEIGHT}", *options],
            cwd=folder, stderr=subprocess.PIPE, text=True)
        # No window manager runs here, so nobody else gives the keys to the window.
        self.wait_for("a window to focus", self._focus_window)
        self.xdotool("mousemove", self.WIDTH // 2, self.HEIGHT // 2)
        self.wait_for("a first picture", lambda: self.shot().mean() > 1.0)

    def _focus_window(self):
        assert self.process.poll() is None, f"the viewer ended: {self.process.stderr.read()}"
        # Fails until the window is there, and on the screen.
        chain = ["xdotool", "search", "--onlyvisible", "--name", "Bounce", "windowfocus", "--sync"]
        done = subprocess.run(chain, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        return done.returncode == 0

    @staticmethod
    def xdotool(*arguments):
        subprocess.run(["xdotool", *map(str, arguments)], check=True)

    @staticmethod
    def wait_for(what, condition):
        """Returns what the condition gave as soon as that is true."""
        end = time.monotonic() + PATIENCE_S
        while True:
            found = condition()
            if found:
                return found
            assert time.monotonic() < end, f"waited {PATIENCE_S:.0f} s in vain for {what}"
            time.sleep(0.1)

    def shot(self):
        raw = subprocess.run(
            ["import", "-window", "root", "-crop", f"{self.WIDTH}x{self.HEIGHT}+0+0", "-depth", "8", "rgb:-"],
            check=True, stdout=subprocess.PIPE)
        return Picture(self.WIDTH, self.HEIGHT, raw.stdout)

    def settled(self):
        """The picture once it has stopped changing for longer than a frame takes."""
        last = self.shot()
        since = time.monotonic()
        end = since + PATIENCE_S
        while time.monotonic() - since < 1.2:
            time.sleep(0.2)
            now = self.shot()
            if now.rgb != last.rgb:
                last, since = now, time.monotonic()
            assert time.monotonic() < end, "the picture does not come to rest"
        return last

    def keys(self, *keys):
        for key in keys:
            self.xdotool("key", key)

    def after_keys(self, *keys):
        """The picture that the keys lead to; they must change it."""
        before = self.shot()
        self.keys(*keys)
        self.wait_for(f"an answer to {' '.join(keys)}", lambda: self.shot().difference(before) > 0.01)
        return self.settled()

    def resize(self, width, height):
        self.WIDTH, self.HEIGHT = width, height
        self.xdotool("search", "--onlyvisible", "--name", "Bounce", "windowsize", width, height)

    def processor_seconds(self):
        """Time that all its threads have worked."""
        fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        user, system = fields[11:13]  # fields 14 and 15, counted from 1, in proc(5)
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")

    def drag(self, across, down, *held):
        before = self.shot()
        for key in held:
            self.xdotool("keydown", key)
        self.xdotool("mousemove", self.WIDTH // 2, self.HEIGHT // 2, "mousedown", 1)
        for _ in range(4):
            self.xdotool("mousemove_relative", "--", across // 4, down // 4)
        self.xdotool("mouseup", 1)
        for key in held:
            self.xdotool("keyup", key)
        self.wait_for("an answer to the drag", lambda: self.shot().difference(before) > 0.01)
        return self.settled()

    def click(self, x, y):
        # ImGui takes a press and a release that fall into one frame, but only after it has seen the mouse there.
        self.xdotool("mousemove", x, y)
        time.sleep(0.3)
        self.xdotool("click", 1)

    def becomes(self, what, expected):
        """Waits until the window shows a picture; messages that fade may lie over it for some seconds."""
        self.wait_for(what, lambda: self.shot().same_as(expected))

    def quit(self, key):
        self.keys(key)
        _, errors = self.process.communicate(timeout=PATIENCE_S)
        assert self.process.returncode == 0, f"exit code {self.process.returncode}: {errors}"
        return errors

    def end(self):
        """For a test that failed half way; the process is ours."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()


def rendered(bounce, scene, folder, *options, width=Viewer.WIDTH, height=Viewer.HEIGHT):
    """The same picture as bounce render writes it."""
    path = folder / "expected.png"
    subprocess.run([bounce, "render", str(scene), "--size", f"{width}x{height}", "-o", str(path), *options],
                   check=True, stderr=subprocess.DEVNULL)
    return Picture.read(path, width, height)

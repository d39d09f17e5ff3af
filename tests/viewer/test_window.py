# SPDX-License-Identifier: Apache-2.0
"""The viewer in a real window: test_window.py BOUNCE PART, run by CTest. Exits with 77 where tools are missing."""
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from make_scene import write_scene
from screen import Picture, Screen, Viewer, missing_packages, rendered


def check_keys(bounce, scene, folder):
    """What is shown, from where and how bright: by keys and mouse, against what bounce render writes."""
    viewer = Viewer(bounce, scene, folder)
    try:
        shaded = viewer.after_keys("h")
        assert shaded.mean() > 20.0, "the picture is nearly black"
        assert shaded.same_as(rendered(bounce, scene, folder)), "the window differs from bounce render's PNG"

        before = viewer.processor_seconds()
        time.sleep(2.0)
        worked = viewer.processor_seconds() - before
        assert worked < 0.1, f"{worked} s of work in 2 s in which nothing happened"

        flux = viewer.after_keys("7")
        assert flux.same_as(rendered(bounce, scene, folder, "--show", "rsm-flux"))
        indirect = viewer.after_keys("3")
        assert indirect.same_as(rendered(bounce, scene, folder, "--show", "indirect"))
        assert 1.0 < indirect.mean() < shaded.mean(), "indirect light alone is a part of the whole"
        assert flux.difference(shaded) > 5.0 and flux.difference(indirect) > 5.0
        assert viewer.after_keys("1").same_as(shaded)

        brighter = viewer.after_keys("bracketright", "bracketright")
        assert brighter.mean() > 1.2 * shaded.mean(), "a stop up is not brighter"
        assert viewer.after_keys("bracketleft", "bracketleft").same_as(shaded)

        assert viewer.drag(100, 20).difference(shaded) > 2.0, "an orbit changes little"
        assert viewer.after_keys("0").same_as(shaded), "0 does not return to the scene's camera"
        assert viewer.drag(60, 0, "shift").difference(shaded) > 2.0, "panning changes little"
        viewer.keys("0")
        viewer.becomes("the scene's camera again", shaded)

        viewer.keys("c")
        viewer.becomes("the side camera's picture", rendered(bounce, scene, folder, "--camera", "side camera"))
        viewer.keys("0")
        viewer.becomes("the scene's camera again", shaded)

        viewer.keys("s")
        png = folder / "scene.0001.png"
        viewer.wait_for("the saved picture", lambda: png.exists() and (folder / "scene.0001.exr").exists())
        assert Picture.read(png, Viewer.WIDTH, Viewer.HEIGHT).same_as(shaded), "the file differs from the window"
        viewer.becomes("the message's end", shaded)

        helped = viewer.after_keys("F1")
        assert helped.difference(shaded) > 5.0, "no help is seen"
        viewer.keys("F1")
        viewer.becomes("the picture without help", shaded)

        viewer.resize(360, 300)
        viewer.becomes("the picture at the window's new size",
                       rendered(bounce, scene, folder, width=360, height=300))
        viewer.quit("Escape")
    finally:
        viewer.end()


def check_playback(bounce, scene, folder):
    """Playing changes the picture, pausing stops that, stepping and scrubbing reach the frames asked for."""
    viewer = Viewer(bounce, scene, folder)
    try:
        first = viewer.after_keys("h")
        viewer.keys("space")
        shots = []
        for _ in range(2):  # it goes on playing, not just to a second picture
            seen = shots[-1] if shots else first
            viewer.wait_for("motion", lambda: viewer.shot().difference(seen) > 0.05)
            shots.append(viewer.shot())
        viewer.keys("space")
        paused = viewer.settled()
        time.sleep(1.5)
        assert viewer.shot().rgb == paused.rgb, "the picture changes while paused"

        viewer.keys("shift+Left")
        viewer.becomes("the first frame", first)
        viewer.keys("Right")
        viewer.becomes("the second frame", rendered(bounce, scene, folder, "--frames", "2"))
        viewer.keys("Left")
        viewer.becomes("the first frame", first)
        viewer.keys("Left")
        viewer.becomes("the last frame, around the end", rendered(bounce, scene, folder, "--frames", "49"))
        viewer.keys("shift+Left")
        viewer.becomes("the first frame", first)

        # The timeline lies along the lower edge; a click in the slider's middle goes there.
        viewer.after_keys("h")
        viewer.click(160, Viewer.HEIGHT - 30)
        right_side = (300, 10, Viewer.WIDTH, Viewer.HEIGHT - 60)  # beside the panels
        viewer.wait_for("another frame after scrubbing",
                        lambda: viewer.shot().region(*right_side).difference(first.region(*right_side)) > 0.5)
        viewer.quit("q")
    finally:
        viewer.end()


def check_reload(bounce, scene, folder):
    """A changed file is shown; a broken one leaves the old picture, says so, and can be mended."""
    viewer = Viewer(bounce, scene, folder)
    try:
        grey = viewer.after_keys("h")
        changed = folder / "changed.glb"
        write_scene(changed, cube_color=(0.05, 0.9, 0.05))
        green = rendered(bounce, changed, folder)
        assert green.difference(grey) > 0.5, "the test's two scenes look alike"
        os.replace(changed, scene)
        viewer.becomes("the changed scene", green)

        whole = scene.read_bytes()
        scene.write_bytes(whole[:len(whole) // 2])
        corner = (Viewer.WIDTH // 2, 0, Viewer.WIDTH, 60)
        viewer.wait_for("a message in the upper right",
                        lambda: viewer.shot().region(*corner).difference(green.region(*corner)) > 1.0)
        kept = viewer.settled()
        lower = (0, Viewer.HEIGHT // 2, Viewer.WIDTH, Viewer.HEIGHT)
        assert kept.region(*lower).same_as(green.region(*lower)), "the old picture is gone"

        write_scene(scene)
        viewer.becomes("the mended scene, without the message", grey)
        errors = viewer.quit("Escape")
        assert "the changed file is not shown" in errors, errors
    finally:
        viewer.end()


def check_refusal(bounce, scene, folder):
    """Exit codes where no window can be shown; one sentence each."""

    def run(*arguments, **variables):
        return subprocess.run([bounce, "view", *map(str, arguments)], cwd=folder, env={**os.environ, **variables},
                              stderr=subprocess.PIPE, text=True, timeout=60)

    def refused(done, code, word):
        assert done.returncode == code, f"exit code {done.returncode}: {done.stderr}"
        assert word in done.stderr and done.stderr.count("\n") == 1, done.stderr

    refused(run(scene, DISPLAY=":987", WAYLAND_DISPLAY=""), 4, "window")
    refused(run(folder / "nothing.glb"), 3, "nothing.glb")
    refused(run(scene, "--camera", "no such camera"), 2, "no such camera")


PARTS = {"keys": check_keys, "playback": check_playback, "reload": check_reload, "refusal": check_refusal}


def main():
    bounce, part = sys.argv[1:]
    if missing := missing_packages():
        print(f"skipped: needs {', '.join(missing)}")
        return 77
    with Screen(), tempfile.TemporaryDirectory() as folder:
        scene = Path(folder) / "scene.glb"
        write_scene(scene)
        PARTS[part](os.path.abspath(bounce), scene, Path(folder))
    return 0


if __name__ == "__main__":
    sys.exit(main())

# SPDX-License-Identifier: Apache-2.0
"""Small programs in the place of Blender, f3d and xvfb-run: `bounce evaluate` runs in a second with them."""

import json
import os
import stat

SIZE = "32x18"

BLENDER = r"""#!/usr/bin/env python3
import json, os, shutil, sys, time
if sys.argv[1:] == ["--version"]:
    print("Blender 9.9.9\n\tbuild hash: abcdef")
    sys.exit()
if "--python-expr" in sys.argv:
    sys.exit()
here = os.path.dirname(os.path.abspath(__file__))
job = json.load(open(sys.argv[-1]))
script = next(word for word in sys.argv if word.endswith(".py")).rsplit("/", 1)[-1]
open(here + "/calls", "a").write(json.dumps({"script": script, **job}) + "\n")
tell = lambda **event: print("BOUNCE " + json.dumps(event), flush=True)
tell(event="ready", version="9.9.9", threads=2, files=[], film_exposure=1.0,
     view={"display_device": "sRGB", "view_transform": "Standard", "look": "None", "exposure": 0, "gamma": 1})
parent = os.getppid()
for frame in job["frames"]:
    if script == "f3d_export.py":
        for name in ("lit", "unlit"):
            open(frame[name], "w").write("glTF")
        tell(event="frame", frame=frame["frame"], seconds=0.25, position=[1, 2, 3], focal_point=[0, 0, 0],
             view_up=[0, 1, 0], view_angle=30, background=[0, 0, 0])
        continue
    tell(event="warm_up", frame=frame["frame"], seconds=0.5)
    for item in frame["renders"]:
        # "hang": stands still before that many samples, until whoever started it is gone.
        hang = open(here + "/hang").read() if os.path.exists(here + "/hang") else ""
        while hang == str(item.get("spp")):
            time.sleep(0.02)
            if os.getppid() != parent:
                sys.exit(1)
        shutil.copy(here + "/engine.exr", item["output"])
        samples = item.get("spp", item.get("samples"))
        tell(event="render", frame=frame["frame"], spp=samples, samples=samples, seed=item.get("seed", 0),
             seconds=0.05 * samples, output=item["output"], rss_peak_bytes=300 * 2 ** 20)
"""

F3D = r"""#!/usr/bin/env python3
import os, shutil, sys, time
if "--version" in sys.argv:
    print("f3d 9.9.9")
    sys.exit()
if "--no-render" in sys.argv:
    sys.exit()
here = os.path.dirname(os.path.abspath(__file__))
options = dict(word[2:].split("=", 1) for word in sys.argv[1:] if "=" in word)
time.sleep(0.003 * open(options["interaction-test-play"]).read().count("KeyPress"))
shutil.copy(here + "/engine.png", options["output"])
"""

XVFB = r"""#!/bin/sh
while [ "$1" != "-screen 0 4096x4096x24" ]; do shift; done
shift
exec "$@"
"""


def install(folder):
    """Writes the programs; engine.exr and engine.png beside them are what they render."""
    for name, text in (("blender", BLENDER), ("f3d", F3D), ("xvfb-run", XVFB)):
        path = folder / name
        path.write_text(text, encoding="utf-8")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)


def environment_of(engines, tmp_path):
    # The driver's cache of shaders is left where it is: to compile them all anew takes longer than the rest.
    shaders = os.environ.get("XDG_CACHE_HOME") or os.path.expanduser("~/.cache")
    return {"PATH": f"{engines}:/usr/bin:/bin", "DISPLAY": "", "XDG_CACHE_HOME": str(tmp_path / "cache"),
            "MESA_SHADER_CACHE_DIR": shaders}


def arguments_of(engines, scene, output):
    # Without bounces one run of Bounce's own is all there is.
    return ["evaluate", scene, "-o", output, "--frames", "10,11", "--size", SIZE, "--reference-spp", "32", "--repeat", "2",
            "--cycles-spp", "1,4", "--bounces", "0", "--blender", engines / "blender"]


def jobs(engines):
    """What the stand-in for Blender was started for, in order."""
    return [json.loads(line) for line in (engines / "calls").read_text(encoding="utf-8").splitlines()]

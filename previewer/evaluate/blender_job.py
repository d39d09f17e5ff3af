# SPDX-License-Identifier: Apache-2.0
"""What the scripts share that run a job in Blender: opening the scene, its picture's settings, telling what happens.

A job is `-- JOB.json` on the command line, with the scene's path, for a glTF file `addon`, the add-on whose Draco library
decodes it, and `defaults`, what Bounce shows where the file says nothing (scene_defaults.h). What happens is told on stdout in lines "BOUNCE {json}"; of every script:

    {event: "ready", files, ...}   the scene is open; files: what it refers to
    {event: "begin"}               a render starts
    {event: "note", message}       something about the scene that was changed
    {event: "error", message}      the last line of a job that failed; Blender then ends with 1
"""

import json
import statistics
import sys
import time
import traceback
from pathlib import Path

import bpy


class SceneError(Exception):
    pass


def tell(event, **values):
    print("BOUNCE " + json.dumps({"event": event, **values}), flush=True)


def open_scene(job):
    """The scene to render, and the number to add to Bounce's frame numbers in it."""
    if not job["scene"].lower().endswith(".blend"):
        sys.path.insert(0, str(Path(__file__).resolve().parent))
        import cycles_import_gltf

        return cycles_import_gltf.load(job["scene"], job.get("addon"), job.get("defaults"),
                                       lambda text: tell("note", message=text))
    if not bpy.data.filepath:
        raise SceneError("the .blend file could not be opened")
    return bpy.context.scene, None


def open_job():
    """The job, its scene and what open_scene says of frame numbers. A scene without an active camera is refused."""
    job = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text(encoding="utf-8"))
    scene, imported = open_scene(job)
    if scene.camera is None:
        raise SceneError("the scene has no active camera")
    return job, scene, imported


def referred_files():
    """Absolute paths of the files that the open scene refers to and does not hold itself."""
    return [bpy.path.abspath(path) for path in bpy.utils.blend_paths(absolute=True, packed=False)]


def frame_of(scene, imported, frame):
    """Sets the scene to Bounce's frame; returns Blender's number of it."""
    if imported is not None:
        frame = imported.apply(frame)
    whole = int(frame // 1)
    scene.frame_set(whole, subframe=frame - whole)
    return frame


def match_picture(scene, width, height):
    """Switches off everything that would change the picture after or beside the light itself; size in pixels."""
    render = scene.render
    render.resolution_x = width
    render.resolution_y = height
    render.resolution_percentage = 100
    render.use_border = False
    render.use_multiview = False
    render.use_motion_blur = False
    render.use_compositing = False
    render.use_sequencer = False
    render.use_freestyle = False
    render.use_simplify = False
    render.film_transparent = False
    # Off, as by default: kept data also keeps the old sample count and seed, and an animation rebuilds it anyway.
    render.use_persistent_data = False
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_mode = "RGB"
    render.image_settings.color_depth = "32"
    if scene.camera is not None and scene.camera.type == "CAMERA" and scene.camera.data.dof.use_dof:
        scene.camera.data.dof.use_dof = False
        tell("note", message="depth of field was switched off")
    for layer in list(scene.view_layers)[1:]:
        layer.use = False
    first = scene.view_layers[0]
    first.use = True
    first.material_override = None
    first.samples = 0


def timed_render():
    """Seconds of one render of the frame that is set."""
    tell("begin")
    start = time.perf_counter()
    result = bpy.ops.render.render(write_still=False)
    seconds = time.perf_counter() - start
    if "FINISHED" not in result:
        raise SceneError("the render did not finish")
    return seconds


def repeated_renders(first, repeat):
    """The seconds of several renders, `first` the one already there, as an event tells them: the median and all."""
    times = [first] + [timed_render() for _ in range(repeat - 1)]
    return {"seconds": statistics.median(times), "seconds_all": times}


def peak_memory():
    """The largest resident memory of this process so far, in bytes; 0 where the system does not tell."""
    try:
        lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("VmHWM:")), 0)


def sentence(error):
    """One line: an operator's error carries a whole traceback, whose unindented last lines say what happened."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and not line.startswith((" ", "Location"))]
    named = [line for line in lines[1:] if "Error: " in line]
    return (named or lines or [type(error).__name__])[0 if named else -1]


def run(main):
    """Runs a script's main(); what it raises becomes the event "error" and exit code 1."""
    try:
        main()
    except Exception as error:
        if not isinstance(error, SceneError):
            traceback.print_exc(file=sys.stdout)
        tell("error", message=sentence(error))
        sys.exit(1)

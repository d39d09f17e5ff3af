# SPDX-License-Identifier: Apache-2.0
"""Renders frames of a scene with Cycles on the CPU, with light paths that match Bounce's, and times them.

    blender -b --factory-startup [SCENE.blend] --python-exit-code 1 -P cycles_render.py -- JOB.json

JOB.json: {scene, addon, width, height, bounces, frames: [{frame, renders: [{spp, seed, repeat, output}]}]}.
Each output is a scene-linear EXR of 32-bit floats. What happens is told on stdout in lines "BOUNCE {json}":

    {event: "ready", version, threads, files, view}        the scene is open; files: what it refers to
    {event: "begin"}                                       a render starts; Cycles prints "Sample 0/N" after its set-up
    {event: "warm_up", frame, seconds}                     the first render of a frame, one sample
    {event: "render", frame, spp, seed, seconds, output, rss_peak_bytes}   a later render of the same frame; median of
                                                           `repeat`; the process's largest resident memory so far
    {event: "note", message}                               something about the scene that was changed
    {event: "error", message}
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


def match_light_paths(cycles, bounces):
    """Direct light and exactly N bounces off surfaces, diffuse or glossy.

    Cycles' maxima count what comes after the first surface: with max_bounces 0 a surface is lit by the lights alone.
    Glossy bounces count as diffuse ones do, and reflective caustics are on: with either off, Cycles does not leave out
    the glossy lobe of a surface but ends the paths that happened to sample it, and rough surfaces seen at a grazing
    angle lose several per cent of their diffuse light as well. Nothing is clamped, guessed or cut off, so that the mean
    over seeds is the exact value.
    """
    cycles.max_bounces = bounces
    cycles.diffuse_bounces = bounces
    cycles.glossy_bounces = bounces
    cycles.transmission_bounces = 0
    cycles.volume_bounces = 0
    cycles.caustics_reflective = True
    cycles.caustics_refractive = False
    cycles.blur_glossy = 0.0
    cycles.sample_clamp_direct = 0.0
    cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = 0.0
    cycles.use_fast_gi = False


def match_sampling(scene):
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.use_animated_seed = False
    cycles.time_limit = 0.0
    cycles.pixel_filter_type = "BLACKMAN_HARRIS"
    cycles.filter_width = 1.5


def match_picture(scene, width, height):
    """Everything that would change the picture after or beside the light itself."""
    render = scene.render
    render.engine = "CYCLES"
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
    tell("begin")
    start = time.perf_counter()
    result = bpy.ops.render.render(write_still=False)
    seconds = time.perf_counter() - start
    if "FINISHED" not in result:
        raise SceneError("Cycles did not finish the render")
    return seconds


def peak_memory():
    """The largest resident memory of this process so far, in bytes; 0 where the system does not tell."""
    try:
        lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("VmHWM:")), 0)


def frame_of(scene, imported, frame):
    """Sets the scene to Bounce's frame; returns Blender's number of it."""
    if imported is not None:
        frame = imported.apply(frame)
    whole = int(frame // 1)
    scene.frame_set(whole, subframe=frame - whole)
    return frame


def render_frame(scene, frame, renders):
    scene.cycles.samples = 1
    scene.cycles.seed = 0
    tell("warm_up", frame=frame, seconds=timed_render())
    for item in renders:
        scene.cycles.samples = item["spp"]
        scene.cycles.seed = item["seed"]
        seconds = statistics.median(timed_render() for _ in range(item["repeat"]))
        bpy.data.images["Render Result"].save_render(item["output"], scene=scene)
        tell("render", frame=frame, spp=item["spp"], seed=item["seed"], seconds=seconds, output=item["output"],
             rss_peak_bytes=peak_memory())


def open_scene(job):
    """The scene to render, and the number to add to Bounce's frame numbers in it."""
    if job["scene"].endswith((".glb", ".gltf")):
        sys.path.insert(0, str(Path(__file__).resolve().parent))
        import cycles_import_gltf

        return cycles_import_gltf.load(job["scene"], job.get("addon"), lambda text: tell("note", message=text))
    if not bpy.data.filepath:
        raise SceneError("the .blend file could not be opened")
    return bpy.context.scene, None


def main():
    job = json.loads(Path(sys.argv[sys.argv.index("--") + 1]).read_text(encoding="utf-8"))
    scene, imported = open_scene(job)
    if scene.camera is None:
        raise SceneError("the scene has no active camera")
    match_picture(scene, job["width"], job["height"])
    match_sampling(scene)
    match_light_paths(scene.cycles, job["bounces"])
    files = [bpy.path.abspath(path) for path in bpy.utils.blend_paths(absolute=True, packed=False)]
    view = scene.view_settings
    tell("ready", version=bpy.app.version_string, threads=scene.render.threads, files=files,
         view={"display_device": scene.display_settings.display_device, "view_transform": view.view_transform,
               "look": view.look, "exposure": view.exposure, "gamma": view.gamma})
    for item in job["frames"]:
        render_frame(scene, frame_of(scene, imported, item["frame"]), item["renders"])


def sentence(error):
    """One line: an operator's error carries a whole traceback, whose unindented last lines say what happened."""
    lines = [line.strip() for line in str(error).splitlines() if line.strip() and not line.startswith((" ", "Location"))]
    named = [line for line in lines[1:] if "Error: " in line]
    return (named or lines or [type(error).__name__])[0 if named else -1]


if __name__ == "__main__":
    try:
        main()
    except Exception as error:
        if not isinstance(error, SceneError):
            traceback.print_exc(file=sys.stdout)
        tell("error", message=sentence(error))
        sys.exit(1)

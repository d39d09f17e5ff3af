# SPDX-License-Identifier: Apache-2.0
"""Renders frames of a scene with Cycles on the CPU, with light paths that match Bounce's or its own, and times them.

    blender -b --factory-startup [SCENE.blend] --python-exit-code 1 -P cycles_render.py -- JOB.json

JOB.json: {scene, addon, width, height, bounces, frames: [{frame, renders: [{spp, seed, repeat, output}]}]}.
bounces: off surfaces, after direct light; null: the scene's own light paths.
Each output is a scene-linear EXR of 32-bit floats. Lines "BOUNCE {json}" on stdout: note, error and begin (after which
Cycles prints "Sample 0/N" when it is set up) as blender_job.py tells them, and

    {event: "ready", version, threads, files, view}
    {event: "warm_up", frame, seconds}                     the first render of a frame, one sample
    {event: "render", frame, spp, seed, seconds, seconds_all, output, rss_peak_bytes}   later renders of the same frame:
                                                           the median of `repeat` and all of them; the process's largest
                                                           resident memory so far
"""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from blender_job import (frame_of, match_picture, open_job, peak_memory, referred_files, repeated_renders, run,
                         tell, timed_render)


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


def render_frame(scene, frame, renders):
    scene.cycles.samples = 1
    scene.cycles.seed = 0
    tell("warm_up", frame=frame, seconds=timed_render())
    for item in renders:
        scene.cycles.samples = item["spp"]
        scene.cycles.seed = item["seed"]
        times = repeated_renders(timed_render(), item["repeat"])
        bpy.data.images["Render Result"].save_render(item["output"], scene=scene)
        tell("render", frame=frame, spp=item["spp"], seed=item["seed"], output=item["output"],
             rss_peak_bytes=peak_memory(), **times)


def main():
    job, scene, imported = open_job()
    scene.render.engine = "CYCLES"
    match_picture(scene, job["width"], job["height"])
    match_sampling(scene)
    if job["bounces"] is not None:
        match_light_paths(scene.cycles, job["bounces"])
    view = scene.view_settings
    tell("ready", version=bpy.app.version_string, threads=scene.render.threads, files=referred_files(),
         view={"display_device": scene.display_settings.display_device, "view_transform": view.view_transform,
               "look": view.look, "exposure": view.exposure, "gamma": view.gamma})
    for item in job["frames"]:
        render_frame(scene, frame_of(scene, imported, item["frame"]), item["renders"])


if __name__ == "__main__":
    run(main)

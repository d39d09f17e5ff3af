# SPDX-License-Identifier: Apache-2.0
"""Renders frames of a scene with Eevee and times them. It needs a display: Blender 3.4 makes no OpenGL without one.

    blender -b --factory-startup [SCENE.blend] --python-exit-code 1 -P eevee_render.py -- JOB.json

JOB.json: {scene, addon, width, height, limit_seconds, frames: [{frame, renders: [{samples, output}]}]}. The scene's own
settings of Eevee stay: soft shadows, shadow maps' sizes, ambient occlusion, screen-space reflections. Set here: samples,
and off what changes the picture after the light (bloom, motion blur, depth of field, compositing). Light probes are used
where the scene has baked ones; none is baked, so indirect light is the world's alone, as in a file nobody prepared.

Lines "BOUNCE {json}" on stdout: ready, note, error as blender_job.py tells them, and

    {event: "warm_up", frame, seconds}                                     a render that is not counted
    {event: "render", frame, samples, seconds, seconds_all, rss_peak_bytes}   the median of the renders and all of them;
                                                                           output is written
    {event: "skip", frame, samples, expected_seconds}                      it would have taken longer than the limit
"""

import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from blender_job import (SceneError, frame_of, match_picture, open_job, peak_memory, referred_files,
                         repeated_renders, run, tell, timed_render)

# The first render compiles shaders. The second is the first of steady state, and with its samples says how time grows.
WARM_UPS = (1, 4)
QUICK_SECONDS = 2.0
QUICK_REPEAT = 3


def choose_engine(render):
    for name in ("BLENDER_EEVEE", "BLENDER_EEVEE_NEXT"):
        try:
            render.engine = name
            return
        except TypeError:
            continue
    raise SceneError("this Blender has no Eevee")


def match_eevee(scene):
    choose_engine(scene.render)
    for name in ("use_bloom", "use_motion_blur"):
        if hasattr(scene.eevee, name):
            setattr(scene.eevee, name, False)


def expected_seconds(known, samples):
    """A frame costs a part that is always the same and one that grows with the samples: a line through the two
    renders with the most samples."""
    if len(known) < 2 or samples <= min(known):
        return min(known.values())  # fewer samples take no longer
    (fewer, short), (more, long) = sorted(known.items())[-2:]
    return long + max(long - short, 0.0) / (more - fewer) * (samples - more)


def render_frame(scene, item, limit):
    known = {}
    for samples in WARM_UPS:
        scene.eevee.taa_render_samples = samples
        seconds = timed_render()
        tell("warm_up", frame=item["frame"], seconds=seconds)
        known = {samples: seconds}
        if seconds > limit:
            break  # nothing is known to be faster: another warm-up would only take as long again
    for wanted in item["renders"]:
        samples = wanted["samples"]
        expected = expected_seconds(known, samples)
        if expected > limit:
            tell("skip", frame=item["frame"], samples=samples, expected_seconds=expected)
            continue
        scene.eevee.taa_render_samples = samples
        first = timed_render()
        times = repeated_renders(first, QUICK_REPEAT if first < QUICK_SECONDS else 1)
        known[samples] = times["seconds"]
        bpy.data.images["Render Result"].save_render(wanted["output"], scene=scene)
        tell("render", frame=item["frame"], samples=samples, rss_peak_bytes=peak_memory(), **times)


def main():
    job, scene, imported = open_job()
    match_picture(scene, job["width"], job["height"])
    exposure = scene.cycles.film_exposure
    match_eevee(scene)
    tell("ready", version=bpy.app.version_string, files=referred_files(), film_exposure=exposure)
    for item in job["frames"]:
        frame_of(scene, imported, item["frame"])
        render_frame(scene, item, job["limit_seconds"])


if __name__ == "__main__":
    run(main)

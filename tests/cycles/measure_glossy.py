# SPDX-License-Identifier: Apache-2.0
"""Measures Cycles' glossy lobe against single-scattering GGX with two forms of Smith's shadowing.

    blender -b --factory-startup --python-exit-code 1 -P tests/cycles/measure_glossy.py

A plane of white metal (Principled BSDF, Metallic 1, Base Color 1: Fresnel's factor is 1 everywhere) under a sun of angle
0 and strength 1, seen by an orthographic camera whose frame is 4 mm wide, without bounces: a pixel's radiance is BRDF
times cosine of the light. Light and view lie in one plane with the normal, the light on the other side of it for
positive angles (0 is the normal; light at v is the mirror direction of a view at v). Printed for each case: what Cycles
shows over the law with independent shadowing, G1(l) G1(v), and over the law with height-correlated shadowing,
1/(1 + Lambda(l) + Lambda(v)); both have the same distribution D. docs/lights.md has the table.
"""
import math
import os
import tempfile

import bpy
import numpy

ROUGHNESS = (0.3, 0.5, 0.75, 1.0)
VIEWS_DEG = (0, 30, 60, 75)
LIGHTS_DEG = (-60, 0, 30, 60, 75)
# Below this part of its peak a lobe is nothing, and a ratio to it says nothing.
LEAST_SHARE = 1e-4
SAMPLES = {"GGX": 4, "MULTI_GGX": 4096}  # the multiple-scattering lobe is itself evaluated by a random walk


def new_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.max_bounces = 0
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.sample_clamp_direct = 0.0
    scene.cycles.light_sampling_threshold = 0.0
    scene.render.resolution_x = scene.render.resolution_y = 8
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.image_settings.color_mode = "RGB"
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.world = world
    material = bpy.data.materials.new("metal")
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    shader.inputs["Metallic"].default_value = 1.0
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(material)
    camera = bpy.data.cameras.new("camera")
    camera.type = "ORTHO"
    camera.ortho_scale = 0.004
    scene.camera = bpy.data.objects.new("camera", camera)
    scene.collection.objects.link(scene.camera)
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy, sun.angle = 1.0, 0.0
    node = bpy.data.objects.new("sun", sun)
    scene.collection.objects.link(node)
    return scene, shader, node


def render_middle(scene, samples, folder):
    scene.cycles.samples = samples
    scene.render.filepath = os.path.join(folder, "pixel.exr")
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(scene.render.filepath)
    pixels = numpy.array(image.pixels[:]).reshape(8, 8, -1)
    bpy.data.images.remove(image)
    return float(pixels[2:6, 2:6, 0].mean())


def laws(roughness, light, view):
    """BRDF times the light's cosine, with independent and with correlated shadowing; angles in radians."""
    alpha2 = max(roughness, 1e-2) ** 4
    half = 0.5 * (light - view)  # from the normal; the light's angle counts away from the viewer
    t = math.cos(half) ** 2 * (alpha2 - 1.0) + 1.0
    distribution = alpha2 / (math.pi * t * t)

    def smith_lambda(angle):
        return 0.5 * (math.sqrt(1.0 + alpha2 * math.tan(angle) ** 2) - 1.0)

    common = distribution / (4.0 * math.cos(view))
    independent = common / ((1.0 + smith_lambda(light)) * (1.0 + smith_lambda(view)))
    correlated = common / (1.0 + smith_lambda(light) + smith_lambda(view))
    return independent, correlated


def main():
    scene, shader, sun = new_scene()
    lines = [f"Blender {bpy.app.version_string}; Cycles over independent | over correlated shadowing"]
    worst = {"independent": 0.0, "correlated": 0.0}
    with tempfile.TemporaryDirectory() as folder:
        for distribution, samples in SAMPLES.items():
            material = shader.id_data.nodes["Principled BSDF"]
            default = material.bl_rna.properties["distribution"].default
            material.distribution = distribution
            lines.append(f"{distribution}{' (the default)' if distribution == default else ''}")
            lines.append("roughness  view | light " + "".join(f"{a:>+16d}" for a in LIGHTS_DEG))
            for roughness in ROUGHNESS:
                shader.inputs["Roughness"].default_value = roughness
                peak = laws(roughness, 0.0, 0.0)[0]
                for view_deg in VIEWS_DEG:
                    view = math.radians(view_deg)
                    scene.camera.location = (-5.0 * math.sin(view), 0.0, 5.0 * math.cos(view))
                    # A camera looks along its -Z.
                    scene.camera.rotation_euler = (0.0, -view, 0.0)
                    cells = ""
                    for light_deg in LIGHTS_DEG:
                        light = math.radians(light_deg)
                        sun.rotation_euler = (0.0, light, 0.0)
                        independent, correlated = laws(roughness, light, view)
                        if independent < LEAST_SHARE * peak:
                            cells += f"{'-':>16}"
                            continue
                        value = render_middle(scene, samples, folder)
                        cells += f"{value / independent:9.4f} {value / correlated:.4f}"
                        if distribution == "GGX":
                            worst["independent"] = max(worst["independent"], abs(value / independent - 1.0))
                            worst["correlated"] = max(worst["correlated"], abs(value / correlated - 1.0))
                    lines.append(f"{roughness:9.2f} {view_deg:5d} |       {cells}")
    lines.append("GGX, largest relative difference: " + ", ".join(f"{k} {v:.4f}" for k, v in worst.items()))
    print("\n".join(lines))


main()

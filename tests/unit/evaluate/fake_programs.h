// SPDX-License-Identifier: Apache-2.0
//
// Small scripts in the place of Bounce and Blender: they take the same arguments and leave the same
// files, so that what runs them is tested in milliseconds and without a GPU.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "image/image_io.h"

namespace bounce::test {

inline std::filesystem::path write_script(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path) << text;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    return path;
}

inline void write_constant(const std::filesystem::path& path, float value, int width, int height) {
    Image image(width, height);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    write_image(path, image);
}

// clang-format off
// `bounce render`: copies picture.exr to the output of each frame and tells of 20 ms a frame, 30 ms in the
// first of three renders. Its arguments are appended to bounce_calls, a line a call.
inline std::filesystem::path fake_bounce(const std::filesystem::path& folder) {
    return write_script(folder / "bounce", "#!/bin/sh\nset -e\nhere='" + folder.string() + R"sh('
echo "$@" >> "$here/bounce_calls"
while [ $# -gt 0 ]; do
  case "$1" in
    -o) output=$2; shift;;
    --frames) frames=$(echo "$2" | tr , ' '); shift;;
    --stats) stats=$2; shift;;
  esac
  shift
done
items=
for frame in $frames; do
  number=$(printf %04d "$frame")
  cp "$here/picture.exr" "$(echo "$output" | sed "s/####/$number/")"
  items="$items${items:+,}{\"frame\":$frame,\"time_s\":0,\"wall_ms\":20,\"wall_ms_all\":[30,20,20]}"
done
echo "{\"gl\":{\"vendor\":\"v\",\"renderer\":\"r\",\"version\":\"4.5\"},\"frames\":[$items]}" > "$stats"
)sh");
}

// `blender`: answers --version; as a renderer of the job it copies cycles.exr to each output, and tells
// of 2 s a sample. Its job files are appended to blender_calls.
inline std::filesystem::path fake_blender(const std::filesystem::path& folder) {
    return write_script(folder / "blender", R"py(#!/usr/bin/env python3
import json, shutil, sys
if sys.argv[1:] == ["--version"]:
    print("Blender 9.9.9\n\tbuild hash: abcdef")
    sys.exit()
here = ')py" + folder.string() + R"py('
job = json.load(open(sys.argv[-1]))
open(here + "/blender_calls", "a").write(json.dumps(job) + "\n")
tell = lambda **event: print("BOUNCE " + json.dumps(event), flush=True)
tell(event="ready", version="9.9.9", threads=2, files=[], view={"display_device": "sRGB",
     "view_transform": "Standard", "look": "None", "exposure": 0, "gamma": 1})
for frame in job["frames"]:
    tell(event="begin")
    tell(event="warm_up", frame=frame["frame"], seconds=3.0)
    for item in frame["renders"]:
        tell(event="begin")
        print("Fra:1 | Scene, ViewLayer | Sample 0/%d" % item["spp"], flush=True)
        shutil.copy(here + "/cycles.exr", item["output"])
        tell(event="render", frame=frame["frame"], spp=item["spp"], seed=item["seed"], seconds=2.0 * item["spp"],
             output=item["output"])
)py");
}
// clang-format on

}  // namespace bounce::test

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
// `bounce render`: copies picture.exr, or picture.0001.exr of frame 1 where that is there, to the output of each frame
// (motion.exr with --show motion, told in motion_calls; where there is none it fails) and tells of 20 ms a frame, 30 ms in the
// first of three renders. Its arguments are appended to bounce_calls, a line a call; those of a run that times passes to pass_calls.
inline std::filesystem::path fake_bounce(const std::filesystem::path& folder) {
    return write_script(folder / "bounce", "#!/bin/sh\nset -e\nhere='" + folder.string() + R"sh('
source=picture
case "$*" in
  *"--show motion"*) echo "$@" >> "$here/motion_calls"; source=motion;;
  *--no-pass-times*) echo "$@" >> "$here/bounce_calls";;
  *) echo "$@" >> "$here/pass_calls";;
esac
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
  picture="$here/$source.exr"
  if [ -e "$here/$source.$number.exr" ]; then picture="$here/$source.$number.exr"; fi
  cp "$picture" "$(echo "$output" | sed "s/####/$number/")"
  items="$items${items:+,}{\"frame\":$frame,\"time_s\":0,\"wall_ms\":20,\"wall_ms_all\":[30,20,20],\"passes\":[{\"name\":\"gbuffer\",\"gpu_ms\":5,\"gpu_ms_all\":[4,5,9],\"cpu_ms\":1}]}"
done
echo "{\"gl\":{\"vendor\":\"v\",\"renderer\":\"r\",\"version\":\"4.5\"},\"frames\":[$items],\"left_out\":[{\"pass\":\"deform\",\"reason\":\"nothing moves\"}],\"approximations\":[],\"startup\":{\"context_ms\":40,\"load_ms\":200,\"upload_ms\":50,\"first_frame_ms\":70},\"run_ms\":0,\"memory\":{\"gl_peak_bytes\":7,\"rss_peak_bytes\":8}}" > "$stats"
)sh");
}

// `blender`: answers --version; as a renderer of the job it copies cycles.exr to each output (cycles_own.exr by the scene's own light paths), and tells
// of 2 s a sample, up to 1.5 and 4 s where it is asked for three renders. Its job files are appended to blender_calls; a file cycles_fail_after N ends it behind N renders, one
// cycles_cut N cuts off the pictures of N samples, as the real one does without a word on a full disk.
inline std::filesystem::path fake_blender(const std::filesystem::path& folder) {
    return write_script(folder / "blender", R"py(#!/usr/bin/env python3
import json, os, shutil, sys
if sys.argv[1:] == ["--version"]:
    print("Blender 9.9.9\n\tbuild hash: abcdef")
    sys.exit()
here = ')py" + folder.string() + R"py('
job = json.load(open(sys.argv[-1]))
open(here + "/blender_calls", "a").write(json.dumps(job) + "\n")
tell = lambda **event: print("BOUNCE " + json.dumps(event), flush=True)
left = int(open(here + "/cycles_fail_after").read()) if os.path.exists(here + "/cycles_fail_after") else 1000
tell(event="ready", version="9.9.9", threads=2, files=[], view={"display_device": "sRGB",
     "view_transform": "Standard", "look": "None", "exposure": 0, "gamma": 1})
for frame in job["frames"]:
    tell(event="begin")
    tell(event="warm_up", frame=frame["frame"], seconds=3.0)
    for item in frame["renders"]:
        if left == 0:
            sys.exit(1)
        left -= 1
        tell(event="begin")
        print("Fra:1 | Scene, ViewLayer | Sample 0/%d" % item["spp"], flush=True)
        own = job.get("bounces", 0) is None and os.path.exists(here + "/cycles_own.exr")
        shutil.copy(here + ("/cycles_own.exr" if own else "/cycles.exr"), item["output"])
        if os.path.exists(here + "/cycles_cut") and int(open(here + "/cycles_cut").read()) == item["spp"]:
            os.truncate(item["output"], 300)
        tell(event="render", frame=frame["frame"], spp=item["spp"], seed=item["seed"], seconds=2.0 * item["spp"],
             output=item["output"], seconds_all=[2.0 * item["spp"], 1.5 * item["spp"], 4.0 * item["spp"]][:item["repeat"]])
)py");
}

// `blender` for the peers: as Eevee's script it copies peer.exr to each output and tells of 0.1 s a sample, as f3d's it
// tells of a camera. Files beside it change what it does: fail_after N ends it behind N renders, skip N leaves out N
// samples, bad_camera is an error. Its jobs are appended to peer_calls.
inline std::filesystem::path fake_peer_blender(const std::filesystem::path& folder) {
    return write_script(folder / "peer_blender", R"py(#!/usr/bin/env python3
import json, os, shutil, sys
here = ')py" + folder.string() + R"py('
job = json.load(open(sys.argv[-1]))
open(here + "/peer_calls", "a").write(json.dumps(job) + "\n")
read = lambda name: open(here + "/" + name).read() if os.path.exists(here + "/" + name) else ""
tell = lambda **event: print("BOUNCE " + json.dumps(event), flush=True)
tell(event="ready", version="9.9.9", files=[], film_exposure=2.0)
left = int(read("fail_after") or 1000)
if read("bad_camera"):
    tell(event="error", message=read("bad_camera"))
    sys.exit(1)
for frame in job["frames"]:
    if "lit" in frame:
        for name in ("lit", "unlit"):
            open(frame[name], "w").write("glTF")
        tell(event="frame", frame=frame["frame"], seconds=0.25, position=[1, 2, 3.5], focal_point=[0, 0, 0],
             view_up=[0, 1, 0], view_angle=30.5, background=[0, 0, 0])
        continue
    tell(event="warm_up", frame=frame["frame"], seconds=7.0)
    for item in frame["renders"]:
        if str(item["samples"]) == read("skip"):
            tell(event="skip", frame=frame["frame"], samples=item["samples"], expected_seconds=99.0)
            continue
        if left == 0:
            sys.exit(1)
        left -= 1
        shutil.copy(here + "/peer.exr", item["output"])
        tell(event="render", frame=frame["frame"], samples=item["samples"], seconds=0.1 * item["samples"],
             rss_peak_bytes=12345, seconds_all=[0.1 * item["samples"], 0.05 * item["samples"], 0.3 * item["samples"]])
)py");
}

// `f3d` in folder/bin: 100 ms of start, 40 ms without a window, and 5 ms a press; copies peer.png to its output. Its arguments are appended to
// f3d_calls.
inline std::filesystem::path fake_f3d(const std::filesystem::path& folder) {
    return write_script(folder / "bin/f3d", R"py(#!/usr/bin/env python3
import shutil, sys, time
here = ')py" + folder.string() + R"py('
if "--version" in sys.argv:
    print("f3d 9.9.9")
    sys.exit()
if "--no-render" in sys.argv:
    time.sleep(0.04)
    sys.exit()
open(here + "/f3d_calls", "a").write(" ".join(sys.argv[1:]) + "\n")
options = dict(word[2:].split("=", 1) for word in sys.argv[1:] if "=" in word)
time.sleep(0.1 + 0.005 * open(options["interaction-test-play"]).read().count("KeyPress"))
shutil.copy(here + "/peer.png", options["output"])
)py");
}
// clang-format on

}  // namespace bounce::test

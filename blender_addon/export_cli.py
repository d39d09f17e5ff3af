# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports a scene from the command line, with nothing installed in Blender:

    blender -b --factory-startup SCENE.blend -P blender_addon/export_cli.py -- OUT.glb [options]
"""

import argparse
import json
import sys
import traceback
from pathlib import Path

import addon_utils
import bpy

EXIT_FAILED = 1


def parse(arguments):
    from bounce.options import Options

    defaults = Options()
    parser = argparse.ArgumentParser(prog="export_cli.py", description="Export the open .blend for Bounce.")
    parser.add_argument("output", metavar="OUT.glb", help="file to write; .gltf writes separate files")
    parser.add_argument("--no-draco", dest="draco", action="store_false", help="do not compress meshes")
    parser.add_argument("--draco-level", type=_bounded(0, 10), default=defaults.draco_level, metavar="0-10",
                        help="0 is fastest, 10 smallest (default %(default)s)")
    for name in ("position", "normal", "texcoord", "color", "generic"):
        parser.add_argument(f"--{name}-bits", type=_bounded(0, 30), default=getattr(defaults, f"{name}_bits"),
                            metavar="N", help="quantisation, 0 for none (default %(default)s)")
    parser.add_argument("--no-animation", dest="animation", action="store_false",
                        help="write the first frame alone")
    parser.add_argument("--keep-all", action="store_true",
                        help="write what nothing reads and what is there twice as well, for comparison")
    parser.add_argument("--verbose", action="store_true", help="list what is left out, and why")
    parser.add_argument("--report", metavar="FILE.json", help="write what is left out and what cannot be represented")
    return parser.parse_args(arguments)


def _bounded(low, high):
    def convert(text):
        value = int(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{value} is not within {low} and {high}")
        return value

    return convert


def main():
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    # Before anything else imports the add-on, which Blender would otherwise take for changed and load again.
    module = addon_utils.enable("bounce", default_set=True)
    arguments = vars(parse(sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []))
    from bounce.errors import ExportError
    from bounce.export import export
    from bounce.options import Options

    if module is None:
        raise ExportError("the add-on 'bounce' cannot be enabled")
    if not bpy.data.filepath:
        # Blender's default scene is nobody's.
        raise ExportError("no .blend file is open; was it found and could this Blender read it?")
    output, verbose, listing = (arguments.pop(name) for name in ("output", "verbose", "report"))
    report = export(output, Options(**arguments))
    for line in report.lines(verbose):
        print(f"bounce: {line}")
    if listing is not None:
        Path(listing).write_text(json.dumps(report.as_json(), indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    # Blender itself exits with 0 after a Python exception.
    try:
        main()
    except SystemExit:
        raise
    except Exception as error:
        name = ""
        if type(error).__name__ != "ExportError":
            # Not foreseen: the sentence goes to stderr as ever, where it happened to stdout.
            traceback.print_exc(file=sys.stdout)
            name = f"{type(error).__name__}: "
        print(f"bounce: export failed: {name}{error}", file=sys.stderr)
        sys.exit(EXIT_FAILED)

#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the add-on into a .zip that Blender installs (Edit > Preferences > Add-ons > Install).

    blender_addon/package.py [OUT.zip] [--draco LIBRARY]

Without --draco the newest libextern_draco of the checkout's builds goes in, if there is one.
"""

import argparse
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

from bounce import draco_library  # noqa: E402

# Archives of the same files are the same bytes.
_TIMESTAMP = (2020, 1, 1, 0, 0, 0)


def files(library):
    for path in sorted((HERE / "bounce").rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts and path.name != draco_library.FILE_NAME:
            yield path, path.relative_to(HERE)
    yield HERE / "LICENSE", Path("bounce/LICENSE")
    if library is not None:
        yield library, Path("bounce") / draco_library.FILE_NAME


def main():
    parser = argparse.ArgumentParser(description="Pack the Bounce add-on for Blender.")
    parser.add_argument("output", nargs="?", type=Path, default=Path("bounce-addon.zip"), metavar="OUT.zip")
    parser.add_argument("--draco", type=Path, metavar="LIBRARY", help="libextern_draco to put in")
    arguments = parser.parse_args()
    if arguments.draco is not None and not arguments.draco.is_file():
        parser.error(f"{arguments.draco} does not exist")
    library = arguments.draco
    if library is None:
        library = next((p for p in draco_library.candidates(HERE / "bounce") if p.is_file()), None)
    with zipfile.ZipFile(arguments.output, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, name in files(library):
            entry = zipfile.ZipInfo(str(name), _TIMESTAMP)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, path.read_bytes())
    print(f"{arguments.output}: " + ("with the Draco library" if library else "without a Draco library (none built)"))


if __name__ == "__main__":
    main()

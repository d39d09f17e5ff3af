# SPDX-License-Identifier: GPL-3.0-or-later
"""Changes to the open scene that last as long as an export and are then taken back."""

import contextlib


class Edits:
    """Use with `with`: on leaving, everything is undone in reverse order, whatever happened in between."""

    def __init__(self):
        self._undo = contextlib.ExitStack()

    def __enter__(self):
        return self

    def __exit__(self, *exception):
        return self._undo.__exit__(*exception)

    def set(self, owner, name, value):
        before = getattr(owner, name)
        if before == value:
            return
        setattr(owner, name, value)
        self._undo.callback(setattr, owner, name, before)

    def undo_with(self, function, *arguments):
        self._undo.callback(function, *arguments)

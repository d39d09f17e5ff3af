# SPDX-License-Identifier: GPL-3.0-or-later


class ExportError(Exception):
    """What the user is told, in one sentence, when an export cannot be made."""

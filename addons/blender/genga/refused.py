# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors for users, and operators that report them to Blender. Independent of Blender."""


class Refused(Exception):
    """An error for the user, in a sentence that says how to fix it."""


def engine():
    """Imports the package genga, which the extension includes as a wheel."""
    try:
        import genga
    except ImportError as error:
        raise Refused(
            "this add-on lacks genga's wheel: install the zip that addons/blender/build makes"
        ) from error
    return genga


def kinds():
    """Returns the errors to report that are not bugs of the add-on."""
    try:
        return (Refused, OSError, engine().Error)
    except Refused:
        return (Refused, OSError)


class Reported:
    """An operator that reports errors of `run` to Blender, without a traceback."""

    def execute(self, context):
        return self.reported(lambda: self.run(context))

    def reported(self, work):
        try:
            return work()
        except kinds() as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

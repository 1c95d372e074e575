"""Errors for a person, and operators that report them in Blender's way. Knows nothing of Blender."""


class Refused(Exception):
    """What is wrong and the way out, in a sentence."""


def engine():
    """The package genga, which the extension carries as a wheel."""
    try:
        import genga
    except ImportError as error:
        raise Refused(
            "this add-on came without genga's wheel: install the zip that addons/blender/build makes"
        ) from error
    return genga


def kinds():
    """The errors that are told and are no fault of the add-on."""
    try:
        return (Refused, OSError, engine().Error)
    except Refused:
        return (Refused, OSError)


class Reported:
    """An operator whose `run` is told to Blender: what is refused is an error report, never a traceback."""

    def execute(self, context):
        return self.reported(lambda: self.run(context))

    def reported(self, work):
        try:
            return work()
        except kinds() as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

"""What a window of Blender does with operators and panels. As a module Blender has no window that runs."""

from types import SimpleNamespace

import bpy


class Window:
    """Blender's context with a window manager that notes what a person would see."""

    def __init__(self):
        self.shown, self.timers, self.status = [], 0, []
        self.workspace = SimpleNamespace(status_text_set=self.status.append)
        self.window_manager = self

    def __getattr__(self, name):
        return getattr(bpy.context, name)

    def event_timer_add(self, _seconds, window):
        self.timers += 1
        return self.timers

    def event_timer_remove(self, _timer):
        self.timers -= 1

    def progress_begin(self, *ends):
        self.shown = list(ends[:1])

    def progress_update(self, at):
        self.shown.append(at)

    def progress_end(self):
        self.shown.append("end")

    def modal_handler_add(self, _operator):
        return True

    def invoke_confirm(self, _operator, _event, title, message):
        self.asked = title, message
        return {"RUNNING_MODAL"}


def driven(operator, **properties):
    """An operator as Blender's window drives it; as a module Blender has none. `said` is what it reports."""
    plain = tuple(kind for kind in operator.__mro__[1:] if not issubclass(kind, bpy.types.bpy_struct) and kind is not object)
    own = {name: own for name, own in vars(operator).items() if callable(own) and not name.startswith("__")}
    said = []
    made = type("Driven", plain, {**own, **properties, "said": said, "report": lambda _, *told: said.append(told)})
    return made()


def modally(operator, window, events):
    """Runs an operator by its modal functions on events until it ends."""
    own, events = driven(operator), iter(events)
    done = own.invoke(window, None)
    while done == {"RUNNING_MODAL"}:
        done = own.modal(window, SimpleNamespace(type=next(events)))
    return done, own.said


class Layout:
    """A layout that draws nothing, and knows what Blender could not draw."""

    def __init__(self):
        self.drawn = []

    def part(self, **_):
        return self

    row = column = part

    def separator(self):
        pass

    def prop(self, data, name, **_):
        assert name in data.bl_rna.properties, name
        self.drawn.append(name)

    def operator(self, name, **_):
        of, _, own = name.partition(".")
        assert hasattr(bpy.types, f"{of.upper()}_OT_{own}"), name
        self.drawn.append(name)
        return SimpleNamespace()

    def menu(self, name):
        assert hasattr(bpy.types, name), name

    def template_list(self, kind, _, data, name, own, active, **_rows):
        assert hasattr(bpy.types, kind) and name in data.bl_rna.properties and active in own.bl_rna.properties
        for one in data.passages if name == "passages" else ():
            bpy.types.GENGA_UL_passages.draw_item(None, bpy.context, self, data, one, 0, own, active)

    def label(self, text, **_):
        self.drawn.append(text)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Exports the result as timesheets and other files, written by genga itself."""

from bpy.props import EnumProperty, StringProperty
from bpy.types import Operator

from . import findings
from .refused import Refused, Reported
from .subject import armature_of

FORMATS = (
    ("xdts", "XDTS", "Timesheets for drawing programs"),
    ("xsheet", "X-Sheet", "The timesheet on paper: HTML, and each page as SVG"),
    ("csv", "CSV", "Tables of genga, drawings and koma"),
    ("json", "Sheet", "The sheet as JSON, which can be edited and read again"),
    ("cut", "Cut Folder", "Both timesheets, and each column's pictures named by cel number"),
    ("poses", "Poses", "Picture: the poses of the genga in a row"),
    ("flipbook", "Flip-Book", "A page to play and step through in any browser"),
)


class GENGA_OT_export(Reported, Operator):
    """Write the timesheet into a folder"""

    bl_idname = "genga.export"
    bl_label = "Export Timesheet"

    directory: StringProperty(subtype="DIR_PATH")
    filter_folder: StringProperty(default="", options={"HIDDEN"})
    formats: EnumProperty(
        name="Formats",
        items=FORMATS,
        options={"ENUM_FLAG"},
        default={"xdts", "xsheet", "csv"},
    )

    @classmethod
    def poll(cls, context):
        if findings.of(armature_of(context)) is None:
            cls.poll_message_set("Find the keys of an armature first")
            return False
        return True

    def invoke(self, context, _event):
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def run(self, context):
        if not self.formats or not self.directory:
            raise Refused("choose a folder and at least one format")
        result = findings.of(armature_of(context)).result
        names = [name for name, *_ in FORMATS if name in self.formats]
        written = result.write(self.directory, *names)
        self.report({"INFO"}, f"{len(written)} files in {self.directory}")
        return {"FINISHED"}

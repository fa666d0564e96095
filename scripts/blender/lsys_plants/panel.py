# SPDX-License-Identifier: MIT
"""Properties, operators and panels of the add-on.

A plant or forest is a collection whose settings, `lsys`, have a kind other than NONE; its contents follow the settings.
"""
import os
import struct
import textwrap

import bpy
from bpy.props import (BoolProperty, CollectionProperty, EnumProperty, FloatProperty, IntProperty,
                       PointerProperty, StringProperty)
from bpy_extras.io_utils import ImportHelper

from . import compiler, scene
from .compiler import CompilerError
from .gltf import GltfError

FAILURES = (CompilerError, GltfError, OSError)
#: A plant is updated after this many seconds without a change, so that dragging a value runs lsc only once.
DELAY = 0.3
#: Largest value of an IntProperty in Blender.
MAX_INT = 2**31 - 1
#: Max number of lines of messages in the panel.
MAX_LINES = 12


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    lsc: StringProperty(name="lsc", subtype="FILE_PATH", description="Path of the program lsc; empty: the Python module lsys, or else lsc in PATH")
    seconds: FloatProperty(name="Time limit", default=120.0, min=1.0, soft_max=3600.0, subtype="TIME_ABSOLUTE",
                           description="Seconds after which a run of lsc is stopped")

    def draw(self, context):
        self.layout.prop(self, "lsc")
        self.layout.prop(self, "seconds")


def compiler_and_limit():
    """The compiler of the preferences, and its time limit in seconds. Raises CompilerError if none is found."""
    addon = bpy.context.preferences.addons.get(__package__)
    if addon is None:  # registered by a script instead of being enabled in the preferences
        return compiler.find_compiler(), 120.0
    return compiler.find_compiler(bpy.path.abspath(addon.preferences.lsc)), addon.preferences.seconds


pending = set()  # names of collections with changes that wait for the timer


class PausedUpdates:
    """A `with` block in which changes of settings do not update plants."""

    depth = 0

    def __enter__(self):
        PausedUpdates.depth += 1

    def __exit__(self, *_):
        PausedUpdates.depth -= 1


def changed(self, context):
    """Updates the plant: at once in background mode, else when no value has changed for DELAY seconds."""
    collection = self.id_data
    if PausedUpdates.depth > 0 or not collection.lsys.is_live or collection.lsys.kind == "NONE":
        return
    if bpy.app.background:
        try:
            update(collection)
        except FAILURES:
            pass  # the settings have the message, which the panel shows
        return
    pending.add(collection.name)
    if bpy.app.timers.is_registered(run_pending):
        bpy.app.timers.unregister(run_pending)
    bpy.app.timers.register(run_pending, first_interval=DELAY)


def run_pending():
    """Updates the plants of `pending`."""
    names = sorted(pending)
    pending.clear()
    windows = bpy.context.window_manager.windows
    for name in names:
        if name in bpy.data.collections and windows:
            with bpy.context.temp_override(window=windows[0]):
                try:
                    bpy.ops.lsys.update(collection=name)
                except RuntimeError:
                    pass  # Blender has reported the error, and the panel shows it


def file_changed(self, context):
    collection = self.id_data
    if PausedUpdates.depth > 0 or self.kind == "NONE":
        return
    try:
        read_file(collection, keep=False)
    except FAILURES as error:
        self.message = str(error)
        return
    changed(self, context)


class Parameter(bpy.types.PropertyGroup):
    """A #param or #define of the grammar."""

    def get_value(self):
        return self.get("number", self.default)

    def set_value(self, value):
        self["number"] = min(max(value, self.minimum), self.maximum) if self.is_bounded else value

    default: FloatProperty()
    minimum: FloatProperty()
    maximum: FloatProperty()
    is_bounded: BoolProperty()
    value: FloatProperty(name="Value", get=get_value, set=set_value, update=changed, precision=3, step=1)


class Settings(bpy.types.PropertyGroup):
    """The settings of a plant or forest."""

    kind: EnumProperty(items=(("NONE", "None", ""), ("PLANT", "Plant", "One plant of a grammar"),
                              ("FOREST", "Forest", "A scene, or many plants of a grammar")))
    is_live: BoolProperty(name="Live", default=True, update=changed,
                          description="Follow each change of a value at once")
    file: StringProperty(name="File", subtype="FILE_PATH", update=file_changed,
                         description="A grammar; for a forest also a scene (.toml)")
    seed: IntProperty(name="Seed", min=0, update=changed,
                      description="Equal seeds give equal plants; for a forest this is the key")
    generations: IntProperty(name="Generations", min=0, soft_max=30, update=changed,
                             description="Rounds of rewriting")
    height: FloatProperty(name="Height", min=0.0, soft_max=100.0, unit="LENGTH", update=changed,
                          description="Height of the plant, or of full-grown trees of a forest; "
                                      "0: height of the grammar")
    count: IntProperty(name="Trees", default=1000, min=1, soft_max=10000, update=changed,
                       description="Number of trees of a forest of a grammar")
    size: FloatProperty(name="Side", default=100.0, min=0.01, soft_max=10000.0, unit="LENGTH", update=changed,
                        description="Side of the ground of a forest of a grammar")
    options: StringProperty(name="Options", update=changed,
                            description="More options of lsc, such as --sides 12 --smooth-joints")
    parameters: CollectionProperty(type=Parameter)
    has_key: BoolProperty(description="The key of the scene is known, and was shown as the seed")
    message: StringProperty(description="Last messages of lsc")

    @property
    def is_scene(self):
        return self.file.lower().endswith(".toml")


def path_of(settings):
    """The path of the grammar or scene. CompilerError: there is no such file."""
    path = bpy.path.abspath(settings.file)
    if not os.path.isfile(path):
        raise CompilerError(f"{path or 'no file'}: there is no such file")
    return path


def read_file(collection, keep):
    """Reads generations, seed and parameters of the grammar. With `keep`, values that the user changed stay."""
    settings = collection.lsys
    path = path_of(settings)
    found, seconds = compiler_and_limit()
    if settings.is_scene:
        settings.parameters.clear()
        settings.has_key = keep and settings.has_key
        return
    grammar = found.read_parameters(path, seconds)
    values = {p.name: p.value for p in settings.parameters if p.value != p.default} if keep else {}
    with PausedUpdates():
        settings.parameters.clear()
        for one in grammar["parameters"]:
            if "value" not in one:
                continue  # a random constant, which depends on the seed
            parameter = settings.parameters.add()
            parameter.name = one["name"]
            parameter.default = one["value"]
            parameter.is_bounded = "min" in one
            parameter.minimum, parameter.maximum = one.get("min", 0.0), one.get("max", 0.0)
            parameter.value = values.get(one["name"], one["value"])
        if not keep:
            settings.generations = min(grammar["generations"], MAX_INT)
            settings.seed = min(grammar["seed"], MAX_INT)


def shortest(value):
    """The shortest text that reads back as the same 32-bit float."""
    bits = struct.pack("f", value)
    return next(text for text in (f"{value:.{digits}g}" for digits in range(6, 10))
                if struct.pack("f", float(text)) == bits)


def arguments_of(collection):
    """Arguments of lsc, except the output file."""
    settings = collection.lsys
    path = path_of(settings)
    more = compiler.split_options(settings.options)
    if settings.kind == "PLANT":
        arguments = ["export", path, "--seed", str(settings.seed)]
    else:
        arguments = ["forest", path]
        if settings.is_scene:
            if settings.has_key:
                arguments += ["--key", str(settings.seed)]
        else:
            arguments += ["--key", str(settings.seed), "--count", str(settings.count),
                          "--size", shortest(settings.size)]
    if not settings.is_scene:
        arguments += ["--generations", str(settings.generations)]
    if settings.height > 0:
        arguments += ["--height", shortest(settings.height)]
    for parameter in settings.parameters:
        if parameter.value != parameter.default:
            arguments += ["-D", f"{parameter.name}={shortest(parameter.value)}"]
    return arguments + more


def update(collection):
    """Runs the compiler, replaces the contents of the collection and returns the messages.

    Raises FAILURES; the contents then stay, and the settings have the message.
    """
    settings = collection.lsys
    try:
        found, seconds = compiler_and_limit()
        with compiler.TemporaryGlb(found, arguments_of(collection), seconds) as (path, messages):
            extras = scene.fill(collection, path, settings.kind == "FOREST")
    except FAILURES as error:
        settings.message = str(error)
        raise
    settings.message = messages
    if settings.is_scene and not settings.has_key and str(extras.get("key", "")).isdigit():
        key = int(extras["key"])
        if key <= MAX_INT:
            with PausedUpdates():
                settings.seed = key
                settings.has_key = True
    return messages


def current(context):
    """The plant of the active object, else the active collection if it is a plant, else None."""
    if context.object is not None:
        for collection in context.object.users_collection:
            if collection.lsys.kind != "NONE":
                return collection
    collection = context.collection
    return collection if collection is not None and collection.lsys.kind != "NONE" else None


class Runner:
    """Base of the operators: errors become reports with the text of lsc."""

    bl_options = {"REGISTER", "UNDO"}

    def attempt(self, action):
        try:
            messages = action()
        except FAILURES as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if messages:
            self.report({"WARNING"}, messages)
        return {"FINISHED"}

    def chosen(self, context):
        named = getattr(self, "collection", "")
        return bpy.data.collections.get(named) if named else current(context)


class Creator(Runner, ImportHelper):
    """Base of operators that make a new collection and fill it; an error removes the collection."""

    def execute(self, context):
        def create():
            name = os.path.splitext(os.path.basename(self.filepath))[0] or "plant"
            collection = bpy.data.collections.new(name)
            context.scene.collection.children.link(collection)
            settings = collection.lsys
            try:
                with PausedUpdates():
                    settings.kind = self.kind
                    settings.file = self.filepath
                read_file(collection, keep=False)
                messages = update(collection)
            except BaseException:
                bpy.data.collections.remove(collection)
                raise
            scene.activate(scene.anchor_of(collection))
            return messages

        return self.attempt(create)


class NewPlant(Creator, bpy.types.Operator):
    """Grow a plant from a grammar, in a collection of its own"""

    bl_idname = "lsys.new_plant"
    bl_label = "New plant"
    kind = "PLANT"
    filename_ext = ".lsys"
    filter_glob: StringProperty(default="*.lsys;*.lsb;*.l;*.l3d;*.l++;*.rules;*.hlsys;*.sys", options={"HIDDEN"})


class NewForest(Creator, bpy.types.Operator):
    """Make a forest of a scene or of a grammar, in a collection of its own"""

    bl_idname = "lsys.new_forest"
    bl_label = "New forest"
    kind = "FOREST"
    filename_ext = ".toml"
    filter_glob: StringProperty(default="*.toml;*.lsys;*.lsb;*.l;*.l3d;*.l++;*.rules;*.hlsys;*.sys",
                                options={"HIDDEN"})


class ImportForest(Runner, ImportHelper, bpy.types.Operator):
    """Import a forest that lsc has written, instances included"""

    bl_idname = "lsys.import_forest"
    bl_label = "Import forest of lsc"
    filename_ext = ".glb"
    filter_glob: StringProperty(default="*.glb;*.gltf", options={"HIDDEN"})

    def execute(self, context):
        def load():
            name = os.path.splitext(os.path.basename(self.filepath))[0] or "forest"
            collection = bpy.data.collections.new(name)
            context.scene.collection.children.link(collection)
            try:
                scene.fill(collection, self.filepath, True)
            except BaseException:
                bpy.data.collections.remove(collection)
                raise

        return self.attempt(load)


class Update(Runner, bpy.types.Operator):
    """Make the plant anew from its settings"""

    bl_idname = "lsys.update"
    bl_label = "Update"
    collection: StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        collection = self.chosen(context)
        if collection is None:
            self.report({"ERROR"}, "no plant or forest of lsc is active")
            return {"CANCELLED"}
        return self.attempt(lambda: update(collection))


class Reload(Runner, bpy.types.Operator):
    """Read the file again, after it was edited; changed values stay"""

    bl_idname = "lsys.reload"
    bl_label = "Reload file"
    collection: StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        collection = self.chosen(context)
        if collection is None:
            self.report({"ERROR"}, "no plant or forest of lsc is active")
            return {"CANCELLED"}

        def reload():
            read_file(collection, keep=True)
            return update(collection)

        return self.attempt(reload)


class ResetValues(Runner, bpy.types.Operator):
    """Give all parameters the values of the grammar"""

    bl_idname = "lsys.reset"
    bl_label = "Reset values"
    collection: StringProperty(options={"HIDDEN", "SKIP_SAVE"})

    def execute(self, context):
        collection = self.chosen(context)
        if collection is None:
            self.report({"ERROR"}, "no plant or forest of lsc is active")
            return {"CANCELLED"}
        settings = collection.lsys
        with PausedUpdates():
            for parameter in settings.parameters:
                parameter.value = parameter.default
        return self.attempt(lambda: update(collection))


class PlantPanel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_lsys_plants"
    bl_label = "L-system plants"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "L-systems"

    def draw(self, context):
        layout = self.layout
        row = layout.row(align=True)
        row.operator("lsys.new_plant", icon="ADD")
        row.operator("lsys.new_forest", icon="ADD")
        collection = current(context)
        if collection is None:
            layout.label(text="No plant or forest is active", icon="INFO")
            return
        settings = collection.lsys
        layout.label(text=f"{collection.name}: {settings.kind.lower()}", icon="OUTLINER_COLLECTION")
        column = layout.column()
        column.use_property_split = True
        column.use_property_decorate = False
        column.prop(settings, "file")
        if not settings.is_scene or settings.has_key:
            column.prop(settings, "seed")
        if not settings.is_scene:
            column.prop(settings, "generations")
        column.prop(settings, "height")
        if settings.kind == "FOREST" and not settings.is_scene:
            column.prop(settings, "count")
            column.prop(settings, "size")
        column.prop(settings, "options")
        column.prop(settings, "is_live")
        row = layout.row(align=True)
        row.operator("lsys.update", icon="FILE_REFRESH")
        row.operator("lsys.reload", icon="FILE_TICK")
        # Labels do not wrap; a character of the default font is about 7 pixels wide.
        width = max(24, int(context.region.width / (7 * context.preferences.system.ui_scale)) - 4)
        messages = layout.column(align=True)
        for i, line in enumerate(settings.message.splitlines()[:MAX_LINES]):
            for part in textwrap.wrap(line, width) or [""]:
                messages.label(text=part, icon="INFO" if i == 0 else "BLANK1")
                i += 1


class ParameterPanel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_lsys_parameters"
    bl_parent_id = "VIEW3D_PT_lsys_plants"
    bl_label = "Parameters"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "L-systems"

    @classmethod
    def poll(cls, context):
        collection = current(context)
        return collection is not None and len(collection.lsys.parameters) > 0

    def draw(self, context):
        column = self.layout.column(align=True)
        for parameter in current(context).lsys.parameters:
            name = parameter.name
            if parameter.is_bounded:
                name += f" ({shortest(parameter.minimum)} to {shortest(parameter.maximum)})"
            column.prop(parameter, "value", text=name)
        self.layout.operator("lsys.reset", icon="LOOP_BACK")


def draw_import(self, context):
    self.layout.operator("lsys.import_forest", text="Forest of lsc (.glb, .gltf)")


CLASSES = (Preferences, Parameter, Settings, NewPlant, NewForest, ImportForest, Update, Reload, ResetValues,
           PlantPanel, ParameterPanel)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Collection.lsys = PointerProperty(type=Settings)
    bpy.types.TOPBAR_MT_file_import.append(draw_import)


def unregister():
    if bpy.app.timers.is_registered(run_pending):
        bpy.app.timers.unregister(run_pending)
    bpy.types.TOPBAR_MT_file_import.remove(draw_import)
    del bpy.types.Collection.lsys
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)

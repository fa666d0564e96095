# SPDX-License-Identifier: MIT
"""Imports the levels of detail of a plant as one static mesh of Unreal Engine 5.

In the console of the editor: py unreal_import_lods.py tree.lods.json /Game/Trees
`lsc export --lods N --lod-files` writes the list and the files beside it. Based on the documentation of
StaticMeshEditorSubsystem and AssetImportTask, not tried in Unreal Engine.
"""

import json
import os
import sys


# Max number of levels of a static mesh.
MAX_LEVELS = 8


def select_levels(levels):
    """The first levels and the last one, at most MAX_LEVELS."""
    return levels if len(levels) <= MAX_LEVELS else levels[: MAX_LEVELS - 1] + levels[-1:]


def screen_sizes(levels):
    """For each level, the fraction of the screen height at which the level begins; 1 for the finest."""
    return [level["screen_height"] for level in levels]


def import_mesh(unreal, path, folder):
    """Imports a file and returns its static mesh."""
    task = unreal.AssetImportTask()
    task.set_editor_property("filename", path)
    task.set_editor_property("destination_path", folder)
    task.set_editor_property("automated", True)
    task.set_editor_property("replace_existing", True)
    task.set_editor_property("save", True)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    for imported in task.get_editor_property("imported_object_paths"):
        asset = unreal.load_asset(imported)
        if isinstance(asset, unreal.StaticMesh):
            return asset
    raise RuntimeError(f"{path}: no static mesh was imported")


def import_levels(unreal, list_path, folder):
    with open(list_path, encoding="utf-8") as file:
        levels = select_levels(json.load(file)["levels"])
    beside = os.path.dirname(os.path.abspath(list_path))
    name = os.path.basename(list_path).split(".")[0]
    editor = unreal.get_editor_subsystem(unreal.StaticMeshEditorSubsystem)
    mesh = None
    for number, level in enumerate(levels):
        part = import_mesh(unreal, os.path.join(beside, level["file"]), f"{folder}/{name}/LOD{number}")
        if number == 0:
            mesh = part
        # The last argument, False, gives the level its own material slots, because it may lack materials of level 0.
        elif editor.set_lod_from_static_mesh(mesh, number, part, 0, False) != number:
            raise RuntimeError(f"{level['file']}: not accepted as level {number}")
    if not editor.set_lod_screen_sizes(mesh, screen_sizes(levels)):
        raise RuntimeError("the screen sizes were not accepted")
    unreal.EditorAssetLibrary.save_loaded_asset(mesh)
    return mesh


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: unreal_import_lods.py tree.lods.json /Game/FOLDER")
    import unreal as editor_module

    print(import_levels(editor_module, sys.argv[1], sys.argv[2]).get_path_name())

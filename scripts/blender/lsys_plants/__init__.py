# SPDX-License-Identifier: MIT
"""L-system plants: grows plants and forests in Blender with lsc. See scripts/blender/README.md."""

bl_info = {
    "name": "L-system plants",
    "author": "The authors of lsc",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > L-systems",
    "description": "Plants and forests from grammars, by the compiler lsc",
    "category": "Add Mesh",
}


def register():
    from . import panel

    panel.register()


def unregister():
    from . import panel

    panel.unregister()

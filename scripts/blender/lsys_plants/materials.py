# SPDX-License-Identifier: MIT
"""Makes the materials of a forest, whose glTF file Blender's own importer does not read.

Written for Blender 3.4. The code for differences of 4.0 to 4.5 follows Blender's release notes and has not been run.
"""

REPEAT = 10497


def socket(sockets, *names):
    """The first socket with one of the names; Blender 4.0 renamed some sockets."""
    for name in names:
        if name in sockets:
            return sockets[name]
    raise KeyError(names[0])


class Materials:
    """Materials of a file, each made at its first use."""

    def __init__(self, bpy, gltf):
        self.bpy = bpy
        self.gltf = gltf
        self.made = {}
        self.images = {}

    def get(self, number, has_colours):
        """The material `number`, or a default one if it is None; with `has_colours`, times the vertex colours."""
        key = (number, has_colours)
        if key not in self.made:
            self.made[key] = self.make(self.gltf.item("materials", number) if number is not None else {}, has_colours)
        return self.made[key]

    def image(self, number, is_data):
        """The image `number`, made at its first use. `is_data`: its numbers are not colours."""
        if (number, is_data) not in self.images:
            name, data = self.gltf.picture(number)
            image = self.bpy.data.images.new(name, 8, 8)
            image.pack(data=data, data_len=len(data))
            image.source = "FILE"
            if is_data:
                image.colorspace_settings.name = "Non-Color"
            self.images[number, is_data] = image
        return self.images[number, is_data]

    def texture(self, tree, info, is_data, row):
        """A node of `tree` for `info`, a texture of a glTF material. `row`: its height in the node editor."""
        texture = self.gltf.item("textures", info["index"])
        sampler = self.gltf.item("samplers", texture["sampler"]) if "sampler" in texture else {}
        node = tree.nodes.new("ShaderNodeTexImage")
        node.location = (-900, row)
        node.image = self.image(texture["source"], is_data)
        node.extension = "REPEAT" if sampler.get("wrapS", REPEAT) == REPEAT else "EXTEND"
        return node

    def product(self, tree, first, second, row):
        """Output of a node that multiplies two colours."""
        node = tree.nodes.new("ShaderNodeMixRGB")
        node.location = (-350, row)
        node.blend_type = "MULTIPLY"
        node.inputs["Fac"].default_value = 1.0
        tree.links.new(first, node.inputs["Color1"])
        if isinstance(second, (list, tuple)):
            node.inputs["Color2"].default_value = second
        else:
            tree.links.new(second, node.inputs["Color2"])
        return node.outputs["Color"]

    def make(self, source, has_colours):
        material = self.bpy.data.materials.new(source.get("name", "material"))
        shading = source.get("pbrMetallicRoughness", {})
        factor = shading.get("baseColorFactor", [1.0, 1.0, 1.0, 1.0])
        material.diffuse_color = factor
        material.roughness = shading.get("roughnessFactor", 1.0)
        material.metallic = shading.get("metallicFactor", 1.0)
        material.use_backface_culling = not source.get("doubleSided", False)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        output.location = (300, 0)
        surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
        tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])
        surface.inputs["Roughness"].default_value = material.roughness
        surface.inputs["Metallic"].default_value = material.metallic
        socket(surface.inputs, "Specular IOR Level", "Specular").default_value = 0.5
        colour = None
        picture = None
        if "baseColorTexture" in shading:
            picture = self.texture(tree, shading["baseColorTexture"], False, 300)
            colour = picture.outputs["Color"]
        if has_colours:
            own = tree.nodes.new("ShaderNodeVertexColor")
            own.location = (-650, 500)
            own.layer_name = "Color"
            colour = own.outputs["Color"] if colour is None else self.product(tree, colour, own.outputs["Color"], 400)
        base = surface.inputs["Base Color"]
        base.default_value = factor
        if colour is not None:
            is_white = list(factor[:3]) == [1.0, 1.0, 1.0]
            tree.links.new(colour if is_white else self.product(tree, colour, factor, 200), base)
        if "normalTexture" in source:
            relief = self.texture(tree, source["normalTexture"], True, -300)
            normal = tree.nodes.new("ShaderNodeNormalMap")
            normal.location = (-350, -300)
            normal.inputs["Strength"].default_value = source["normalTexture"].get("scale", 1.0)
            tree.links.new(relief.outputs["Color"], normal.inputs["Color"])
            tree.links.new(normal.outputs["Normal"], surface.inputs["Normal"])
        self.set_opacity(material, source, picture, surface.inputs["Alpha"], factor[3])
        return material

    def set_opacity(self, material, source, picture, alpha, factor):
        mode = source.get("alphaMode", "OPAQUE")
        if mode == "OPAQUE":
            return
        tree = material.node_tree
        alpha.default_value = factor
        threshold = source.get("alphaCutoff", 0.5)
        if picture is not None:
            opacity = picture.outputs["Alpha"]
            if mode == "MASK":
                # Cycles has no alpha clip, so a node applies the threshold in all render engines.
                step = tree.nodes.new("ShaderNodeMath")
                step.location = (-350, 0)
                step.operation = "GREATER_THAN"
                tree.links.new(opacity, step.inputs[0])
                step.inputs[1].default_value = threshold / max(factor, 1e-6)
                opacity = step.outputs[0]
            tree.links.new(opacity, alpha)
        if self.bpy.app.version < (4, 2, 0):
            material.blend_method = "CLIP" if mode == "MASK" else "HASHED"
            material.shadow_method = material.blend_method
            material.alpha_threshold = 0.5
        else:
            material.surface_render_method = "DITHERED"

"""What tests within Blender put into its scenes."""


def white_matt(bpy):
    """A material that reflects all light, the same in all directions."""
    material = bpy.data.materials.new("white")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    white = nodes.new("ShaderNodeBsdfDiffuse")
    white.inputs["Color"].default_value = (1, 1, 1, 1)
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(white.outputs["BSDF"], output.inputs["Surface"])
    return material

$if FORMAT=vdb$$if PLAYS=no$"""Adds the volume of $FILE$ to the open scene, in metres, with a material whose density is extinction.
$if FORMAT=vdb$$if PLAYS=yes$"""Adds the $FRAMES$ volumes of $NAME$ to the open scene as one that plays, in metres, with a material whose density
$if FORMAT=vdb$$if PLAYS=yes$is extinction, and gives the scene $RATE$ frames per second.
$if FORMAT=exr$"""Makes $FILE$ the world of the open scene, with its numbers taken as they are: the sun stands $SUN_PLACE$.
$if FORMAT=exr$$if LAMP=yes$The map lacks the sun's disc, so the script adds the sun as a lamp.

Run it in Blender's text editor, or as `blender scene.blend --python $NAME$.blender.py`.
"""
import math
import os

import bpy
import mathutils

text = bpy.data.texts.get(os.path.basename(__file__))
script = bpy.path.abspath(text.filepath) if text and text.filepath else __file__
path = os.path.join(os.path.dirname(os.path.abspath(script)), "$FILE$")
scene = bpy.context.scene

$if FORMAT=vdb$volume = bpy.data.volumes.new("$NAME$")
$if FORMAT=vdb$volume.filepath = path
$if FORMAT=vdb$$if PLAYS=yes$volume.is_sequence = True
$if FORMAT=vdb$$if PLAYS=yes$volume.frame_duration = $FRAMES$
$if FORMAT=vdb$$if PLAYS=yes$volume.sequence_mode = "REPEAT"
$if FORMAT=vdb$$if PLAYS=yes$scene.render.fps, scene.render.fps_base = round($RATE$), round($RATE$) / $RATE$
$if FORMAT=vdb$cloud = bpy.data.objects.new("$NAME$", volume)
$if FORMAT=vdb$scene.collection.objects.link(cloud)
$if FORMAT=vdb$
$if FORMAT=vdb$material = bpy.data.materials.new("$NAME$")
$if FORMAT=vdb$material.use_nodes = True
$if FORMAT=vdb$nodes = material.node_tree.nodes
$if FORMAT=vdb$nodes.clear()
$if FORMAT=vdb$shader = nodes.new("ShaderNodeVolumePrincipled")
$if FORMAT=vdb$shader.inputs["Color"].default_value = (1, 1, 1, 1)  # the albedo of water droplets
$if FORMAT=vdb$shader.inputs["Density Attribute"].default_value = "$GRID$"
$if FORMAT=vdb$shader.inputs["Density"].default_value = $EXTINCTION$  # 1/m, where the grid is 1
$if FORMAT=vdb$shader.inputs["Anisotropy"].default_value = 0.87  # the mean cosine of droplets of 12 um
$if FORMAT=vdb$output = nodes.new("ShaderNodeOutputMaterial")
$if FORMAT=vdb$material.node_tree.links.new(shader.outputs["Volume"], output.inputs["Volume"])
$if FORMAT=vdb$volume.materials.append(material)
$if FORMAT=vdb$
$if FORMAT=vdb$# Clouds are white because light is scattered many times. By default Cycles follows none of that.
$if FORMAT=vdb$scene.render.engine = "CYCLES"
$if FORMAT=vdb$scene.cycles.volume_bounces = max(scene.cycles.volume_bounces, 64)
$if FORMAT=vdb$scene.cycles.max_bounces = max(scene.cycles.max_bounces, 64)
$if FORMAT=vdb$
$if FORMAT=vdb$# A camera that has all of the cloud in its picture, from a little below, unless the scene has one of its own.
$if FORMAT=vdb$if scene.camera is None or scene.camera.name == "Camera":
$if FORMAT=vdb$    camera = bpy.data.objects.new("$NAME$ camera", bpy.data.cameras.new("$NAME$"))
$if FORMAT=vdb$    scene.collection.objects.link(camera)
$if FORMAT=vdb$    scene.camera = camera
$if FORMAT=vdb$    camera.location = ($CAMERA_AT$)
$if FORMAT=vdb$    camera.rotation_mode = "QUATERNION"
$if FORMAT=vdb$    camera.rotation_quaternion = mathutils.Vector(($CAMERA_AHEAD$)).to_track_quat("-Z", "Y")
$if FORMAT=vdb$
$if FORMAT=vdb$# By default cameras see nothing beyond 100 m.
$if FORMAT=vdb$reach = 10 * $CAMERA_REACH$
$if FORMAT=vdb$for camera in bpy.data.cameras:
$if FORMAT=vdb$    camera.clip_end = max(camera.clip_end, reach)
$if FORMAT=vdb$for screen in bpy.data.screens:
$if FORMAT=vdb$    for area in screen.areas:
$if FORMAT=vdb$        if area.type == "VIEW_3D":
$if FORMAT=vdb$            area.spaces.active.clip_end = max(area.spaces.active.clip_end, reach)
$if FORMAT=exr$image = bpy.data.images.load(path, check_existing=True)
$if FORMAT=exr$image.colorspace_settings.name = "Non-Color"
$if FORMAT=exr$world = bpy.data.worlds.new("$NAME$")
$if FORMAT=exr$world.use_nodes = True
$if FORMAT=exr$nodes = world.node_tree.nodes
$if FORMAT=exr$nodes.clear()
$if FORMAT=exr$texture = nodes.new("ShaderNodeTexEnvironment")
$if FORMAT=exr$texture.image = image
$if FORMAT=exr$background = nodes.new("ShaderNodeBackground")
$if FORMAT=exr$output = nodes.new("ShaderNodeOutputWorld")
$if FORMAT=exr$world.node_tree.links.new(texture.outputs["Color"], background.inputs["Color"])
$if FORMAT=exr$world.node_tree.links.new(background.outputs["Background"], output.inputs["Surface"])
$if FORMAT=exr$scene.world = world
$if FORMAT=exr$
$if FORMAT=exr$# The sun of an earlier sky goes with its world.
$if FORMAT=exr$for lamp in [thing for thing in bpy.data.objects if thing.get("skybake") == "sun"]:
$if FORMAT=exr$    bpy.data.objects.remove(lamp)
$if LAMP=yes$
$if LAMP=yes$# The strength is the irradiance of a surface that faces the sun, in the unit of the map.
$if LAMP=yes$sun = bpy.data.lights.new("$NAME$", "SUN")
$if LAMP=yes$sun.energy = $IRRADIANCE$
$if LAMP=yes$sun.color = ($SUN_R$, $SUN_G$, $SUN_B$)
$if LAMP=yes$sun.angle = 0.0093  # 0.533 degrees
$if LAMP=yes$lamp = bpy.data.objects.new("$NAME$", sun)
$if LAMP=yes$lamp["skybake"] = "sun"
$if LAMP=yes$lamp.rotation_mode = "QUATERNION"
$if LAMP=yes$lamp.rotation_quaternion = mathutils.Vector(($SUN_AHEAD$, -($SUN_RIGHT$), $SUN_UP$)).to_track_quat("Z", "Y")
$if LAMP=yes$scene.collection.objects.link(lamp)
$if LAMP=yes$
$if LAMP=yes$# Light is per irradiance of the sun, and dark as it is: white that faces the sun becomes bright.
$if LAMP=yes$if scene.view_settings.exposure == 0:
$if LAMP=yes$    scene.view_settings.exposure = math.log2(0.8 * math.pi / $IRRADIANCE$)

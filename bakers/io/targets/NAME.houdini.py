$if FORMAT=vdb$"""Adds $FILE$ to /obj as a geometry node, in metres and with y up, and a camera that sees all of it. The node's comment
$if FORMAT=vdb$says what times density is extinction.
$if FORMAT=exr$"""Adds the sky of $FILE$ to /stage, as $NAME$.usda has it: the map as a dome light, and its sun if it has one.

Run it in Houdini (File > Run Script, or `hython -i $NAME$.houdini.py`).
"""
import os

import hou

$if FORMAT=vdb$$if PLAYS=no$path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "$FILE$").replace("\\", "/")
$if FORMAT=exr$path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "$NAME$.usda").replace("\\", "/")
$if PLAYS=yes$# The number of the frame, which begins anew after the last one.
$if PLAYS=yes$frame = "`padzero($DIGITS$, ($F - 1) % $FRAMES$ + 1)`"
$if PLAYS=yes$path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "$NAME$_" + frame + "$ENDING$").replace("\\", "/")
$if PLAYS=yes$hou.setFps($RATE$)

$if FORMAT=vdb$geometry = hou.node("/obj").createNode("geo", "$ID$")
$if FORMAT=vdb$source = geometry.createNode("file", "source")
$if FORMAT=vdb$source.parm("file").set(path)
$if FORMAT=vdb$rotation = geometry.createNode("xform", "y_up")  # Houdini's y points up, the file's z does
$if FORMAT=vdb$rotation.setInput(0, source)
$if FORMAT=vdb$rotation.parm("rx").set(-90)
$if FORMAT=vdb$rotation.setDisplayFlag(True)
$if FORMAT=vdb$rotation.setRenderFlag(True)
$if FORMAT=vdb$geometry.setComment("extinction in 1/m is the grid $GRID$ times $EXTINCTION$: the volume shader's density scale")
$if FORMAT=vdb$camera = hou.node("/obj").createNode("cam", "$ID$_camera")
$if FORMAT=vdb$camera.parm("focal").set($CAMERA_FOCAL$)
$if FORMAT=vdb$camera.parm("aperture").set($CAMERA_WIDTH$)
$if FORMAT=vdb$camera.parm("far").set($CAMERA_REACH$)
$if FORMAT=vdb$camera.setWorldTransform(hou.Matrix4((
$if FORMAT=vdb$    ($CAMERA_AXIS_X$, 0),
$if FORMAT=vdb$    ($CAMERA_AXIS_Y$, 0),
$if FORMAT=vdb$    ($CAMERA_AXIS_Z$, 0),
$if FORMAT=vdb$    ($CAMERA_AT_Y_UP$, 1))))
$if FORMAT=exr$sky = hou.node("/stage").createNode("sublayer", "$ID$")
$if FORMAT=exr$sky.parm("filepath1").set(path)

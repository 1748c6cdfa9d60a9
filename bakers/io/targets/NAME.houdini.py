$if FORMAT=vdb$"""Adds $FILE$ to /obj as a geometry node, in metres and with y up. The node's comment says what times density is extinction.
$if FORMAT=exr$"""Adds $FILE$ to /obj as an environment light.

Run it in Houdini (File > Run Script, or `hython -i $NAME$.houdini.py`).
"""
import os

import hou

$if PLAYS=no$path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "$FILE$").replace("\\", "/")
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
$if FORMAT=exr$light = hou.node("/obj").createNode("envlight", "$ID$")
$if FORMAT=exr$light.parm("env_map").set(path)

$if FORMAT=dds,png$"""Imports $FILE$ into Unreal as /Game/skybake/$ID$ with all settings made: run this script in the editor
$if FORMAT=hdr$"""Imports $FILE$ into Unreal as the cube /Game/skybake/$ID$ and lights the level with it: run this script in the editor
$if FORMAT=vdb$$if PLAYS=no$"""Imports $FILE$ into Unreal as /Game/skybake/$ID$ and puts it into the level: run this script in the editor
$if FORMAT=vdb$$if PLAYS=yes$"""Imports the $FRAMES$ files of $NAME$ into Unreal as one that plays and puts it into the level: run this in the editor
(Tools > Execute Python Script; the plug-in Python Editor Script Plugin must be on).
$if FORMAT=dds,png$It also makes the material function MF_$ID$, which samples the texture at UVW.
$if FORMAT=png$The sheet has $COLUMNS$ x $ROWS$ frames, counted from the left and from the top, as SubUV materials have it.
$if FORMAT=vdb$It makes the material M_$ID$ and a Heterogeneous Volume where the recipe has the cloud: Unreal counts in
$if FORMAT=vdb$centimetres and its y points the other way. A camera sees all of it. The script is for Unreal 5.4 and later, which place a volume by its file.
$if FORMAT=hdr$It makes a HDRI Backdrop where that plug-in is on, else a Sky Light: straight ahead is -y, up +z and right +x.
$if LAMP=yes$The sky lacks the sun's disc, so it also makes the sun, whose intensity is the irradiance in the unit of the map.
"""
import os

import unreal

folder = "/Game/skybake"
tools = unreal.AssetToolsHelpers.get_asset_tools()

task = unreal.AssetImportTask()
task.filename = os.path.join(os.path.dirname(os.path.abspath(__file__)), "$FILE$")
task.destination_path = folder
task.destination_name = "$ID$"
task.automated = task.replace_existing = task.save = True
$if FORMAT=vdb$task.factory = unreal.SparseVolumeTextureFactory()  # finds all numbered files
tools.import_asset_tasks([task])
texture = unreal.load_asset(folder + "/$ID$") or next(iter(task.get_objects()), None)
if texture is None:
    raise RuntimeError("Unreal did not import " + task.filename)

$if FORMAT=dds,png$settings = {
$if FORMAT=dds,png$    "srgb": False,
$if FORMAT=dds,png$$if TYPE=half$    "compression_settings": unreal.TextureCompressionSettings.TC_HDR,
$if FORMAT=dds,png$$if TYPE=unorm8$    "compression_settings": unreal.TextureCompressionSettings.TC_VECTOR_DISPLACEMENTMAP,
$if FORMAT=dds,png$$if TYPE=bc4$    "compression_settings": unreal.TextureCompressionSettings.TC_ALPHA,
$if FORMAT=dds,png$$if LEVELS=1$    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,
$if FORMAT=dds,png$$if LEVELS=2,3,4,5,6,7,8,9,10,11,12,13,14,15$    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_LEAVE_EXISTING_MIPS,
$if FORMAT=dds,png$$if FILTER=linear$    "filter": unreal.TextureFilter.TF_BILINEAR,
$if FORMAT=dds,png$$if FILTER=nearest$    "filter": unreal.TextureFilter.TF_NEAREST,
$if FORMAT=dds,png$$if DIM=2$$if WRAP_U=repeat$    "address_x": unreal.TextureAddress.TA_WRAP,
$if FORMAT=dds,png$$if DIM=2$$if WRAP_U=clamp$    "address_x": unreal.TextureAddress.TA_CLAMP,
$if FORMAT=dds,png$$if DIM=2$$if WRAP_V=repeat$    "address_y": unreal.TextureAddress.TA_WRAP,
$if FORMAT=dds,png$$if DIM=2$$if WRAP_V=clamp$    "address_y": unreal.TextureAddress.TA_CLAMP,
$if FORMAT=dds,png$}
$if FORMAT=dds,png$for name, value in settings.items():
$if FORMAT=dds,png$    texture.set_editor_property(name, value)
$if FORMAT=dds,png$
$if FORMAT=dds,png$materials = unreal.MaterialEditingLibrary
$if FORMAT=dds,png$unreal.EditorAssetLibrary.delete_asset(folder + "/MF_$ID$")
$if FORMAT=dds,png$function = tools.create_asset("MF_$ID$", folder, unreal.MaterialFunction, unreal.MaterialFunctionFactoryNew())
$if FORMAT=dds,png$place = materials.create_material_expression_in_function(function, unreal.MaterialExpressionFunctionInput, -600, 0)
$if FORMAT=dds,png$place.set_editor_property("input_name", "UVW")
$if FORMAT=png$place.set_editor_property("input_type", unreal.FunctionInputType.FUNCTION_INPUT_VECTOR2)
$if FORMAT=dds$$if DIM=2$place.set_editor_property("input_type", unreal.FunctionInputType.FUNCTION_INPUT_VECTOR2)
$if FORMAT=dds$$if DIM=3$place.set_editor_property("input_type", unreal.FunctionInputType.FUNCTION_INPUT_VECTOR3)
$if FORMAT=dds,png$sample = materials.create_material_expression_in_function(function, unreal.MaterialExpressionTextureSample, -300, 0)
$if FORMAT=dds,png$sample.set_editor_property("texture", texture)
$if FORMAT=dds,png$sample.set_editor_property("sampler_type", unreal.MaterialSamplerType.SAMPLERTYPE_LINEAR_COLOR)
$if FORMAT=dds,png$result = materials.create_material_expression_in_function(function, unreal.MaterialExpressionFunctionOutput, 0, 0)
$if FORMAT=dds,png$materials.connect_material_expressions(place, "", sample, "UVs")
$if FORMAT=dds,png$materials.connect_material_expressions(sample, "RGBA", result, "")
$if FORMAT=dds,png$materials.update_material_function(function)
$if FORMAT=vdb$materials = unreal.MaterialEditingLibrary
$if FORMAT=vdb$unreal.EditorAssetLibrary.delete_asset(folder + "/M_$ID$")
$if FORMAT=vdb$material = tools.create_asset("M_$ID$", folder, unreal.Material, unreal.MaterialFactoryNew())
$if FORMAT=vdb$material.set_editor_property("material_domain", unreal.MaterialDomain.MD_VOLUME)
$if FORMAT=vdb$material.set_editor_property("blend_mode", unreal.BlendMode.BLEND_ADDITIVE)
$if FORMAT=vdb$sample = materials.create_material_expression(material, unreal.MaterialExpressionSparseVolumeTextureSampleParameter, -600, 0)
$if FORMAT=vdb$sample.set_editor_property("parameter_name", "SparseVolumeTexture")
$if FORMAT=vdb$sample.set_editor_property("sparse_volume_texture", texture)
$if FORMAT=vdb$density = materials.create_material_expression(material, unreal.MaterialExpressionComponentMask, -400, 0)
$if FORMAT=vdb$density.set_editor_property("r", True)
$if FORMAT=vdb$for channel in "gba":
$if FORMAT=vdb$    density.set_editor_property(channel, False)
$if FORMAT=vdb$extinction = materials.create_material_expression(material, unreal.MaterialExpressionMultiply, -200, 0)
$if FORMAT=vdb$extinction.set_editor_property("const_b", $EXTINCTION$ / 100)  # per centimetre, where the grid is 1
$if FORMAT=vdb$albedo = materials.create_material_expression(material, unreal.MaterialExpressionConstant3Vector, -200, -200)
$if FORMAT=vdb$albedo.set_editor_property("constant", unreal.LinearColor(1, 1, 1))  # water droplets absorb no visible light
$if FORMAT=vdb$materials.connect_material_expressions(sample, "Attributes A", density, "")
$if FORMAT=vdb$materials.connect_material_expressions(density, "", extinction, "A")
$if FORMAT=vdb$materials.connect_material_property(extinction, "", unreal.MaterialProperty.MP_SUBSURFACE_COLOR)  # shown as Extinction
$if FORMAT=vdb$materials.connect_material_property(albedo, "", unreal.MaterialProperty.MP_BASE_COLOR)  # shown as Albedo
$if FORMAT=vdb$materials.recompile_material(material)
$if FORMAT=vdb$
$if FORMAT=vdb$actors = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
$if FORMAT=vdb$for actor in actors.get_all_level_actors():
$if FORMAT=vdb$    if actor.get_actor_label() in ("skybake $NAME$", "skybake $NAME$ camera"):
$if FORMAT=vdb$        actors.destroy_actor(actor)
$if FORMAT=vdb$actor = actors.spawn_actor_from_class(unreal.HeterogeneousVolume, unreal.Vector(0, 0, 0), unreal.Rotator(0, 0, 0))
$if FORMAT=vdb$actor.set_actor_label("skybake $NAME$")
$if FORMAT=vdb$actor.set_actor_scale3d(unreal.Vector(100, -100, 100))  # from metres
$if FORMAT=vdb$volume = actor.get_component_by_class(unreal.HeterogeneousVolumeComponent)
$if FORMAT=vdb$volume.set_material(0, material)
$if FORMAT=vdb$$if PLAYS=yes$volume.set_frame_rate($RATE$)
$if FORMAT=vdb$$if PLAYS=yes$volume.set_start_frame(0)
$if FORMAT=vdb$$if PLAYS=yes$volume.set_end_frame($FRAMES$ - 1)
$if FORMAT=vdb$$if PLAYS=yes$volume.set_looping(True)
$if FORMAT=vdb$$if PLAYS=yes$volume.set_playing(True)
$if FORMAT=vdb$
$if FORMAT=vdb$# A camera that has all of the cloud in its picture.
$if FORMAT=vdb$x, y, z = ($CAMERA_AT$)
$if FORMAT=vdb$ahead = ($CAMERA_AHEAD$)
$if FORMAT=vdb$rotation = unreal.MathLibrary.make_rot_from_x(unreal.Vector(ahead[0], -ahead[1], ahead[2]))
$if FORMAT=vdb$camera = actors.spawn_actor_from_class(unreal.CameraActor, unreal.Vector(100 * x, -100 * y, 100 * z), rotation)
$if FORMAT=vdb$camera.set_actor_label("skybake $NAME$ camera")
$if FORMAT=vdb$camera.camera_component.set_field_of_view($CAMERA_ANGLE$)
$if FORMAT=hdr$# Faces of cubes that are made of panoramas have 512 texels along an edge, if nothing else is said.
$if FORMAT=hdr$texture.set_editor_property("max_texture_size", 1 << ($WIDTH$ // 2 - 1).bit_length())
$if FORMAT=hdr$
$if FORMAT=hdr$actors = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
$if FORMAT=hdr$for actor in actors.get_all_level_actors():
$if FORMAT=hdr$    if actor.get_actor_label() in ("skybake sky", "skybake sun"):
$if FORMAT=hdr$        actors.destroy_actor(actor)
$if FORMAT=hdr$backdrop = unreal.load_class(None, "/HDRIBackdrop/Blueprints/HDRIBackdrop.HDRIBackdrop_C")
$if FORMAT=hdr$sky = actors.spawn_actor_from_class(backdrop or unreal.SkyLight, unreal.Vector(0, 0, 0), unreal.Rotator(0, 0, 0))
$if FORMAT=hdr$sky.set_actor_label("skybake sky")
$if FORMAT=hdr$if backdrop:  # it has a sky light of its own
$if FORMAT=hdr$    sky.set_editor_property("Cubemap", texture)
$if FORMAT=hdr$    sky.set_editor_property("Intensity", 1.0)
$if FORMAT=hdr$else:
$if FORMAT=hdr$    light = sky.get_component_by_class(unreal.SkyLightComponent)
$if FORMAT=hdr$    light.set_mobility(unreal.ComponentMobility.MOVABLE)
$if FORMAT=hdr$    light.set_editor_property("source_type", unreal.SkyLightSourceType.SLS_SPECIFIED_CUBEMAP)
$if FORMAT=hdr$    light.set_editor_property("cubemap", texture)
$if FORMAT=hdr$    light.set_editor_property("lower_hemisphere_is_black", False)  # the map has the ground
$if FORMAT=hdr$    light.set_editor_property("intensity", 1.0)
$if FORMAT=hdr$    light.recapture_sky()
$if LAMP=yes$
$if LAMP=yes$# A directional light shines along its +x.
$if LAMP=yes$from_sun = unreal.MathLibrary.make_rot_from_x(unreal.Vector(-($SUN_RIGHT$), $SUN_AHEAD$, -($SUN_UP$)))
$if LAMP=yes$lamp = actors.spawn_actor_from_class(unreal.DirectionalLight, unreal.Vector(0, 0, 0), from_sun)
$if LAMP=yes$lamp.set_actor_label("skybake sun")
$if LAMP=yes$sun = lamp.get_component_by_class(unreal.DirectionalLightComponent)
$if LAMP=yes$sun.set_mobility(unreal.ComponentMobility.MOVABLE)
$if LAMP=yes$sun.set_intensity($IRRADIANCE$)
$if LAMP=yes$sun.set_light_color(unreal.LinearColor($SUN_R$, $SUN_G$, $SUN_B$))
$if LAMP=yes$sun.set_editor_property("light_source_angle", 0.533)
unreal.EditorAssetLibrary.save_directory(folder)

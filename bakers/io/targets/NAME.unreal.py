"""Imports $FILE$ into Unreal as /Game/skybake/$ID$ with all settings made: run this script in the editor
(Tools > Execute Python Script; the plug-in Python Editor Script Plugin must be on).
$if FORMAT=dds$It also makes the material function MF_$ID$, which samples the texture at UVW.
$if FORMAT=vdb$The sparse volume texture is for Heterogeneous Volumes: extinction in 1/m is the density times $EXTINCTION$.
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
tools.import_asset_tasks([task])
texture = unreal.load_asset(folder + "/$ID$")
if texture is None:
    raise RuntimeError("Unreal did not import " + task.filename)

$if FORMAT=dds$settings = {
$if FORMAT=dds$    "srgb": False,
$if FORMAT=dds$$if TYPE=half$    "compression_settings": unreal.TextureCompressionSettings.TC_HDR,
$if FORMAT=dds$$if TYPE=unorm8$    "compression_settings": unreal.TextureCompressionSettings.TC_VECTOR_DISPLACEMENTMAP,
$if FORMAT=dds$$if TYPE=bc4$    "compression_settings": unreal.TextureCompressionSettings.TC_ALPHA,
$if FORMAT=dds$$if LEVELS=1$    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,
$if FORMAT=dds$$if LEVELS=2,3,4,5,6,7,8,9,10,11,12,13,14,15$    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_LEAVE_EXISTING_MIPS,
$if FORMAT=dds$$if FILTER=linear$    "filter": unreal.TextureFilter.TF_BILINEAR,
$if FORMAT=dds$$if FILTER=nearest$    "filter": unreal.TextureFilter.TF_NEAREST,
$if FORMAT=dds$$if DIM=2$$if WRAP_U=repeat$    "address_x": unreal.TextureAddress.TA_WRAP,
$if FORMAT=dds$$if DIM=2$$if WRAP_U=clamp$    "address_x": unreal.TextureAddress.TA_CLAMP,
$if FORMAT=dds$$if DIM=2$$if WRAP_V=repeat$    "address_y": unreal.TextureAddress.TA_WRAP,
$if FORMAT=dds$$if DIM=2$$if WRAP_V=clamp$    "address_y": unreal.TextureAddress.TA_CLAMP,
$if FORMAT=dds$}
$if FORMAT=dds$for name, value in settings.items():
$if FORMAT=dds$    texture.set_editor_property(name, value)
$if FORMAT=dds$
$if FORMAT=dds$materials = unreal.MaterialEditingLibrary
$if FORMAT=dds$unreal.EditorAssetLibrary.delete_asset(folder + "/MF_$ID$")
$if FORMAT=dds$function = tools.create_asset("MF_$ID$", folder, unreal.MaterialFunction, unreal.MaterialFunctionFactoryNew())
$if FORMAT=dds$place = materials.create_material_expression_in_function(function, unreal.MaterialExpressionFunctionInput, -600, 0)
$if FORMAT=dds$place.set_editor_property("input_name", "UVW")
$if FORMAT=dds$$if DIM=2$place.set_editor_property("input_type", unreal.FunctionInputType.FUNCTION_INPUT_VECTOR2)
$if FORMAT=dds$$if DIM=3$place.set_editor_property("input_type", unreal.FunctionInputType.FUNCTION_INPUT_VECTOR3)
$if FORMAT=dds$sample = materials.create_material_expression_in_function(function, unreal.MaterialExpressionTextureSample, -300, 0)
$if FORMAT=dds$sample.set_editor_property("texture", texture)
$if FORMAT=dds$sample.set_editor_property("sampler_type", unreal.MaterialSamplerType.SAMPLERTYPE_LINEAR_COLOR)
$if FORMAT=dds$result = materials.create_material_expression_in_function(function, unreal.MaterialExpressionFunctionOutput, 0, 0)
$if FORMAT=dds$materials.connect_material_expressions(place, "", sample, "UVs")
$if FORMAT=dds$materials.connect_material_expressions(sample, "RGBA", result, "")
$if FORMAT=dds$materials.update_material_function(function)
unreal.EditorAssetLibrary.save_directory(folder)

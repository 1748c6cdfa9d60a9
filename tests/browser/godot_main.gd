# Reads textures of the target godot by the shader includes that lie beside them, at the places of probes, and loads the
# scenes and the environments, which cameras look at. The answers go to the page as JSON.
extends Node


func _ready() -> void:
	var asked: Array = JSON.parse_string(FileAccess.get_file_as_string("res://asked.json"))
	var answers: Array = []
	for asset: Dictionary in asked:
		answers.append(await answer_of(asset))
	JavaScriptBridge.eval("window.answer(%s)" % JSON.stringify(JSON.stringify(answers)))


func answer_of(asset: Dictionary) -> Dictionary:
	var answer := {}
	var texture: Texture = load("res://" + asset.file)
	answer.kind = texture.get_class()
	answer.size = [texture.get_width(), texture.get_height()]
	if texture is Texture3D:
		answer.size.append(texture.get_depth())
	if texture is TextureLayered:
		answer.size[1] *= texture.get_layers()
	answer.format = texture.get_image().get_format() if texture is Texture2D else texture.get_format()
	answer.has_mips = texture.get_image().has_mipmaps() if texture is Texture2D else texture.has_mipmaps()
	answer.bits = await bits_of(asset, texture)
	if asset.has("normals"):
		answer.lit = await lit_planes(load("res://" + asset.scene), asset.normals)
	elif asset.has("scene"):
		answer.fog = fog_of(load("res://" + asset.scene))
	if asset.has("environment"):
		var environment: Environment = load("res://" + asset.environment)
		answer.seen = await colors_of(environment, asset.views)
	return answer


# The 32 bits of each number that the shader's function returns at the places: one byte per pixel.
func bits_of(asset: Dictionary, texture: Texture) -> Array:
	var places := PackedVector3Array()
	for place: Array in asset.places:
		places.append(Vector3(place[0], place[1], place[2]))
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = asset.shader
	material.set_shader_parameter(asset.id, texture)
	material.set_shader_parameter("places", places)
	var viewport := SubViewport.new()
	viewport.size = Vector2i(16 * places.size(), 2)
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var rectangle := ColorRect.new()
	rectangle.size = viewport.size
	rectangle.material = material
	viewport.add_child(rectangle)
	add_child(viewport)
	for i in 3:
		await RenderingServer.frame_post_draw
	var image := viewport.get_texture().get_image()
	var bytes: Array = []
	for x in image.get_width():
		bytes.append(image.get_pixel(x, 0).r8)
	viewport.queue_free()
	return bytes


# A world of its own, for one camera.
func small_viewport() -> SubViewport:
	var viewport := SubViewport.new()
	viewport.size = Vector2i(9, 9)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	return viewport


# The colour, 0 to 255, in the middle of the next picture.
func color_in(viewport: SubViewport) -> Array:
	for i in 3:
		await RenderingServer.frame_post_draw
	var color := viewport.get_texture().get_image().get_pixel(4, 4)
	return [color.r8, color.g8, color.b8]


# The colours, 0 to 255, that a camera sees in the middle of its picture when it looks into these directions.
func colors_of(environment: Environment, directions: Array) -> Array:
	var viewport := small_viewport()
	var camera := Camera3D.new()
	camera.environment = environment
	camera.fov = 1.0
	viewport.add_child(camera)
	add_child(viewport)
	var colors: Array = []
	for direction: Array in directions:
		var ahead := Vector3(direction[0], direction[1], direction[2])
		camera.look_at_from_position(Vector3.ZERO, ahead, Vector3.BACK if absf(ahead.y) > 0.9 else Vector3.UP)
		colors.append(await color_in(viewport))
	viewport.queue_free()
	return colors


# The colours, 0 to 255, of white matt planes with these normals under the lamp of the scene alone.
func lit_planes(scene: PackedScene, normals: Array) -> Array:
	var viewport := small_viewport()
	var sky := scene.instantiate()
	var plane := MeshInstance3D.new()
	plane.mesh = QuadMesh.new()
	plane.material_override = StandardMaterial3D.new()
	plane.material_override.metallic_specular = 0.0
	plane.material_override.diffuse_mode = BaseMaterial3D.DIFFUSE_LAMBERT
	var camera := Camera3D.new()
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	for node: Node in [sky, plane, camera]:
		viewport.add_child(node)
	add_child(viewport)
	var colors: Array = []
	for normal: Array in normals:
		var facing := Vector3(normal[0], normal[1], normal[2])
		var up := Vector3.BACK if absf(facing.y) > 0.9 else Vector3.UP
		plane.basis = Basis.looking_at(-facing, up)
		camera.look_at_from_position(facing, Vector3.ZERO, up)
		colors.append(await color_in(viewport))
	viewport.queue_free()
	return colors


# The corners of the fog in Godot's axes, and what its material has.
func fog_of(scene: PackedScene) -> Dictionary:
	var fog: FogVolume = scene.instantiate()
	var low: Vector3 = fog.transform * (-0.5 * fog.size)
	var high: Vector3 = fog.transform * (0.5 * fog.size)
	var material: FogMaterial = fog.material
	return {
		"low": [low.x, low.y, low.z], "high": [high.x, high.y, high.z], "density": material.density,
		"depth": material.density_texture.get_depth()}

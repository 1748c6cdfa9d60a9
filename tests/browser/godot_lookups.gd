# Runs shaders of Godot whose pixels are the bytes of what functions return for given numbers and textures, once with the
# textures' texels and once with these in the opposite order. The answers go to the page as JSON.
extends Node


func _ready() -> void:
	var asked: Array = JSON.parse_string(FileAccess.get_file_as_string("res://asked.json"))
	var answers: Array = []
	for job: Dictionary in asked:
		answers.append({"found": await bytes_of(job, false), "reversed": await bytes_of(job, true)})
	JavaScriptBridge.eval("window.answer(%s)" % JSON.stringify(JSON.stringify(answers)))


func bytes_of(job: Dictionary, is_reversed: bool) -> Array:
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = job.shader
	var numbers := PackedFloat32Array(job.given).to_byte_array()
	var given := Image.create_from_data(job.columns, job.rows, false, Image.FORMAT_RGBAF, numbers)
	material.set_shader_parameter("given", ImageTexture.create_from_image(given))
	for i in job.textures.size():
		material.set_shader_parameter("t%d" % i, texture_of(job.textures[i], is_reversed))
	var viewport := SubViewport.new()
	viewport.size = Vector2i(16, maxi(job.rows, 2))
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	var rectangle := ColorRect.new()
	rectangle.size = viewport.size
	rectangle.material = material
	viewport.add_child(rectangle)
	add_child(viewport)
	for i in 2:
		await RenderingServer.frame_post_draw
	var image := viewport.get_texture().get_image()
	viewport.queue_free()
	image.convert(Image.FORMAT_R8)
	return Array(image.get_data().slice(0, 16 * int(job.rows)))


func texture_of(asked: Dictionary, is_reversed: bool) -> Texture:
	var bytes := FileAccess.get_file_as_bytes("res://" + asked.file)
	if is_reversed:
		var floats := bytes.to_float32_array()
		var turned := floats.duplicate()
		for i in range(0, floats.size(), 4):
			for c in 4:
				turned[floats.size() - 4 - i + c] = floats[i + c]
		bytes = turned.to_byte_array()
	if asked.kind == "2D":
		return ImageTexture.create_from_image(
			Image.create_from_data(asked.size[0], asked.size[1], false, Image.FORMAT_RGBAF, bytes))
	var slices: Array[Image] = []
	var length: int = 16 * int(asked.size[0]) * int(asked.size[1])
	for z in int(asked.size[2]):
		slices.append(Image.create_from_data(
			asked.size[0], asked.size[1], false, Image.FORMAT_RGBAF, bytes.slice(z * length, (z + 1) * length)))
	if asked.kind == "2DArray":
		var layers := Texture2DArray.new()
		layers.create_from_images(slices)
		return layers
	var texture := ImageTexture3D.new()
	texture.create(Image.FORMAT_RGBAF, asked.size[0], asked.size[1], asked.size[2], false, slices)
	return texture

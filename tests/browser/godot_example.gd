# Draws the scene of examples/runtimes/godot with a view. The answer, which goes to the page as JSON, is the picture, as
# bytes of RGBA and with the means of squares of two by two pixels.
extends Node


func _ready() -> void:
	var asked: Dictionary = JSON.parse_string(FileAccess.get_file_as_string("res://asked.json"))
	var scene: PackedScene = load("res://picture.tscn")
	var rectangle: ColorRect = scene.instantiate()
	var material: ShaderMaterial = rectangle.material
	var u: Array = asked.uniforms
	# The block of uniforms as examples/runtimes/view.js packs it.
	material.set_shader_parameter("tan_half_fov", u[3])
	material.set_shader_parameter("exposure", u[7])
	var vectors := {"camera": 0, "forward": 4, "right": 8, "up": 12, "sun": 16}
	for parameter: String in vectors:
		var at: int = vectors[parameter]
		material.set_shader_parameter(parameter, Vector3(u[at], u[at + 1], u[at + 2]))
	var viewport := SubViewport.new()
	viewport.size = Vector2i(asked.size[0], asked.size[1])
	viewport.render_target_update_mode = SubViewport.UPDATE_ONCE
	viewport.add_child(rectangle)
	add_child(viewport)
	for i in 3:
		await RenderingServer.frame_post_draw
	var bytes := viewport.get_texture().get_image()
	bytes.convert(Image.FORMAT_RGBA8)
	JavaScriptBridge.eval("window.answer(%s)" % JSON.stringify(JSON.stringify(means_of(bytes))))


func means_of(image: Image) -> Array:
	var means: Array = []
	for y in range(0, image.get_height(), 2):
		for x in range(0, image.get_width(), 2):
			var sum := Color(0, 0, 0, 0)
			for place: Vector2i in [Vector2i(0, 0), Vector2i(1, 0), Vector2i(0, 1), Vector2i(1, 1)]:
				sum += image.get_pixelv(Vector2i(x, y) + place)
			for c in 4:
				means.append(sum[c] * 255.0 / 4.0)
	return means

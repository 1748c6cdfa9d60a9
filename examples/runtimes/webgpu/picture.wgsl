// The shaders of a triangle that covers the picture, by a camera on a plain: x and y along the ground, z up.
// main.js binds the textures by their order here.
struct View {
    camera: vec3f,                                                          // m
    tan_half_fov: f32,
    forward: vec3f,
    exposure: f32,
    right: vec3f,
    up: vec3f,
    sun: vec3f,
    size: vec2f,                                                            // pixels
}
@group(0) @binding(0) var<uniform> view: View;
@group(0) @binding(1) var transmittance_table: texture_2d<f32>;
@group(0) @binding(2) var transmittance_sampler: sampler;
@group(0) @binding(3) var multiple_scattering_table: texture_2d<f32>;
@group(0) @binding(4) var multiple_scattering_sampler: sampler;
@group(0) @binding(5) var cloud_table: texture_3d<f32>;
@group(0) @binding(6) var cloud_sampler: sampler;
@group(0) @binding(7) var cells_table: texture_3d<f32>;

@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, i == 1), select(-1.0, 3.0, i == 2), 0.0, 1.0);
}

@fragment fn picture(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2f(at.x, view.size.y - at.y);                            // from the lower left corner
    let place = (2.0 * pixel - view.size) / view.size.x * view.tan_half_fov;
    let ray = normalize(view.forward + place.x * view.right + place.y * view.up);
    // Jimenez 2014: neighbouring pixels differ much.
    let noise = fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
    let light = skybake_view(transmittance_table, transmittance_sampler, multiple_scattering_table,
        multiple_scattering_sampler, cloud_table, cloud_sampler, cells_table, view.camera, ray, view.sun,
        2.0 * view.tan_half_fov / view.size.x, noise);
    return vec4f(shown_by_film(view.exposure * light), 1.0);
}

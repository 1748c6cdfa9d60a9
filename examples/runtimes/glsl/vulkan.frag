// The fragment shader of a triangle that covers the picture, for Vulkan. In this folder:
//   glslangValidator -V vulkan.frag -o picture.spv
#version 450
#extension GL_GOOGLE_include_directive : require

layout(std140, binding = 0) uniform View {
    vec3 camera;                                                            // m
    float tan_half_fov;
    vec3 forward;
    float exposure;
    vec3 right, up, sun;
    vec2 size;
};
layout(binding = 1) uniform sampler2D transmittance_table;
layout(binding = 2) uniform sampler2D multiple_scattering_table;
layout(binding = 3) uniform sampler3D cloud_table;
layout(binding = 4) uniform sampler3D cells_table;
layout(location = 0) out vec4 color;

#include "baked/lookups.glsl"
#include "picture.glsl"

void main() { color = picture(vec2(gl_FragCoord.x, size.y - gl_FragCoord.y)); }

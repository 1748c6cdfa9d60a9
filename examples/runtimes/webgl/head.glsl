#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler3D;
layout(std140) uniform View {
    vec3 camera;                                                            // m
    float tan_half_fov;
    vec3 forward;
    float exposure;
    vec3 right, up, sun;
    vec2 size;
};
uniform sampler2D transmittance_table, multiple_scattering_table;
uniform sampler3D cloud_table, cells_table;
out vec4 color;
vec4 picture(vec2 pixel);
void main() { color = picture(gl_FragCoord.xy); }

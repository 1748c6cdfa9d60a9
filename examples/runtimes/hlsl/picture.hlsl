// The pixel shader of a triangle that covers the picture, by a camera on a plain: x and y along the ground,
// z up. In this folder:
//   dxc -T ps_6_0 -E main picture.hlsl                            for Direct3D
//   glslangValidator -D -V -S frag -e main picture.hlsl           for Vulkan
cbuffer View : register(b0) {
    float3 camera;                                                          // m
    float tan_half_fov;
    float3 forward;
    float exposure;
    float3 right, up, sun;
    float2 size;                                                            // pixels
};
Texture2D transmittance_table : register(t0);
Texture2D multiple_scattering_table : register(t1);
Texture3D cloud_table : register(t2);
Texture3D cells_table : register(t3);
SamplerState transmittance_sampler : register(s0);
SamplerState multiple_scattering_sampler : register(s1);
SamplerState cloud_sampler : register(s2);

#include "baked/lookups.hlsl"

float4 main(float4 at : SV_Position) : SV_Target {
    float2 pixel = float2(at.x, size.y - at.y);                             // from the lower left corner
    float2 place = (2.0 * pixel - size) / size.x * tan_half_fov;
    float3 ray = normalize(forward + place.x * right + place.y * up);
    // Jimenez 2014: neighbouring pixels differ much.
    float noise = frac(52.9829189 * frac(dot(pixel, float2(0.06711056, 0.00583715))));
    float3 light = skybake_view(transmittance_table, transmittance_sampler, multiple_scattering_table,
                                multiple_scattering_sampler, cloud_table, cloud_sampler, cells_table, camera, ray, sun,
                                2.0 * tan_half_fov / size.x, noise);
    return float4(shown_by_film(exposure * light), 1.0);
}

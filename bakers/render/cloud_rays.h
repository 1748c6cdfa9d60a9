// Many rays through a cloud at once: the vector kernel of cloud_view.
//
// Along a ray samples stand at t_k = (k + jitter) * step, k an integer: leaping over some never
// moves another. A sample at which the lookup is not above medium.visible_above adds nothing, not
// even a rounding; and every sample that is leapt over is one of those, as it lies within cells
// that are empty by exact arithmetic: cells of samples are compared as integers are, in the float
// arithmetic that places the samples. So results are the same bits with and without leaping. They
// do not depend on the instruction set either, since each ray has a lane of its own and lanes do
// not mix.
//
// All lookups are trilinear in float. Extinction sigma is constant over a step, transmittance falls
// by exp(-sigma step) over it, and what the step scatters towards the eye is
// J (1 - exp(-sigma step)) (Hillaire 2016, section 5.6.2: exact for constant sigma and J, albedo
// 1). Rays end once less than kOpaque gets through.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/render/cloud_light.h"
#include "bakers/render/cloud_medium.h"

namespace skybake {

// Below this nothing behind shows in 8 bits: a quarter of 1/255.
inline constexpr float kOpaque = 0x1p-10F;

// A block of rays, one lane each.
struct RayBlock {
    static constexpr int kCount = 256;
    using Floats = std::array<float, kCount>;

    // Per ray: voxels per metre along x, y, z.
    alignas(64) std::array<Floats, 3> direction{};
    alignas(64) Floats sun_offset{};    // 1 - cosine of the angle between ray and sun
    alignas(64) Floats jitter{};        // of samples along the ray, in [0, 1]
    alignas(64) Floats light_jitter{};  // of samples towards the sun, in [0, 1]
    alignas(64) Floats first{};         // samples k = first ... end - 1, integers below 2^24
    alignas(64) Floats end{};
};

// What reaches the eye, in terms of what the light will turn out to be: sunlight's part is split
// by altitude, so that it may vary linearly from the layer's base to its top.
//   radiance = E(base) sun_at_base + E(top) sun_at_top + L(sky) from_sky + L(ground) from_ground
// with E the sun's irradiance (at normal incidence) and L mean radiances of the two hemispheres.
struct RayResults {
    using Floats = RayBlock::Floats;
    alignas(64) Floats sun_at_base{};  // 1/sr
    alignas(64) Floats sun_at_top{};   // 1/sr
    alignas(64) Floats from_sky{};
    alignas(64) Floats from_ground{};
    alignas(64) Floats transmittance{};
    alignas(64) Floats distance_m{};  // mean over what is seen, times 1 - transmittance
};

struct FetchCounts {
    std::int64_t samples = 0;        // lookups of the volume along rays
    std::int64_t light_samples = 0;  // and towards the sun
    std::int64_t cells = 0;          // lookups of the leap grid
};

struct CloudMarch {
    const CloudMedium* medium = nullptr;
    const DiffuseShare* diffuse = nullptr;
    std::array<OctavePhase, kOctaves> octaves = octave_phases();
    std::array<float, 3> origin{};           // of all rays, in voxels
    std::array<float, 3> light_direction{};  // towards the sun, in voxels per metre
    float step_m = 1;
    float light_step_m = 1;        // towards the sun
    std::vector<float> sun_leaps;  // sun_leaps.h, of samples towards the sun; where leaping
    float light_samples = 0;       // at most, towards the sun; an integer
    bool leaping = true;
};

// Adds to `counts`.
void march_cloud_rays(const CloudMarch& march, const RayBlock& rays, RayResults& results,
                      FetchCounts& counts);

}  // namespace skybake

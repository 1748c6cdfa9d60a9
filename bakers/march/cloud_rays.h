// Marches many rays through one or more cloud layers at once. This is the vector kernel of
// cloud_view.h and scene_view.h.
//
// The samples of a ray are at t_k = u (1 + growth u) step with u = k + jitter and integer k, so leaping over
// some samples never moves the others. A sample stands for the way from u = k to k + 1. The step at distance t
// is step sqrt(1 + 4 growth t / step). A sample whose lookup is not above medium.visible_above adds
// exactly nothing, not even a rounding. Every sample that is leapt over is of this kind: it lies in
// cells that are empty by exact arithmetic, and a sample's cell is found with the same float
// arithmetic that places the sample. So results have the same bits with and without leaping. They
// do not depend on the instruction set either, because each ray has its own lane and lanes do not
// mix.
//
// All lookups are trilinear in float. The extinction sigma is constant over a step, the
// transmittance falls by the factor exp(-sigma step), and the step scatters
// J (1 - exp(-sigma step)) towards the eye (Hillaire 2016, section 5.6.2; exact for constant sigma
// and J and albedo 1). A ray ends when its transmittance is below kOpaque.
//
// Each layer has samples of its own distance. The samples of all layers along a ray are taken in the
// order of their distances, and a sample's light is attenuated by all samples before it, of whatever
// layer. Towards the sun, the optical depths of all layers are added. Their samples are at
// s_k = (k + jitter) * light_step from the point; from the point, where the extinction is known, to the second
// sample the trapezoidal rule is used, so that the depth hardly depends on the jitter where the point is deep
// in cloud.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/march/cloud_light.h"
#include "bakers/march/cloud_medium.h"
#include "bakers/march/light_in_cloud.h"

namespace skybake {

// Below this transmittance, about a quarter of 1/255, nothing behind the cloud shows in 8 bits.
inline constexpr float kOpaque = 0x1p-10F;

// Samples share the light of one point up to this share of what the eye sees, and over this many steps
// (cloud_points-inl.h). Against light for every sample this costs a picture an RMS of 0.23 of 255.
inline constexpr float kSharedWeight = 0x1p-3F;
inline constexpr float kSharedSteps = 8;

// A block of rays, one lane each.
struct RayBlock {
    static constexpr int kCount = 256;
    using Floats = std::array<float, kCount>;

    // The direction of each ray, in voxels per metre along x, y, z.
    alignas(64) std::array<Floats, 3> direction{};
    alignas(64) Floats sun_offset{};    // 1 - cosine of the angle between ray and sun
    alignas(64) Floats jitter{};        // of samples along the ray, in [0, 1]
    alignas(64) Floats light_jitter{};  // of samples towards the sun, in [0, 1]
    alignas(64) Floats first{};         // samples k = first ... end - 1, integers below 2^24
    alignas(64) Floats end{};
};

// The light that reaches the eye, as coefficients of light sources that are only known later.
// Sunlight is split in two by altitude, so that it may vary linearly from the layer's base to its
// top.
//   radiance = E(base) sun_at_base + E(top) sun_at_top + L(sky) from_sky + L(ground) from_ground
// E is the sun's irradiance at normal incidence; L is the mean radiance of a hemisphere.
struct RayResults {
    using Floats = RayBlock::Floats;
    alignas(64) Floats sun_at_base{};  // 1/sr
    alignas(64) Floats sun_at_top{};   // 1/sr
    alignas(64) Floats from_sky{};
    alignas(64) Floats from_ground{};
    alignas(64) Floats transmittance{};  // of all layers
    alignas(64) Floats opacity{};        // the share of light from the eye that ends in this layer
    alignas(64) Floats distance_m{};     // mean distance of what is seen of it, times opacity
};

struct FetchCounts {
    std::int64_t samples = 0;        // lookups of the volume along rays
    std::int64_t light_samples = 0;  // lookups towards the sun
    std::int64_t cells = 0;          // lookups of the leap grid
};

struct CloudMarch {
    const CloudMedium* medium = nullptr;
    const DiffuseShare* diffuse = nullptr;
    // Takes the place of `diffuse` and of octaves, and thins what rays meet by its share; null: none is solved.
    const LightInCloud* solved = nullptr;
    std::array<OctavePhase, kOctaves> octaves{};  // of octave_phases
    std::array<float, 3> origin{};                // of all rays, in voxels
    std::array<float, 3> light_direction{};       // towards the sun, in voxels per metre
    float step_m = 1;                             // along rays, where they begin
    float growth = 0;                             // of those steps
    float light_step_m = 1;                       // towards the sun
    std::vector<float> sun_leaps;  // of samples towards the sun (sun_leaps.h), if leaping
    float light_samples = 0;       // the most per march towards the sun; an integer
    // Along rays, extinction falls smoothly from its full value at the first distance to 0 at the
    // second. It is the full value everywhere if both are 0.
    float fade_from_m = 0;
    float fade_to_m = 0;
    bool leaping = true;
    // Marches towards the sun from points of the same layer begin so far from them, and have so many samples of
    // the above; 0: all.
    float own_begin_m = 0;
    float own_samples = 0;
    // These marches go on where the one above ends, in longer steps through means of the medium (coarse_medium).
    // Points of other layers have the whole march of the first of them, if there is one. Where light is solved,
    // points of the same layer have the rest of the depth from there.
    std::vector<CloudMarch> far_light;
};

// Marches a block of rays through layers and adds its lookups to `counts`. `rays` and `results` have
// one block for each layer; the rays of all blocks are the same, each in its layer's voxels.
void march_cloud_rays(std::span<const CloudMarch> layers, std::span<const RayBlock> rays,
                      std::span<RayResults> results, FetchCounts& counts);

// A point outside or inside of layers, in metres: x and y from the tiles' corner, z as altitude.
// `jitter` in [0, 1] shifts its samples towards the sun.
struct SunlitPoint {
    float x_m = 0;
    float y_m = 0;
    float altitude_m = 0;
    float jitter = 0;
};

// Returns the optical depth of all layers from each point towards the sun.
std::vector<float> depths_towards_sun(std::span<const CloudMarch> layers,
                                      std::span<const SunlitPoint> points, FetchCounts& counts);

}  // namespace skybake

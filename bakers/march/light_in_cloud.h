// Light within a cloud's layer that was solved for, of all orders of scattering, as a march looks it up in
// place of octaves (cloud_light.h). The room assets/cloud_light solves for it.
//
// A march takes the extinction s sigma from the eye on. Per unit of that, a point sends towards the eye,
// which looks in the direction d at an angle u from the sun,
//
//   E (p(u) / s exp(-s tau) F(u, tau) + sum_lm a_lm Y_lm(-d)) + L(sky) sum b_lm Y_lm + L(ground) sum c_lm Y_lm
//
// E is the sun's irradiance, L the mean radiance of a hemisphere, tau the optical depth towards the sun, p
// the phase function, and F the factor of light that goes on by small angles
// (assets/forward_scattering/small_angles.h), which is below 0 near the sun behind thick cloud. The coefficients
// a, b and c stand in cells of the layer.
//
// A point stands for a part of its ray, of the optical depth w, along which the depth to the sun falls by
// v = max(nu, 0) w with nu = cos u, as in a cloud that is even there. The first term is its mean over that
// part, with F apart from the exponentials: exp(-s tau) becomes exp(-s tau) sinhc((w - v) s / 2) / sinhc(w s / 2)
// with sinhc x = sinh x / x, and F becomes its mean over the depths tau - v / 2 to tau + v / 2. So rays towards
// the sun see what the integral is, where parts below 0 and above it cancel.
#pragma once

#include <array>
#include <cstddef>

#include "bakers/air/cloud_phase.h"
#include "bakers/field/image.h"
#include "bakers/math/memory.h"
#include "bakers/math/vectors.h"

namespace skybake {

struct LightInCloud {
    // Coefficients of sunlight, of degree 3, and of the sky's or the ground's light, of degree 1.
    static constexpr std::size_t kSun = 16;
    static constexpr std::size_t kHemisphere = 4;
    static constexpr std::size_t kAll = kSun + 2 * kHemisphere;

    CloudPhase phase;            // p
    double backwards = 0;        // its backward_share
    double share = 1;            // s
    std::array<int, 3> cells{};  // of the tile
    // The coefficients a, b, c of each cell, x fastest, with one more cell on each side as a PaddedVolume
    // has one more voxel.
    AlignedFloats values;
    AlignedFloats depths;   // towards the sun, in the same cells
    Image2<float> forward;  // the integral of F over tau from 0, by forward_mapping.h
};

// Returns the optical depth towards the sun at a place in shares of the tile, which repeats along x and y.
float sun_depth_at(const LightInCloud& light, std::array<float, 3> place);

// What the points of a ray have in common.
struct LitRay {
    std::array<float, LightInCloud::kSun> harmonics{};  // Y_lm(-d)
    double once = 0;                                    // p(u) / s
    double forward = 0;                                 // max(nu, 0)
    double column = 0;                                  // in texels of F
};
// `look` is a unit vector, `offset` 1 - cosine of its angle to the sun.
LitRay lit_ray(const LightInCloud& light, const glm::dvec3& look, double offset);

// A point in shares of the tile, x and y in [0, 1) and z in [0, 1]. What lies beyond the layer, of the optical
// depth `beyond` of `tau`, lets sunlight that is scattered later pass as it lets diffuse light pass.
struct LitPoint {
    std::array<float, 3> place{};
    float tau = 0;
    float beyond = 0;
    float width = 0;  // w
};

// The light of a point, per unit of E, L(sky) and L(ground).
struct PointLight {
    float sun = 0;
    float sky = 0;
    float ground = 0;
};
PointLight light_of(const LightInCloud& light, const LitRay& ray, const LitPoint& point);

}  // namespace skybake

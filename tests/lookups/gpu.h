// GLSL as C++: the types and functions that the published lookups use, in single precision and no
// more exact than GPUs are. A file of examples/lookups, with f after its literals
// (glsl_to_cpp.cmake), is included in this namespace and runs.
//
// Where a GPU's functions differ from a C library's, so do these:
//
//   asin, acos      Mesa's polynomial (GL on most of Linux): off by up to 4e-4 and 2e-4
//   atan(y, x)      Mesa's polynomial: off by up to 3e-6, and by 2e-5 of small angles
//   sqrt, length    4 units in the last place; Vulkan wants 2 of an inverse root, 2.5 of a division
//   log             3 units in the last place, but between 1/2 and 2 up to 2^-21 (Vulkan's bound)
//   exp             3 + 2 |x| units in the last place (Vulkan's bound)
//   pow(x, y)       exp(y log(x))
//
// An error that Vulkan only bounds is a fixed function of the argument, anywhere within the bound.
// There is no sin or cos, whose error Vulkan bounds by 2^-11: no lookup can do with that.
//
// Filtering is exact here: its steps of 1/256 texel are what the tolerance of probes is for.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "tests/lookups/texture.h"

namespace skybake::gpu {

using glm::abs;
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::floor;
using glm::ivec3;
using glm::max;
using glm::min;
using glm::mix;
using glm::sign;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// In [-1, 1], by the bits of a float.
inline double any_share(float x) {
    std::uint32_t bits = std::bit_cast<std::uint32_t>(x) * 2654435761U;
    bits = (bits ^ (bits >> 15U)) * 2246822519U;
    return (bits ^ (bits >> 13U)) / 2147483647.5 - 1;
}

inline float sqrt(float x) {
    return static_cast<float>(std::sqrt(double{x}) * (1 + 4 * 0x1p-24 * any_share(x)));
}

inline float exp(float x) {
    const double error = (3 + 2 * std::fabs(double{x})) * 0x1p-24;
    return static_cast<float>(std::exp(double{x}) * (1 + error * any_share(x)));
}

float log(float x);

// GPUs take it from logarithms; that of a negative x is not a number.
inline float pow(float x, float y) { return x == 0 && y > 0 ? 0 : exp(y * log(x)); }

inline float log(float x) {
    const double exact = std::log(double{x});
    const double error = x >= 0.5f && x <= 2.0f ? 0x1p-21 : 3 * 0x1p-24 * std::fabs(exact);
    return static_cast<float>(exact + error * any_share(x));
}

// Mesa, src/compiler/glsl/builtin_functions.cpp, asin_expr.
inline float asin_of_mesa(float x, float p0, float p1) {
    constexpr float kHalfPi = 1.57079633f;
    const float a = std::fabs(x);
    const float factor = kHalfPi + a * (0.5f * kHalfPi - 1.0f + a * (p0 + a * p1));
    return std::copysign(kHalfPi - std::sqrt(1.0f - a) * factor, x);
}
inline float asin(float x) { return asin_of_mesa(x, 0.086566724f, -0.03102955f); }
inline float acos(float x) { return 1.57079633f - asin_of_mesa(x, 0.08132463f, -0.02363318f); }

// Mesa, src/compiler/nir/nir_builtin_builder.c: the polynomial in min(|t|, 1 / |t|).
inline float atan(float y, float x) {
    const float small = std::fmin(std::fabs(x), std::fabs(y));
    const float large = std::fmax(std::fabs(x), std::fabs(y));
    const float t = small / large;  // of two zeros GLSL says nothing, and this is NaN
    const float s = t * t;
    float angle = t * (0.9999793128310355f +
                       s * (-0.3326756418091246f +
                            s * (0.1938924977115610f +
                                 s * (-0.1173503194786851f +
                                      s * (0.0536813784310406f + s * -0.0121323213173444f)))));
    if (std::fabs(y) > std::fabs(x)) angle = 1.57079633f - angle;
    if (x < 0) angle = 3.14159265f - angle;
    return std::copysign(angle, y);
}

inline float length(const vec3& v) { return gpu::sqrt(dot(v, v)); }
inline float length(const vec2& v) { return gpu::sqrt(dot(v, v)); }

// The result of a lookup.
struct Texel : vec4 {
    explicit Texel(const vec4& value) : vec4(value), rgb(value.x, value.y, value.z) {}
    vec3 rgb;
};

struct sampler2D {
    const Texture& texture;
};
struct sampler3D {
    const Texture& texture;
};
struct sampler2DArray {
    const Texture& texture;
};

inline Texel texel_of(const std::array<double, 4>& value) {
    return Texel(vec4(value[0], value[1], value[2], value[3]));
}
inline Texel texture(const sampler2D& table, const vec2& uv) {
    return texel_of(filtered(table.texture, {uv.x, uv.y, 0.5}));
}
inline Texel texture(const sampler3D& table, const vec3& uvw) {
    return texel_of(filtered(table.texture, {uvw.x, uvw.y, uvw.z}));
}
// The layer is the nearest one (GLSL 4.60, section 8.9).
inline Texel texture(const sampler2DArray& table, const vec3& at) {
    const int layers = table.texture.size[2];
    const double layer = std::clamp(std::floor(double{at.z} + 0.5), 0.0, layers - 1.0);
    return texel_of(filtered(table.texture, {at.x, at.y, (layer + 0.5) / layers}));
}
inline Texel texelFetch(const sampler3D& table, const ivec3& at, int /*level*/) {
    return texel_of(fetched(table.texture, {at.x, at.y, at.z}));
}
// Filters at a place, in double.
inline std::array<double, 4> filtered_at(const Texture& texture, const glm::dvec3& place) {
    return filtered(texture, {place.x, place.y, place.z});
}
// The texels of a texture along each axis, as lookups take them.
inline vec3 size_of(const Texture& texture) {
    return {texture.size[0], texture.size[1], texture.size[2]};
}

}  // namespace skybake::gpu

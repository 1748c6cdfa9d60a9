#include "bakers/color/color_space.h"

#include <cassert>
#include <glm/matrix.hpp>

namespace skybake {
namespace {

constexpr glm::dvec2 kD65(0.3127, 0.3290);          // as Rec. 709 and Rec. 2020 state it
constexpr glm::dvec2 kAcesWhite(0.32168, 0.33767);  // SMPTE ST 2065-1

struct SpaceFacts {
    std::string_view name;
    Primaries primaries;
};
// In the order of the enumerators.
constexpr SpaceFacts kSpaces[] = {
    // IEC 61966-2-1, ITU-R BT.709
    {"linear_srgb", {{0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, kD65}},
    // SMPTE EG 432-1 with D65
    {"display_p3", {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, kD65}},
    // ITU-R BT.2020
    {"rec2020", {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, kD65}},
    // AP1, S-2014-004
    {"acescg", {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, kAcesWhite}},
    {"xyz", {{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}},
    {"none", {}}};

const SpaceFacts& facts_of(ColorSpace space) { return kSpaces[static_cast<std::size_t>(space)]; }

glm::dmat3 diagonal(glm::dvec3 scales) {
    glm::dmat3 matrix(0);
    for (std::size_t i = 0; i < 3; ++i) matrix[i][i] = scales[i];
    return matrix;
}

}  // namespace

std::span<const ColorSpace> all_color_spaces() {
    static constexpr std::array kAll = {ColorSpace::linear_srgb, ColorSpace::display_p3,
                                        ColorSpace::rec2020, ColorSpace::acescg, ColorSpace::xyz};
    return kAll;
}

std::string_view to_string(ColorSpace space) { return facts_of(space).name; }

std::optional<ColorSpace> color_space_named(std::string_view name) {
    for (const ColorSpace space : all_color_spaces()) {
        if (to_string(space) == name) return space;
    }
    return std::nullopt;
}

Primaries primaries_of(ColorSpace space) {
    assert(space != ColorSpace::none);
    return facts_of(space).primaries;
}

glm::dvec3 xyz_of(glm::dvec2 chromaticity) {
    const double x = chromaticity.x, y = chromaticity.y;
    return glm::dvec3(x, y, 1 - x - y) / y;
}

glm::dmat3 to_xyz(ColorSpace space) {
    const Primaries primaries = primaries_of(space);
    const auto column = [](glm::dvec2 p) { return glm::dvec3(p.x, p.y, 1 - p.x - p.y); };
    const glm::dmat3 unscaled(column(primaries.red), column(primaries.green),
                              column(primaries.blue));
    // Each primary is scaled so that (1, 1, 1) is the white with Y = 1.
    return unscaled * diagonal(glm::inverse(unscaled) * xyz_of(primaries.white));
}

glm::dmat3 from_xyz(ColorSpace space) { return glm::inverse(to_xyz(space)); }

glm::dmat3 bradford(glm::dvec3 from_white_xyz, glm::dvec3 to_white_xyz) {
    // From XYZ to the sharpened cones of Lam 1985; GLM takes columns.
    constexpr glm::dmat3 kCones(0.8951, -0.7502, 0.0389, 0.2664, 1.7135, -0.0685, -0.1614, 0.0367,
                                1.0296);
    const glm::dvec3 from = kCones * from_white_xyz, to = kCones * to_white_xyz;
    return glm::inverse(kCones) * diagonal(to / from) * kCones;
}

glm::dmat3 from_xyz(ColorSpace space, White white, glm::dvec3 sun_xyz) {
    const glm::dmat3 matrix = from_xyz(space);
    if (white == White::own) return matrix;
    if (space == ColorSpace::xyz) return diagonal(1.0 / (matrix * sun_xyz)) * matrix;
    return matrix * bradford(sun_xyz, xyz_of(primaries_of(space).white));
}

}  // namespace skybake

// Shared by tests of environments: maps of any function, and lookups of them.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "bakers/assets/environment/environment_mapping.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/field/baked.h"
#include "bakers/field/image.h"
#include "config/assets/environment.h"
#include "tests/light/sky_media.h"
#include "tests/support/loops.h"
#include "tests/support/outcomes.h"

namespace skybake::test {

using config::EnvironmentMapping;

inline constexpr double kPi = std::numbers::pi;

// A mapping at a size, also at sizes that halve to odd ones.
struct MappingCase {
    EnvironmentMapping mapping;
    std::array<int, 2> size;
};
inline const std::vector<MappingCase> kMappingCases = {
    {EnvironmentMapping::longitude_latitude, {32, 16}},
    {EnvironmentMapping::longitude_latitude, {7, 5}},
    {EnvironmentMapping::cube, {16, 96}},
    {EnvironmentMapping::cube, {5, 30}},
    {EnvironmentMapping::octahedral, {16, 16}},
    {EnvironmentMapping::octahedral, {9, 9}},
    {EnvironmentMapping::octahedral, {1, 1}},
    {EnvironmentMapping::equal_area, {16, 16}},
    {EnvironmentMapping::equal_area, {9, 9}},
    {EnvironmentMapping::equal_area, {1, 1}},
};

// Directions spread evenly over the sphere, none of them on an edge of a mapping: a spiral.
inline std::vector<glm::dvec3> even_directions(int count) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count; ++i) {
        const double up = 1 - (2 * i + 1.0) / count;
        const double level = std::sqrt(1 - up * up);
        const double turn = 2.399963229728653 * i + 0.123;
        directions.push_back({level * std::sin(turn), up, level * std::cos(turn)});
    }
    return directions;
}

// Calls visit(direction, solid angle, texel) for each texel.
template <class Map, class Visit>
void for_texels(Map& map, const EnvironmentLayout& layout, const Visit& visit) {
    const auto [columns, rows] = layout.part_size();
    testing::for_each_voxel({columns, rows, layout.parts()}, [&](int x, int y, int part) {
        visit(layout.direction(part, (x + 0.5) / columns, (y + 0.5) / rows),
              layout.solid_angle(part, x, y), map.texel(x, part * rows + y));
    });
}

// The map of one channel whose texels are a function of their directions.
inline Image2<float> map_of(const EnvironmentLayout& layout,
                            const std::function<double(const glm::dvec3&)>& light) {
    const auto [columns, rows] = layout.part_size();
    Image2<float> map(columns, rows * layout.parts(), 1);
    for_texels(map, layout, [&](const glm::dvec3& direction, double, float* texel) {
        *texel = static_cast<float>(light(direction));
    });
    return map;
}

inline config::EnvironmentBake map_bake(std::array<int, 2> size, double sun_deg) {
    config::EnvironmentBake bake;
    bake.size = size;
    bake.sun_elevation = {sun_deg * kDegree};
    return bake;
}

inline Baked baked(const config::EnvironmentBake& bake, std::span<const CloudMedium> media,
                   Certification certification = Certification::off, int threads = 1,
                   const SkyLight& light = earth().light()) {
    Baked table;
    table.name = "around";
    table.channel_names = {"R", "G", "B"};
    return without_errors(bake_environment(
        light, bake, {.threads = threads, .certification = certification}, table, media));
}

}  // namespace skybake::test

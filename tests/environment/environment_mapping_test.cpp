#include "bakers/assets/environment/environment_mapping.h"
#include "config/assets/environment.h"

#include <gtest/gtest.h>

#include "tests/environment/maps.h"
#include "tests/support/loops.h"

namespace skybake {
namespace {

using config::EnvironmentMapping;
using namespace test;

EnvironmentLayout layout_of(const MappingCase& of) { return {of.mapping, of.size}; }

TEST(EnvironmentMapping, AngleIsThatOfTheCLibrary) {
    for (int i = 0; i < 2000; ++i) {
        const double angle = -kPi + 2 * kPi * (i + 0.5) / 2000;
        const double length = std::pow(10, i % 7 - 3);
        EXPECT_NEAR(angle_of(length * std::sin(angle), length * std::cos(angle)), angle, 1e-15);
    }
    EXPECT_EQ(angle_of(0, 0), 0);
    EXPECT_NEAR(angle_of(0, -2), kPi, 1e-15);
    EXPECT_NEAR(angle_of(1e-9, 1), 1e-9, 1e-15);
}

// The integral over the sphere, whatever the mapping; and each texel against the size of its patch,
// by differences between directions, which know nothing of solid angles.
TEST(EnvironmentMapping, SolidAnglesOfTexelsAreThoseOfTheirPatches) {
    for (const MappingCase& of : kMappingCases) {
        const EnvironmentLayout layout = layout_of(of);
        const auto [columns, rows] = layout.part_size();
        double sum = 0;
        testing::for_each_voxel({columns, rows, layout.parts()}, [&](int x, int y, int part) {
            const double found = layout.solid_angle(part, x, y);
            EXPECT_GT(found, 0);
            sum += found;
            constexpr int kPatches = 32;
            double patches = 0;
            for (int k = 0; k < kPatches * kPatches; ++k) {
                const double step = 1.0 / kPatches;
                const double left = (x + k % kPatches * step) / columns;
                const double top = (y + k / kPatches * step) / rows;
                const double right = left + step / columns;
                const double bottom = top + step / rows;
                const glm::dvec3 a =
                    layout.direction(part, right, bottom) - layout.direction(part, left, top);
                const glm::dvec3 b =
                    layout.direction(part, left, bottom) - layout.direction(part, right, top);
                patches += 0.5 * glm::length(glm::cross(a, b));
            }
            EXPECT_NEAR(patches / found, 1, 4e-3) << columns << " " << x << " " << y;
        });
        EXPECT_NEAR(sum, 4 * kPi, 1e-9);
    }
}

// The solid angle per area, which weighs rays within a texel, against that of the texels.
TEST(EnvironmentMapping, DensityIsProportionalToTheSolidAngle) {
    for (const MappingCase& of : kMappingCases) {
        if (of.size[0] < 16) continue;
        const EnvironmentLayout layout(of.mapping, {16 * of.size[0], 16 * of.size[1]});
        const auto [columns, rows] = layout.part_size();
        const double scale = layout.solid_angle(0, columns / 3, rows / 3) /
                             layout.density((columns / 3 + 0.5) / columns, (rows / 3 + 0.5) / rows);
        for (int y = 1; y < rows; y += 7) {
            for (int x = 0; x < columns; x += 5) {
                const double found = layout.density((x + 0.5) / columns, (y + 0.5) / rows);
                EXPECT_NEAR(scale * found / layout.solid_angle(0, x, y), 1, 2e-2) << x << " " << y;
            }
        }
    }
}

TEST(EnvironmentMapping, FindsTheTexelThatShowsADirection) {
    for (const MappingCase& of : kMappingCases) {
        const EnvironmentLayout layout = layout_of(of);
        for (const glm::dvec3& direction : test::even_directions(500)) {
            const EnvironmentLayout::At at = layout.at(direction);
            const glm::dvec3 back = layout.direction(at.part, at.x, at.y);
            EXPECT_LT(glm::length(back - direction), 1e-14);
            EXPECT_TRUE(at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1);
        }
    }
}

// Longitude and latitude in words: ahead in the middle, the right side at 3/4, the zenith on top.
TEST(EnvironmentMapping, LooksAheadInTheMiddle) {
    const EnvironmentLayout map(EnvironmentMapping::longitude_latitude, {8, 4});
    EXPECT_LT(glm::length(map.direction(0, 0.5, 0.5) - glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_LT(glm::length(map.direction(0, 0.75, 0.5) - glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::length(map.direction(0, 0.3, 0) - glm::dvec3(0, 1, 0)), 1e-15);
    const EnvironmentLayout square(EnvironmentMapping::octahedral, {8, 8});
    EXPECT_LT(glm::length(square.direction(0, 0.5, 0.5) - glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_LT(glm::length(square.direction(0, 0.5, 0) - glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_LT(glm::length(square.direction(0, 1, 0.5) - glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::length(square.direction(0, 1, 1) - glm::dvec3(0, -1, 0)), 1e-15);
    const EnvironmentLayout pbrt(EnvironmentMapping::equal_area, {8, 8});
    EXPECT_LT(glm::length(pbrt.direction(0, 0.5, 0.5) - glm::dvec3(0, 1, 0)), 1e-15);
    EXPECT_LT(glm::length(pbrt.direction(0, 1, 0.5) - glm::dvec3(0, 0, 1)), 1e-15);
    EXPECT_LT(glm::length(pbrt.direction(0, 0.5, 0) - glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_LT(glm::length(pbrt.direction(0, 1, 1) - glm::dvec3(0, -1, 0)), 1e-15);
}

// Table 8.19 of the specification of OpenGL 4.6: of each face the major axis and what sc and tc are.
TEST(EnvironmentMapping, FacesOfACubeAreThoseOfGpus) {
    struct Face {
        glm::dvec3 major, sc, tc;
    };
    const Face faces[] = {
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
    const EnvironmentLayout layout(EnvironmentMapping::cube, {8, 48});
    for (const glm::dvec3& direction : test::even_directions(3000)) {
        int face = 0;
        for (int i = 1; i < 6; ++i) {
            if (glm::dot(direction, faces[i].major) > glm::dot(direction, faces[face].major)) {
                face = i;
            }
        }
        const double major = glm::dot(direction, faces[face].major);
        const EnvironmentLayout::At at = layout.at(direction);
        EXPECT_EQ(at.part, face);
        EXPECT_NEAR(at.x, 0.5 * (glm::dot(direction, faces[face].sc) / major + 1), 1e-14);
        EXPECT_NEAR(at.y, 0.5 * (glm::dot(direction, faces[face].tc) / major + 1), 1e-14);
    }
}

// A place just beyond an edge is next to one just within it, on whichever part it is: no seam is
// torn or shifted.
TEST(EnvironmentMapping, HasNoSeams) {
    constexpr double kStep = 1e-7;
    for (const MappingCase& of : kMappingCases) {
        const EnvironmentLayout layout = layout_of(of);
        for (int part = 0; part < layout.parts(); ++part) {
            for (int i = 0; i < 40; ++i) {
                const double along = (i + 0.4) / 40;
                const double places[][4] = {{-kStep, along, kStep, along},
                                            {1 + kStep, along, 1 - kStep, along},
                                            {along, -kStep, along, kStep},
                                            {along, 1 + kStep, along, 1 - kStep}};
                for (const auto& [x, y, in_x, in_y] : places) {
                    const glm::dvec3 beyond = layout.direction(part, x, y);
                    const glm::dvec3 within = layout.direction(part, in_x, in_y);
                    EXPECT_LT(glm::length(beyond - within), 20 * kStep);
                    const EnvironmentLayout::At at = layout.at(beyond);
                    EXPECT_LT(glm::length(layout.direction(at.part, at.x, at.y) - beyond), 1e-9);
                }
            }
        }
    }
}

}  // namespace
}  // namespace skybake

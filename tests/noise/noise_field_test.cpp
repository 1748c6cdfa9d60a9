// NoiseField and the kernels below it: boxes, channels and paths, each equal to the specification.
#include "bakers/noise/noise_field.h"

#include <gtest/gtest.h>

#include "bakers/math/quadrature.h"
#include "bakers/noise/cell_kernel.h"
#include "bakers/noise/gradient_kernel.h"
#include "bakers/noise/scattered_kernel.h"
#include "tests/noise/every_target.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;
using test::expect_specified;

TEST(NoiseField, EqualsTheSpecificationOnEveryTarget) {
    int targets = 0;
    test::on_every_target([&](const char*) { ++targets; });
    EXPECT_GE(targets, 2);
    for (const config::Noise& noise : test::noises_of_all_kinds({{4, 4, 4}, {9, 5, 7}})) {
        expect_specified(noise, {33, 20, 11}, {{}, {33, 20, 11}});
        expect_specified(noise, {33, 20, 11}, {{29, 1, 6}, {4, 5, 3}});  // few voxels
    }
}

TEST(NoiseField, EqualsTheSpecificationOfAnyOctaves) {
    // The second of three octaves has more cells than voxels.
    for (const auto& noise : test::noises_of_all_kinds({{4, 4, 4}, {9, 5, 40}, {3, 5, 7}})) {
        expect_specified(noise, {33, 20, 11}, {{0, 1, 0}, {33, 18, 11}});
    }
    // Rows of whole vectors go straight to the caller.
    expect_specified(test::noise_of({test::perlin({{4, 4, 4}, {16, 16, 16}}),
                                     test::perlin({{8, 3, 5}}, NoiseFractal::billow),
                                     test::curl({{4, 4, 4}}, config::CurlComponent::z)}),
                     {32, 32, 32}, {{0, 3, 5}, {32, 17, 11}});
    // Long rows are made in pieces, here of up to as many cells as voxels.
    expect_specified(test::noise_of({test::perlin({{75, 4, 2}, {620, 5, 3}, {3, 2, 1}})}),
                     {620, 20, 3}, {{13, 1, 0}, {607, 13, 3}});
    // With more cells than voxels along an axis each sample is hashed on its own.
    expect_specified(test::noise_of({test::perlin({{50, 3, 4}}), test::worley({{1, 2, 40}}),
                                     test::worley({{5, 3, 40}}, WorleyFeature::f2),
                                     test::worley({{74, 27, 9}}, WorleyFeature::f2_minus_f1)}),
                     {37, 9, 9}, {{5, 2, 1}, {32, 7, 8}});
}

// From the widest cells, of 64 voxels, to cells of one voxel, whose blocks differ in shape.
TEST(NoiseField, EqualsTheSpecificationForCellsOfAnyWidth) {
    for (const int voxels : {1, 2, 3, 5, 6, 8, 12, 16, 24, 31, 64}) {
        const int frequency = std::max(1, 64 / voxels);
        const std::array<int, 3> size = {64, 64, 64};
        const test::Frequency all = {frequency, frequency, frequency};
        expect_specified(
            test::noise_of(
                {test::worley({all}), test::worley({all}, WorleyFeature::f2), test::perlin({all})}),
            size, {{37, 11, 50}, {21, 9, 5}});
        // Wide along one axis, narrow along the others.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            test::Frequency mixed = {2, 2, 2};
            mixed[axis] = frequency;
            expect_specified(test::noise_of({test::worley({mixed}, WorleyFeature::f2_minus_f1),
                                             test::perlin({mixed})}),
                             size, {{3, 44, 9}, {18, 6, 9}});
        }
    }
}

TEST(NoiseField, FillsOnlyWhatIsWanted) {
    const NoisePlan plan = make_noise_plan(test::noises_of_all_kinds({{3, 4, 5}})[0], {24, 24, 24});
    const NoiseField field(plan);
    const VoxelBox box{{1, 2, 3}, {23, 11, 9}};
    const test::Planes all = test::filled(field, box, plan.output_channels());
    for (std::size_t wanted = 0; wanted < all.size(); ++wanted) {
        std::vector<float*> targets(all.size(), nullptr);
        std::vector<float> plane(all[wanted].size());
        targets[wanted] = plane.data();
        field.fill(box, targets);
        EXPECT_EQ(plane, all[wanted]) << wanted;
    }
}

TEST(NoiseField, PacksFourChannelsOrThreeIntoOne) {
    config::Noise noise = test::noise_of(
        {test::channel_of(config::NoiseType::perlin_worley, {{2, 2, 2}}), test::worley({{3, 3, 3}}),
         test::worley({{5, 5, 5}}), test::worley({{7, 7, 7}})});
    noise.pack = config::NoisePacking::shape;
    expect_specified(noise, {20, 20, 20}, {{1, 1, 1}, {19, 7, 10}});
    noise.channels.pop_back();
    noise.pack = config::NoisePacking::detail;
    expect_specified(noise, {20, 20, 20}, {{1, 1, 1}, {19, 7, 10}});
    EXPECT_EQ(make_noise_plan(noise, {4, 4, 4}).output_channels(), 1);
}

// Second nearest points are often beyond the 27 cells about a voxel: in so many voxels some are, for
// cells of 4, 3.3 and 1.3 voxels, and for wide ones of 25. All channels have one field: two are it, a
// third shapes it.
TEST(NoiseField, CellsOfAnyWidthEqualThePointwiseKernel) {
    for (const auto& [frequency, size] : {std::pair{32, 128}, {30, 100}, {64, 80}, {4, 100}}) {
        config::NoiseChannel inverted =
            test::worley({{frequency, frequency, frequency}}, WorleyFeature::f2);
        const config::NoiseChannel plain = inverted;
        inverted.invert = true;
        const NoisePlan plan =
            make_noise_plan(test::noise_of({plain, plain, inverted}), {size, size, size});
        ASSERT_EQ(plan.fields.size(), 1u);
        const VoxelBox box{{0, 0, 0}, {size, size, size}};
        const test::Planes made = test::whole(plan);
        const auto stride = static_cast<std::size_t>((size + 15) / 16 * 16);
        const auto rows = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
        std::vector<float> pointwise(stride * rows);
        fill_cell_field_pointwise(plan.fields[0], box, stride, pointwise.data());
        std::int64_t unlike = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t x = 0; x < static_cast<std::size_t>(size); ++x) {
                const float value = pointwise[row * stride + x];
                const std::size_t at = row * static_cast<std::size_t>(size) + x;
                unlike += made[0][at] != value || made[1][at] != value || made[2][at] != 1 - value;
            }
        }
        EXPECT_EQ(unlike, 0) << frequency << " cells, " << size << " voxels";
    }
}

// Where cells have four voxels or more, the voxels of a block share points (cell_kernel.h). Boxes begin
// and end anywhere; a cell may be the whole tile, and points may move.
TEST(Alligator, EqualsTheSpecificationWhereCellsAreWide) {
    struct Case {
        std::array<int, 3> size;
        std::array<int, 3> frequency;
        VoxelBox box;
    };
    for (const Case& any :
         {Case{{40, 33, 35}, {4, 4, 4}, {{}, {40, 33, 35}}},
          Case{{40, 33, 35}, {4, 3, 2}, {{7, 5, 3}, {29, 13, 11}}},
          Case{{32, 32, 32}, {8, 8, 8}, {{}, {32, 32, 32}}},          // 4 voxels
          Case{{67, 25, 18}, {11, 5, 4}, {{1, 2, 3}, {66, 23, 15}}},  // 4.5 to 6.1 voxels
          Case{{24, 16, 16}, {1, 1, 1}, {{}, {24, 16, 16}}},
          Case{{64, 8, 16}, {2, 1, 3}, {{63, 7, 0}, {1, 1, 16}}},
          Case{{31, 32, 32}, {8, 8, 8}, {{}, {31, 32, 32}}}}) {  // 3.9 voxels: not shared
        NoisePlan plan =
            make_noise_plan(test::noise_of({test::alligator({any.frequency})}), any.size);
        for (const PathShift shift : {PathShift{}, {12345678, 0}, {12345678, 23456789}}) {
            plan.fields[0].shift = shift;
            expect_specified(plan, any.box);
        }
    }
}

}  // namespace
}  // namespace skybake::noise

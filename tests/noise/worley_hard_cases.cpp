// Cellular noise is exact: against brute force over every cell of small lattices, and where 27
// cells are not enough.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/noise/noise_reference.h"
#include "tests/noise/cell_holes.h"
#include "tests/noise/every_target.h"
#include "tests/noise/running_error.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using config::WorleyFeature;
using test::Frequency;
using test::hold;

// The two nearest points among all cells of the lattice and as many copies of it as hold all that
// is within two cells of the tile.
std::array<double, 2> nearest_of_all(std::uint64_t key, const Frequency& period,
                                     const std::array<double, 3>& place) {
    std::array<int, 3> beyond;
    for (std::size_t i = 0; i < 3; ++i) beyond[i] = (2 + period[i]) / period[i] * period[i];
    std::array<double, 2> nearest = {1e9, 1e9};
    const auto wrap = [](int c, int p) { return static_cast<std::uint32_t>(((c % p) + p) % p); };
    for (int z = -beyond[2]; z < period[2] + beyond[2]; ++z) {
        for (int y = -beyond[1]; y < period[1] + beyond[1]; ++y) {
            const RowKey row = row_key(key, wrap(y, period[1]), wrap(z, period[2]));
            for (int x = -beyond[0]; x < period[0] + beyond[0]; ++x) {
                const CellPoint point = cell_point(row, wrap(x, period[0]));
                const double dx = x + double{point.x} - place[0] * period[0];
                const double dy = y + double{point.y} - place[1] * period[1];
                const double dz = z + double{point.z} - place[2] * period[2];
                const double distance = std::sqrt(dx * dx + dy * dy + dz * dz);
                if (distance < nearest[0]) {
                    nearest = {distance, nearest[0]};
                } else {
                    nearest[1] = std::min(nearest[1], distance);
                }
            }
        }
    }
    return nearest;
}

TEST(NoiseHardCase, WorleyAgainstAllCells) {
    double worst = 0;
    double worst_reference = 0;
    for (const Frequency& period :
         {Frequency{1, 1, 1}, {1, 2, 3}, {2, 2, 2}, {5, 4, 3}, {7, 2, 6}}) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            const std::array<int, 3> size = {19, 13, 11};
            const config::Noise noise =
                test::noise_of({test::worley({period}), test::worley({period}, WorleyFeature::f2),
                                test::worley({period}, WorleyFeature::f2_minus_f1)},
                               seed);
            const NoisePlan plan = make_noise_plan(noise, size);
            if (seed == 0) test::expect_specified(plan, {{}, size});
            const test::Planes values = test::whole(plan);
            const std::uint64_t key = octave_key(seed, 0, Purpose::cells, period);
            for (std::size_t i = 0; i < values[0].size(); i += 3) {
                const auto at = static_cast<int>(i);
                const Voxel voxel = {at % 19, at / 19 % 13, at / 19 / 13};
                const auto place = test::place_of(plan.axes, voxel);
                const auto [f1, f2] = nearest_of_all(key, period, place);
                worst = std::max({worst, std::fabs(values[0][i] - f1), std::fabs(values[1][i] - f2),
                                  std::fabs(values[2][i] - (f2 - f1))});
                const std::vector<double> reference = noise_reference(noise, place);
                worst_reference = std::max(
                    {worst_reference, std::fabs(reference[0] - f1), std::fabs(reference[1] - f2)});
            }
        }
    }
    EXPECT_LE(worst_reference, 1e-14);
    hold("worley F1, F2, F2-F1 of small lattices", "brute force over all cells and copies, double",
         worst, 2 * test::distance_error(7) + test::kFloatRounding);
}

// How the value is spread: 1 - d / sqrt(3) cannot use all of its range.
TEST(NoiseHardCase, WorleyRange) {
    const config::Noise noise = test::noise_of({test::worley(
        {{32, 32, 32}}, WorleyFeature::f1, config::WorleyValue::one_minus_distance_over_sqrt3)});
    const test::Planes values =
        test::filled(NoiseField(make_noise_plan(noise, {128, 128, 128})), {{}, {128, 128, 64}}, 1);
    const auto [low, high] = std::minmax_element(values[0].begin(), values[0].end());
    EXPECT_GE(*low, 0);
    EXPECT_LE(*high, 1);
    // A place without a point within 1.3 cells, and points near voxels, are among 16384 cells.
    EXPECT_LE(*low, 0.4f);
    EXPECT_GE(*high, 0.95f);
    hold(fmt::format("worley 1-d/sqrt(3): {:.3f} to {:.3f}", *low, *high), "within [0, 1]: beyond",
         std::max(0.0, std::max(-double{*low}, *high - 1.0)), 0);
}

void hold_holes(std::int64_t unsure, double at_least_wrong_by) {
    const test::HoleCount count = test::look_into_holes(unsure);
    EXPECT_GE(count.unsure, unsure);
    EXPECT_GT(count.wrong, 0);
    EXPECT_GE(count.wrong_by, at_least_wrong_by);
    hold(fmt::format("worley at {:.1e} points with F1 > 1 + m", static_cast<double>(count.unsure)),
         fmt::format("125 cells, bits unlike; 27: {} wrong by <= {:.3f}", count.wrong,
                     count.wrong_by),
         static_cast<double>(count.mismatches), 0);
}

TEST(NoiseHardCase, WorleyWhere27CellsFail) { hold_holes(1'000'000, 0.05); }

TEST(SlowNoiseHardCase, WorleyWhere27CellsFail1e8) { hold_holes(100'000'000, 0.1); }

// The same holes by every instruction set and by both kernels, F2 too.
TEST(NoiseHardCase, WorleyHolesOnEveryTarget) {
    const Frequency frequency = {test::kHoleCells, test::kHoleCells, test::kHoleCells};
    const std::uint64_t key = octave_key(7, 0, Purpose::cells, frequency);
    const auto holes =
        test::holes_between(test::plane_of_points(key, 0), test::plane_of_points(key, 1), 1);
    const NoisePlan plan = make_noise_plan(
        test::noise_of({test::worley({frequency}), test::worley({frequency}, WorleyFeature::f2)}),
        {test::kHoleSize, test::kHoleSize, test::kHoleSize});
    ASSERT_GE(holes.size(), 40u);
    std::int64_t unlike = 0;
    for (std::size_t i = 0; i < 40; ++i) {
        VoxelBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            const int reach = i % 2 == 0 ? 5 : 3;  // blockwise: more than 512 voxels; pointwise
            box.origin[k] = holes[i][k] * test::kHoleVoxelsPerCell - reach;
            box.size[k] = 2 * reach;
        }
        unlike += test::expect_specified(plan, box);
    }
    hold("worley F1, F2 about 40 holes", "specification on every SIMD target, bits unlike",
         static_cast<double>(unlike), 0);
}

}  // namespace
}  // namespace skybake::noise

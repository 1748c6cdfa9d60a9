// Tiling, boxes and sizes: whatever the period, voxels a tile apart are the same bits, and any box
// is a part of the whole.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/math/quadrature.h"
#include "bakers/noise/lattice_hash.h"
#include "tests/noise/every_target.h"
#include "tests/noise/running_error.h"
#include "tests/support/hard_case.h"

namespace skybake::noise {
namespace {

using test::Frequency;
using test::hold;

Voxel voxel_near(int index, const std::array<TileAxis, 3>& axes) {
    Voxel voxel;
    const std::array<double, 3> point = low_discrepancy_point(index);
    for (std::size_t i = 0; i < 3; ++i) voxel[i] = static_cast<int>(point[i] * axes[i].size);
    return voxel;
}

std::int64_t largest_ulps(const std::vector<float>& a, const std::vector<float>& b) {
    std::int64_t largest = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        largest = std::max(largest, test::ulps_between(a[c], b[c]));
    }
    return largest;
}

// Over all axes: voxel N against 0, N + 1 against 1, -1 against N - 1, and far tiles.
std::int64_t seam_ulps(const NoisePlan& plan, int points) {
    std::int64_t largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t size = plan.axes[axis].size;
        for (int i = 0; i < points; ++i) {
            Voxel here = voxel_near(i, plan.axes);
            Voxel there = here;
            const auto compare = [&](std::int64_t a, std::int64_t b) {
                here[axis] = a;
                there[axis] = b;
                largest =
                    std::max(largest, largest_ulps(noise_at(plan, here), noise_at(plan, there)));
            };
            compare(size, 0);
            compare(size + 1, 1);
            compare(-1, size - 1);
            compare(1000 * size + size / 3, size / 3);
        }
    }
    return largest;
}

// The voxels beyond the seam by the kernels' lattices: a box at the tile's end, made of cells up to
// the period, against noise_at of the same voxels a tile further on, made of cells after it.
std::int64_t kernel_seam_ulps(const NoisePlan& plan) {
    const NoiseField field(plan);
    VoxelBox box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.size[i] = std::min(plan.axes[i].size, 10);
        box.origin[i] = plan.axes[i].size - box.size[i];
    }
    const test::Planes end = test::filled(field, box, plan.output_channels());
    box.origin[0] += plan.axes[0].size;
    box.origin[1] -= plan.axes[1].size;
    box.origin[2] += 3 * plan.axes[2].size;
    const test::Planes beyond = test::specified(plan, box);
    std::int64_t largest = 0;
    for (std::size_t c = 0; c < end.size(); ++c) {
        largest = std::max(largest, largest_ulps(end[c], beyond[c]));
    }
    return largest;
}

// Error against the reference at voxels on both sides of a seam, as a share of the bound.
double error_at_seam(const config::Noise& noise, const NoisePlan& plan, int points) {
    double worst = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < points; ++i) {
            for (const std::int64_t offset : {-1, 0, 1}) {
                Voxel voxel = voxel_near(i, plan.axes);
                voxel[axis] = plan.axes[axis].size + offset;
                worst = std::max(worst, test::error_share(noise, plan, voxel));
            }
        }
    }
    return worst;
}

void hold_tiling(int period) {
    // Sizes that the period does not divide, nor they it; cells wide and narrow, also below a
    // voxel.
    double worst = 0;
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{640, 97, 10}, {311, 640, 1}, {5, 1030, 643}}) {
        const std::vector<Frequency> frequencies = {{period, period, period},
                                                    {period, std::max(1, period / 2), period + 1}};
        for (config::Noise& noise : test::noises_of_all_kinds(frequencies)) {
            for (const auto sampling :
                 {config::NoiseSampling::centers, config::NoiseSampling::slices_at_corners}) {
                noise.sampling = sampling;
                const NoisePlan plan = make_noise_plan(noise, size);
                worst = std::max(worst, static_cast<double>(seam_ulps(plan, 8)));
                worst = std::max(worst, static_cast<double>(kernel_seam_ulps(plan)));
                EXPECT_LE(error_at_seam(noise, plan, 3), 1);
            }
        }
    }
    hold(fmt::format("noise tiling, period {}", period),
         "voxel N against 0, N+1 : 1, -1 : N-1, ulp", worst, 0);
}

TEST(NoiseHardCase, NoiseTilesWithPeriod1) { hold_tiling(1); }
TEST(NoiseHardCase, NoiseTilesWithPeriod3) { hold_tiling(3); }
TEST(NoiseHardCase, NoiseTilesWithPeriod7) { hold_tiling(7); }
TEST(NoiseHardCase, NoiseTilesWithPeriod255) { hold_tiling(255); }
TEST(NoiseHardCase, NoiseTilesWithPeriod256) { hold_tiling(256); }
TEST(NoiseHardCase, NoiseTilesWithPeriod257) { hold_tiling(257); }
TEST(NoiseHardCase, NoiseTilesWithPeriod300) { hold_tiling(300); }
TEST(NoiseHardCase, NoiseTilesWithPeriod512) { hold_tiling(512); }

// --- Frequencies about the sampling limit -------------------------------------------------------

TEST(NoiseHardCase, NoiseFrequenciesAtTheLimit) {
    for (const auto& [name, frequency] : {std::pair<const char*, int>{"size/4", 16},
                                          {"size/2", 32},
                                          {"size", 64},
                                          {"size + 1", 65},
                                          {"17 times size", 1088},
                                          {"2^20", 1 << 20}}) {
        test::Mismatches mismatches;
        double error = 0;
        std::int64_t zeros = 0;
        const VoxelBox box{{40, 9, 25}, {24, 13, 11}};
        for (const config::Noise& noise :
             test::noises_of_all_kinds({{frequency, frequency, frequency}})) {
            const NoisePlan plan = make_noise_plan(noise, {64, 64, 64});
            const test::Mismatches found = test::unlike_specification(plan, box);
            mismatches.count += found.count;
            if (mismatches.first.empty()) mismatches.first = found.first;
            for (int i = 0; i < 50; ++i) {
                const Voxel voxel = voxel_near(i, plan.axes);
                const auto wanted = test::uncertain_noise(noise, test::place_of(plan.axes, voxel));
                const std::vector<float> values = noise_at(plan, voxel);
                for (std::size_t c = 0; c < values.size(); ++c) {
                    const double apart = std::fabs(values[c] - wanted[c].value);
                    EXPECT_LE(apart, wanted[c].error) << name << ' ' << c;
                    error = std::max(error, apart);
                }
            }
        }
        EXPECT_EQ(mismatches.count, 0) << name << ' ' << mismatches.first;
        hold(fmt::format("noise frequency at {}, 64 voxels", name),
             fmt::format("double reference; {} bits unlike", mismatches.count), error, 1e-5);
        // By its definition, a gradient octave is 0 at lattice points, which are the lower corners of
        // cells of two voxels and of one: at an eighth of voxels, and at all.
        config::Noise octave = test::noise_of(
            {test::perlin({{frequency, frequency, frequency}}, NoiseFractal::billow)});
        octave.sampling = config::NoiseSampling::corners;
        const NoisePlan plan = make_noise_plan(octave, {64, 64, 64});
        const test::Planes values = test::filled(NoiseField(plan), {{}, {64, 64, 8}}, 1);
        for (const float v : values[0]) zeros += v == 0 ? 1 : 0;
        // Opposite gradients make up a few more.
        if (frequency == 32) {
            EXPECT_GE(zeros, 64 * 64 * 8 / 8);
            EXPECT_LT(zeros, 64 * 64 * 8 / 2);
        }
        if (frequency % 64 == 0) {
            EXPECT_EQ(zeros, 64 * 64 * 8);
        }
        if (frequency == 65) {
            EXPECT_LT(zeros, 64 * 64 * 8 / 16);
        }
    }
}

// --- Sizes --------------------------------------------------------------------------------------

std::int64_t unlike(const std::vector<Frequency>& frequencies, const std::array<int, 3>& size,
                    const std::vector<VoxelBox>& boxes) {
    std::int64_t count = 0;
    for (const config::Noise& noise : test::noises_of_all_kinds(frequencies)) {
        const NoisePlan plan = make_noise_plan(noise, size);
        for (const VoxelBox& box : boxes) count += test::expect_specified(plan, box);
    }
    return count;
}

void row(const char* name, std::int64_t count) {
    hold(name, "specification on every SIMD target, bits unlike", static_cast<double>(count), 0);
}

TEST(NoiseHardCase, NoiseSizes) {
    row("noise size 1 x 1 x 1", unlike({{1, 1, 1}, {5, 3, 8}}, {1, 1, 1}, {{{}, {1, 1, 1}}}));
    row("noise sizes 1 on two axes", unlike({{16, 4, 1}, {300, 4, 9}}, {1000, 1, 1},
                                            {{{}, {1000, 1, 1}}, {{3, 0, 0}, {600, 1, 1}}}) +
                                         unlike({{4, 16, 1}}, {1, 1000, 1}, {{{}, {1, 1000, 1}}}) +
                                         unlike({{4, 3, 16}}, {1, 1, 1000}, {{{}, {1, 1, 1000}}}));
    row("noise size 131 x 7 x 3",
        unlike({{4, 4, 2}, {60, 7, 3}}, {131, 7, 3}, {{{}, {131, 7, 3}}}));
    row("noise size 512 x 512 x 64", unlike({{8, 8, 8}, {100, 64, 16}}, {512, 512, 64},
                                            {{{505, 500, 55}, {7, 12, 9}},
                                             {{0, 17, 3}, {512, 2, 1}},
                                             {{100, 0, 63}, {3, 300, 1}}}));
}

TEST(NoiseHardCase, NoiseBoxesEqualTheWhole) {
    const std::array<int, 3> size = {67, 41, 23};
    std::int64_t count = 0;
    int boxes = 0;
    for (const config::Noise& noise : test::noises_of_all_kinds({{5, 4, 3}, {13, 16, 23}})) {
        const NoisePlan plan = make_noise_plan(noise, size);
        const NoiseField field(plan);
        const test::Planes whole = test::whole(plan);
        for (int i = 0; i < 200; ++i, ++boxes) {
            VoxelBox box;
            const auto a = low_discrepancy_point(2 * i);
            const auto b = low_discrepancy_point(2 * i + 1);
            for (std::size_t k = 0; k < 3; ++k) {
                box.origin[k] = static_cast<int>(a[k] * size[k]);
                box.size[k] = 1 + static_cast<int>(b[k] * (size[k] - box.origin[k]));
            }
            const test::Planes part =
                test::filled_with_canaries(field, box, plan.output_channels());
            test::Planes wanted(part.size());
            testing::for_each_voxel(box.size, [&](int x, int y, int z) {
                const int row = (box.origin[2] + z) * size[1] + box.origin[1] + y;
                const auto at = static_cast<std::size_t>(row * size[0] + box.origin[0] + x);
                for (std::size_t c = 0; c < part.size(); ++c) wanted[c].push_back(whole[c][at]);
            });
            test::Mismatches mismatches;
            mismatches.compare(part, wanted, box, "box");
            EXPECT_EQ(mismatches.count, 0) << mismatches.first;
            count += mismatches.count;
        }
    }
    hold(fmt::format("noise, {} boxes at any origin", boxes),
         "the whole volume's voxels, bits unlike", static_cast<double>(count), 0);
}

// --- Lattices and volumes of more than 2^32 -----------------------------------------------------

TEST(NoiseHardCase, NoiseLastVoxels) {
    // 10^9 cells of about a voxel, in the last corner of 8 GiB; and axes of 16384 voxels, one of
    // them of 2^20 cells.
    row("noise 1024^3, 10^9 cells, last voxels",
        unlike({{1000, 1000, 1000}, {1024, 1023, 1021}}, {1024, 1024, 1024},
               {{{1015, 1016, 1014}, {9, 8, 10}},
                {{1020, 1020, 1020}, {4, 4, 4}},
                {{0, 1023, 1023}, {1024, 1, 1}}}));
    row("noise 16384^3, last voxels",
        unlike({{16384, 100, 1}, {3000, 16000, 16383}}, {16384, 16384, 16384},
               {{{16373, 16376, 16377}, {11, 8, 7}}, {{16380, 16380, 16380}, {4, 4, 4}}}));
    row("noise 16384 voxels of 2^20 cells, last voxels",
        unlike({{1 << 20, 1000, 1000}, {1000, 1 << 20, 1 << 20}}, {16384, 1024, 1024},
               {{{16373, 1016, 1015}, {11, 8, 9}}, {{16380, 1020, 1020}, {4, 4, 4}}}));
    // And the last voxel is where the reference has it.
    for (const config::Noise& noise : test::noises_of_all_kinds({{1 << 20, 1000, 16384}})) {
        const NoisePlan plan = make_noise_plan(noise, {16384, 1024, 16384});
        const Voxel last = {16383, 1023, 16383};
        EXPECT_LE(test::error_share(noise, plan, last), 1);
    }
}

using PointBits = std::array<std::uint32_t, 3>;

// The 72 bits of a cell's point.
PointBits point_bits(std::uint64_t key, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const CellPoint point = cell_point(row_key(key, y, z), x);
    return {static_cast<std::uint32_t>(point.x * 0x1p24f),
            static_cast<std::uint32_t>(point.y * 0x1p24f),
            static_cast<std::uint32_t>(point.z * 0x1p24f)};
}

// Points of cells of large lattices, in places where linear or 32-bit indices would meet: were one
// lost, two would have equal points.
TEST(NoiseHardCase, NoiseLatticesWithoutLoss) {
    const auto repeats = [](std::vector<PointBits> points) {
        std::sort(points.begin(), points.end());
        std::int64_t count = 0;
        for (std::size_t i = 1; i < points.size(); ++i) count += points[i] == points[i - 1] ? 1 : 0;
        return static_cast<double>(count);
    };
    // 2048^3 cells: linear indices of these differ by multiples of 2^32, 1024 planes.
    const std::uint64_t key = octave_key(7, 0, Purpose::cells, {2048, 2048, 2048});
    std::vector<PointBits> points;
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const std::uint32_t x = i % 2048;
        const std::uint32_t y = i / 2048 * 41 % 2048;
        const std::uint32_t z = i * 7 % 1024;
        points.push_back(point_bits(key, x, y, z));
        points.push_back(point_bits(key, x, y, z + 1024));
    }
    hold("noise lattice of 2048^3 cells", "2^32 cells apart, equal points of 200 000",
         repeats(points), 0);
    // 2^20 x 1000 x 1 cells: all of some rows, a row after the other.
    const std::uint64_t wide = octave_key(7, 0, Purpose::cells, {1 << 20, 1000, 1});
    points.clear();
    for (const std::uint32_t y : {0u, 1u, 2u, 999u}) {
        for (std::uint32_t x = 0; x < 1u << 18; ++x)
            points.push_back(point_bits(wide, 4 * x, y, 0));
    }
    hold("noise lattice of 2^20 x 1000 cells", "rows, equal points of 2^20", repeats(points), 0);
    // Corners of 2^20 cubed, whose linear indices differ by more than 2^32 or 2^53.
    const std::uint64_t cube = octave_key(7, 0, Purpose::cells, {1 << 20, 1 << 20, 1 << 20});
    points.clear();
    const std::vector<std::uint32_t> ends = {0, 1, 2, 4095, 4096, 65535, 65536, 1048574, 1048575};
    for (const std::uint32_t z : ends) {
        for (const std::uint32_t y : ends) {
            for (const std::uint32_t x : ends) points.push_back(point_bits(cube, x, y, z));
        }
    }
    hold("noise lattice of 10^18 cells", "its ends, equal points of 729", repeats(points), 0);
}

}  // namespace
}  // namespace skybake::noise

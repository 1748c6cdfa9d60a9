#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "bakers/field/certify.h"
#include "bakers/field/finish_volume.h"
#include "bakers/field/pixel_type.h"
#include "bakers/field/survey_volume.h"
#include "tests/field/looked_up.h"
#include "tests/support/volumes.h"

namespace skybake {

namespace {

using namespace testing;
using Point = std::array<double, 3>;

// The level of a volume whose statistics are known.
Level level_of(const std::array<int, 3>& size, int channels, PixelType type,
               FunctionVoxels::Function function) {
    Baked volume = plain_volume(size, channels, type, std::move(function));
    const std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(channels), {0, 1});
    EXPECT_TRUE(survey_level(volume, 0, ranges, {}).empty());
    return volume.levels[0];
}

TEST(CertifyVolume, ConstantsAreExact) {
    for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
        const float value = round_to_pixel_type(0.4, type);
        const Level level = level_of({7, 5, 1}, 1, type, [=](int, int, int, int) { return value; });
        const auto reference = [=](const Point&) { return std::vector<double>{double{value}}; };
        EXPECT_LT(measure_lookups(level, type, reference, 200, {}).figures.max, 1e-15);
        EXPECT_EQ(measure_voxels(level, type, reference, 200, {}).points, 200);
        EXPECT_LT(measure_voxels(level, type, reference, 200, {}).figures.max, 1e-15);
        // Without a range, the difference itself.
        const auto other = [=](const Point&) { return std::vector<double>{double{value} + 0.25}; };
        EXPECT_NEAR(measure_lookups(level, type, other, 50, {}).figures.max, 0.25, 1e-12);
        EXPECT_NEAR(measure_lookups(level, type, other, 50, {}).figures.rms, 0.25, 1e-12);
    }
}

// A bump a t (1 - t) between voxels along x, and nothing at them, is what a trilinear lookup
// misses: a / 4 at most, sqrt(1/30) a of root mean square.
TEST(CertifyVolume, FindsAKnownErrorBetweenVoxels) {
    const std::array<int, 3> size = {8, 6, 4};
    const Level level = level_of(size, 1, PixelType::float32, sample_voxel);
    const double range = level.statistics[0].max - level.statistics[0].min;
    const double a = 0.01;
    const auto reference = [&](const Point& uvw) {
        const double position = uvw[0] * size[0] - 0.5;
        const double t = position - std::floor(position);
        return std::vector<double>{looked_up(sample_voxel, size, PixelType::float32, 0, uvw) +
                                   a * t * (1 - t)};
    };
    const VolumeErrors errors = measure_lookups(level, PixelType::float32, reference, 2000, {});
    EXPECT_EQ(errors.points, 2000);
    EXPECT_NEAR(errors.figures.max, a / 4 / range, 1e-6);
    EXPECT_NEAR(errors.figures.rms, a / std::sqrt(30.0) / range, 0.01 * a / range);
    // The worst is in the middle between two voxels.
    const double position = errors.worst[0] * size[0] - 0.5;
    EXPECT_NEAR(position - std::floor(position), 0.5, 0.01);
    // At voxels there is none of it.
    EXPECT_LT(measure_voxels(level, PixelType::float32, reference, 192, {}).figures.max, 1e-12);
}

// A ball in the middle, at a seam or at a clamped end, with an error where a lookup in an empty voxel takes some of
// it: these places are counted. Points that are spread evenly meet two of them.
TEST(CertifyVolume, KnowsTheErrorsOfSparseVolumes) {
    constexpr int n = 32;
    for (const int middle : {14, 0, n - 1}) {
        const auto ball = [=](int x, int y, int z, int) {
            const int across = std::min(std::abs(x - middle), n - std::abs(x - middle));
            const int apart = across * across + (y - 9) * (y - 9) + (z - middle) * (z - middle);
            return apart < 3 ? 1.0F / static_cast<float>(1 + apart) : 0.0F;
        };
        Level level = level_of({n, n, n}, 1, PixelType::half, ball);
        level.repeats[2] = false;
        const auto is_wrong = [&](const Point& uvw) {
            const auto voxel = [&](std::size_t axis) { return static_cast<int>(uvw[axis] * n); };
            return look_up(level, PixelType::half, uvw)[0] > 0 &&
                   ball(voxel(0), voxel(1), voxel(2), 0) == 0;
        };
        // The eight parts of a voxel are right or wrong as a whole.
        int wrong = 0;
        for (int i = 0; i < 8 * n * n * n; ++i) {
            const auto part = [](int k) { return (k % (2 * n) + 0.5) / (2 * n); };
            wrong += is_wrong({part(i), part(i / (2 * n)), part(i / (4 * n * n))}) ? 1 : 0;
        }
        const double rms = 0.1 * std::sqrt(wrong / (8.0 * n * n * n));
        const auto reference = [&](const Point& uvw) {
            return std::vector<double>{look_up(level, PixelType::half, uvw)[0] +
                                       (is_wrong(uvw) ? 0.1 : 0)};
        };
        const ErrorFigures found =
            measure_lookups(level, PixelType::half, reference, 1024, {}).figures;
        EXPECT_NEAR(found.rms, rms, 0.1 * rms) << middle;
        EXPECT_NEAR(found.max, 0.1, 1e-6) << middle;
    }
}

TEST(CertifyVolume, CountsRoundingAtVoxels) {
    const std::array<int, 3> size = {16, 16, 16};
    for (const PixelType type : {PixelType::half, PixelType::unorm8, PixelType::unorm16}) {
        const Level level = level_of(size, 3, type, sample_voxel);
        const auto exact = [&](const Point& uvw) {
            std::vector<double> values;
            for (int c = 0; c < 3; ++c) {
                values.push_back(double{sample_voxel(static_cast<int>(uvw[0] * 16),
                                                     static_cast<int>(uvw[1] * 16),
                                                     static_cast<int>(uvw[2] * 16), c)});
            }
            return values;
        };
        const double range = level.statistics[0].max - level.statistics[0].min;
        const VolumeErrors errors = measure_voxels(level, type, exact, 3000, {});
        // Half a step at values near 1: 2^-12 of halves.
        const double half_step = type == PixelType::half ? 0x1p-12 : rounding_error(type);
        EXPECT_LE(errors.figures.max, half_step / range * 1.01);
        EXPECT_GE(errors.figures.max, half_step * 0.98);
        EXPECT_LT(errors.figures.rms, errors.figures.max);
    }
}

// Channels of ranges 1, 100 and 0.001, one of which is off by 3 % of its range.
TEST(CertifyVolume, EachChannelIsMeasuredByItsOwnRange) {
    const std::array<int, 3> size = {6, 5, 4};
    const auto scaled = [](int x, int y, int z, int c) {
        constexpr std::array<float, 3> kScale = {1, 100, 1e-3F};
        return kScale[static_cast<std::size_t>(c)] * sample_voxel(x, y, z, c);
    };
    const Level level = level_of(size, 3, PixelType::float32, scaled);
    for (std::size_t off = 0; off < 3; ++off) {
        const ValueStatistics& s = level.statistics[off];
        const auto reference = [&](const Point& uvw) {
            std::vector<double> values;
            for (int c = 0; c < 3; ++c) {
                values.push_back(looked_up(scaled, size, PixelType::float32, c, uvw));
            }
            values[off] += 0.03 * (s.max - s.min);
            return values;
        };
        for (const auto& measure : {measure_lookups, measure_voxels}) {
            const ErrorFigures errors =
                measure(level, PixelType::float32, reference, 100, {}, {}).figures;
            EXPECT_NEAR(errors.max, 0.03, 1e-6) << off;
            EXPECT_NEAR(errors.rms, 0.03 / std::sqrt(3.0), 1e-6) << off;
        }
    }
}

// The reference is asked in the middle of an axis of one voxel, and all over other axes.
TEST(CertifyVolume, FlatAxesAreMeasuredInTheirMiddle) {
    for (std::size_t flat = 0; flat < 3; ++flat) {
        std::array<int, 3> size = {5, 6, 7};
        size[flat] = 1;
        const Level level = level_of(size, 1, PixelType::float32, sample_voxel);
        const auto reference = [&](const Point& uvw) {
            return std::vector<double>{
                looked_up(sample_voxel, size, PixelType::float32, 0, uvw) +
                (std::fabs(uvw[flat] - 0.5) + (uvw[(flat + 1) % 3] > 0.9 ? 0.5 : 0))};
        };
        const VolumeErrors errors =
            measure_lookups(level, PixelType::float32, reference, 300, {.threads = 1});
        const double range = level.statistics[0].max - level.statistics[0].min;
        EXPECT_NEAR(errors.figures.max, 0.5 / range, 1e-6);
        EXPECT_EQ(errors.worst[flat], 0.5);
        EXPECT_GT(errors.worst[(flat + 1) % 3], 0.9);
        EXPECT_NEAR(errors.figures.rms, 0.5 / range * std::sqrt(0.1), 0.01 / range);
    }
}

TEST(CertifyVolume, NamesTheWorstPlaceAndAsksInTextureCoordinates) {
    const std::array<int, 3> size = {5, 7, 9};
    const Level level = level_of(size, 3, PixelType::half, sample_voxel);
    const auto reference = [](const Point& uvw) {
        return std::vector<double>{uvw[0] + uvw[1] * uvw[2], uvw[2], uvw[0]};
    };
    const VolumeErrors errors =
        measure_lookups(level, PixelType::half, reference, 500, {.threads = 2});
    double worst = 0;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        const double range = level.statistics[channel].max - level.statistics[channel].min;
        const double found = looked_up(sample_voxel, size, PixelType::half, c, errors.worst);
        worst = std::max(worst, std::fabs(found - reference(errors.worst)[channel]) / range);
    }
    EXPECT_NEAR(errors.figures.max, worst, 1e-12);
    const VolumeErrors again =
        measure_lookups(level, PixelType::half, reference, 500, {.threads = 1});
    EXPECT_EQ(again.figures.max, errors.figures.max);
    EXPECT_EQ(again.figures.rms, errors.figures.rms);
    EXPECT_EQ(again.worst, errors.worst);
}

// Errors of a third of their noise, as paths of light would measure them, with noise of every size.
TEST(ErrorStatistics, TakeOffTheNoiseOfTheReference) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    ErrorStatistics with_noise, plain, only_noise;
    for (int i = 0; i < 20000; ++i) {
        const double noise = 0.01 * (1 + i % 5);
        const double error = noise / 3 * normal(random);
        plain.add(error);
        with_noise.add(error + noise * normal(random), noise);
        only_noise.add(noise * normal(random), noise);
    }
    EXPECT_NEAR(with_noise.figures().rms, plain.figures().rms, 0.1 * plain.figures().rms);
    EXPECT_LT(with_noise.figures().max, 0.2);
    // The sum of 20000 squares is known to sqrt(2 / 20000), so that less than a tenth of the noise is unseen.
    EXPECT_GT(only_noise.figures().rms, 0.001);
    EXPECT_LT(only_noise.figures().rms, 0.01);
    with_noise.add(std::nan(""), 0.01);
    EXPECT_TRUE(std::isnan(with_noise.figures().max));
    EXPECT_TRUE(std::isnan(with_noise.figures().rms));
}

using UnitPlace = std::array<double, 3>;

// A level that has been surveyed and has its probes.
Level probed(const std::array<int, 3>& size, int channels, PixelType type,
             FunctionVoxels::Function function, bool nearest = false, int threads = 1) {
    Baked volume = plain_volume(size, channels, type, std::move(function));
    const std::vector<std::array<double, 2>> ranges(static_cast<std::size_t>(channels), {0, 1});
    BakeOptions options;
    options.threads = threads;
    EXPECT_TRUE(survey_level(volume, 0, ranges, options).empty());
    Level& level = volume.levels[0];
    level.nearest = nearest;
    EXPECT_FALSE(add_volume_probes("shape", 3, {}, type, options, level).has_value());
    return level;
}

bool catches(const Level& level, const std::string& fault) {
    return std::find(level.catches.begin(), level.catches.end(), fault) != level.catches.end();
}

TEST(VolumeProbes, AreTheStoredVoxelsLookedUpDirectly) {
    for (const std::array<int, 3>& size :
         {std::array<int, 3>{8, 6, 10}, {1, 1, 1}, {3, 1, 2}, {16, 16, 16}}) {
        for (const PixelType type : {PixelType::float32, PixelType::half, PixelType::unorm8}) {
            const Level level = probed(size, 3, type, sample_voxel);
            EXPECT_GE(level.probes.size(), 16u);
            for (const Probe& probe : level.probes) {
                ASSERT_EQ(probe.value.size(), 3u);
                ASSERT_EQ(probe.tolerance.size(), 3u);
                ASSERT_EQ(probe.at.size(), 3u);
                for (const double u : probe.uvw) EXPECT_TRUE(u >= 0 && u <= 1) << u;
                for (std::size_t c = 0; c < 3; ++c) {
                    EXPECT_GT(probe.tolerance[c], 0);
                    EXPECT_NEAR(probe.value[c],
                                looked_up(sample_voxel, size, type, static_cast<int>(c), probe.uvw),
                                1e-12);
                }
            }
        }
    }
}

// A runtime that gets an axis backwards, swaps two, is half a voxel off or clamps at the seam must
// fail: on each axis some probes are apart from what it finds by more than they tolerate.
TEST(VolumeProbes, CatchWrongLookups) {
    const std::array<int, 3> size = {16, 16, 16};
    const Level level = probed(size, 1, PixelType::half, sample_voxel);
    const auto caught = [&](const auto& change) {
        int count = 0;
        for (const Probe& probe : level.probes) {
            const double found =
                looked_up(sample_voxel, size, PixelType::half, 0, change(probe.uvw));
            count += std::fabs(found - probe.value[0]) > probe.tolerance[0] ? 1 : 0;
        }
        return count;
    };
    EXPECT_EQ(caught([](const UnitPlace& p) { return p; }), 0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto moved = [axis](UnitPlace p, double by) {
            p[axis] += by;
            return p;
        };
        EXPECT_GE(caught([&](UnitPlace p) {
                      p[axis] = 1 - p[axis];
                      return p;
                  }),
                  8);
        EXPECT_GE(caught([&](const UnitPlace& p) { return moved(p, 0.5 / 16); }), 8);
        EXPECT_GE(caught([&](UnitPlace p) {
                      std::swap(p[axis], p[(axis + 1) % 3]);
                      return p;
                  }),
                  8);
        EXPECT_GE(caught([&](UnitPlace p) {  // clamped
                      p[axis] = std::min(std::max(p[axis], 0.5 / 16), 15.5 / 16);
                      return p;
                  }),
                  3);
        // Filtering in steps of 1/256 voxel, rounded either way, passes.
        EXPECT_EQ(caught([&](UnitPlace p) {
                      for (std::size_t k = 0; k < 3; ++k) {
                          p[k] = std::floor(p[k] * 16 * 256 + (k == axis ? 0.9 : 0)) / (16 * 256);
                      }
                      return p;
                  }),
                  0);
    }
    for (const char* fault :
         {"zeros", "flip_u", "flip_v", "flip_w", "swap_uv", "swap_uw", "swap_vw", "shift_u",
          "shift_v", "shift_w", "wrap_u", "wrap_v", "wrap_w", "filter"}) {
        EXPECT_TRUE(catches(level, fault)) << fault;
    }
}

// A blob of a few voxels in a quarter of a million: that it is empty elsewhere proves nothing.
TEST(VolumeProbes, LieWhereSparseVolumesAreNotEmpty) {
    const auto blob = [](int x, int y, int z, int) {
        const int apart = std::max({std::abs(x - 41), std::abs(y - 9), std::abs(z - 50)});
        return apart < 2 ? 1.0F - 0.25F * static_cast<float>(apart) : 0.0F;
    };
    const Level level = probed({64, 64, 64}, 1, PixelType::half, blob);
    int within = 0;
    for (const Probe& probe : level.probes) {
        within += probe.value[0] > 16 * probe.tolerance[0] ? 1 : 0;
    }
    EXPECT_GE(within, 12);
    for (const char* fault : {"zeros", "flip_u", "flip_v", "flip_w", "swap_uv", "swap_uw",
                              "swap_vw", "shift_u", "shift_v", "shift_w", "filter"}) {
        EXPECT_TRUE(catches(level, fault)) << fault;
    }
}

TEST(VolumeProbes, OfNearestVoxelsTellLinearLookups) {
    const auto cell = [](int x, int y, int z, int) { return (x * y + z) % 3 == 0 ? 1.0F : 0.0F; };
    const Level level = probed({8, 8, 4}, 1, PixelType::unorm8, cell, true);
    for (const Probe& probe : level.probes) {
        EXPECT_TRUE(probe.value[0] == 0 || probe.value[0] == 1) << probe.value[0];
    }
    EXPECT_TRUE(catches(level, "filter"));
    EXPECT_TRUE(catches(level, "flip_u"));
    EXPECT_TRUE(catches(level, "shift_w"));
}

// A fault that changes no lookup cannot be caught, and is not said to be.
TEST(VolumeProbes, LeaveOutFaultsThatChangeNothing) {
    const Level constant =
        probed({8, 8, 8}, 1, PixelType::half, [](int, int, int, int) { return 0.5F; });
    EXPECT_EQ(constant.catches, std::vector<std::string>{"zeros"});
    const Level empty =
        probed({8, 8, 8}, 1, PixelType::half, [](int, int, int, int) { return 0.0F; });
    EXPECT_TRUE(empty.catches.empty());
    EXPECT_GE(empty.probes.size(), 16u);
    // The same backwards along x.
    const Level mirrored = probed({8, 8, 8}, 1, PixelType::half, [](int x, int y, int z, int) {
        return sample_voxel(std::min(x, 7 - x), y, z, 0);
    });
    EXPECT_FALSE(catches(mirrored, "flip_u"));
    EXPECT_TRUE(catches(mirrored, "flip_v"));
    EXPECT_TRUE(catches(mirrored, "shift_u"));
    EXPECT_TRUE(catches(mirrored, "swap_uv"));
    // The same with x and y exchanged.
    const Level square = probed({8, 8, 8}, 1, PixelType::half, [](int x, int y, int z, int) {
        return sample_voxel(std::min(x, y), std::max(x, y), z, 0);
    });
    EXPECT_FALSE(catches(square, "swap_uv"));
    EXPECT_TRUE(catches(square, "swap_uw"));
    EXPECT_TRUE(catches(square, "flip_u"));
    // The same all along z.
    const Level column = probed({8, 8, 8}, 1, PixelType::half,
                                [](int x, int y, int, int) { return sample_voxel(x, y, 0, 0); });
    for (const char* fault : {"flip_w", "shift_w", "wrap_w"}) {
        EXPECT_FALSE(catches(column, fault)) << fault;
    }
    EXPECT_TRUE(catches(column, "swap_uw"));
}

TEST(VolumeProbes, AreTheSameForAnyNumberOfThreads) {
    const Level one = probed({16, 12, 9}, 3, PixelType::half, sample_voxel, false, 1);
    const Level two = probed({16, 12, 9}, 3, PixelType::half, sample_voxel, false, 2);
    ASSERT_EQ(one.probes.size(), two.probes.size());
    EXPECT_EQ(one.catches, two.catches);
    for (std::size_t i = 0; i < one.probes.size(); ++i) {
        EXPECT_EQ(one.probes[i].uvw, two.probes[i].uvw);
        EXPECT_EQ(one.probes[i].value, two.probes[i].value);
        EXPECT_EQ(one.probes[i].tolerance, two.probes[i].tolerance);
    }
}

}  // namespace

}  // namespace skybake

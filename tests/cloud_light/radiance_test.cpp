// The solved light of a layer: against paths of light, the furnace, and as recipes bake it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "bakers/assets/cloud_light/coarser_cells.h"
#include "bakers/assets/cloud_light/radiance_kernel.h"
#include "bakers/assets/cloud_light/radiance_levels.h"
#include "bakers/assets/cloud_light/radiance_solver.h"
#include "bakers/assets/cloud_light/radiance_volume.h"
#include "tests/cloud_light/layers.h"
#include "tests/support/volumes.h"

namespace skybake::cloud_light {
namespace {

BakeOptions on(int threads) { return {.threads = threads}; }

// A slab of a vertical optical depth, 48 voxels of 8 m high.
CloudLayer slab(double depth) { return test::layer_of({3, 2, 48}, 1, depth / (8 * 48)); }

// With an albedo of 1 in light from all around, each cell sends out the light that it takes in: J is 1 in
// all directions, whatever the cloud.
TEST(Radiance, IsThatOfAFurnace) {
    const CloudLayer layer = test::rough_layer({9, 6, 7}, 0.4);
    LayerSources sources;
    sources.sky = 1;
    sources.ground = 1;
    const SolvedRadiance solved =
        solve_radiance(layer, place_grid(layer.size, 1, false), scattering_of(droplet_phase(12), 1),
                       3, sources, on(2));
    for (std::size_t c = 0; c < 16; ++c) {
        const double wanted = c == 0 ? 2 * std::sqrt(std::numbers::pi) : 0;
        for (const float value : values_of(solved.scattered, c)) EXPECT_NEAR(value, wanted, 4e-3);
    }
}

// Sky and ground are each other's image.
TEST(Radiance, OfSkyAndGroundAddUpToTheFurnace) {
    const CloudLayer layer = test::rough_layer({8, 8, 6}, 0.6);
    const PlaceGrid places = place_grid(layer.size, 2, false);
    std::vector<float> sum(occupancy::count_of(places.count));
    for (const bool sky : {true, false}) {
        LayerSources sources;
        (sky ? sources.sky : sources.ground) = 1;
        const SolvedRadiance solved =
            solve_radiance(layer, places, scattering_of(droplet_phase(12), 1), 1, sources, on(2));
        const std::vector<float> values = values_of(solved.scattered, 0);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            EXPECT_GT(values[i], 0);
            sum[i] += values[i];
        }
    }
    for (const float value : sum) EXPECT_NEAR(value, 2 * std::sqrt(std::numbers::pi), 1e-2);
}

CloudLightBake bake_of(CloudLightContents contents) {
    CloudLightBake bake;
    bake.contents = contents;
    bake.degree = 3;
    if (contents == CloudLightContents::sun_radiance) bake.sun_elevations = {{0.7}};
    return bake;
}

// The solution and paths of light in all directions, in the middle of a slab.
TEST(Radiance, IsThatOfPathsOfLight) {
    const CloudLayer layer = slab(6);
    const PlaceGrid places = place_grid(layer.size, 1, false);
    for (const auto contents :
         {CloudLightContents::sun_radiance, CloudLightContents::ground_radiance}) {
        const CloudLightBake bake = bake_of(contents);
        Facts details;
        const auto values = radiance_values(layer, places, bake, on(2), details);
        ASSERT_EQ(values.size(), 4U);
        const VolumeReference reference = radiance_reference(layer, bake, 2);
        const double most = *std::max_element(values[0].begin(), values[0].end());
        double squares = 0;
        for (const int z : {8, 24, 40}) {
            const std::vector<double> wanted =
                reference({0.5 / 3, 0.25, (z + 0.5) / layer.size[2]});
            const std::size_t i = occupancy::index_of(layer.size, 0, 0, z);
            for (std::size_t c = 0; c < 4; ++c) {
                const double error = (double{values[c][i]} - wanted[c]) / most;
                squares += error * error / 12;
            }
        }
        EXPECT_LT(std::sqrt(squares), 0.05) << static_cast<int>(contents);
    }
}

TEST(Radiance, HasTheSameBitsForAnyNumberOfThreads) {
    const CloudLayer layer = test::rough_layer({12, 10, 6}, 0.5);
    const PlaceGrid places = place_grid(layer.size, 2, false);
    Facts details;
    const CloudLightBake bake = bake_of(CloudLightContents::sun_radiance);
    EXPECT_EQ(radiance_values(layer, places, bake, on(1), details),
              radiance_values(layer, places, bake, on(3), details));
}

TEST(Radiance, OfHardCasesIsFinite) {
    CloudLayer opaque = test::rough_layer({7, 5, 6});
    opaque.optics.extinction_per_m = 1e4;
    CloudLayer wall = test::lone_cloud({12, 12, 12}, {2, 3, 4}, {9, 10, 11});
    wall.optics.extinction_per_m = 1e9;
    CloudLayer edge = test::rough_layer({6, 6, 6});
    test::add_edge(0.3, 0.1, edge);
    const std::vector<CloudLayer> layers = {test::layer_of({4, 4, 4}, 0),
                                            test::layer_of({1, 1, 1}, 0.5F), opaque, wall, edge};
    for (const CloudLayer& layer : layers) {
        for (const auto contents :
             {CloudLightContents::sun_radiance, CloudLightContents::sky_radiance}) {
            Facts details;
            const auto values = radiance_values(layer, place_grid(layer.size, 2, false),
                                                bake_of(contents), on(2), details);
            for (const float value : values[0]) {
                EXPECT_TRUE(std::isfinite(value));
                EXPECT_GE(value, 0);
            }
        }
    }
}

TEST(ScaledScattering, HasTheMomentsOfTheWholeBelowItsPeak) {
    const CloudScattering droplets = scattering_of(droplet_phase(12), 0.9);
    const std::vector<double> moments = moments_of(droplets, 4);
    EXPECT_NEAR(moments[0], 1, 1e-12);
    const ScaledScattering rest = scaled(droplets, 3);
    for (std::size_t l = 0; l < 4; ++l) {
        // Light that is scattered into the peak goes on: s (1 - w' chi'_l) = 1 - w chi_l.
        EXPECT_NEAR(rest.extinction_share * (1 - rest.returned[l]), 1 - 0.9 * moments[l], 1e-12);
    }
}

// One cell shines in the middle of nothing. Around it light goes away from it.
TEST(RadianceSweep, CarriesLightAwayFromWhatSendsItOut) {
    const std::array<int, 3> size = {9, 9, 9};
    LayerCells cells{CellFields(size, 1), {10, 12, 8}};
    cells.extinction.row(0, 4, 4)[4] = 1;
    CellFields sources(size, 4);
    sources.row(0, 4, 4)[4] = 1;
    const RadianceSweep sweep(cells, 1, 2);
    CellFields light(size, 4);
    sweep.find_radiance(sources, {}, light, on(2));
    constexpr std::array<std::size_t, 3> kAlong = {3, 1, 2};  // coefficients of x, y, z
    for (std::size_t a = 0; a < 3; ++a) {
        for (const int side : {-2, 2}) {
            std::array<int, 3> at = {4, 4, 4};
            at[a] += side;
            EXPECT_GT(light.row(0, at[2], at[1])[at[0]], 0) << a;
            EXPECT_GT(static_cast<float>(side) * light.row(kAlong[a], at[2], at[1])[at[0]], 0) << a;
        }
    }
    // Within the cell light is that which it sends out, for it is thick.
    EXPECT_NEAR(light.row(0, 4, 4)[4], 1, 0.2);
}

// Adds orders of scattering, one after the other, until one is nothing beside their sum.
CellFields sum_of_orders(const RadianceSweep& sweep, const std::vector<double>& returned,
                         const CellFields& first, const EnteringLight& entering) {
    CellFields sum(first.size(), first.count());
    CellFields order(first.size(), first.count());
    CellFields sent_out = first;
    EnteringLight light = entering;
    double largest = 1;
    double largest_of_sum = 0;
    while (largest > 1e-6 * largest_of_sum) {
        sweep.find_radiance(sent_out, light, order, on(1));
        light = {};  // it has entered
        largest = 0;
        for_each_plane(first, on(1), [&](int z) {
            for_each_row(first, [&](std::size_t c, int y) {
                for (int x = 0; x < first.size()[0]; ++x) {
                    const double value = returned[c == 0 ? 0 : 1] * order.row(c, z, y)[x];
                    sent_out.row(c, z, y)[x] = static_cast<float>(value);
                    sum.row(c, z, y)[x] += static_cast<float>(value);
                    largest = std::max(largest, std::fabs(value));
                    largest_of_sum = std::max(largest_of_sum, double{sum.row(c, z, y)[x]});
                }
            });
        });
    }
    return sum;
}

TEST(Radiance, IsTheSumOfAllOrders) {
    struct Case {
        const char* what;
        CloudLayer layer;
        double extinction_per_m;
    };
    const std::vector<Case> cases = {
        {"thin", test::rough_layer({20, 12, 10}, 0.3), 0.02},
        {"odd sizes", test::rough_layer({14, 11, 9}, 0.4), 0.1},
        {"thick", test::lone_cloud({16, 16, 12}, {3, 4, 2}, {12, 13, 10}), 0.2},
        {"a slab", test::layer_of({8, 12, 16}, 1), 0.05},
    };
    for (const Case& one : cases) {
        SCOPED_TRACE(one.what);
        LayerCells cells{CellFields(one.layer.size, 1), one.layer.voxel_m};
        CellFields first(one.layer.size, 4);
        for_each_plane(first, on(1), [&](int z) {
            testing::for_each_texel(first.size()[0], first.size()[1], [&](int x, int y) {
                cells.extinction.row(0, z, y)[x] =
                    static_cast<float>(one.extinction_per_m) * one.layer.value(x, y, z);
                first.row(0, z, y)[x] = static_cast<float>(z + 1);
            });
        });
        const std::vector<double> returned = {1, 0.7};
        const RadianceLevels levels(cells, returned, on(1));
        const ScatteredLight found = levels.solve(first, {0.5}, {1e-5}, on(1));
        EXPECT_LE(found.sweeps, 12);
        const std::vector<float> light = values_of(found.light, 0);
        const std::vector<float> sums =
            values_of(sum_of_orders(levels.sweep(), returned, first, {0.5}), 0);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            ASSERT_NEAR(light[i], sums[i], 2e-3 * sums[i]) << i;
        }
    }
}

// Light that enters evenly from all sides is even within, where nothing is absorbed: a furnace. Gaps between thick
// cells let it in, which coarser cells do not have.
TEST(Radiance, OfGapsBetweenThickCellsIsThatOfAFurnace) {
    const std::array<int, 3> size = {60, 60, 34};
    const CloudLayer gaps = test::rough_layer(size, 0.6);
    CloudLayer lone = gaps;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        if (std::max({std::abs(2 * x - 60), std::abs(2 * y - 60), std::abs(2 * z - 34)}) > 24) {
            lone.values[occupancy::index_of(size, x, y, z)] = 0;
        }
    });
    for (const CloudLayer& layer : {gaps, lone}) {
        for (const double depth : {5.0, 50.0, 500.0}) {
            LayerCells cells{CellFields(size, 1), {10, 10, 10}};
            testing::for_each_voxel(size, [&](int x, int y, int z) {
                cells.extinction.row(0, z, y)[x] =
                    static_cast<float>(depth / 10) * layer.value(x, y, z);
            });
            const RadianceLevels levels(cells, {1, 0.7}, on(2));
            const ScatteredLight found = levels.solve(CellFields(size, 4), {1, 1}, {1e-5}, on(2));
            EXPECT_LE(found.sweeps, 25) << depth;
            const double even = std::sqrt(4 * std::numbers::pi);
            double worst = 0;
            for (const float value : values_of(found.light, 0)) {
                worst = std::max(worst, std::fabs(value - even) / even);
            }
            // Light of a thick cell leaves it so slowly that a change of 1e-5 stands for a depth's share of error.
            EXPECT_LT(worst, 1e-3 + 1e-5 * depth) << depth;
        }
    }
}

// Light that is even stays so, and cells send out as much together as apart.
TEST(CoarserCells, SendOutWhatTheyTake) {
    const std::array<int, 3> size = {15, 14, 11};
    const CellFactors factors = coarser_factors(size);
    EXPECT_EQ(factors, (CellFactors{3, 2, 2}));
    EXPECT_EQ(coarser_factors({7, 2, 1}), kSameCells);
    const CloudLayer layer = test::rough_layer(size, 0.7);
    LayerCells cells{CellFields(size, 1), {10, 10, 10}};
    CellFields light(size, 1);
    double sent_out = 0;
    testing::for_each_voxel(size, [&](int x, int y, int z) {
        cells.extinction.row(0, z, y)[x] = layer.value(x, y, z);
        light.row(0, z, y)[x] = static_cast<float>(x + 2 * y + 3 * z);
        sent_out += double{layer.value(x, y, z)} * light.row(0, z, y)[x];
    });
    const LayerCells coarser = coarser_cells(cells, factors);
    EXPECT_EQ(coarser.extinction.size(), (std::array<int, 3>{5, 7, 6}));
    EXPECT_EQ(coarser.edge_m, (std::array<double, 3>{30, 20, 20}));
    const CellFields mean = mean_light(light, cells.extinction, factors, on(2));
    double together = 0;
    testing::for_each_voxel({5, 7, 6}, [&](int x, int y, int z) {
        together += 12 * double{coarser.extinction.row(0, z, y)[x]} * mean.row(0, z, y)[x];
    });
    EXPECT_NEAR(together, sent_out, 1e-5 * sent_out);

    CellFields even({5, 7, 6}, 1);
    for (int z = 0; z < 6; ++z) {
        for (int y = 0; y < 7; ++y) std::fill_n(even.row(0, z, y), 5, static_cast<float>(z));
    }
    CellFields fine(size, 1);
    add_interpolated(even, factors, 2, fine, on(2));
    // Centres of coarser cells are at 1, 3, 5 ... finer ones.
    EXPECT_EQ(fine.row(0, 0, 3)[4], 0);
    EXPECT_EQ(fine.row(0, 1, 13)[14], 2 * 0.25F);
    EXPECT_EQ(fine.row(0, 2, 0)[0], 2 * 0.75F);
    EXPECT_EQ(fine.row(0, 10, 5)[7], 2 * 4.75F);
}

TEST(RadianceKernel, PairsOfDirectionsHaveTheHarmonicsOfBoth) {
    constexpr std::size_t kCount = 21;
    for (const std::size_t coefficients : {1U, 4U, 9U, 16U}) {
        std::vector<std::vector<float>> rows;
        CoefficientRows<const float> of{};
        for (std::size_t c = 0; c < coefficients; ++c) {
            rows.emplace_back();
            for (std::size_t i = 0; i < kCount + kRowSlack; ++i) {
                rows[c].push_back(static_cast<float>((i * 5 + c * 3) % 13) / 13);
            }
            of[c] = rows[c].data();
        }
        const glm::dvec3 one = glm::normalize(glm::dvec3(0.4, -0.7, 0.3));
        const std::array<Harmonics, 2> values = {harmonics(one),
                                                 harmonics({-one.x, -one.y, one.z})};
        PairHarmonics pair{{}, coefficients};
        for (std::size_t c = 0; c < coefficients; ++c) {
            pair.values[c] = static_cast<float>(values[0][c]);
        }
        std::vector<float> first(kCount + kRowSlack), second(kCount + kRowSlack);
        send_out(pair, of, kCount, first.data(), second.data());
        std::vector<std::vector<float>> sums(coefficients,
                                             std::vector<float>(kCount + kRowSlack, 1));
        CoefficientRows<float> into{};
        for (std::size_t c = 0; c < coefficients; ++c) into[c] = sums[c].data();
        const std::array<PairLight, 2> pairs = {PairLight{pair, first.data(), second.data()},
                                                PairLight{pair, rows[0].data(), first.data()}};
        gather(pairs, kCount, into);
        for (std::size_t i = 0; i < kCount; ++i) {
            double a = 0;
            double b = 0;
            for (std::size_t c = 0; c < coefficients; ++c) {
                a += values[0][c] * double{rows[c][i]};
                b += values[1][c] * double{rows[c][i]};
            }
            ASSERT_NEAR(first[i], a, 1e-5);
            ASSERT_NEAR(second[i], b, 1e-5);
            for (std::size_t c = 0; c < coefficients; ++c) {
                const double wanted =
                    1 + values[0][c] * (a + double{rows[0][i]}) + values[1][c] * (b + a);
                ASSERT_NEAR(sums[c][i], wanted, 2e-5) << c;
            }
        }
    }
}

TEST(RadianceKernel, StepsAsTheFormulaSays) {
    constexpr std::size_t kCount = 21;
    std::array<std::vector<float>, 9> rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        for (std::size_t i = 0; i < kCount + kRowSlack; ++i) {
            rows[k].push_back(static_cast<float>((i * 7 + k * 5) % 11) / 11);
        }
    }
    const std::vector<float> before = rows[8];
    RowStep step{{rows[0].data(), rows[1].data(), rows[2].data(), rows[3].data()},
                 {0.1F, 0.2F, 0.3F, 0.4F},
                 rows[4].data(),
                 rows[5].data(),
                 rows[6].data(),
                 0.5F};
    step_row(step, kCount, rows[7].data(), rows[8].data());
    for (std::size_t i = 0; i < kCount; ++i) {
        float light = 0;
        for (std::size_t k = 0; k < 4; ++k) light = light + step.share[k] * rows[k][i];
        const float excess = light - rows[6][i];
        EXPECT_EQ(rows[7][i], rows[6][i] + excess * rows[4][i]) << i;
        EXPECT_EQ(rows[8][i], before[i] + 0.5F * (rows[6][i] + excess * rows[5][i])) << i;
    }
}

}  // namespace
}  // namespace skybake::cloud_light

#include "bakers/occupancy/marcher.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <string>

#include "bakers/assets/occupancy/occupancy_grid.h"
#include "bakers/assets/sources/source_volume.h"
#include "bakers/field/baked.h"
#include "bakers/occupancy/cell_range.h"
#include "bakers/occupancy/leap_distance.h"
#include "bakers/occupancy/occupied_cells.h"
#include "config/assets/occupancy_filter.h"
#include "config/recipe/recipe.h"
#include "tests/occupancy/distance_trial.h"
#include "tests/support/any_values.h"
#include "tests/support/number_rows.h"
#include "tests/support/volumes.h"

namespace skybake::occupancy {
namespace {

using test::any_number;
using test::Values;
using test::Volume;

struct Ray {
    std::array<double, 3> origin{};
    std::array<double, 3> direction{};
};

// What a march made of a ray.
struct Found {
    double sum = 0;
    MarchFetches fetches;
};

class Marcher {
  public:
    Marcher(const Volume& volume, float threshold, double edge_softness)
        : volume_(volume),
          threshold_(threshold),
          edge_softness_(edge_softness),
          cells_(occupied_cells(
              cell_ranges(volume.voxels.data(), volume.grid, config::OccupancyFilter::trilinear),
              threshold)),
          leaps_(leap_distance(cells_)) {}

    Found straight(const SampledRay& ray) const {
        Found found;
        for (int k = 0; k < ray.samples; ++k) found.sum += seen(ray.at(k));
        return found;
    }
    Found by(const std::vector<std::uint8_t>& leaps, const SampledRay& ray) const {
        Found found;
        const LeapCells cells{volume_.grid, leaps};
        found.fetches = march(ray, cells, [&](const Place& place) {
            const double value = seen(place);
            found.sum += value;
            return value > 0;
        });
        return found;
    }
    Found by_leaps(const SampledRay& ray) const { return by(leaps_, ray); }
    const OccupiedCells& cells() const { return cells_; }

  private:
    // What a runtime makes of a lookup where the threshold is applied after filtering.
    double seen(const Place& place) const {
        const auto value =
            static_cast<float>(test::lookup(volume_, config::OccupancyFilter::trilinear, place));
        if (!(value > threshold_)) return 0;
        if (edge_softness_ == 0) return double{value};
        const double x = std::min((double{value} - double{threshold_}) / edge_softness_, 1.0);
        return double{value} * (x * x * (3 - 2 * x));
    }

    const Volume& volume_;
    float threshold_;
    double edge_softness_;
    OccupiedCells cells_;
    std::vector<std::uint8_t> leaps_;
};

// The samples of a ray in units of the tile's extent that are within the layer, up to a length.
SampledRay sampled(const Ray& ray, const std::array<double, 3>& extent, const Volume& volume,
                   double length, double step) {
    SampledRay samples;
    for (std::size_t a = 0; a < 3; ++a) {
        const double voxels = volume.grid.voxels[a] / extent[a];
        samples.from[a] = ray.origin[a] * voxels;
        samples.step[a] = ray.direction[a] * step * voxels;
    }
    const auto is_within = [&](int k) {
        const double height = samples.at(k)[2];
        return height >= 0 && height <= volume.grid.voxels[2];
    };
    const int count = static_cast<int>(length / step) + 1;
    int first = 0;
    while (first < count && !is_within(first)) ++first;
    int end = first;
    while (end < count && is_within(end)) ++end;
    samples.from = samples.at(first);
    samples.samples = end - first;
    return samples;
}

// A grid without leaps, from cell to cell.
std::vector<std::uint8_t> next_cells(const OccupiedCells& cells) {
    std::vector<std::uint8_t> leaps;
    for (const std::uint8_t occupied : cells.occupied) leaps.push_back(occupied == 0 ? 1 : 0);
    return leaps;
}

// Some along axes, some along faces of cells and through their corners.
Ray any_ray(const Volume& volume, const std::array<double, 3>& extent) {
    Ray ray;
    double norm = 0;
    while (norm == 0) {
        for (double& x : ray.direction) {
            x = *rc::gen::inRange(0, 4) == 0 ? *rc::gen::inRange(-1, 2) : any_number(-1, 1);
        }
        norm = std::hypot(ray.direction[0], ray.direction[1], ray.direction[2]);
    }
    for (double& x : ray.direction) x /= norm;
    for (std::size_t a = 0; a < 3; ++a) {
        const int voxels = volume.grid.voxels[a];
        const double place = *rc::gen::inRange(0, 3) == 0
                                 ? *rc::gen::inRange(0, voxels + 1) / static_cast<double>(voxels)
                                 : any_number(-0.2, 1.2);
        ray.origin[a] = place * extent[a];
    }
    return ray;
}

TEST(Marcher, SkipsNothingThatARaySees) {
    int skipped = 0;
    EXPECT_TRUE(rc::check([&] {
        Volume volume =
            test::any_volume(32, *rc::gen::element(Values::uniform, Values::sparse, Values::steps,
                                                   Values::denormals, Values::constant));
        // A cloud in one half of it, or voxels here and there.
        if (*rc::gen::arbitrary<bool>()) {
            std::fill(volume.voxels.begin(),
                      volume.voxels.begin() + static_cast<std::ptrdiff_t>(volume.voxels.size() / 2),
                      0.0F);
        }
        const bool has_edge = *rc::gen::arbitrary<bool>();
        const float threshold = has_edge ? *rc::gen::element(0.0F, 0.35F, 0.5F, 0.7F, 0.95F) : 0;
        const std::array<double, 3> extent = {any_number(1, 700), any_number(1, 700),
                                              any_number(1, 700)};
        const Marcher marcher(volume, threshold, has_edge ? *rc::gen::element(0.05, 1.0) : 0);
        for (int i = 0; i < 10; ++i) {
            const SampledRay ray = sampled(any_ray(volume, extent), extent, volume,
                                           any_number(0, 800), any_number(1, 20));
            const double sum = marcher.straight(ray).sum;
            const Found cells = marcher.by(next_cells(marcher.cells()), ray);
            const Found leaps = marcher.by_leaps(ray);
            RC_ASSERT(std::bit_cast<std::uint64_t>(cells.sum) == std::bit_cast<std::uint64_t>(sum));
            RC_ASSERT(std::bit_cast<std::uint64_t>(leaps.sum) == std::bit_cast<std::uint64_t>(sum));
            RC_ASSERT(leaps.fetches.densities <= ray.samples);
            RC_ASSERT(leaps.fetches.structure <= cells.fetches.structure);
            skipped += ray.samples - leaps.fetches.densities;
        }
    }));
    EXPECT_GT(skipped, 1000);
}

// Vertical rays of 32 samples, two for each voxel, past one voxel of cloud and through a slab. The grid
// is asked once for each box, and not where the sample before had cloud.
TEST(Marcher, AsksOncePerBoxAndNotWithinCloud) {
    const SampledRay ray{{5.5, 5.5, 0.25}, {0, 0, 0.5}, 32};
    Volume one = test::volume_of({{16, 16, 16}, 4});
    one.at(5, 5, 9) = 1;
    const Found voxel = Marcher(one, 0, 0).by_leaps(ray);
    EXPECT_EQ(voxel.fetches.structure, 3);  // the box of two cells, the voxel's cell, the one above
    EXPECT_EQ(voxel.fetches.densities, 8);
    Volume slab = test::volume_of({{16, 16, 16}, 4});
    for (int z = 4; z < 12; ++z) {
        for (int i = 0; i < 16 * 16; ++i) slab.at(i % 16, i / 16, z) = 1;
    }
    // Lookups are above 0 from 3.5 to 12.5, in all four cells.
    const Found within = Marcher(slab, 0, 0).by_leaps(ray);
    EXPECT_EQ(within.fetches.structure, 2);  // at the base, and at 13.25
    EXPECT_EQ(within.fetches.densities, 32);
}

// The rays that Olajos 2016 measures with, through his volume, whose rule loses thin parts.
TEST(Marcher, SkipsMoreThanTheRuleOfTheThesis) {
    const auto recipe = config::parse_recipe(
        "[noise.shape]\npreset = \"thesis\"\n[clouds.thesis]\npreset = \"thesis\"\n"
        "[bake.thesis]\nasset = \"cloud_volume\"\ncloud = \"thesis\"\nsize = [128, 128, 128]\n",
        "thesis");
    Facts facts;
    const auto held = hold_source_volume(recipe.value->parameters, "thesis", {}, facts);
    Volume volume = test::volume_of({{128, 128, 128}, 4});
    const std::size_t channel = channel_named(*held.value, "G");
    std::vector<float*> channels(held.value->channel_names.size(), nullptr);
    channels[channel] = volume.voxels.data();
    held.value->levels.front().voxels->fill({{}, volume.grid.voxels}, channels);
    const float threshold =
        filtered_threshold(config::cloud_named(recipe.value->parameters, "thesis"));
    const Marcher marcher(volume, threshold, 0.05);
    const OccupiedCells thesis = test::cells_of_thesis(volume, threshold);
    // 12.9 % and 18.7 % were measured elsewhere on noise of another seed.
    EXPECT_NEAR(occupied_share(marcher.cells()), 0.129, 0.01);
    EXPECT_NEAR(occupied_share(thesis), 0.187, 0.01);
    for (const std::string name : {"up", "within", "down"}) {
        double straight = 0;
        double of_thesis = 0;
        double leaps = 0;
        for (const auto& v : test::number_rows(SKYBAKE_TEST_DATA "/rays_" + name + ".csv")) {
            ASSERT_EQ(v.size(), 6U);
            const Ray ray = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
            const SampledRay samples = sampled(ray, {600, 600, 600}, volume, 500, 1);
            const Found found = marcher.by_leaps(samples);
            EXPECT_EQ(found.sum, marcher.straight(samples).sum);
            straight += samples.samples;
            of_thesis += marcher.by(next_cells(thesis), samples).fetches.all();
            leaps += found.fetches.all();
        }
        fmt::print("{}: {:.2f} by leaps, {:.2f} by the rule of the thesis\n", name,
                   straight / leaps, straight / of_thesis);
        EXPECT_LT(leaps, of_thesis) << name;
        EXPECT_LT(2.4 * leaps, straight) << name << ": 2.4 is what the thesis gained";
    }
}

constexpr std::array<int, 3> kVoxels = {48, 32, 24};
constexpr std::array<double, 3> kVoxel_m = {20, 30, 10};

Volume volume_where(const std::function<bool(int, int, int)>& has_cloud) {
    Volume volume = test::volume_of({kVoxels, 4});
    testing::for_each_voxel(
        kVoxels, [&](int x, int y, int z) { volume.at(x, y, z) = has_cloud(x, y, z) ? 1 : 0; });
    return volume;
}

SkippingGain gain_of(const Volume& volume, int threads = 1) {
    const std::vector<std::uint8_t> leaps = leap_distance(occupied_cells(
        cell_ranges(volume.voxels.data(), volume.grid, config::OccupancyFilter::trilinear), 0));
    const LeapCells cells{volume.grid, leaps};
    return skipping_gain(test::bits_of(volume, 0), kVoxel_m, config::OccupancyFilter::trilinear,
                         cells, {.threads = threads});
}

// Cosines from 1 to 1/2, all as often, have the mean 2 log(2) of their inverse.
TEST(SkippingGain, IsBesideAMarchThatBeginsAndEndsWithTheLayer) {
    const SkippingGain empty = gain_of(volume_where([](int, int, int) { return false; }));
    EXPECT_NEAR(empty.without, kVoxels[2] * 2 * std::log(2.0), 0.05);
    EXPECT_NEAR(empty.with, 1, 1e-9);
}

// A ray asks once, and not again within cloud.
TEST(SkippingGain, IsALossWhereAllIsCloud) {
    const SkippingGain full = gain_of(volume_where([](int, int, int) { return true; }));
    EXPECT_NEAR(full.with, full.without + 1, 1e-9);
}

// A slab at the top takes one leap and a look at each sample in its cells. From one at the base leaps
// begin anew, short ones first.
TEST(SkippingGain, IsOfRaysFromBelow) {
    const SkippingGain low = gain_of(volume_where([](int, int, int z) { return z < 3; }));
    const SkippingGain high = gain_of(volume_where([](int, int, int z) { return z > 20; }), 2);
    EXPECT_NEAR(high.with, 2 + high.without * 4 / kVoxels[2], 0.5);
    EXPECT_GT(low.with, high.with + 2);
}

}  // namespace
}  // namespace skybake::occupancy

#include "bakers/render/cloud_view.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bakers/render/cloud_camera.h"
#include "bakers/render/cloud_framing.h"
#include "bakers/march/sun_leaps.h"
#include "tests/noise/every_target.h"
#include "tests/preview/clouds.h"
#include "tests/preview/skies.h"
#include "tests/support/cloud_view_reference.h"

namespace skybake {
namespace {

using test::cloud_of;
using test::clumped_voxels;

enum Result { kSunAtBase, kSunAtTop, kFromSky, kFromGround, kTransmittance, kDistance };

CloudMedium medium_of(const config::Cloud& cloud, const std::array<int, 3>& size,
                      const std::vector<float>& voxels, int cell = 4) {
    CloudMedium medium = cloud_medium(cloud, voxels.data(), size, 1, 1);
    medium.leaps = leaps_of_voxels(medium, cell, 1);
    return medium;
}

bool same_bits(const Image2<float>& a, const Image2<float>& b) {
    return a.texels.size() == b.texels.size() &&
           std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof(float)) == 0;
}

// A picture from below or from above, of a small cloud.
CloudViewSettings small_view(const CloudMedium& medium, const SunDirection& sun) {
    CloudViewSettings settings = framed_view(medium, sun, 20, 12);
    settings.reach_m = 4 * std::max(medium.extent_m[0], medium.extent_m[1]);
    return settings;
}

// Evenly, whatever RapidCheck's size.
double any_of(double from, double to) {
    const int share = *rc::gen::resize(100, rc::gen::inRange(0, 1 << 20));
    return from + (to - from) * share / static_cast<double>(1 << 20);
}
int any_count(int from, int to) { return static_cast<int>(any_of(from, to + 1)); }

struct Scene {
    CloudMedium medium;
    CloudViewSettings settings;
};

Scene any_scene() {
    const std::array<int, 3> size = {any_count(1, 40), any_count(1, 40),
                                     *rc::gen::element(1, 2, 7, 16, 21)};
    config::Cloud cloud = cloud_of({any_of(100, 2000), any_of(100, 2000), any_of(50, 1000)},
                                   *rc::gen::element(0.0, 700.0));
    cloud.extinction_scale.per_meter = *rc::gen::element(0.0, 0.002, 0.005, 0.05, 1e6);
    if (*rc::gen::arbitrary<bool>()) {
        cloud.threshold_at = config::ThresholdAt::runtime;
        cloud.threshold = *rc::gen::element(0.0, 0.25, 0.5, 2.0);
        cloud.edge_softness = *rc::gen::element(0.0, 0.05);
    }
    const auto voxels = clumped_voxels(size, static_cast<std::uint32_t>(any_count(0, 1 << 20)),
                                       *rc::gen::element(0.0, 0.02, 0.05, 0.1, 0.3, 1.0));
    Scene scene;
    scene.medium = medium_of(cloud, size, voxels, *rc::gen::element(1, 2, 4, 8, 16));
    const SunDirection sun = {*rc::gen::element(-90.0, -5.0, 0.0, 0.3, 12.0, 20.0, 45.0, 90.0),
                              *rc::gen::element(0.0, 45.0, 90.0, 137.0, 270.0)};
    scene.settings = small_view(scene.medium, sun);
    CloudCamera& camera = scene.settings.camera;
    const bool below = *rc::gen::arbitrary<bool>();
    const double height = below ? any_of(-0.5, 0.9) : any_of(0.1, 1.5);  // of the layer
    camera.position_m = {any_of(-3000, 3000), any_of(-3000, 3000),
                         cloud.base_altitude.meters + height * cloud.extent[2].meters};
    camera.azimuth_degrees = *rc::gen::element(0.0, 45.0, 90.0, 180.0, 201.0);
    camera.elevation_degrees = (below ? 1 : -1) * *rc::gen::element(0.0, 10.0, 45.0, 90.0);
    return scene;
}

RC_GTEST_PROP(CloudView, LeapingChangesNoBit, ()) {
    for (int i = 0; i < 8; ++i) {
        Scene scene = any_scene();
        const MarchedView leaping = march_view(scene.medium, scene.settings, 1);
        scene.settings.leaping = false;
        const MarchedView straight = march_view(scene.medium, scene.settings, 1);
        RC_ASSERT(same_bits(leaping.results, straight.results));
        RC_ASSERT(leaping.fetches.samples <= straight.fetches.samples);
        RC_ASSERT(leaping.fetches.light_samples <= straight.fetches.light_samples);
        for (const float value : straight.results.texels) RC_ASSERT(std::isfinite(value));
    }
}

TEST(CloudView, LeapsSaveFetches) {
    const std::array<int, 3> size = {48, 48, 24};
    const CloudMedium medium =
        medium_of(cloud_of({2000, 2000, 800}, 600), size, clumped_voxels(size, 5, 0.02));
    CloudViewSettings settings = small_view(medium, {30, 100});
    const FetchCounts leaping = march_view(medium, settings, 1).fetches;
    settings.leaping = false;
    const FetchCounts straight = march_view(medium, settings, 1).fetches;
    EXPECT_LT(3 * leaping.samples, straight.samples);
    EXPECT_LT(2 * leaping.light_samples, straight.light_samples);
    EXPECT_GT(leaping.cells, 0);
    EXPECT_EQ(straight.cells, 0);
}

TEST(CloudView, IsTheSameOnAllThreadsAndTargets) {
    const std::array<int, 3> size = {33, 20, 12};
    const CloudMedium medium =
        medium_of(cloud_of({1300, 900, 500}, 400), size, clumped_voxels(size, 9, 0.3));
    CloudViewSettings settings = small_view(medium, {12, 80});
    settings.width = 50;
    settings.height = 35;
    const Image2<float> one = march_view(medium, settings, 1).results;
    EXPECT_TRUE(same_bits(march_view(medium, settings, 3).results, one));
    test::on_every_target([&](const char* target) {
        EXPECT_TRUE(same_bits(march_view(medium, settings, 1).results, one)) << target;
    });
}

// Fine steps of both; what is left is theirs, and that two samples share their light.
TEST(CloudView, IsTheDefinition) {
    const std::array<int, 3> size = {12, 9, 6};
    for (const SunDirection& sun :
         {SunDirection{-20, 0}, {10, 80}, {35, 0}, {35, 200}, {90, 80}, {0, 140}}) {
        const auto seed = static_cast<std::uint32_t>(1000 + sun.azimuth_degrees);
        const CloudMedium medium =
            medium_of(cloud_of({1200, 900, 600}, 500), size, clumped_voxels(size, seed, 0.4));
        CloudViewSettings settings = small_view(medium, sun);
        settings.width = 8;
        settings.height = 5;
        settings.camera.elevation_degrees = 40;
        settings.step_m = 4;
        settings.light_step_m = 4;
        const Image2<float> view = march_view(medium, settings, 1).results;
        const DiffuseShare diffuse = diffuse_share(medium, 4, 1);
        const CameraRays rays(settings.camera, settings.width, settings.height);
        int opaque = 0;
        for (int y = 0; y < settings.height; ++y) {
            for (int x = 0; x < settings.width; ++x) {
                const float* made = view.texel(x, y);
                const ReferenceRay wanted =
                    reference_ray(medium, diffuse, settings, rays.through(x, y), 250);
                const auto compare = [&](Result result, double reference) {
                    EXPECT_NEAR(made[result], reference, 0.004 + 0.03 * reference)
                        << "result " << result << ", sun " << sun.elevation_degrees;
                };
                compare(kTransmittance, wanted.transmittance);
                compare(kSunAtBase, wanted.sun_at_base);
                compare(kSunAtTop, wanted.sun_at_top);
                compare(kFromSky, wanted.from_sky);
                compare(kFromGround, wanted.from_ground);
                EXPECT_NEAR(made[kDistance], wanted.distance_m, 4 + 0.03 * wanted.distance_m);
                opaque += wanted.transmittance < 0.5 ? 1 : 0;
            }
        }
        EXPECT_GT(opaque, 5);
    }
}

// A homogeneous layer, seen from below.
struct Slab {
    CloudMedium medium;
    CloudViewSettings settings;
    double height = 600;
    double sigma = 0;

    Slab(double tau, const SunDirection& sun) : sigma(tau / height) {
        config::Cloud cloud = cloud_of({1000, 1000, height}, 500);
        cloud.extinction_scale.per_meter = sigma;
        const std::array<int, 3> size = {8, 8, 6};
        medium = medium_of(cloud, size, std::vector<float>(8 * 8 * 6, 1.0F));
        settings = small_view(medium, sun);
        settings.camera.elevation_degrees = 50;
        settings.step_m = 0.5;
        settings.light_step_m = 0.5;
    }
};

TEST(CloudView, LetsThroughWhatBeerSays) {
    for (const double tau : {0.01, 0.5, 3.0}) {
        const Slab slab(tau, {40, 70});
        const Image2<float> view = march_view(slab.medium, slab.settings, 1).results;
        const CameraRays rays(slab.settings.camera, view.width, view.height);
        for (int y = 0; y < view.height; ++y) {
            for (int x = 0; x < view.width; ++x) {
                const double length = slab.height / rays.through(x, y)[2];
                // Samples within the layer: one more or less than its length in steps.
                // Each of its floats rounds by 2^-24, exp by twice as much.
                const double rounding = length / slab.settings.step_m * 0x1p-22;
                EXPECT_NEAR(-std::log(double{view.texel(x, y)[kTransmittance]}),
                            slab.sigma * length, slab.sigma * slab.settings.step_m + rounding);
            }
        }
    }
}

// The octaves' integral over a slab of optical depth tau, the light leaving it at its base:
//   b^n p_n / mu  integral over depth t from 0 to tau of exp(-(tau - t) / mu - a^n t / mu_s).
double slab_radiance(double tau, double mu, double mu_sun, double offset) {
    double sum = 0;
    double a = 1;
    for (const OctavePhase& octave : octave_phases()) {
        const double rate = 1 / mu - a / mu_sun;
        const double integral = std::exp(-tau / mu) * (std::exp(tau * rate) - 1) / rate;
        sum += octave.brightness * phase_value(octave.phase, offset) * integral / mu;
        a *= kOctaveHalving;
    }
    return sum;
}

TEST(CloudView, ScattersSunlightAsTheClosedFormSays) {
    for (const double tau : {0.02, 1.0, 6.0}) {
        const Slab slab(tau, {65, 170});
        const glm::dvec3 sun = direction_of(65, 170);
        const Image2<float> view = march_view(slab.medium, slab.settings, 1).results;
        const CameraRays rays(slab.settings.camera, view.width, view.height);
        for (int y = 0; y < view.height; ++y) {
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 ray = rays.through(x, y);
                const double wanted =
                    slab_radiance(tau, ray[2], sun[2], one_minus_cosine(ray, sun));
                const double made =
                    double{view.texel(x, y)[kSunAtBase]} + double{view.texel(x, y)[kSunAtTop]};
                EXPECT_NEAR(made, wanted, 0.01 * wanted) << tau;
            }
        }
    }
}

// Under a white sky and above white ground nothing is brighter than they are.
RC_GTEST_PROP(CloudView, GivesNoMoreThanAWhiteFurnace, ()) {
    const Scene scene = any_scene();
    const Image2<float> view = march_view(scene.medium, scene.settings, 1).results;
    for (std::size_t i = 0; i < view.texels.size(); i += MarchedView::kChannels) {
        const float* seen = &view.texels[i];
        RC_ASSERT(seen[kTransmittance] >= 0.0F);
        RC_ASSERT(seen[kTransmittance] <= 1.0F);
        RC_ASSERT(seen[kFromSky] + seen[kFromGround] + seen[kTransmittance] <= 1.0F + 1e-5F);
    }
}

// What a slab sends back of the sun's light, by Gauss-like sums over directions.
double plane_albedo(double tau, double mu_sun) {
    const auto octaves = octave_phases();
    const double sun_level = std::sqrt(1 - mu_sun * mu_sun);
    constexpr int kMus = 64;
    constexpr int kAzimuths = 128;
    double sum = 0;
    for (int i = 0; i < kMus; ++i) {
        const double mu = (i + 0.5) / kMus;
        for (int j = 0; j < kAzimuths; ++j) {
            const double azimuth = M_PI * (j + 0.5) / kAzimuths;
            // From the way of the light, down, to that of the eye's light, up.
            const double cosine =
                -mu * mu_sun + std::sqrt(1 - mu * mu) * sun_level * std::cos(azimuth);
            double radiance = 0;
            double a = 1;
            for (const OctavePhase& octave : octaves) {
                const double rate = 1 / mu + a / mu_sun;
                radiance += octave.brightness * phase_value(octave.phase, 1 - cosine) *
                            (1 - std::exp(-tau * rate)) / (rate * mu);
                a *= kOctaveHalving;
            }
            sum += radiance * mu * (1.0 / kMus) * (2 * M_PI / kAzimuths);
        }
    }
    return sum / mu_sun;
}

TEST(CloudLight, OctavesSendBackLessThanComesInFromTwentyDegreesUp) {
    for (const double elevation : {20.0, 35.0, 90.0}) {
        for (const double tau : {0.1, 1.0, 10.0, 1000.0}) {
            EXPECT_LT(plane_albedo(tau, sine_of_degrees(elevation)), 1.0)
                << elevation << ' ' << tau;
        }
    }
    EXPECT_NEAR(plane_albedo(20, 1), 0.37, 0.01);
}

TEST(DropletPhase, IntegratesToOneWithItsMeanCosine) {
    for (const double diameter : {5.0, 12.0, 50.0}) {
        for (const double eccentricity : {1.0, 0.5, 0.0}) {
            const DropletPhase phase = widened(droplet_phase(diameter), eccentricity);
            // offset = 2 x^6: dense where the forward peak is.
            constexpr int kSteps = 200000;
            double sum = 0;
            double moment = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double x = (i + 0.5) / kSteps;
                const double offset = 2 * std::pow(x, 6);
                const double weight = 2 * M_PI * 12 * std::pow(x, 5) / kSteps;
                sum += weight * phase_value(phase, offset);
                moment += weight * phase_value(phase, offset) * (1 - offset);
            }
            EXPECT_NEAR(sum, 1, 1e-4);
            EXPECT_NEAR(moment, mean_cosine(phase), 1e-4);
        }
    }
}

// Bohren's 2 / (2 + (1 - g) tau).
TEST(CloudLight, DiffuseShareOfASlabIsTwoStreamTheorys) {
    for (const double tau : {0.0, 1.0, 30.0}) {
        const Slab slab(tau, {40, 70});
        const double g = mean_cosine(droplet_phase(kDropletDiameter_um));
        const DiffuseShare share = diffuse_share(slab.medium, 1, 1);
        EXPECT_NEAR(share.through, 2 / (2 + (1 - g) * tau), 1e-9);
        const float lowest = share.from_sky.values[static_cast<std::size_t>(
            share.from_sky.plane() + share.from_sky.row() + 1)];
        EXPECT_NEAR(double{lowest}, 2 / (2 + (1 - g) * tau * (1 - 0.5 / 6)), 1e-6);
    }
}

// Every sample that is left out is in an empty cell.
RC_GTEST_PROP(SunLeaps, LeaveOutEmptyCellsAlone, ()) {
    const int cell = *rc::gen::element(1, 2, 4);
    const std::array<int, 3> size = {cell * any_count(1, 12), cell * any_count(1, 12),
                                     any_count(1, 24)};
    const auto voxels =
        clumped_voxels(size, static_cast<std::uint32_t>(any_count(0, 1 << 20)), 0.1);
    const CloudMedium medium = medium_of(cloud_of({1000, 1000, 500}), size, voxels, cell);
    const LeapGrid& grid = medium.leaps;
    const glm::dvec3 step = {any_of(-2, 2), any_of(-2, 2), *rc::gen::element(-1.5, 0.0, 0.01, 0.7)};
    const auto leaps = sun_leaps(grid, size, step, 40, 1);
    for (int i = 0; i < 200; ++i) {
        const std::array<double, 3> place = {any_of(0, 1) * size[0], any_of(0, 1) * size[1],
                                             any_of(0, 1) * size[2]};
        const auto reach_at = [&](double k, bool& inside) {
            std::array<int, 3> index{};
            for (std::size_t a = 0; a < 3; ++a) {
                const double at = std::floor(place[a] + k * step[a]);
                const int voxel = static_cast<int>(at);
                if (a == 2) inside = voxel >= 0 && voxel < size[2];
                index[a] = (a < 2 ? occupancy::wrapped(voxel, size[a])
                                  : occupancy::clamped(voxel, size[a])) /
                           cell;
            }
            return occupancy::index_of(grid.cells, index[0], index[1], index[2]);
        };
        bool inside = true;
        const float leap = leaps[reach_at(0, inside)];
        RC_ASSERT((leap < 0) == (grid.reach[reach_at(0, inside)] < 0));
        for (int k = 1; k <= std::min(static_cast<int>(leap), 40); ++k) {
            const std::size_t there = reach_at(k, inside);
            RC_ASSERT(!inside || grid.reach[there] >= 0);
        }
    }
}

// Straight up from an empty plane below an empty one nothing is met.
TEST(SunLeaps, SeeFartherThanTheNearestCell) {
    const std::array<int, 3> size = {16, 16, 16};
    std::vector<float> voxels(16 * 16 * 16);
    voxels[occupancy::index_of(size, 1, 1, 1)] = 1;
    const CloudMedium medium = medium_of(cloud_of({1000, 1000, 1000}), size, voxels, 2);
    const auto leaps = sun_leaps(medium.leaps, size, {0, 0, 0.5}, 100, 1);
    const auto at = [&](int x, int y, int z) {
        return leaps[occupancy::index_of(medium.leaps.cells, x, y, z)];
    };
    EXPECT_EQ(at(0, 0, 0), -1);
    EXPECT_EQ(at(0, 0, 4), 100);
    EXPECT_EQ(at(4, 4, 0), 100);
}

TEST(CloudView, ShowsSkyWhereThereIsNoCloud) {
    static const test::Sky sky = test::sky_of("earth_hillaire");
    const std::array<int, 3> size = {16, 16, 4};
    const CloudMedium empty =
        medium_of(cloud_of({1000, 1000, 500}, 800), size, std::vector<float>(1024));
    const CloudMedium full =
        medium_of(cloud_of({1000, 1000, 500}, 800), size, std::vector<float>(1024, 1.0F));
    for (const double elevation : {90.0, 20.0, 0.0, -2.0, -90.0}) {
        CloudViewSettings settings = small_view(empty, {elevation, 90});
        const Atmosphere air{sky.medium, sky.tables};
        const Image2<float> sky_alone = render_cloud(empty, air, settings, 1).radiance;
        const Image2<float> overcast = render_cloud(full, air, settings, 2).radiance;
        double brightest = 0;
        for (const Image2<float>* image : {&sky_alone, &overcast}) {
            for (const float value : image->texels) {
                ASSERT_TRUE(std::isfinite(value)) << elevation;
                ASSERT_GE(value, 0.0F) << elevation;
                brightest = std::max(brightest, double{value});
            }
        }
        EXPECT_LT(brightest, 2.0) << elevation;  // per unit of solar irradiance, no sun in view
        EXPECT_EQ(same_bits(sky_alone, overcast), elevation == -90) << elevation;
    }
}

}  // namespace
}  // namespace skybake

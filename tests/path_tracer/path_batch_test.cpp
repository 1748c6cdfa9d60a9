// Batches of paths against single paths, the specification: every number of each path is the same,
// for every instruction set that this machine has.
#include "bakers/light/path_tracer/path_batch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/path_tracer/path_media.h"
#include "tests/path_tracer/single_path.h"
#include "tests/support/every_target.h"

namespace skybake {
namespace {

// Shared by all paths of a batch.
struct Scene {
    std::string name;
    SkyMedium medium;
    PathSource source;
    PathRules rules;
    PathStart start;
    bool one_start = true;  // or each path has a direction of its own
};

struct PathResult {
    PathLight light;
    Spectrum second_flight{};
};

// Paths have random numbers alone, or first the coordinates of points.
std::vector<RandomStream> streams(std::size_t count) {
    std::vector<RandomStream> random;
    for (std::size_t i = 0; i < count; ++i) random.emplace_back(11, 5, i);
    return random;
}

std::size_t hero_of(const Scene& scene, std::size_t path) {
    return path % static_cast<std::size_t>(scene.medium.air.channels);
}

PathStart start_of(const Scene& scene, std::size_t path) {
    PathStart start = scene.start;
    if (scene.one_start) return start;
    RandomStream random(12, 5, path);
    const double one_minus = 2 * random.next();
    start.direction = scatter(start.up, {one_minus, 2 - one_minus}, random.next());
    return start;
}

std::vector<PathResult> walk_singly(const PathMedium& medium, const Scene& scene,
                                    const ScrambledPoints* points, std::size_t count) {
    const test::SinglePath path(medium);
    std::vector<PathResult> results(count);
    const std::vector<RandomStream> random = streams(count);
    for (std::size_t i = 0; i < count; ++i) {
        test::PathNumbers numbers =
            points != nullptr
                ? test::PathNumbers(*points, 7 + static_cast<std::uint32_t>(i), random[i])
                : test::PathNumbers(random[i]);
        const PathStart start = start_of(scene, i);
        results[i].second_flight = path.walk(scene.source, start, scene.rules, hero_of(scene, i),
                                             numbers, results[i].light);
    }
    return results;
}

std::vector<PathResult> walk_together(const PathMedium& medium, const Scene& scene,
                                      const ScrambledPoints* points, std::size_t count) {
    PathBatch batch(points != nullptr ? BatchNumbers(*points, 7, streams(count))
                                      : BatchNumbers(streams(count)));
    const PathMedium::Flight first = medium.first_flight(scene.start, scene.rules);
    if (scene.one_start) batch.first = &first;
    for (std::size_t i = 0; i < count; ++i) {
        batch.heroes[i] = hero_of(scene, i);
        batch.starts[i] = start_of(scene, i);
    }
    walk_batch(medium, scene.source, scene.rules, batch);
    std::vector<PathResult> results(count);
    for (std::size_t i = 0; i < count; ++i) {
        results[i] = {batch.light[i], batch.second_flight[i]};
    }
    return results;
}

// The number of the first path that is not the same, or the number of paths.
std::size_t first_difference(const std::vector<PathResult>& a, const std::vector<PathResult>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool same =
            a[i].light.direct == b[i].light.direct && a[i].light.orders == b[i].light.orders &&
            a[i].light.flights == b[i].light.flights && a[i].second_flight == b[i].second_flight;
        if (!same) return i;
    }
    return a.size();
}

// Light and flights of all paths, by which a test knows that they did what it is about.
PathLight sum_of(const std::vector<PathResult>& results) {
    PathLight sum;
    for (const PathResult& result : results) {
        sum.direct += result.light.direct;
        sum.flights += result.light.flights;
        for (std::size_t n = 0; n < kPathOrders; ++n) sum.orders[n] += result.light.orders[n];
    }
    return sum;
}

PathSource sun_at(double zenith_degrees, double radius = 0) {
    return {false,
            {test::sine_of_degrees(zenith_degrees), 0, test::cosine_of_degrees(zenith_degrees)},
            radius};
}

PathStart view_at(double altitude_km, double zenith_degrees) {
    return {{0, 0, 1},
            {test::sine_of_degrees(zenith_degrees) * 0.6,
             test::sine_of_degrees(zenith_degrees) * 0.8, test::cosine_of_degrees(zenith_degrees)},
            altitude_km};
}

std::vector<Scene> scenes() {
    std::vector<Scene> list;
    // Suns and views at each height over the horizon and below it, and the ground of each albedo.
    for (const std::string& preset : test::preset_list()) {
        const SkyMedium medium = test::preset_sky(preset);
        const double top = medium.air.thickness_km;
        PathRules known;
        known.usual_weight = Spectrum(0.02);
        list.push_back({preset + " by day", medium, sun_at(40), {}, view_at(0.005 * top, 75)});
        list.push_back({preset + " at dusk", medium, sun_at(93), known, view_at(0.2 * top, 96)});
        list.push_back({preset + " from space", medium, sun_at(88), known, view_at(top, 120)});
        list.push_back({preset + " all around", medium, sun_at(60), known, view_at(0, 0), false});
    }
    const SkyMedium furnace = test::white_furnace(8, "0.95", "tiny_planet");
    PathSource sky;
    sky.ambient = true;
    list.push_back({"furnace", furnace, sky, {}, view_at(0, 80)});
    const SkyMedium earth = test::preset_sky("earth");
    list.push_back({"a sun with a disc", earth, sun_at(89.9, 0.005), {}, view_at(0, 85)});
    PathRules partial;
    partial.counts_first_order = false;
    partial.sees_ground = false;
    PathStart part = view_at(10, 92);
    part.length_km = 80;
    list.push_back({"part of a ray", earth, sun_at(70), partial, part});
    list.push_back(
        {"one wavelength",
         test::preset_sky("earth_hillaire", {"wavelengths=[\"550 nm\"]",
                                             "atmosphere.layers.rayleigh.scattering=\"13.6e-6 /m\"",
                                             "atmosphere.layers.ozone.absorption=\"1.9e-6 /m\""}),
         sun_at(50),
         {},
         view_at(1, 60)});
    list.push_back({"haze that scatters back",
                    test::preset_sky("earth_hillaire", {"atmosphere.layers.mie.g=-0.9"}),
                    sun_at(50),
                    {},
                    view_at(1, 60)});
    list.push_back(
        {"spheres, each channel with a table of its own",
         make_sky_medium(test::recipe_of("preset = 'earth_hillaire'\n[particles.dust]\n"
                                         "material = 'constant'\nrefractive_index = 1.5\n"
                                         "effective_radius = '1 um'\n[atmosphere.layers.dust]\n"
                                         "profile = 'exponential'\nscale_height = '2 km'\n"
                                         "phase = { mie = 'dust' }\nnumber_density = '30 /cm3'\n",
                                         {})
                             .parameters.atmosphere),
         sun_at(50),
         {},
         view_at(0.1, 60)});
    return list;
}

TEST(PathBatch, WalksAsPathsWalkSingly) {
    constexpr std::size_t kPaths = BatchNumbers::kPaths;
    const ScrambledPoints points(1, 2, 3);
    std::int64_t flights = 0;
    for (const Scene& scene : scenes()) {
        const PathMedium medium(scene.medium);
        for (const ScrambledPoints* even :
             {&points, static_cast<const ScrambledPoints*>(nullptr)}) {
            const std::vector<PathResult> expected = walk_singly(medium, scene, even, kPaths);
            flights += sum_of(expected).flights;
            test::on_every_target([&](const char* target) {
                const std::vector<PathResult> found = walk_together(medium, scene, even, kPaths);
                EXPECT_EQ(first_difference(found, expected), kPaths)
                    << scene.name << ", " << target;
            });
        }
    }
    EXPECT_GT(flights, 10000);
}

// A path does not depend on the others of its batch.
TEST(PathBatch, MayHaveAnyNumberOfPaths) {
    constexpr std::size_t kPaths = BatchNumbers::kPaths;
    const Scene scene = {"earth", test::preset_sky("earth"), sun_at(85), {}, view_at(0, 88)};
    const PathMedium medium(scene.medium);
    const std::vector<PathResult> all = walk_singly(medium, scene, nullptr, kPaths);
    EXPECT_GT(sum_of(all).orders[5][0], 0);
    for (std::size_t count = 1; count <= kPaths; count += 7) {
        const std::vector<PathResult> found = walk_together(medium, scene, nullptr, count);
        EXPECT_EQ(first_difference(found, all), count);
    }
}

// Each number is that of the path's own PathNumbers.
TEST(BatchNumbers, AreThoseOfEachPath) {
    for (const std::size_t count : {1, 5, 16, 64}) {
        for (const std::uint32_t first : {0U, 9U, 64U, 123456789U}) {
            const ScrambledPoints points(3, 4, 5);
            BatchNumbers batch(points, first, streams(count));
            std::vector<test::PathNumbers> single;
            for (std::size_t i = 0; i < count; ++i) {
                single.emplace_back(points, first + static_cast<std::uint32_t>(i),
                                    streams(count)[i]);
            }
            for (std::size_t d = 0; d < ScrambledPoints::kDimensions + 6; ++d) {
                batch.go_on();
                for (std::size_t i = 0; i < count; ++i) {
                    if ((i + d) % 3 == 0) {
                        single[i].go_on();
                    } else {
                        ASSERT_EQ(batch.of(i), single[i].next()) << first << ' ' << i << ' ' << d;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace skybake

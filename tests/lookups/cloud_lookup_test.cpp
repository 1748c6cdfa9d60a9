// Noise, clouds, and the march that leaps over what is empty.
#include <set>

#include "bakers/field/image.h"
#include "bakers/occupancy/marcher.h"
#include "config/sections/cloud.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::cloud_lookups {
#include "lookups/clouds.glsl.h"
#include "lookups/noise.glsl.h"
}  // namespace gpu::cloud_lookups

namespace {

using gpu::filtered_at;
using gpu::size_of;
using gpu::vec3;
using test::add_shares;

// In the first channel, which is the only one.
const gpu::vec4 kUnormLeap(255, 0, 0, 0);

// The metres that texels of 0 and 1 stand for: halves hold metres.
const gpu::vec2 kEnds(0, 1);

const std::string kShape = "[noise.shape]\npreset = 'nubis_shape'\nseed = 7\n";

TEST(NoiseLookup, FloatLosesLittle) {
    for (const bool corners : {false, true}) {
        const test::BakedLookup baked = test::bake_all(
            kShape + (corners ? "sampling = 'corners'\n" : "") +
            "[bake.a]\nasset = 'noise_volume'\nnoise = 'shape'\nsize = [32, 16, 24]\n"
            "pixel_type = 'float'\n");
        const Texture texture = texture_of(baked.asset());
        const vec3 tile(8, 4, 6);
        const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const vec3 p(dice.uniform(-20, 20), dice.uniform(-20, 20), dice.uniform(-20, 20));
            const gpu::vec4 found = corners ? gpu::cloud_lookups::noise_volume_at_corners(
                                                  {texture}, gpu::size_of(texture), p, tile)
                                            : gpu::cloud_lookups::noise_volume({texture}, p, tile);
            // Voxel i is at (i + 1/2) / size, or at i / size.
            const glm::dvec3 half = glm::dvec3(corners ? 0.5 : 0) / glm::dvec3(size_of(texture));
            const auto wanted = filtered_at(texture, glm::dvec3(p) / glm::dvec3(tile) + half);
            add_shares(found, wanted, baked.asset(), loss);
        });
        expect_little_loss(lost, baked.asset().certificate);
    }
}

// The functions make of four channels what pack stores.
TEST(NoiseLookup, ChannelsArePackedAsTheBakerPacksThem) {
    const std::string detail = "[noise.detail]\npreset = 'nubis_detail'\nseed = 11\n";
    const std::string bakes =
        "[bake.a]\nasset = 'noise_volume'\nnoise = 'shape'\nsize = [48, 48, 48]\npixel_type = "
        "'float'\n[bake.b]\nasset = 'noise_volume'\nnoise = 'detail'\nsize = [16, 16, 16]\n"
        "pixel_type = 'float'\n";
    const test::BakedLookup apart = test::bake_all(kShape + detail + bakes);
    const test::BakedLookup packed =
        test::bake_all(kShape + "pack = 'shape'\n" + detail + "pack = 'detail'\n" + bakes);
    const Texture shape = texture_of(apart.asset(0));
    const Texture shape_packed = texture_of(packed.asset(0));
    for (std::size_t i = 0; i < shape_packed.texels.size() && !HasFailure(); ++i) {
        const float* s = shape.texels.data() + 4 * i;
        EXPECT_NEAR(gpu::cloud_lookups::nubis_shape({s[0], s[1], s[2], s[3]}),
                    shape_packed.texels[i], 1e-6);
    }
    const Texture detail_apart = texture_of(apart.asset(1));
    const Texture detail_packed = texture_of(packed.asset(1));
    for (std::size_t i = 0; i < detail_packed.texels.size() && !HasFailure(); ++i) {
        const float* d = detail_apart.texels.data() + 3 * i;
        EXPECT_NEAR(gpu::cloud_lookups::nubis_detail({d[0], d[1], d[2]}), detail_packed.texels[i],
                    1e-6);
    }
}

// A small cloud, its cells and a tile.
struct CloudTrial {
    explicit CloudTrial(const std::string& size = "[60, 64, 20]")
        : baked(test::bake_all(kShape +
                               "pack = 'shape'\n[clouds.cumulus]\nnoise = 'shape'\n"
                               "noise_scale = [1, 1, 1]\nextent = ['3 km', '3.2 km', '1 km']\n"
                               "height_profile = { type = 'cumulus' }\ncoverage = 0.06\n"
                               "[bake.cloud]\nasset = 'cloud_volume'\ncloud = 'cumulus'\n"
                               "size = " +
                               size +
                               "\npixel_type = 'float'\n[bake.leap]\n"
                               "asset = 'occupancy'\nof = 'cloud'\ncell = 4\ncontents = ['leap']\n"
                               "pixel_type = 'unorm8'\nformats = ['bin']\n"
                               "[bake.distance]\nasset = 'cloud_distance'\nof = 'cloud'\n"
                               "cell = 2\n")),
          cloud(texture_of(baked.asset(0))),
          leaps(texture_of(baked.asset(1))),
          distances(texture_of(baked.asset(2))) {}

    struct Ray {
        vec3 from, ray;
        float stride = 0;
        int count = 0;
    };
    // From anywhere in the layer or at its faces, in any direction, level ones too, over several
    // tiles.
    Ray any_ray(test::Dice& dice) const {
        Ray ray;
        glm::dvec3 along = dice.direction();
        if (dice.one_in(2)) along.z *= 0.1;
        if (dice.one_in(10)) along.z = 0;
        if (dice.one_in(10)) along = {0, dice.one_in(2) ? 1 : -1, 0};
        ray.ray = vec3(glm::normalize(along));
        ray.from =
            vec3(dice.uniform(-9000, 9000), dice.uniform(-9000, 9000), dice.uniform(0, 1000));
        if (dice.one_in(4)) ray.from = glm::floor(ray.from / 50.0f) * 50.0f;  // on voxels' faces
        ray.stride = static_cast<float>(dice.decades(5, 200));
        const gpu::vec2 layer = gpu::cloud_lookups::cloud_layer(tile.z, ray.from.z, ray.ray.z);
        const float length = std::min(layer.y - layer.x, 8000.0f);
        ray.from += ray.ray * layer.x;
        ray.count = length > 0 ? static_cast<int>(length / ray.stride) + 1 : 0;
        return ray;
    }
    float march(const Ray& ray, const Texture& with) const {
        return gpu::cloud_lookups::cloud_march({cloud}, {with}, gpu::size_of(with), 4, kUnormLeap,
                                               gpu::size_of(cloud), ray.from, ray.ray, tile,
                                               ray.stride, ray.count);
    }
    // Returns the box that the texels of distances span. Along z, 19 voxels have 10 texels.
    vec3 box() const {
        const auto voxels = static_cast<float>(2 * distances.size[2]);
        return {tile.x, tile.y, tile.z * voxels / static_cast<float>(cloud.size[2])};
    }
    float trace(const Ray& ray, const Texture& with) const {
        return gpu::cloud_lookups::cloud_trace({cloud}, {with}, kEnds, box(), ray.from, ray.ray,
                                               tile, ray.stride, ray.count);
    }
    // At a place in voxels.
    double density_at(const glm::dvec3& place) const {
        return filtered_at(cloud, place / glm::dvec3(size_of(cloud)))[0];
    }
    // In metres from the lower corner of the tile.
    glm::dvec3 place_of(const Probe& probe) const {
        const double base_m = baked.recipe.parameters.clouds.front().base_altitude.meters;
        return {test::at(probe, "x_m"), test::at(probe, "y_m"),
                test::at(probe, "altitude_m") - base_m};
    }
    double distance_at(const glm::dvec3& place) const {
        return filtered_at(distances, place / (2.0 * glm::dvec3(size_of(distances))))[0];
    }
    // A grid that calls nothing empty, whose march looks everywhere.
    Texture without_leaps() const {
        Texture grid = leaps;
        std::fill(grid.texels.begin(), grid.texels.end(), 0.0f);
        return grid;
    }

    test::BakedLookup baked;
    Texture cloud;
    Texture leaps;
    Texture distances;
    vec3 tile{3000, 3200, 1000};
};

// Where the box of a cell that is `leap` cells from an occupied one ends along an axis, in voxels
// from the tile's corner. Tiles follow each other, and the last cell of each may be smaller.
int face_of_box(int cell, int leap, bool upwards, int cells, int voxels) {
    const int face = upwards ? cell + leap : cell + 1 - leap;
    const int tile = face >= 0 ? face / cells : (face - cells + 1) / cells;
    return tile * voxels + 4 * (face - tile * cells);
}

// Compares what the lookup makes of a probe's cell: how far a ray goes on, along each axis and against it.
void expect_leaps_of_probe(const CloudTrial& trial, const Probe& probe, int leap) {
    const glm::dvec3 place = trial.place_of(probe);
    for (int direction = 0; direction < 6; ++direction) {
        const int axis = direction / 2;
        const auto i = static_cast<std::size_t>(axis);
        vec3 ray(0);
        ray[axis] = direction % 2 == 0 ? 1.0f : -1.0f;
        const float found =
            gpu::cloud_lookups::cloud_leap({trial.leaps}, size_of(trial.leaps), 4, kUnormLeap,
                                           size_of(trial.cloud), vec3(place), ray, trial.tile);
        const int cells = trial.leaps.size[i];
        const int voxels = trial.cloud.size[i];
        const int face = face_of_box(static_cast<int>(probe.uvw[i] * cells), leap,
                                     direction % 2 == 0, cells, voxels);
        const double edge_m = double{trial.tile[axis]} / voxels;
        const double margin_m = edge_m / 64;
        const double wanted = leap == 0 ? 0 : std::fabs(face * edge_m - place[axis]) - margin_m;
        EXPECT_NEAR(found, wanted, 1e-5 * (wanted + double{trial.tile[axis]}))
            << "x " << place.x << ", leap " << leap << ", direction " << direction;
    }
}

TEST(CloudLeap, HoldsTheProbes) {
    for (const char* size : {"[60, 64, 20]", "[60, 64, 19]"}) {
        const CloudTrial trial(size);
        std::set<int> leaps;
        for (const Probe& probe : trial.baked.asset(1).levels.front().probes) {
            const auto leap = static_cast<int>(std::lround(255 * probe.value.front()));
            EXPECT_LE(std::fabs(leap / 255.0 - probe.value.front()), probe.tolerance.front());
            expect_leaps_of_probe(trial, probe, leap);
            leaps.insert(leap);
        }
        EXPECT_GT(leaps.size(), 2U);  // of occupied cells, of their neighbours, and farther ones
    }
}

// Marches that look everywhere beside those that skip, over the same rays.
struct Marches {
    double sum = 0;
    long steps = 0;   // lookups of those that look everywhere
    long looked = 0;  // of those that skip
    int different = 0;
};

template <class March>
Marches march_twice(const CloudTrial& trial, const Texture& everywhere, const Texture& skipping,
                    int rays, const March& march) {
    Marches both;
    test::Dice dice;
    for (int i = 0; i < rays; ++i) {
        const CloudTrial::Ray ray = trial.any_ray(dice);
        trial.cloud.lookups = 0;
        const float straight = march(ray, everywhere);
        both.steps += trial.cloud.lookups;
        trial.cloud.lookups = 0;
        if (march(ray, skipping) != straight) ++both.different;
        both.looked += trial.cloud.lookups;
        both.sum += double{straight};
    }
    return both;
}

Marches march_twice(const CloudTrial& trial, const Texture& leaps) {
    return march_twice(
        trial, trial.without_leaps(), leaps, 4000,
        [&](const auto& ray, const Texture& with) { return trial.march(ray, with); });
}

Marches trace_twice(const CloudTrial& trial, const Texture& distances) {
    Texture nowhere = trial.distances;
    std::fill(nowhere.texels.begin(), nowhere.texels.end(), 0.0f);
    return march_twice(trial, nowhere, distances, 3000, [&](const auto& ray, const Texture& with) {
        return trial.trace(ray, with);
    });
}

// They find clouds and gaps, and leave the gaps out.
TEST(CloudMarch, LeapsChangeNothing) {
    const CloudTrial trial;
    ASSERT_EQ(trial.leaps.size, (std::array<int, 3>{15, 16, 5}));
    const Marches both = march_twice(trial, trial.leaps);
    EXPECT_EQ(both.different, 0);
    EXPECT_GT(both.sum, 0);
    EXPECT_LT(both.looked, both.steps / 2);
    EXPECT_LT(trial.leaps.lookups, both.steps / 2);
}

// Counts rays on which the march that bakes and plans count has other fetches than the published one, which
// floats may round to another sample. Rays that begin on voxels' faces are in either voxel.
template <class Stay, class March>
int differently_counted(const CloudTrial& trial, const Texture& structure, const Stay& stay,
                        const March& march) {
    test::Dice dice;
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
        const CloudTrial::Ray ray = trial.any_ray(dice);
        if (ray.from == glm::floor(ray.from / 50.0f) * 50.0f) continue;
        occupancy::SampledRay samples{{}, {}, ray.count};
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<vec3::length_type>(a);
            const double voxels = trial.cloud.size[a] / double{trial.tile[axis]};
            samples.from[a] = double{ray.from[axis]} * voxels;
            samples.step[a] = double{ray.ray[axis]} * double{ray.stride} * voxels;
        }
        const occupancy::MarchFetches counted = occupancy::march(
            samples, [&](const auto& place, const auto& step) { return stay(place, step, ray); },
            [&](const auto& at) {
                return trial.density_at({at[0], at[1], at[2]}) > 0;
            });
        trial.cloud.lookups = structure.lookups = 0;
        march(ray);
        if (counted.densities != trial.cloud.lookups || counted.structure != structure.lookups) {
            ++different;
        }
    }
    return different;
}

TEST(CloudMarch, TakesTheFetchesThatAreCounted) {
    for (const char* size : {"[60, 64, 20]", "[60, 64, 19]"}) {
        const CloudTrial trial(size);
        std::vector<std::uint8_t> leaps;
        for (const float leap : trial.leaps.texels) {
            leaps.push_back(static_cast<std::uint8_t>(std::lround(255 * leap)));
        }
        const occupancy::LeapCells cells{{trial.cloud.size, 4}, leaps};
        const int different = differently_counted(
            trial, trial.leaps,
            [&](const auto& place, const auto& step, const auto&) { return cells(place, step); },
            [&](const auto& ray) { trial.march(ray, trial.leaps); });
        EXPECT_LE(different, 3) << size;
    }
}

TEST(CloudTrace, TakesTheFetchesThatAreCounted) {
    for (const char* size : {"[60, 64, 20]", "[60, 64, 19]"}) {
        const CloudTrial trial(size);
        const int different = differently_counted(
            trial, trial.distances,
            [&](const auto& at, const auto&, const auto& ray) {
                const double share = trial.distance_at({at[0], at[1], at[2]});
                const double metres = std::lerp(double{kEnds.x}, double{kEnds.y}, share);
                return occupancy::stay_of_distance(metres / double{ray.stride});
            },
            [&](const auto& ray) { trial.trace(ray, trial.distances); });
        EXPECT_LE(different, 3) << size;
    }
}

// A grid that is one cell too bold would be noticed.
TEST(CloudMarch, TooLongLeapsWouldBeNoticed) {
    const CloudTrial trial;
    Texture bold = trial.leaps;
    for (float& leap : bold.texels) {
        if (leap > 0) leap += 1.0f / 255;
    }
    EXPECT_GT(march_twice(trial, bold).different, 100);
}

TEST(CloudTrace, DistancesChangeNothing) {
    for (const char* size : {"[60, 64, 20]", "[60, 64, 19]"}) {
        const CloudTrial trial(size);
        const Marches both = trace_twice(trial, trial.distances);
        EXPECT_EQ(both.different, 0) << size;
        EXPECT_GT(both.sum, 0);
        EXPECT_LT(both.looked, 2 * both.steps / 3);
    }
}

// Distances that are a diagonal of a texel too far would be noticed.
TEST(CloudTrace, TooLongDistancesWouldBeNoticed) {
    const CloudTrial trial;
    Texture bold = trial.distances;
    const float more = std::hypot(100.0f, 100.0f, 100.0f);
    for (float& texel : bold.texels) texel += more;
    EXPECT_GT(trace_twice(trial, bold).different, 50);
}

TEST(CloudMarch, AddsUpTheDensities) {
    const CloudTrial trial;
    test::Dice dice;
    for (int i = 0; i < 300; ++i) {
        const CloudTrial::Ray ray = trial.any_ray(dice);
        double sum = 0;
        for (int k = 0; k < ray.count; ++k) {
            const glm::dvec3 p =
                glm::dvec3(ray.from) + glm::dvec3(ray.ray) * (k * double{ray.stride});
            sum += filtered_at(trial.cloud, p / glm::dvec3(trial.tile))[0];
        }
        sum *= double{ray.stride};
        EXPECT_NEAR(trial.march(ray, trial.leaps), sum, 1e-3 * sum + 0.05) << "ray " << i;
    }
}

TEST(CloudLookup, FloatLosesLittle) {
    const CloudTrial trial;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const vec3 p(dice.uniform(-9000, 9000), dice.uniform(-9000, 9000), dice.uniform(0, 1000));
        const float found = gpu::cloud_lookups::cloud_density({trial.cloud}, p, trial.tile);
        const auto wanted = filtered_at(trial.cloud, glm::dvec3(p) / glm::dvec3(trial.tile));
        add_shares(gpu::vec4(found), wanted, trial.baked.asset(), loss);
    });
    expect_little_loss(lost, trial.baked.asset().certificate);
}

TEST(CloudLookup, EdgeIsASmoothStep) {
    test::Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const auto v = static_cast<float>(dice.uniform(0, 1));
        const auto threshold = static_cast<float>(dice.uniform(0, 1));
        const float softness = dice.one_in(5) ? 0.0f : static_cast<float>(dice.uniform(0, 0.3));
        const double x =
            softness > 0 ? std::clamp((double{v} - double{threshold}) / double{softness}, 0.0, 1.0)
                         : 1;
        const double wanted = v > threshold ? double{v} * x * x * (3 - 2 * x) : 0;
        EXPECT_NEAR(gpu::cloud_lookups::cloud_edge(v, threshold, softness), wanted, 2e-5);
    }
}

TEST(CloudLookup, LayerIsBetweenItsFaces) {
    using gpu::cloud_lookups::cloud_layer;
    EXPECT_EQ(cloud_layer(1000, -500, 1), gpu::vec2(500, 1500));
    EXPECT_EQ(cloud_layer(1000, 1500, -0.5f), gpu::vec2(1000, 3000));
    EXPECT_EQ(cloud_layer(1000, 250, -0.5f), gpu::vec2(0, 500));
    const gpu::vec2 away = cloud_layer(1000, 1500, 1);
    EXPECT_GT(away.x, away.y);
    const gpu::vec2 level_above = cloud_layer(1000, 1500, 0);
    EXPECT_GT(level_above.x, level_above.y);
    EXPECT_EQ(cloud_layer(1000, 500, 0).x, 0);
    EXPECT_GT(cloud_layer(1000, 500, 0).y, 1e6f);
}

}  // namespace
}  // namespace skybake

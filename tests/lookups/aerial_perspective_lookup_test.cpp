#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"
#include "config/assets/aerial_perspective.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::aerial_lookups {
#include "lookups/aerial_perspective.glsl.h"
}  // namespace gpu::aerial_lookups

namespace {

using test::BakedLookup;

std::string aerial_recipe(const std::string& keys, const std::string& camera) {
    return "preset = 'earth_hillaire'\n[bake.a]\nasset = 'aerial_perspective'\norders = 'single'\n"
           "pixel_type = 'float'\nsize = [16, 16, 16]\nsun_elevation = '10 deg'\nheading = '40 "
           "deg'\n"
           "aspect = 1.5\n" +
           camera + keys;
}

constexpr const char* kNearGround =
    "altitude = '200 m'\nview_distance = '32 km'\npitch = '5 deg'\n";

struct AerialTrial {
    explicit AerialTrial(const std::string& keys, const std::string& camera_keys = kNearGround)
        : baked(test::bake_all(aerial_recipe(keys, camera_keys))),
          texture(texture_of(baked.asset())),
          bake(baked.recipe.parameters.bakes.front().as<config::AerialPerspectiveBake>()),
          camera(bake, {6360, 100}),
          view_distance_km(bake.view_distance.kilometers()),
          squared(bake.slices == config::SliceSpacing::squared) {}

    // In front of the first slice everything is in proportion to distance, from light 0 and
    // transmittance 1 on.
    std::array<double, 4> in_double(double u, double v, double distance_km) const {
        const double first_km = camera.distance_km(0.5, 0.5, 0.5 / texture.size[2]);
        const double part = distance_km / view_distance_km;
        std::array<double, 4> value = filtered(texture, {u, v, squared ? std::sqrt(part) : part});
        if (distance_km >= first_km) return value;
        const bool transmittance = bake.content == config::AerialContent::transmittance;
        for (std::size_t c = 0; c < 4; ++c) {
            const double at_camera = c == 3 || transmittance ? 1 : 0;
            value[c] = at_camera + (value[c] - at_camera) * (distance_km / first_km);
        }
        return value;
    }
    gpu::vec4 in_float(const gpu::vec2& picture, float distance_km) const {
        return in_float(picture, distance_km, static_cast<float>(view_distance_km));
    }
    gpu::vec4 in_float(const gpu::vec2& picture, float distance_km, float all) const {
        if (bake.content == config::AerialContent::transmittance) {
            return gpu::vec4(
                gpu::aerial_lookups::aerial_transmittance({texture}, gpu::size_of(texture).z,
                                                          picture, distance_km, all, squared),
                1);
        }
        return gpu::aerial_lookups::aerial_perspective({texture}, gpu::size_of(texture).z, picture,
                                                       distance_km, all, squared);
    }

    BakedLookup baked;
    Texture texture;
    config::AerialPerspectiveBake bake;
    AerialCamera camera;
    double view_distance_km;
    bool squared;
};

TEST(AerialPerspectiveLookup, FloatLosesLittle) {
    for (const char* keys : {"", "slices = 'linear'\n", "content = 'transmittance'\n",
                             "slices = 'linear'\ncontent = 'in_scatter'\n"}) {
        SCOPED_TRACE(keys);
        const AerialTrial trial(keys);
        const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const gpu::vec2 picture(dice.uniform(), dice.uniform());
            const auto d =
                static_cast<float>(dice.one_in(2) ? dice.uniform(0, trial.view_distance_km)
                                                  : dice.decades(1e-5, trial.view_distance_km));
            const gpu::vec4 found = trial.in_float(picture, d);
            const std::array<double, 4> wanted =
                trial.in_double(double{picture.x}, double{picture.y}, double{d});
            test::add_shares(found, wanted, trial.baked.asset(), loss);
        });
        expect_little_loss(lost, trial.baked.asset().certificate);
    }
}

// At the camera there is no air between, and light grows in proportion to distance up to slice 0.
TEST(AerialPerspectiveLookup, BeginsWithNothing) {
    for (const char* keys : {"", "slices = 'linear'\n"}) {
        const AerialTrial trial(keys);
        const gpu::vec2 picture(0.3f, 0.6f);
        EXPECT_EQ(trial.in_float(picture, 0), gpu::vec4(0, 0, 0, 1));
        const double first_km = trial.camera.distance_km(0.5, 0.5, 0.5 / trial.texture.size[2]);
        const gpu::vec4 half = trial.in_float(picture, static_cast<float>(0.5 * first_km));
        const gpu::vec4 whole = trial.in_float(picture, static_cast<float>(first_km));
        EXPECT_NEAR(half.x, 0.5f * whole.x, 1e-5f * whole.x);
        EXPECT_GT(whole.x, 0);
    }
}

// A ray goes along forward + tan(fov / 2) (aspect X right + Y up), as the baker's camera has it.
TEST(AerialPerspectiveLookup, PicturesAreTheCameras) {
    const AerialTrial trial("fov = '70 deg'\n");
    const AerialCamera& camera = trial.camera;
    const double pitch = trial.bake.pitch.radians;
    const double heading = trial.bake.heading.radians;
    const double tangent = std::tan(trial.bake.fov.radians / 2);
    const glm::dvec3 ahead(std::cos(heading), std::sin(heading), 0);
    const glm::dvec3 right(-std::sin(heading), std::cos(heading), 0);
    const glm::dvec3 zenith(0, 0, 1);
    const glm::dvec3 forward = std::cos(pitch) * ahead + std::sin(pitch) * zenith;
    const glm::dvec3 up = std::cos(pitch) * zenith - std::sin(pitch) * ahead;
    test::Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const double u = dice.uniform();
        const double v = dice.uniform();
        const glm::dvec3 dir = glm::normalize(
            forward + tangent * (trial.bake.aspect * (2 * u - 1) * right + (1 - 2 * v) * up));
        const ViewDirection view = camera.direction(u, v);
        ASSERT_NEAR(view.mu, dir.z, 1e-12);
        ASSERT_NEAR(view.sine * view.azimuth_cosine, dir.x, 1e-12);
        const gpu::vec2 found = gpu::aerial_lookups::aerial_picture(
            gpu::vec3(dir), gpu::vec3(forward), gpu::vec3(right), gpu::vec3(up),
            static_cast<float>(tangent), static_cast<float>(trial.bake.aspect));
        EXPECT_NEAR(found.x, u, 2e-6);
        EXPECT_NEAR(found.y, v, 2e-6);
    }
}

// A camera in space: the part of a view ray that its slices divide, and what probes say there.
TEST(AerialPerspectiveLookup, FindsTheAirFromSpace) {
    const AerialTrial trial("fov = '60 deg'\n", "altitude = '400 km'\npitch = '-20 deg'\n");
    const AerialCamera& camera = trial.camera;
    ASSERT_TRUE(camera.air());
    const auto way_in_float = [&](double u, double v) {
        const double pitch = trial.bake.pitch.radians;
        return gpu::aerial_lookups::aerial_way(
            gpu::vec2(u, v), gpu::vec2(std::cos(pitch), std::sin(pitch)),
            static_cast<float>(picture_reach(trial.bake)), static_cast<float>(trial.bake.aspect),
            static_cast<float>(camera.radius_km()), 6360.0F, 6460.0F);
    };
    // Where a ray grazes a sphere its last digits decide how much of it it cuts out.
    const auto grazes = [&](double u, double v) {
        const double nearest = camera.radius_km() * camera.direction(u, v).sine;
        return std::fabs(6460 - nearest) < 10 || std::fabs(6360 - nearest) < 10;
    };
    test::Dice dice;
    for (int i = 0; i < 1000; ++i) {
        const double u = dice.uniform();
        const double v = dice.uniform();
        const double tolerance = grazes(u, v) ? 10 : 0.05;
        const gpu::vec2 found = way_in_float(u, v);
        EXPECT_NEAR(found.x, camera.way(u, v).begin_km, tolerance) << u << " " << v;
        EXPECT_NEAR(found.y, camera.way(u, v).reach_km, tolerance) << u << " " << v;
    }
    int tried = 0;
    for (const Probe& probe : trial.baked.asset().levels.front().probes) {
        const double u = probe.uvw[0];
        const double v = probe.uvw[1];
        EXPECT_NEAR(probe.at[2].second, camera.distance_km(u, v, probe.uvw[2]), 1e-6);
        if (grazes(u, v)) continue;
        const gpu::vec2 way = way_in_float(u, v);
        const auto d = static_cast<float>(probe.at[2].second) - way.x;
        test::expect_probe(trial.in_float(gpu::vec2(u, v), d, way.y), probe.value, probe.tolerance,
                           "from space");
        ++tried;
    }
    EXPECT_GT(tried, 5);
}

}  // namespace
}  // namespace skybake

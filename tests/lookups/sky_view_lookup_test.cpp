#include <numbers>

#include "bakers/field/image.h"
#include "bakers/light/sky_view_mapping.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::sky_view_lookup {
#include "lookups/sky_view.glsl.h"
}
namespace gpu::sky_view_by_arc_sines {
#include "lost_digits/sky_view.glsl.h"
}

namespace {

using gpu::vec3;
using test::BakedLookup;

constexpr double kHalfPi = 0.5 * std::numbers::pi;

// Closer to the horizon, in radians, a direction of floats does not tell sky from ground.
constexpr double kUndecided = 5e-7;

struct ViewPlace : test::EngineView {
    int k = 0;
};

class SkyViewTrial {
  public:
    explicit SkyViewTrial(double altitude_km)
        : baked_(test::bake_all(recipe_at(altitude_km))),
          texture_(texture_of(baked_.asset())),
          shell_(baked_.shell()),
          altitude_km_(altitude_km),
          camera_(shell_, altitude_km) {
        for (const float texel : texture_.texels) largest_ = std::max(largest_, double{texel});
    }

    // A direction by its angle above the horizon and its azimuth from the sun k.
    ViewPlace place(double above_horizon, double azimuth, int k, const glm::dvec3& up) const {
        const double sun_elevation = kSuns[static_cast<std::size_t>(k)] * kHalfPi / 90;
        return {test::engine_view(above_horizon - camera_.dip(), azimuth, sun_elevation, up), k};
    }

    ViewPlace any_place(test::Dice& dice) const {
        const bool below = dice.one_in(2);
        const double range = below ? -camera_.range_below()
                                   : std::min(1.1 * camera_.range_above(), kHalfPi + camera_.dip());
        return place(dice.angle(0, range), dice.angle(0, std::numbers::pi),
                     static_cast<int>(2 * dice.uniform()), dice.direction());
    }

    vec3 in_float(const ViewPlace& at) const {
        return gpu::sky_view_lookup::sky_view(
            {texture_}, size_of_one(), static_cast<float>(shell_.ground_radius_km),
            static_cast<float>(shell_.thickness_km), static_cast<float>(altitude_km_), at.dir,
            at.up, at.sun, at.k, 2);
    }
    gpu::vec2 size_of_one() const { return {texture_.size[0], texture_.size[1] / 2}; }
    vec3 in_float_by_arc_sines(const ViewPlace& at) const {
        return gpu::sky_view_by_arc_sines::sky_view({texture_}, static_cast<float>(altitude_km_),
                                                    at.dir, at.up, at.sun, static_cast<float>(at.k),
                                                    2, size_of_one());
    }

    // Above the horizon, in radians, of the direction as floats have it.
    double angle_of(const ViewPlace& at) const {
        const glm::dvec3 dir(at.dir);
        const glm::dvec3 up = glm::normalize(glm::dvec3(at.up));
        const double mu = glm::dot(dir, up);
        return std::atan2(mu, glm::length(dir - mu * up)) + camera_.dip();
    }
    std::array<double, 4> in_double(const ViewPlace& at) const {
        const double angle = angle_of(at);
        if (camera_.in_space() && angle > camera_.range_above()) return {};
        const glm::dvec3 up = glm::normalize(glm::dvec3(at.up));
        const glm::dvec3 view = glm::dvec3(at.dir) - glm::dot(glm::dvec3(at.dir), up) * up;
        const glm::dvec3 sun = glm::dvec3(at.sun) - glm::dot(glm::dvec3(at.sun), up) * up;
        const double azimuth = std::atan2(glm::length(glm::cross(view, sun)), glm::dot(view, sun));
        const double y = std::min(camera_.coordinate(angle), 1.0);
        const double u = texture_coordinate(TexelConvention::end_points_on_texel_centres,
                                            azimuth / std::numbers::pi, texture_.size[0]);
        return filtered(texture_, {u, (at.k + sky_view_v(y, texture_.size[1] / 2)) / 2, 0.5});
    }

    template <class Lookup>
    test::Loss loss(const Lookup& lookup) const {
        return test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const ViewPlace at = any_place(dice);
            if (std::fabs(angle_of(at)) < kUndecided) return;
            test::add_relative(lookup(at), in_double(at), largest_, loss);
        });
    }

    const Baked& table() const { return baked_.asset(); }

  private:
    static constexpr std::array kSuns = {30.0, -4.0};

    static std::string recipe_at(double altitude_km) {
        return "preset = 'earth_hillaire'\n[bake.sky_view]\norders = 'single'\nsize = [64, 36]\n"
               "sun_elevations = ['30 deg', '-4 deg']\naltitude = '" +
               std::to_string(altitude_km) + " km'\n";
    }

    BakedLookup baked_;
    Texture texture_;
    Shell shell_;
    double altitude_km_;
    SkyViewCamera camera_;
    double largest_ = 0;
};

// From the ground, in the air, at its top, just above it and in orbit.
TEST(SkyViewLookup, FloatLosesLittle) {
    for (const double altitude_km : {0.0, 0.002, 12.0, 100.0, 100.01, 400.0}) {
        SCOPED_TRACE(altitude_km);
        const SkyViewTrial trial(altitude_km);
        expect_little_loss(trial.loss([&](const ViewPlace& at) { return trial.in_float(at); }),
                           trial.table().certificate);
    }
}

TEST(SkyViewLookup, ArcSinesWouldBeNoticed) {
    const SkyViewTrial trial(400);
    const test::Loss loss =
        trial.loss([&](const ViewPlace& at) { return trial.in_float_by_arc_sines(at); });
    const ErrorFigures& own = trial.table().certificate.lookup;
    EXPECT_FALSE(loss.is_a_tenth_of(own)) << loss.text(own);
}

// Straight up and down, where there is no azimuth, no lookup is undefined.
TEST(SkyViewLookup, HasAValueWhereThereIsNoAzimuth) {
    const SkyViewTrial trial(0.5);
    for (const float z : {-1.0f, 1.0f}) {
        const ViewPlace at{{{0, 0, z}, {0, 0, 1}, {1, 0, 0}}, 0};
        const vec3 found = trial.in_float(at);
        const std::array<double, 4> wanted = trial.in_double(at);
        EXPECT_NEAR(found.x, wanted[0], 1e-5 * wanted[0]);
        const vec3 sun_above = trial.in_float({{{0.6f, 0, 0.8f * z}, {0, 0, 1}, {0, 0, 1}}, 0});
        EXPECT_TRUE(std::isfinite(sun_above.x));
    }
}

}  // namespace
}  // namespace skybake

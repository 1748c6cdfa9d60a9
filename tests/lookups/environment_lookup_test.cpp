#include <numbers>

#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::environment_lookup {
#include "lookups/environment.glsl.h"
}

namespace {

using gpu::vec3;
using test::BakedLookup;

constexpr double kPi = std::numbers::pi;

class EnvironmentTrial {
  public:
    EnvironmentTrial()
        : baked_(test::bake_all("preset = 'earth_hillaire'\n[bake.environment]\norders = 'single'\n"
                                "size = [64, 32]\naltitude = '1 km'\n"
                                "sun_elevation = '20 deg'\n")),
          texture_(texture_of(baked_.asset())) {
        for (const float texel : texture_.texels) largest_ = std::max(largest_, double{texel});
    }

    vec3 in_float(double azimuth, double elevation, const glm::dvec3& up) const {
        const auto at = test::engine_view(elevation, azimuth, 20 * kPi / 180, up);
        return gpu::environment_lookup::environment({texture_}, at.dir, at.up, at.sun);
    }
    std::array<double, 4> in_double(double azimuth, double elevation) const {
        return filtered(texture_, {azimuth / (2 * kPi) + 0.5, 0.5 - elevation / kPi, 0.5});
    }

    const Baked& table() const { return baked_.asset(); }
    double largest() const { return largest_; }

  private:
    BakedLookup baked_;
    Texture texture_;
    double largest_ = 0;
};

TEST(EnvironmentLookup, FloatLosesLittle) {
    const EnvironmentTrial trial;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const double azimuth = dice.angle(-kPi, kPi);
        const double elevation = dice.angle(-kPi / 2, kPi / 2);
        const vec3 found = trial.in_float(azimuth, elevation, dice.direction());
        test::add_relative(found, trial.in_double(azimuth, elevation), trial.largest(), loss);
    });
    expect_little_loss(lost, trial.table().certificate);
}

// Straight up and down, where there is no azimuth, no lookup is undefined.
TEST(EnvironmentLookup, HasAValueWhereThereIsNoAzimuth) {
    const EnvironmentTrial trial;
    for (const float z : {-1.0f, 1.0f}) {
        const vec3 found = gpu::environment_lookup::environment({texture_of(trial.table())},
                                                                {0, 0, z}, {0, 0, 1}, {1, 0, 0});
        EXPECT_TRUE(std::isfinite(found.x) && found.x >= 0);
    }
}

}  // namespace
}  // namespace skybake

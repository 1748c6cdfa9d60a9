// The march of a runtime with stored tables, beside quadrature that shares neither steps nor tables.
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/plan/light_truth.h"
#include "bakers/render/sky_view.h"
#include "config/assets/multiple_scattering.h"

namespace skybake {
namespace {

class StoredSky : public ::testing::Test {
  protected:
    StoredSky()
        : recipe_(
              *config::parse_recipe("preset = \"earth_hillaire\"\n[atmosphere]\nground_albedo = 0\n"
                                    "[bake.t]\nasset = \"transmittance\"\nsize = [512, 128]\n"
                                    "[bake.m]\nasset = \"multiple_scattering\"\n"
                                    "size = [64, 64]\ncontent = \"moments\"\ndegree = 4\n",
                                    "recipe")
                   .value),
          medium_(make_sky_medium(recipe_.parameters.atmosphere)),
          transmittance_(baked("t")),
          moments_(baked("m")),
          views_(scene_views(config::Draws::sky, {0, 3, 5, 80, {}, 64}, shell(), 48, 1)) {}

    Shell shell() const { return shell_of(recipe_.parameters.atmosphere); }

    Baked baked(const std::string& name) const {
        const config::Bake& bake = config::bake_named(recipe_.parameters, name);
        return *bake_asset(recipe_, bake, {.certification = Certification::off}).value;
    }

    std::vector<Spectrum> march(const Baked& moments, int steps, int threads = 1,
                                const std::vector<double>& reaches_km = {}) const {
        const PreviewAsset transmittance = {describe(transmittance_), transmittance_.image(), {}};
        const PreviewAsset scattering = {describe(moments), moments.image(), {}};
        std::vector<SkyRay> rays;
        for (const auto& [view, distance_km] : views_) {
            rays.push_back(sky_ray(shell(), view.altitude_km, view.sun, view.direction));
        }
        return march_sky(medium_, *make_sky_tables(transmittance, &scattering).value, rays, steps,
                         threads, reaches_km);
    }

    // The largest relative difference from quadrature with the same moments and exact sunlight.
    double error(const Baked& moments, int steps) const {
        const auto orders = stored_orders(
            recipe_.parameters,
            config::bake_named(recipe_.parameters, "m").as<config::MultipleScatteringBake>(),
            medium_, moments_.image());
        const SkyIntegrator integrator(medium_, orders.get());
        const std::vector<Spectrum> found = march(moments, steps);
        double largest = 0;
        for (std::size_t i = 0; i < views_.size(); ++i) {
            const SkySample& view = views_[i].sky;
            const SkyRadiance exact =
                integrator.radiance(view.altitude_km, view.sun, view.direction);
            for (std::size_t c = 0; c < 3; ++c) {
                const double wanted = exact.single[c] + exact.multiple[c];
                largest = std::max(largest, std::fabs(found[i][c] / wanted - 1));
            }
        }
        return largest;
    }

    config::Recipe recipe_;
    SkyMedium medium_;
    Baked transmittance_;
    Baked moments_;
    std::vector<LightView> views_;
};

// A step's error falls with its square.
TEST_F(StoredSky, ConvergesToQuadrature) {
    const double few = error(moments_, 16);
    const double more = error(moments_, 32);
    EXPECT_LT(error(moments_, 512), 1e-3);
    EXPECT_GT(few, 3 * more);
    EXPECT_GT(few, 1e-2);
}

// Zeros, the table upside down and half a texel beside show.
TEST_F(StoredSky, WrongTablesShow) {
    const Image2<float>& right = moments_.image();
    Image2<float> zeros = right;
    std::fill(zeros.texels.begin(), zeros.texels.end(), 0.0f);
    Image2<float> flipped = right;
    std::reverse(flipped.texels.begin(), flipped.texels.end());
    for (const Image2<float>& wrong : {zeros, flipped}) {
        Baked table = moments_;
        set_image(wrong, table);
        EXPECT_GT(error(table, 512), 0.05);
    }
}

// A ray that ends beyond the air is the whole ray, to the bit; a short one holds the light of its
// beginning; and light only adds up with the distance.
TEST_F(StoredSky, MarchesUpToADistance) {
    const std::vector<Spectrum> whole = march(moments_, 64);
    EXPECT_EQ(march(moments_, 64, 1, std::vector<double>(views_.size(), 1e5)), whole);
    const double short_km = 0.01;
    const auto near = march(moments_, 64, 1, std::vector<double>(views_.size(), short_km));
    const auto twice = march(moments_, 64, 1, std::vector<double>(views_.size(), 2 * short_km));
    const auto far = march(moments_, 64, 1, std::vector<double>(views_.size(), 20.0));
    for (std::size_t i = 0; i < views_.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_NEAR(twice[i][c] / near[i][c], 2, 0.02) << i;
            EXPECT_GT(far[i][c], twice[i][c]) << i;
            EXPECT_LT(far[i][c], whole[i][c] * 1.001) << i;
        }
    }
}

TEST_F(StoredSky, SameBitsForAnyThreads) {
    EXPECT_EQ(march(moments_, 8, 1), march(moments_, 8, 3));
}

}  // namespace
}  // namespace skybake

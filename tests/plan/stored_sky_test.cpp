// The march of a runtime with stored tables, beside quadrature that shares neither steps nor tables.
#include <gtest/gtest.h>

#include <cmath>

#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/light/sky_radiance.h"
#include "bakers/plan/sky_truth.h"
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
          views_(scene_views({0, 3, 5, 80, {}}, shell(), 48, 1)) {}

    Shell shell() const { return shell_of(recipe_.parameters.atmosphere); }

    Baked baked(const std::string& name) const {
        const config::Bake& bake = config::bake_named(recipe_.parameters, name);
        return *bake_asset(recipe_, bake, {.certification = Certification::off}).value;
    }

    std::vector<Spectrum> march(const Baked& moments, int steps, int threads = 1) const {
        const PreviewAsset transmittance = {describe(transmittance_), transmittance_.image(), {}};
        const PreviewAsset scattering = {describe(moments), moments.image(), {}};
        std::vector<SkyRay> rays;
        for (const SkySample& view : views_) {
            rays.push_back(camera_ray(shell(), view.altitude_km, view.sun, view.direction).in_air);
        }
        return march_sky(medium_, *make_sky_tables(transmittance, &scattering).value, rays, steps,
                         threads);
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
            const SkyRadiance exact =
                integrator.radiance(views_[i].altitude_km, views_[i].sun, views_[i].direction);
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
    std::vector<SkySample> views_;
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

TEST_F(StoredSky, SameBitsForAnyThreads) {
    EXPECT_EQ(march(moments_, 8, 1), march(moments_, 8, 3));
}

}  // namespace
}  // namespace skybake

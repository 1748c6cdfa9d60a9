// Factors of light that goes on by small angles: lookups in float against the table in double.
#include <cmath>

#include "bakers/assets/forward_scattering/forward_table.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::forward_lookups {
#include "lookups/forward_scattering.glsl.h"
}  // namespace gpu::forward_lookups

namespace {

TEST(ForwardScatteringLookup, FloatLosesLittle) {
    const test::BakedLookup baked = test::bake_all("[bake.a]\nasset = 'forward_scattering'\n");
    const Texture texture = texture_of(baked.asset());
    constexpr auto kConvention = TexelConvention::end_points_on_texel_centres;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        // All angles, also those of the peak, and depths beyond the deepest texel.
        const auto offset = static_cast<float>(2 * std::pow(dice.uniform(0, 1), 4));
        const auto depth = static_cast<float>(300 * std::pow(dice.uniform(0, 1), 2));
        const double x = std::sqrt(std::sqrt(double{offset} / 2));
        const double y = forward_scattering::depth_coordinate(double{depth});
        const double wanted =
            filtered(texture, {texture_coordinate(kConvention, x, texture.size[0]),
                               texture_coordinate(kConvention, y, texture.size[1]), 0.5})[0];
        const float found = gpu::forward_lookups::forward_scattering(
            {texture}, gpu::vec2(gpu::size_of(texture)), offset, depth);
        loss.add(double{found} - wanted);
    });
    test::expect_little_loss(lost, baked.asset().certificate);
}

TEST(ForwardScatteringLookup, IsOneWhereTheSunIsNotHidden) {
    const test::BakedLookup baked = test::bake_all("[bake.a]\nasset = 'forward_scattering'\n");
    const Texture texture = texture_of(baked.asset());
    for (const float offset : {0.0F, 1e-6F, 0.01F, 1.0F, 2.0F}) {
        EXPECT_NEAR(gpu::forward_lookups::forward_scattering(
                        {texture}, gpu::vec2(gpu::size_of(texture)), offset, 0),
                    1, 1e-6);
    }
}

}  // namespace
}  // namespace skybake

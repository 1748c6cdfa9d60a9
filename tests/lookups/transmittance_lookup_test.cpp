#include "bakers/air/transmittance_mapping.h"
#include "bakers/field/image.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::transmittance_lookups {
#include "lookups/transmittance.glsl.h"
}

namespace {

using gpu::transmittance_lookups::transmittance_to_top;
using gpu::transmittance_lookups::transmittance_to_top_ue;
using test::BakedLookup;

struct TransmittanceTrial {
    explicit TransmittanceTrial(const std::string& planet, bool ue_mapping)
        : baked(test::bake_all("preset = '" + planet + "'\n[bake.transmittance]\nmapping = '" +
                               (ue_mapping ? "ue" : "bruneton") + "'\n")),
          texture(texture_of(baked.asset())),
          shell(baked.shell()),
          ue(ue_mapping) {}

    gpu::vec3 in_float(float h, float mu) const {
        const auto R = static_cast<float>(shell.ground_radius_km);
        const auto D = static_cast<float>(shell.thickness_km);
        return ue ? transmittance_to_top_ue({texture}, R, D, h, mu)
                  : transmittance_to_top({texture}, gpu::vec2(gpu::size_of(texture)), R, D, h, mu);
    }
    std::array<double, 4> in_double(double h, double mu) const {
        const UnitCoordinates x = transmittance_coordinates(shell, h, mu);
        const auto convention = ue ? TexelConvention::end_points_on_edges
                                   : TexelConvention::end_points_on_texel_centres;
        return filtered(texture, {texture_coordinate(convention, x.x_mu, texture.size[0]),
                                  texture_coordinate(convention, x.x_r, texture.size[1]), 0.5});
    }

    BakedLookup baked;
    Texture texture;
    Shell shell;
    bool ue;
};

TEST(TransmittanceLookup, FloatLosesLittle) {
    for (const char* planet : {"earth_hillaire", "tiny_planet"}) {
        for (const bool ue : {false, true}) {
            SCOPED_TRACE(std::string(planet) + (ue ? ", ue" : ", bruneton"));
            const TransmittanceTrial trial(planet, ue);
            const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
                const float h = dice.altitude_km(trial.shell.thickness_km);
                const double angle = dice.angle(test::horizon_angle(trial.shell, double{h}), 0);
                const auto mu = static_cast<float>(std::cos(angle));
                const gpu::vec3 found = trial.in_float(h, mu);
                const std::array<double, 4> wanted = trial.in_double(double{h}, double{mu});
                for (int c = 0; c < 3; ++c) {
                    loss.add(double{found[c]} - wanted[static_cast<std::size_t>(c)]);
                }
            });
            expect_little_loss(lost, trial.baked.asset().certificate);
        }
    }
}

}  // namespace
}  // namespace skybake

#include "bakers/air/particles/phase_function.h"
#include "bakers/assets/bruneton/scattering_mapping.h"
#include "bakers/field/image.h"
#include "config/sections/layer.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::bruneton_lookups {
#include "lookups/bruneton.glsl.h"
}
namespace gpu::bruneton_by_squares {
#include "lost_digits/bruneton.glsl.h"
}

namespace {

constexpr double kDarkestSun = -0.2;
constexpr int kSubImages = 4;

// A ray, a sun and the angle between them, as floats.
struct ScatteringPlace {
    float h = 0, mu = 0, mu_s = 0, nu = 0;
    bool ground = false;
};

struct ScatteringTrial {
    ScatteringTrial()
        : baked(test::bake_all("preset = 'earth_hillaire'\n"
                               "[bake.a]\nasset = 'bruneton'\ntable = 'single_mie'\n"
                               "pixel_type = 'float'\nsize = [64, 64, 16]\nnu_size = 4\n"
                               "sun_cos_zenith_min = -0.2\n")),
          texture(texture_of(baked.asset())),
          shell(baked.shell()),
          mapping(shell, texture.size, kSubImages, kDarkestSun) {
        for (const float texel : texture.texels) largest = std::max(largest, double{texel});
    }

    ScatteringPlace any_place(test::Dice& dice) const {
        ScatteringPlace at;
        at.h = dice.altitude_km(shell.thickness_km);
        at.ground = dice.one_in(2);
        const double horizon = test::horizon_angle(shell, double{at.h});
        at.mu = static_cast<float>(std::cos(dice.angle(horizon, at.ground ? std::numbers::pi : 0)));
        const double terminator = (dice.one_in(2) ? -1 : 1) * dice.decades(1e-6, 1);
        const double mu_s =
            dice.one_in(2) ? dice.uniform(kDarkestSun, 1) : std::max(terminator, kDarkestSun);
        at.mu_s = static_cast<float>(mu_s);
        const FeasibleCosines nu = feasible_cosines(double{at.mu}, double{at.mu_s});
        at.nu = static_cast<float>(std::clamp(dice.uniform(nu.low, nu.high), -1.0, 1.0));
        return at;
    }

    gpu::vec4 in_float(const ScatteringPlace& at) const {
        return gpu::bruneton_lookups::bruneton_scattering(
            {texture}, gpu::size_of(texture), static_cast<float>(shell.ground_radius_km),
            static_cast<float>(shell.thickness_km), at.h, at.mu, at.mu_s, at.nu, at.ground,
            static_cast<float>(kDarkestSun), kSubImages);
    }
    gpu::vec4 in_float_by_squares(const ScatteringPlace& at) const {
        return gpu::bruneton_by_squares::lookUpScattering(
            {texture}, static_cast<float>(shell.ground_radius_km) + at.h, at.mu, at.mu_s, at.nu,
            at.ground);
    }
    std::array<double, 4> in_double(const ScatteringPlace& at) const {
        ScatteringView view;
        view.altitude_km = double{at.h};
        view.s_km = (shell.ground_radius_km + view.altitude_km) * double{at.mu};
        view.meets_ground = at.ground;
        view.length_km = at.ground ? distance_to_ground_km(shell, view.altitude_km, view.s_km)
                                   : distance_to_top_km(shell, view.altitude_km, view.s_km);
        return at_coordinates(mapping.coordinates(view, double{at.mu_s}, double{at.nu}));
    }
    std::array<double, 4> at_coordinates(const ScatteringCoordinates& x) const {
        constexpr auto kEnds = TexelConvention::end_points_on_texel_centres;
        const double u = texture_coordinate(kEnds, x.x_mu_s, mapping.sun_size());
        const double v = 0.5 * texture_coordinate(kEnds, x.x_mu, mapping.half_size());
        const double w = texture_coordinate(kEnds, x.x_r, texture.size[2]);
        const double position = x.x_nu * (kSubImages - 1);
        const double image = std::min(std::floor(position), kSubImages - 2.0);
        const auto of_image = [&](double i) {
            return filtered(texture, {(i + u) / kSubImages, x.meets_ground ? 0.5 - v : 0.5 + v, w});
        };
        const std::array<double, 4> low = of_image(image);
        std::array<double, 4> value = of_image(image + 1);
        for (std::size_t c = 0; c < 4; ++c)
            value[c] = low[c] + (value[c] - low[c]) * (position - image);
        return value;
    }

    template <class Lookup>
    test::Loss loss(const Lookup& lookup) const {
        return test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
            const ScatteringPlace at = any_place(dice);
            test::add_relative(lookup(at), in_double(at), largest, loss);
        });
    }

    test::BakedLookup baked;
    Texture texture;
    Shell shell;
    ScatteringMapping mapping;
    double largest = 0;
};

TEST(BrunetonLookup, FloatLosesLittle) {
    const ScatteringTrial trial;
    expect_little_loss(trial.loss([&](const auto& at) { return trial.in_float(at); }),
                       trial.baked.asset().certificate);
}

TEST(BrunetonLookup, DifferencesOfSquaresWouldBeNoticed) {
    const ScatteringTrial trial;
    const test::Loss loss =
        trial.loss([&](const auto& at) { return trial.in_float_by_squares(at); });
    const ErrorFigures& own = trial.baked.asset().certificate.lookup;
    EXPECT_FALSE(loss.is_a_tenth_of(own)) << loss.text(own);
}

// Every texel is where the mapping has it, but for what a cosine of float moves a ray at the
// horizon.
TEST(BrunetonLookup, FindsTheTexels) {
    const ScatteringTrial trial;
    const Texture& texture = trial.texture;
    for (int u = 0; u < texture.size[0]; u += 3) {
        for (int v = 0; v < texture.size[1]; ++v) {
            for (int w = 1; w < texture.size[2]; ++w) {
                const ScatteringView view = trial.mapping.view_of_texel(v, w);
                ScatteringPlace at;
                at.h = static_cast<float>(view.altitude_km);
                at.mu = static_cast<float>(view.s_km /
                                           (trial.shell.ground_radius_km + view.altitude_km));
                at.mu_s = static_cast<float>(trial.mapping.sun_of_texel(u));
                at.nu = static_cast<float>(trial.mapping.nu_of_texel(u));
                at.ground = view.meets_ground;
                const double wanted = double{texture.texel({u, v, w}, 0)};
                EXPECT_NEAR(trial.in_float(at).x, wanted, 5e-3 * wanted + 1e-5 * trial.largest);
            }
        }
    }
}

TEST(BrunetonIrradianceLookup, FloatLosesLittle) {
    const test::BakedLookup baked = test::bake_all(
        "preset = 'earth_hillaire'\n[bake.a]\nasset = 'bruneton'\ntable = 'irradiance'\norders = "
        "1\n"
        "pixel_type = 'float'\nsize = [32, 8, 1]\n");
    const Texture texture = texture_of(baked.asset());
    const Shell shell = baked.shell();
    const ValueStatistics& red = baked.asset().levels.front().statistics.front();
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const float h = dice.altitude_km(shell.thickness_km);
        const auto mu_s = static_cast<float>(dice.uniform(-1, 1));
        const gpu::vec3 found = gpu::bruneton_lookups::bruneton_irradiance(
            {texture}, gpu::vec2(gpu::size_of(texture)), static_cast<float>(shell.thickness_km), h,
            mu_s);
        const std::array<double, 4> wanted = filtered(
            texture,
            {(0.5 + 0.5 * (double{mu_s} + 1) * (texture.size[0] - 1)) / texture.size[0],
             (0.5 + double{h} / shell.thickness_km * (texture.size[1] - 1)) / texture.size[1],
             0.5});
        loss.add((double{found.x} - wanted[0]) / (red.max - red.min));
    });
    expect_little_loss(lost, baked.asset().certificate);
}

TEST(BrunetonLookup, PhaseFunctionsAreTheBakers) {
    for (int i = 0; i <= 200; ++i) {
        const double nu = 0.01 * i - 1;
        const auto cosine = static_cast<float>(nu);
        const double rayleigh = 3 / (16 * std::numbers::pi) * (1 + nu * nu);
        EXPECT_NEAR(gpu::bruneton_lookups::rayleigh_phase(cosine), rayleigh, 1e-6 * rayleigh);
        for (const double g : {0.0, 0.76, 0.8, -0.3}) {
            const PhaseFunction phase = make_phase_function(config::Phase::cornette_shanks, g);
            const double wanted = phase_value(phase, 1 - nu, 1 + nu);
            EXPECT_NEAR(gpu::bruneton_lookups::mie_phase(cosine, static_cast<float>(g)), wanted,
                        1e-5 * wanted);
        }
    }
}

}  // namespace
}  // namespace skybake

#include "bakers/assets/optical_depth/column_kinds.h"
#include "config/assets/optical_depth.h"
#include "tests/lookups/lookup_trial.h"

namespace skybake {
namespace gpu::column_lookups {
#include "lookups/columns.glsl.h"
}  // namespace gpu::column_lookups

namespace {

using config::OpticalDepthBake;

// A path of floats: from an altitude along a zenith angle, over a length, up to another altitude.
struct FloatPath {
    float h = 0, mu = 0, d = 0, end = 0;
};

struct ColumnTrial {
    explicit ColumnTrial(const std::string& keys)
        : baked(test::bake_all(
              "preset = 'earth_hillaire'\n[atmosphere.layers.dust]\npreset = 'dust'\n"
              "[atmosphere.layers.fog]\npreset = 'fog'\n"
              "[atmosphere.layers.rain]\npreset = 'rain'\n[bake.a]\n"
              "asset = 'optical_depth'\npixel_type = 'float'\n"
              "kinds = ['rayleigh', 'dust', 'fog', 'rain']\n" +
              keys)),
          bake(baked.recipe.parameters.bakes.front().as<OpticalDepthBake>()),
          kinds(make_column_kinds(baked.recipe.parameters.atmosphere, bake.kinds)),
          texture(texture_of(baked.asset())),
          geometry(column_geometry(kinds)),
          table(bake, geometry),
          air{static_cast<float>(geometry.shell.ground_radius_km),
              static_cast<float>(geometry.shell.thickness_km),
              static_cast<float>(geometry.scale.fine_km)} {}

    // Columns in km, as lookups return them.
    std::array<double, 4> in_double(const ColumnPath& path) const {
        std::array<double, 4> columns = filtered(texture, table.texture_coordinates(path));
        for (double& column : columns) column = mean_density_of_stored(column) * path.length_km;
        return columns;
    }

    // Adds the errors of the transmittance of each kind alone and of all together.
    void add_errors(const gpu::vec4& found, const std::array<double, 4>& wanted,
                    test::Loss& loss) const {
        for (std::size_t c = 0; c < 3; ++c) {
            double depth_found = 0;
            double depth_wanted = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                const double extinction = kinds[k].extinction_per_km[c];
                const double column = double{found[static_cast<gpu::vec4::length_type>(k)]};
                loss.add(std::exp(-extinction * column) - std::exp(-extinction * wanted[k]));
                depth_found += extinction * column;
                depth_wanted += extinction * wanted[k];
            }
            loss.add(std::exp(-depth_found) - std::exp(-depth_wanted));
        }
    }

    // Within the air: up to the top or to the ground, near the horizon more often than not.
    FloatPath any_path(test::Dice& dice) const {
        const Shell& shell = geometry.shell;
        FloatPath path;
        path.h = dice.altitude_km(shell.thickness_km);
        const double h = double{path.h};
        const bool ground = dice.one_in(2);
        path.mu = static_cast<float>(
            std::cos(dice.angle(test::horizon_angle(shell, h), ground ? std::numbers::pi : 0)));
        const double s = (shell.ground_radius_km + h) * double{path.mu};
        const bool falls = s < -horizon_distance_km(shell, h);
        const double longest =
            falls ? distance_to_ground_km(shell, h, s) : distance_to_top_km(shell, h, s);
        const double part = dice.one_in(2) ? dice.uniform() : dice.decades(1e-6, 1);
        path.d = static_cast<float>(longest * part);
        path.end = static_cast<float>(
            std::clamp(altitude_along_km(shell, h, s, double{path.d}), 0.0, shell.thickness_km));
        return path;
    }

    test::BakedLookup baked;
    OpticalDepthBake bake;
    std::vector<ColumnKind> kinds;
    Texture texture;
    ColumnGeometry geometry;
    ColumnTable table;
    gpu::column_lookups::ColumnShell air;
};

// At 256x128 texels the RMS is a hundredth of the table's own, but the maximum a sixth: for rays
// that graze fog within millimetres of the ground, as r mu in float is off by as much.
TEST(ColumnLookup, FloatLosesLittleToTheTop) {
    const ColumnTrial trial("size = [128, 64, 1]\n");
    const Shell& shell = trial.geometry.shell;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const float h = dice.altitude_km(shell.thickness_km);
        const double angle = dice.angle(test::horizon_angle(shell, double{h}), 0);
        const auto mu = static_cast<float>(std::cos(angle));
        const double s = std::max((shell.ground_radius_km + double{h}) * double{mu},
                                  -horizon_distance_km(shell, double{h}));
        const gpu::vec4 found = gpu::column_lookups::column_to_top(
            {trial.texture}, gpu::vec2(gpu::size_of(trial.texture)), trial.air, h, mu);
        const ColumnPath path{double{h}, s, distance_to_top_km(shell, double{h}, s)};
        trial.add_errors(found, trial.in_double(path), loss);
    });
    expect_little_loss(lost, trial.baked.asset().certificate);
}

TEST(ColumnLookup, FloatLosesLittleBetweenPoints) {
    const ColumnTrial trial("table = 'between'\nsize = [32, 32, 32]\n");
    const double R = trial.geometry.shell.ground_radius_km;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const FloatPath path = trial.any_path(dice);
        const gpu::vec4 found = gpu::column_lookups::column_between(
            {trial.texture}, gpu::size_of(trial.texture), trial.air, path.h, path.end, path.d);
        // The triangle of both points and the centre, by the altitudes and the distance as floats.
        const double low = std::min(double{path.h}, double{path.end});
        const double gain = std::max(double{path.h}, double{path.end}) - low;
        const double d = std::max(double{path.d}, gain);
        const double s = d > 0 ? 0.5 * (gain * (gain + 2 * (R + low)) / d - d) : R + low;
        trial.add_errors(found, trial.in_double({low, s, d}), loss);
    });
    expect_little_loss(lost, trial.baked.asset().certificate);
}

TEST(ColumnLookup, FloatLosesLittleAlongRays) {
    const ColumnTrial trial("table = 'between'\ncoordinates = 'distance'\nsize = [32, 32, 32]\n");
    const double R = trial.geometry.shell.ground_radius_km;
    const test::Loss lost = test::loss_at_places([&](test::Dice& dice, test::Loss& loss) {
        const FloatPath path = trial.any_path(dice);
        const gpu::vec4 found = gpu::column_lookups::column_along(
            {trial.texture}, gpu::size_of(trial.texture), trial.air, path.h, path.mu, path.d);
        const double h = double{path.h};
        trial.add_errors(found, trial.in_double({h, (R + h) * double{path.mu}, double{path.d}}),
                         loss);
    });
    expect_little_loss(lost, trial.baked.asset().certificate);
}

TEST(ColumnLookup, FloatLosesLittleOfDensitiesAndPhases) {
    const ColumnTrial densities("table = 'density'\nsize = [256, 1, 1]\n");
    const ColumnTrial phases("table = 'phase'\nsize = [256, 1, 1]\n");
    test::Dice dice;
    test::Loss density_loss;
    test::Loss phase_loss;
    const auto x_of_u = [](double x, int size) { return (0.5 + x * (size - 1)) / size; };
    for (int i = 0; i < test::kPlaces; ++i) {
        const float h = dice.altitude_km(densities.geometry.shell.thickness_km);
        const gpu::vec4 density =
            gpu::column_lookups::column_density({densities.texture}, 256, densities.air, h);
        const std::array<double, 4> wanted_density =
            filtered(densities.texture,
                     {x_of_u(scaled_altitude(densities.geometry.scale, double{h}), 256), 0.5, 0.5});
        const double angle =
            dice.angle(dice.one_in(2) ? 0 : std::numbers::pi, 0.5 * std::numbers::pi);
        const gpu::vec3 a(1, 0, 0);
        const gpu::vec3 b(std::cos(angle), std::sin(angle), 0);
        const gpu::vec4 phase = gpu::column_lookups::column_phase({phases.texture}, 256, a, b);
        const glm::dvec3 unit = glm::normalize(glm::dvec3(b));
        const double exact = std::atan2(unit.y, unit.x);
        const std::array<double, 4> wanted_phase =
            filtered(phases.texture, {x_of_u(std::sqrt(exact / std::numbers::pi), 256), 0.5, 0.5});
        test::add_shares(density, wanted_density, densities.baked.asset(), density_loss);
        for (std::size_t k = 0; k < 4; ++k) {
            const auto channel = static_cast<gpu::vec4::length_type>(k);
            phase_loss.add(double{phase[channel]} / wanted_phase[k] - 1);
        }
    }
    {
        SCOPED_TRACE("density");
        expect_little_loss(density_loss, densities.baked.asset().certificate);
    }
    SCOPED_TRACE("phase");
    expect_little_loss(phase_loss, phases.baked.asset().certificate);
}

// The horizon's cosine is a float; those beside it are rays a few millimetres off. Rounding must not
// decide between texels of two kinds of rays, which hold errors that differ by several per cent. Within
// a kind, two centimetres of the lowest altitude change columns by up to one per cent.
TEST(ColumnLookup, IsTheSameOneFloatAboveAndBelowTheHorizon) {
    const ColumnTrial trial("table = 'between'\ncoordinates = 'distance'\nsize = [32, 32, 32]\n");
    const Shell& shell = trial.geometry.shell;
    for (const float h : {0.01F, 0.5F, 8.0F, 69.263901F}) {
        const double rho = horizon_distance_km(shell, double{h});
        const auto at_horizon = static_cast<float>(-rho / (shell.ground_radius_km + double{h}));
        for (const double part : {0.1, 0.455, 0.9}) {
            const auto d = static_cast<float>(part * rho);
            const auto columns = [&](float mu) {
                return gpu::column_lookups::column_along(
                    {trial.texture}, gpu::size_of(trial.texture), trial.air, h, mu, d);
            };
            const gpu::vec4 wanted = columns(at_horizon);
            for (const float mu :
                 {std::nextafter(at_horizon, -1.0F), std::nextafter(at_horizon, 0.0F)}) {
                const double s = (shell.ground_radius_km + double{h}) * double{mu};
                const auto twin = trial.in_double({double{h}, s, double{d}});
                const gpu::vec4 found = columns(mu);
                for (gpu::vec4::length_type k = 0; k < 4; ++k) {
                    EXPECT_NEAR(double{found[k]}, double{wanted[k]},
                                0.02 * std::fabs(double{wanted[k]}) + 1e-7)
                        << h << " " << d;
                    EXPECT_NEAR(twin[static_cast<std::size_t>(k)], double{wanted[k]},
                                0.02 * std::fabs(double{wanted[k]}) + 1e-7)
                        << h << " " << d;
                }
            }
        }
    }
}

}  // namespace
}  // namespace skybake

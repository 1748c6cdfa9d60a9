#include <array>
#include <vector>

#include "bakers/air/particles/layer_phase.h"
#include "bakers/assets/environment/environment_table.h"
#include "bakers/assets/irradiance/irradiance_table.h"
#include "bakers/assets/multiple_scattering/multiple_scattering_table.h"
#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/phase/phase_table.h"
#include "bakers/assets/sky_view/sky_view_table.h"
#include "bakers/assets/transmittance/transmittance_table.h"
#include "bakers/light/multiple_scattering_mapping.h"
#include "bakers/light/solver/solve_light.h"
#include "bakers/math/relative_error.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/sky_view.h"
#include "tests/certificates/claims.h"
#include "tests/certificates/dense_table.h"
#include "tests/light/sky_media.h"
#include "tests/support/outcomes.h"

namespace skybake::test {
namespace {

// Bakes with texels within 1 % or, where no quadrature is as fine as that, within 50 %.
template <class Asset, class Bake>
Baked as_fine_as_possible(Asset& asset, const Bake& bake) {
    asset.max_texel_error = 0.01;
    config::Outcome<Baked> outcome = bake();
    if (outcome.value) return std::move(*outcome.value);
    asset.max_texel_error = 0.5;
    return test::without_errors(bake());
}

ValueRow kernel_row(const TableModel& model, int level) {
    return [&model, level](double y, const std::vector<double>& x, double* values) {
        model.row(level, y, x, values);
    };
}

Claim claim_of(const TableModel& model, const Baked& table, const ValueRow& row, PointCounts even,
               RandomCase& random) {
    return {table.certificate.lookup, DenseTable(model, table.image(), row, random).figures(),
            claimed_by_even_points(model, table.image(), row, even)};
}

config::SkyOrders random_orders(RandomCase& random) {
    return random.below(2) == 0 ? config::SkyOrders::single : config::SkyOrders::all;
}

// A camera in the air or above it, and a sun above or below the horizon.
struct SkyCase {
    config::Atmosphere atmosphere;
    config::SkyOrders orders;
    TestSky sky;
    std::array<int, 2> size;
    config::Length altitude;
    config::Angle sun_elevation;

    SkyCase(RandomCase& random, int most_rows)
        : atmosphere(random.atmosphere()),
          orders(random_orders(random)),
          sky(atmosphere, orders),
          size{random.even(16, 48), random.even(most_rows / 4, most_rows)},
          altitude{1000 * sky.light().shell().thickness_km * random.log_uniform(1e-4, 2)},
          sun_elevation{kDegree * random.uniform(-12, 90)} {}

    // Gives an asset what it has in common with others.
    template <class Bake>
    Bake bake() const {
        Bake result;
        result.orders = orders;
        result.size = size;
        result.altitude = altitude;
        result.pixel_type = config::PixelType::float32;
        return result;
    }

    // `model` is that of sky_view or of environment.
    template <class Model>
    Claim claim(const Baked& table, const Model& model_of, RandomCase& random) const {
        const SkyViewCamera camera(sky.light().shell(), altitude.kilometers());
        const TableModel model =
            model_of(sky.light(), camera, sun_at_elevation(sun_elevation.radians));
        return claim_of(model, table, kernel_row(model, 0), {256, 1}, random);
    }
};

}  // namespace

Claim claim_of_transmittance(RandomCase& random) {
    const Medium medium = make_medium(random.atmosphere());
    config::TransmittanceBake bake;
    bake.size = {random.even(16, 256), random.even(8, 64)};
    bake.mapping = static_cast<config::TransmittanceMapping>(random.below(2));
    bake.content = static_cast<config::TransmittanceContent>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table =
        test::without_errors(bake_transmittance(medium, bake, kClaimOptions, empty_table()));
    const TableModel model = transmittance_model(medium, bake);
    return claim_of(model, table, kernel_row(model, 0), {1024, 1}, random);
}

Claim claim_of_multiple_scattering(RandomCase& random) {
    const Medium medium = make_medium(random.atmosphere());
    config::MultipleScatteringBake bake;
    bake.method = config::MultipleScatteringMethod::converged;
    bake.size = {random.even(12, 48), random.even(8, 32)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = as_fine_as_possible(
        bake, [&] { return bake_multiple_scattering(medium, bake, kClaimOptions, empty_table()); });
    const TableModel model = multiple_scattering_model(medium, bake, kClaimOptions.threads);
    return claim_of(model, table, kernel_row(model, 6), {8, 8}, random);
}

Claim claim_of_solved_scattering(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::MultipleScatteringBake bake;
    bake.size = {random.even(12, 64), random.even(8, 64)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = test::without_errors(
        bake_solved_scattering(atmosphere, {}, bake, kClaimOptions, empty_table()));
    const SkyMedium medium = make_sky_medium(atmosphere);
    const SolvedLight light = solve_light(medium, finer({}), kClaimOptions.threads);
    const SunColumns columns = sun_columns(bake.mapping, {}, shell_of(medium.air));
    TableModel model;
    model.channels = 3;
    model.error = relative_error;
    model.reference = [&](double y, const std::vector<double>& x, double* values) {
        for (const double at : x) {
            const Spectrum mean =
                light.mean_radiance_at(y * medium.air.thickness_km, columns.cosine(at));
            for (std::size_t c = 0; c < 3; ++c) *values++ = mean[c];
        }
    };
    return claim_of(model, table, model.reference, {32, 16}, random);
}

Claim claim_of_sky_view(RandomCase& random) {
    const SkyCase at(random, 64);
    auto bake = at.bake<config::SkyViewBake>();
    bake.sun_elevations = {at.sun_elevation};
    return at.claim(
        test::without_errors(bake_sky_view(at.sky.light(), bake, kClaimOptions, empty_table())),
        [](const auto&... of) { return sky_view_model(of...); }, random);
}

Claim claim_of_environment(RandomCase& random) {
    const SkyCase at(random, 32);
    auto bake = at.bake<config::EnvironmentBake>();
    bake.sun_elevation = at.sun_elevation;
    return at.claim(
        test::without_errors(bake_environment(at.sky.light(), bake, kClaimOptions, empty_table())),
        [](const auto&... of) { return environment_model(of...); }, random);
}

Claim claim_of_irradiance(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::IrradianceBake bake;
    bake.content =
        random.below(3) == 0 ? config::IrradianceContent::direct : config::IrradianceContent::sky;
    bake.orders = random_orders(random);
    const TestSky sky(atmosphere, orders_of(bake));
    bake.size = {random.even(8, 20), random.even(4, 12)};
    bake.mapping = static_cast<config::MultipleScatteringMapping>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked table = as_fine_as_possible(
        bake, [&] { return bake_irradiance(sky.light(), bake, kClaimOptions, empty_table()); });
    const TableModel model = irradiance_model(sky.light(), bake);
    return claim_of(model, table, kernel_row(model, 1), {8, 8}, random);
}

Claim claim_of_phase(RandomCase& random) {
    config::Parameters parameters;
    parameters.atmosphere = random.atmosphere();
    parameters.wavelengths.assign(3, {5.5e-7});
    config::PhaseBake bake;
    bake.layer = parameters.atmosphere.layers.front().name;
    bake.size = random.even(16, 1024);
    bake.degree = 4;
    bake.content = static_cast<config::PhaseContent>(random.below(2));
    bake.spacing = static_cast<config::PhaseSpacing>(1 + random.below(3));
    bake.pixel_type = config::PixelType::float32;
    const Baked table =
        test::without_errors(bake_phase(parameters, bake, kClaimOptions, empty_table()));
    const PhaseSource source = phase_source(parameters, bake, kClaimOptions.threads);
    const TableModel model = bake.content == config::PhaseContent::phase
                                 ? phase_model(source, bake.spacing)
                                 : inverse_phase_model(source);
    return claim_of(model, table, kernel_row(model, 0), {1024, 1}, random);
}

}  // namespace skybake::test

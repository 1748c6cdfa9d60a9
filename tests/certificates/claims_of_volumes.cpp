#include <array>
#include <vector>

#include "bakers/assets/aerial_perspective/aerial_perspective_mapping.h"
#include "bakers/assets/aerial_perspective/aerial_perspective_volume.h"
#include "bakers/assets/bruneton/scattering_error.h"
#include "bakers/assets/bruneton/scattering_volume.h"
#include "bakers/assets/optical_depth/column_volume.h"
#include "bakers/field/certify.h"
#include "bakers/light/shared_light.h"
#include "tests/certificates/claims.h"
#include "tests/certificates/dense_scattering.h"
#include "tests/light/sky_media.h"
#include "tests/support/outcomes.h"

namespace skybake::test {
namespace {

// The dense points are random, one in each of equal layers along the last axis of several voxels.
Claim claim_of_volume(const Baked& volume, const VolumeReference& exact,
                      const VolumeComparison& comparison, int even_points, RandomCase& random) {
    constexpr int kPoints = 12000;
    const Level& level = volume.levels.front();
    std::size_t layered = 2;
    while (level.size[layered] == 1 && layered > 0) --layered;
    ErrorStatistics dense;
    for (int i = 0; i < kPoints; ++i) {
        std::array<double, 3> uvw{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            uvw[axis] = level.size[axis] == 1 ? 0.5 : random.uniform(0, 1);
        }
        uvw[layered] = (i + uvw[layered]) / kPoints;
        if (comparison.lookup_place) uvw = comparison.lookup_place(uvw);
        const std::vector<double> found = look_up(level, volume.pixel_type, uvw);
        const std::vector<double> wanted = exact(uvw);
        for (const double error : errors_of(level, comparison, uvw, found, wanted)) {
            dense.add(error);
        }
    }
    return {volume.certificate.lookup, dense.figures(),
            measure_lookups(level, volume.pixel_type, exact, even_points, kClaimOptions, comparison)
                .figures};
}

}  // namespace

Claim claim_of_single_mie(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::BrunetonBake bake;
    bake.table = config::BrunetonTable::single_mie;
    bake.orders = 1;
    bake.nu_size = 4 + random.below(5);
    bake.size = {bake.nu_size * (8 + random.below(17)), random.even(16, 64), 8 + random.below(17)};
    bake.sun_cos_zenith_min = -0.2;
    bake.mie_layers = {atmosphere.layers.front().name};
    bake.solar_irradiance = {1, 1, 1};
    bake.pixel_type = config::PixelType::float32;
    const SkyMedium medium = make_sky_medium(atmosphere);
    const Baked volume = test::without_errors(
        bake_scattering({{atmosphere, medium, nullptr}}, {}, bake, kClaimOptions, empty_table()));
    const auto& table = static_cast<const VoxelArray&>(*volume.levels[0].voxels);
    const ScatteringContent content(medium, bake);
    const ScatteringMapping mapping(shell_of(medium.air), bake.size, bake.nu_size,
                                    bake.sun_cos_zenith_min);
    const ScatteringRows rows(medium, nullptr, make_sunlight(medium.air, kClaimOptions.threads));
    const ScatteringReference reference(medium, content, nullptr);
    const TableContent table_content({&content}, {}, bake.solar_irradiance);
    const ExactTexel exact = exact_texel(table_content, {&reference});
    const Certificate even = measure_scattering(table, mapping, exact, largest_values(table),
                                                config::PixelType::float32, 64, kClaimOptions);
    return {
        volume.certificate.lookup,
        DenseScattering(mapping, table, texel_row(table_content, {&rows}), exact, random).figures(),
        even.lookup};
}

Claim claim_of_aerial_perspective(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::AerialPerspectiveBake bake;
    bake.orders = static_cast<config::SkyOrders>(random.below(2));
    const TestSky sky(atmosphere, bake.orders);
    bake.size = {8 + random.below(9), 8 + random.below(9), 8 + random.below(17)};
    const double thickness_m = 1000 * sky.light().shell().thickness_km;
    bake.altitude = {thickness_m * random.log_uniform(1e-4, 0.9)};
    bake.sun_elevation = {kDegree * random.uniform(-8, 90)};
    bake.heading = {kDegree * random.uniform(-180, 180)};
    bake.pitch = {kDegree * random.uniform(-30, 30)};
    bake.fov = {kDegree * random.uniform(30, 90)};
    bake.aspect = random.uniform(1, 2);
    bake.view_distance = {thickness_m * random.log_uniform(0.1, 3)};
    bake.slices = static_cast<config::SliceSpacing>(random.below(2));
    bake.pixel_type = config::PixelType::float32;
    const Baked volume = test::without_errors(
        bake_aerial_perspective(sky.light(), bake, kClaimOptions, empty_table()));
    const AerialCamera camera(bake, sky.light().shell());
    const VolumeReference exact = [&](const std::array<double, 3>& uvw) {
        const SkyRadiance at = aerial_perspective(sky.light(), camera, uvw[0], uvw[1],
                                                  {camera.distance_km(uvw[0], uvw[1], uvw[2])})
                                   .front();
        const Spectrum light = sky.light().wanted(at);
        const Spectrum& passing = at.transmittance;
        return std::vector<double>{light[0], light[1], light[2],
                                   (passing[0] + passing[1] + passing[2]) / 3};
    };
    return claim_of_volume(volume, exact, {}, 1024, random);
}

// A table of columns, of densities or of phase functions, of one to three kinds.
Claim claim_of_optical_depth(RandomCase& random) {
    const config::Atmosphere atmosphere = random.atmosphere();
    config::OpticalDepthBake bake;
    bake.table = static_cast<config::OpticalDepthTable>(random.below(4));
    bake.coordinates = static_cast<config::BetweenCoordinates>(random.below(2));
    for (const config::Layer& layer : atmosphere.layers) bake.kinds.push_back(layer.name);
    bake.size = {random.even(16, 64), 1, 1};
    const bool to_top = bake.table == config::OpticalDepthTable::to_top;
    const bool between = bake.table == config::OpticalDepthTable::between;
    if (to_top || between) bake.size[1] = random.even(16, 32);
    if (between) bake.size[2] = random.even(8, 16);
    bake.pixel_type = config::PixelType::float32;
    const Baked volume =
        test::without_errors(bake_columns(atmosphere, bake, kClaimOptions, empty_table()));
    const ColumnVoxels measured = column_voxels(atmosphere, bake);
    return claim_of_volume(volume, measured.reference, measured.comparison, 1024, random);
}

}  // namespace skybake::test

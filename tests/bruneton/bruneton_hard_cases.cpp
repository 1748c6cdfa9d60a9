// Hard cases of the tables of scattering; `ctest -L hard` prints how well each is held.
#include <gtest/gtest.h>

#include "bakers/assets/bruneton/scattering_table.h"
#include "bakers/light/shared_light.h"
#include "bakers/light/solver/solve_light.h"
#include "config/assets/bruneton.h"
#include "tests/light/sky_media.h"
#include "tests/support/hard_case.h"

namespace skybake {
namespace {

using test::hold;

struct Table {
    SkyMedium medium;
    config::BrunetonBake bake;
    ScatteringMapping mapping;
    VoxelArray voxels;
};

// Single scattering of all layers but `mie_layers`, which are in A.
Table table_of(const config::Atmosphere& atmosphere, std::array<int, 3> size, int nu_size,
               std::vector<std::string> mie_layers = {"mie"}) {
    SkyMedium medium = make_sky_medium(atmosphere);
    config::BrunetonBake bake;
    bake.table = config::BrunetonTable::scattering;
    bake.combined = true;
    bake.orders = 1;
    bake.mie_layers = std::move(mie_layers);
    bake.solar_irradiance = {1, 1, 1};
    const ScatteringMapping mapping(shell_of(medium.air), size, nu_size, -0.2);
    const ScatteringContent content(medium, bake);
    const TableParts parts = make_parts(medium, nullptr, make_sunlight(medium.air, 2), content,
                                        mapping, BakeOptions{.threads = 2});
    VoxelArray voxels = scattering_texels(content, mapping, parts);
    return {std::move(medium), bake, mapping, std::move(voxels)};
}

double worst_below_zero(const VoxelArray& voxels) {
    double worst = 0;
    for (std::size_t c = 0; c < voxels.channels(); ++c) {
        for (const float value : voxels.channel(c)) {
            if (!(value >= 0 && std::isfinite(value))) worst = std::max(worst, 1.0);
        }
    }
    return worst;
}

TEST(BrunetonHardCase, PlanetsOfAllKinds) {
    for (const std::string preset : {"earth_hillaire", "mars_rgb", "tiny_planet", "dense_earth"}) {
        const Table table = table_of(test::preset_atmosphere(preset), {16, 8, 4}, 4);
        hold(preset + ": light", "finite and not below 0", worst_below_zero(table.voxels), 0);
    }
}

TEST(BrunetonHardCase, NoAirNoLight) {
    const Table table = table_of(test::preset_atmosphere("vacuum"), {8, 4, 2}, 2, {});
    double brightest = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        brightest = std::max(brightest, table.voxels.largest(c));
    }
    hold("vacuum", "no light", brightest, 0);
}

TEST(BrunetonHardCase, OzoneAlone) {
    const Table table = table_of(
        test::preset_atmosphere("earth_hillaire", {"atmosphere.layers.rayleigh.enabled=false",
                                                   "atmosphere.layers.mie.enabled=false"}),
        {8, 4, 2}, 2, {});
    hold("ozone alone", "no light", table.voxels.largest(0), 0);
}

TEST(BrunetonHardCase, MieAloneIsAllInAlpha) {
    const Table table = table_of(
        test::preset_atmosphere("earth_hillaire", {"atmosphere.layers.rayleigh.enabled=false"}),
        {8, 4, 2}, 2);
    hold("Mie alone: R", "no light", table.voxels.largest(0), 0);
    EXPECT_GT(table.voxels.largest(3), 0);
}

TEST(BrunetonHardCase, TwoTexelsAnAxis) {
    const Table table = table_of(test::preset_atmosphere("earth_hillaire"), {4, 2, 2}, 2);
    hold("sizes 4 x 2 x 2", "finite and not below 0", worst_below_zero(table.voxels), 0);
}

TEST(BrunetonHardCase, HorizonFromBothSides) {
    // At the top rays that graze the ground from above and those that meet it go the same way to
    // it; those that miss it go on through as much air again.
    const Table table = table_of(test::preset_atmosphere("earth_hillaire"), {16, 8, 4}, 4);
    const ScatteringView below = table.mapping.view_of_texel(0, 2);
    const ScatteringView above = table.mapping.view_of_texel(7, 2);
    EXPECT_TRUE(below.meets_ground);
    EXPECT_FALSE(above.meets_ground);
    hold("the horizon, told by half", "one direction",
         std::fabs(below.s_km - above.s_km) / std::fabs(above.s_km), 1e-14);
    const auto at = [&](int v) {
        return double{table.voxels.channel(0)[table.voxels.offset(2 * 4 + 3, v, 2)]};
    };
    EXPECT_GT(at(7), at(0));
}

TEST(BrunetonHardCase, RaysOfNoLength) {
    const Table table = table_of(test::preset_atmosphere("earth_hillaire"), {16, 8, 4}, 4);
    double brightest = 0;
    for (int u = 0; u < 16; ++u) {
        // On the ground downwards, and at the top upwards.
        for (const auto& [v, w] : {std::pair{0, 0}, {3, 0}, {4, 3}}) {
            brightest =
                std::max(brightest, double{table.voxels.channel(0)[table.voxels.offset(u, v, w)]});
        }
    }
    hold("rays of no length", "no light", brightest, 0);
}

TEST(BrunetonHardCase, DarknessGrowsAfterSunset) {
    const Table table = table_of(test::preset_atmosphere("earth_hillaire"), {256, 16, 8}, 8);
    // Straight up from the ground, nu = mu_s about 0: from one darker sun to the next.
    double worst = 0;
    const auto& red = table.voxels.channel(0);
    for (int sun = 1; sun < 12; ++sun) {
        const double darker = red[table.voxels.offset(3 * 32 + sun - 1, 8, 0)];
        const double brighter = red[table.voxels.offset(3 * 32 + sun, 8, 0)];
        worst = std::max(worst, darker / std::max(brighter, 1e-30) - 1);
    }
    hold("sun below the horizon", "light falls", worst, 0);
}

TEST(BrunetonHardCase, DenseAirKeepsItsEnergy) {
    // No more than all sunlight leaves: radiance of a conservative sky is below 1 / pi times a few.
    for (const char* factor : {"10", "50"}) {
        config::Atmosphere dense = test::preset_atmosphere("earth_hillaire");
        for (config::Layer& layer : dense.layers) {
            for (auto& value : layer.scattering) value.per_meter *= std::stod(factor);
            for (auto& value : layer.extinction) value.per_meter *= std::stod(factor);
        }
        const Table table = table_of(dense, {32, 8, 4}, 4);
        double brightest = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            brightest = std::max(brightest, table.voxels.largest(c));
        }
        // The integral of T T_sun sigma_s over the ray is at most 1, that of its own absorption.
        hold(std::string(factor) + " x Earth's air", "at most 1 over the phase function",
             std::max(brightest - 1, 0.0), 0);
    }
}

}  // namespace
}  // namespace skybake

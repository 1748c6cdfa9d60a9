// Atmospheres with their tables, as tests of the sky share them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bakers/assets/multiple_scattering/solved_scattering_table.h"
#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/io/manifest/metadata.h"
#include "bakers/light/sky_light.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/render/sky_view.h"
#include "config/assets/multiple_scattering.h"
#include "tests/support/atmospheres.h"
#include "tests/support/outcomes.h"

namespace skybake::test {

// Bakes all assets of a recipe for a preview, which must not warn.
inline PreviewAssets baked(const std::string& text, const std::vector<std::string>& settings = {}) {
    const auto recipe = recipe_of(text, settings);
    return without_diagnostics(
        bake_assets(recipe, recipe.parameters.bakes, "test", {1, Certification::off, nullptr}));
}

struct Sky {
    config::Recipe recipe;
    PreviewAsset transmittance;
    PreviewAsset multiple_scattering;
    SkyMedium medium;
    SkyTables tables;
};

// Bakes the two tables that sky.recipe asks for, and what is made of them.
inline void bake_tables(Sky& sky) {
    for (const config::Bake& bake : sky.recipe.parameters.bakes) {
        if (bake.name != "transmittance" && bake.name != "multiple_scattering") continue;
        const Baked baked =
            test::without_errors(bake_asset(sky.recipe, bake, {1, Certification::off, nullptr}));
        PreviewAsset& asset =
            bake.name == "transmittance" ? sky.transmittance : sky.multiple_scattering;
        asset.entry = describe(baked);
        asset.table = baked.image();
    }
    sky.medium = make_sky_medium(sky.recipe.parameters.atmosphere);
    sky.tables = test::without_errors(make_sky_tables(sky.transmittance, &sky.multiple_scattering));
}

// A preset's sky from tables of the default sizes, but for `settings`.
inline Sky sky_of(const std::string& preset, const std::vector<std::string>& settings = {}) {
    Sky sky;
    sky.recipe =
        recipe_of("preset = \"" + preset +
                      "\"\n[bake.transmittance]\nsize = [256, 64]\n"
                      "[bake.multiple_scattering]\nmethod = \"converged\"\nmapping = \"hillaire\"\n"
                      "size = [32, 32]\n",
                  settings);
    bake_tables(sky);
    return sky;
}

// Tables so large that what they cost is far below a percent.
inline const std::vector<std::string>& large_tables() {
    static const std::vector<std::string> settings = {
        "bake.transmittance.size=[512,128]", "bake.multiple_scattering.size=[128,64]",
        "bake.multiple_scattering.mapping=\"twilight\"",
        "bake.multiple_scattering.max_texel_error=0.01"};
    return settings;
}

// Tables whose interpolation costs nothing beside a march.
inline const std::vector<std::string>& finest_tables() {
    static const std::vector<std::string> settings = {
        "bake.multiple_scattering.size=[256,128]", "bake.multiple_scattering.mapping=\"twilight\"",
        "bake.multiple_scattering.max_texel_error=0.01"};
    return settings;
}

// The light of a sky by direct integration (sky_radiance.h), with the multiple scattering that its table
// holds. A picture of render_sky differs from it by what marching and coarser tables cost.
inline SkyLight integrated(const Sky& sky) {
    const config::Parameters& parameters = sky.recipe.parameters;
    const auto& bake = parameters.bakes.back().as<config::MultipleScatteringBake>();
    return {sky.medium, config::SkyOrders::all,
            stored_orders(parameters, bake, sky.medium, sky.multiple_scattering.table)};
}

inline SkyView dome(int pixels, double altitude_km, double sun_elevation_degrees) {
    SkyView view;
    view.width = pixels;
    view.height = pixels;
    view.camera_altitude_km = altitude_km;
    view.sun_elevation_degrees = sun_elevation_degrees;
    return view;
}

// With the ground in its lower half.
inline SkyView panorama(int width, double altitude_km, double sun_elevation_degrees) {
    SkyView view = dome(width, altitude_km, sun_elevation_degrees);
    view.projection = SkyProjection::panorama;
    view.height = width / 2;
    view.lowest_degrees = -90;
    return view;
}

inline const Sky& earth() {
    static const Sky sky = sky_of("earth_hillaire");
    return sky;
}

}  // namespace skybake::test

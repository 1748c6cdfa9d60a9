// The tables as data: what every row must have.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/assets/aerial_perspective.h"
#include "config/assets/irradiance.h"
#include "config/assets/multiple_scattering.h"
#include "config/assets/occupancy.h"
#include "config/assets/transmittance.h"
#include "config/fields/field_reader.h"
#include "config/fields/fields.h"
#include "config/sections/atmosphere.h"
#include "config/sections/cloud.h"
#include "config/sections/noise.h"
#include "config/sections/particles.h"

namespace skybake::config {
namespace {

TEST(FieldTables, KeysAreUniqueAndDocumented) {
    for (const Section& section : sections()) {
        std::set<std::string_view> keys;
        for (const Field& field : section.fields) {
            EXPECT_TRUE(keys.insert(field.key).second) << section.path << '.' << field.key;
            EXPECT_FALSE(field.documentation.empty()) << field.key;
            EXPECT_NE(field.documentation.back(), '.') << field.key;
            const bool chooses = field.kind == Kind::choice || field.kind == Kind::choice_list;
            EXPECT_EQ(chooses, !field.choices.empty()) << field.key;
            EXPECT_FALSE(!field.exclusive_side.empty() && field.exclusive_group.empty());
            EXPECT_FALSE(field.required && !field.fallback.empty()) << field.key;
            EXPECT_LE(field.range.minimum, field.range.maximum) << field.key;
        }
    }
}

TEST(FieldTables, DefaultsAreWhatTheirFieldsTake) {
    for (const Section& section : sections()) {
        for (const Field& field : section.fields) {
            if (field.fallback.empty()) continue;
            EXPECT_TRUE(default_value(field, 3)) << field.key;
        }
    }
}

TEST(FieldTables, SelectorsStandBeforeTheirKeysAndHaveTheirValues) {
    for (const Section& section : sections()) {
        for (auto field = section.fields.begin(); field != section.fields.end(); ++field) {
            const auto needed =
                std::find_if(section.fields.begin(), field,
                             [&](const Field& other) { return other.key == field->needs; });
            EXPECT_EQ(needed == field, field->needs.empty()) << field->key;
            EXPECT_TRUE(needed == field || needed->kind == Kind::text) << field->key;
            if (field->selector.empty()) continue;
            const auto selector =
                std::find_if(section.fields.begin(), field,
                             [&](const Field& other) { return other.key == field->selector; });
            ASSERT_NE(selector, field) << field->key;
            const std::vector<std::string_view> names = choice_names(*selector);
            for (const std::string_view value : field->selected_by) {
                EXPECT_NE(std::find(names.begin(), names.end(), value), names.end()) << value;
            }
        }
    }
}

// The decoder turns a choice's place in the table into the enumerator of that place.
TEST(FieldTables, ChoicesStandInTheOrderOfTheirEnumerations) {
    const auto index_of = [](std::string_view path, std::string_view asset, std::string_view key,
                             std::string_view name) {
        const std::vector<std::string_view> names =
            choice_names(*find_field(*find_section(path, asset), key));
        return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    const auto layer = [&](std::string_view key, std::string_view name) {
        return index_of("atmosphere.layers.*", "", key, name);
    };
    const auto transmittance = [&](std::string_view key, std::string_view name) {
        return index_of("bake.*", "transmittance", key, name);
    };
    const auto scattering = [&](std::string_view key, std::string_view name) {
        return index_of("bake.*", "multiple_scattering", key, name);
    };
    EXPECT_EQ(layer("profile", "exponential"), static_cast<int>(Profile::exponential));
    EXPECT_EQ(layer("profile", "tent"), static_cast<int>(Profile::tent));
    EXPECT_EQ(layer("profile", "slab"), static_cast<int>(Profile::slab));
    EXPECT_EQ(layer("profile", "tabulated"), static_cast<int>(Profile::tabulated));
    EXPECT_EQ(layer("phase", "isotropic"), static_cast<int>(Phase::isotropic));
    EXPECT_EQ(layer("phase", "rayleigh"), static_cast<int>(Phase::rayleigh));
    EXPECT_EQ(layer("phase", "henyey_greenstein"), static_cast<int>(Phase::henyey_greenstein));
    EXPECT_EQ(layer("phase", "cornette_shanks"), static_cast<int>(Phase::cornette_shanks));
    EXPECT_EQ(transmittance("content", "transmittance"),
              static_cast<int>(TransmittanceContent::transmittance));
    EXPECT_EQ(transmittance("content", "optical_depth"),
              static_cast<int>(TransmittanceContent::optical_depth));
    EXPECT_EQ(transmittance("mapping", "bruneton"),
              static_cast<int>(TransmittanceMapping::bruneton));
    EXPECT_EQ(transmittance("mapping", "ue"), static_cast<int>(TransmittanceMapping::ue));
    EXPECT_EQ(transmittance("pixel_type", "float"), static_cast<int>(PixelType::float32));
    EXPECT_EQ(transmittance("pixel_type", "half"), static_cast<int>(PixelType::half));
    EXPECT_EQ(transmittance("compression", "none"), static_cast<int>(Compression::none));
    EXPECT_EQ(transmittance("compression", "zip"), static_cast<int>(Compression::zip));
    EXPECT_EQ(transmittance("compression", "zips"), static_cast<int>(Compression::zips));
    EXPECT_EQ(transmittance("compression", "piz"), static_cast<int>(Compression::piz));
    EXPECT_EQ(scattering("mapping", "hillaire"),
              static_cast<int>(MultipleScatteringMapping::hillaire));
    EXPECT_EQ(scattering("mapping", "twilight"),
              static_cast<int>(MultipleScatteringMapping::twilight));
    EXPECT_EQ(scattering("method", "converged"),
              static_cast<int>(MultipleScatteringMethod::converged));
    EXPECT_EQ(scattering("method", "as_in_paper"),
              static_cast<int>(MultipleScatteringMethod::as_in_paper));
    EXPECT_EQ(scattering("method", "solved"), static_cast<int>(MultipleScatteringMethod::solved));
    EXPECT_EQ(scattering("content", "hillaire"),
              static_cast<int>(MultipleScatteringContent::hillaire));
    EXPECT_EQ(scattering("content", "fitted"), static_cast<int>(MultipleScatteringContent::fitted));
    EXPECT_EQ(scattering("content", "moments"),
              static_cast<int>(MultipleScatteringContent::moments));
}

TEST(FieldTables, ChoicesOfTheSkyStandInTheOrderOfTheirEnumerations) {
    using Names = std::vector<std::string_view>;
    const auto names = [](std::string_view asset, std::string_view key) {
        return choice_names(*find_field(*find_section("bake.*", asset), key));
    };
    const auto at = [](const Names& all, auto enumerator) {
        return all[static_cast<std::size_t>(enumerator)];
    };
    for (const char* asset : {"sky_view", "aerial_perspective", "irradiance"}) {
        const Names orders = names(asset, "orders");
        EXPECT_EQ(at(orders, SkyOrders::all), "all");
        EXPECT_EQ(at(orders, SkyOrders::single), "single");
        EXPECT_EQ(at(orders, SkyOrders::multiple), "multiple");
    }
    const Names irradiance = names("irradiance", "content");
    EXPECT_EQ(at(irradiance, IrradianceContent::direct), "direct");
    EXPECT_EQ(at(irradiance, IrradianceContent::sky), "sky");
    EXPECT_EQ(at(irradiance, IrradianceContent::total), "total");
    const Names aerial = names("aerial_perspective", "content");
    EXPECT_EQ(at(aerial, AerialContent::in_scatter_and_transmittance),
              "in_scatter_and_transmittance");
    EXPECT_EQ(at(aerial, AerialContent::in_scatter), "in_scatter");
    EXPECT_EQ(at(aerial, AerialContent::transmittance), "transmittance");
    EXPECT_EQ(names("aerial_perspective", "slices"), (Names{"linear", "squared"}));
    EXPECT_EQ(static_cast<int>(SliceSpacing::squared), 1);
    EXPECT_EQ(names("irradiance", "mapping"), (Names{"hillaire", "twilight"}));
}

TEST(FieldTables, ChoicesOfNoisesStandInTheOrderOfTheirEnumerations) {
    const auto names = [](std::string_view path, std::string_view key,
                          std::string_view asset = "") {
        return choice_names(*find_field(*find_section(path, asset), key));
    };
    const auto expect_at = [](const std::vector<std::string_view>& all, auto enumerator,
                              std::string_view name) {
        const auto index = static_cast<std::size_t>(enumerator);
        ASSERT_LT(index, all.size());
        EXPECT_EQ(all[index], name);
    };
    const auto sampling = names("noise.*", "sampling");
    expect_at(sampling, NoiseSampling::centers, "centers");
    expect_at(sampling, NoiseSampling::corners, "corners");
    expect_at(sampling, NoiseSampling::slices_at_corners, "slices_at_corners");
    const auto pack = names("noise.*", "pack");
    expect_at(pack, NoisePacking::none, "none");
    expect_at(pack, NoisePacking::shape, "shape");
    expect_at(pack, NoisePacking::detail, "detail");
    const auto type = names("noise.*.channels.*", "type");
    expect_at(type, NoiseType::constant, "constant");
    expect_at(type, NoiseType::perlin, "perlin");
    expect_at(type, NoiseType::worley, "worley");
    expect_at(type, NoiseType::perlin_worley, "perlin_worley");
    expect_at(type, NoiseType::curl, "curl");
    const auto fractal = names("noise.*.channels.*", "fractal");
    expect_at(fractal, NoiseFractal::fbm, "fbm");
    expect_at(fractal, NoiseFractal::rectified, "rectified");
    expect_at(fractal, NoiseFractal::ridged, "ridged");
    expect_at(fractal, NoiseFractal::billow, "billow");
    const auto feature = names("noise.*.channels.*", "feature");
    expect_at(feature, WorleyFeature::f1, "f1");
    expect_at(feature, WorleyFeature::f2, "f2");
    expect_at(feature, WorleyFeature::f2_minus_f1, "f2_minus_f1");
    const auto form = names("noise.*.channels.*", "value_form");
    expect_at(form, WorleyValue::distance, "distance");
    expect_at(form, WorleyValue::one_minus_distance, "one_minus_distance");
    expect_at(form, WorleyValue::one_minus_distance_over_sqrt3, "one_minus_distance_over_sqrt3");
    expect_at(form, WorleyValue::one_minus_distance_squared, "one_minus_distance_squared");
    const auto component = names("noise.*.channels.*", "component");
    expect_at(component, CurlComponent::x, "x");
    expect_at(component, CurlComponent::y, "y");
    expect_at(component, CurlComponent::z, "z");
    const auto formats = names("bake.*", "formats", "noise_volume");
    expect_at(formats, VolumeFormat::exr, "exr");
    expect_at(formats, VolumeFormat::vdb, "vdb");
    expect_at(formats, VolumeFormat::bin, "bin");
    const auto pixels = names("bake.*", "pixel_type", "noise_volume");
    expect_at(pixels, PixelType::float32, "float");
    expect_at(pixels, PixelType::half, "half");
    expect_at(pixels, PixelType::unorm8, "unorm8");
    expect_at(pixels, PixelType::unorm16, "unorm16");
    const auto layout = names("bake.*", "layout", "noise_volume");
    expect_at(layout, VolumeLayout::stack, "stack");
    expect_at(layout, VolumeLayout::atlas, "atlas");
    const auto vdb = names("bake.*", "vdb_compression", "noise_volume");
    expect_at(vdb, VdbCompression::none, "none");
    expect_at(vdb, VdbCompression::zip, "zip");
    expect_at(vdb, VdbCompression::blosc, "blosc");
}

TEST(FieldTables, ChoicesOfCloudsStandInTheOrderOfTheirEnumerations) {
    using Names = std::vector<std::string_view>;
    const auto names = [](std::string_view path, std::string_view key,
                          std::string_view asset = "") {
        return choice_names(*find_field(*find_section(path, asset), key));
    };
    EXPECT_EQ(names("clouds.*", "threshold_at"), (Names{"bake", "runtime"}));
    EXPECT_EQ(static_cast<int>(ThresholdAt::runtime), 1);
    EXPECT_EQ(names("clouds.*", "channels"), (Names{"density", "noise"}));
    EXPECT_EQ(static_cast<int>(CloudChannels::noise), 1);
    const auto type = names("clouds.*.height_profile", "type");
    const auto at = [&](HeightProfileType profile) {
        return type[static_cast<std::size_t>(profile)];
    };
    EXPECT_EQ(at(HeightProfileType::thesis), "thesis");
    EXPECT_EQ(at(HeightProfileType::cumulus), "cumulus");
    EXPECT_EQ(at(HeightProfileType::stratus), "stratus");
    EXPECT_EQ(at(HeightProfileType::stratocumulus), "stratocumulus");
    EXPECT_EQ(at(HeightProfileType::blended), "blended");
    EXPECT_EQ(at(HeightProfileType::tabulated), "tabulated");
    for (const char* map : {"clouds.*.coverage_map", "clouds.*.type_map"}) {
        EXPECT_EQ(names(map, "wrap")[static_cast<std::size_t>(MapWrap::clamp)], "clamp");
        EXPECT_EQ(names(map, "filter")[static_cast<std::size_t>(MapFilter::linear)], "linear");
        EXPECT_EQ(names(map, "color_space")[static_cast<std::size_t>(MapColorSpace::srgb)], "srgb");
    }
    const auto filter = names("bake.*", "filter", "occupancy");
    EXPECT_EQ(filter[static_cast<std::size_t>(OccupancyFilter::nearest)], "nearest");
    EXPECT_EQ(filter[static_cast<std::size_t>(OccupancyFilter::trilinear)], "trilinear");
    EXPECT_EQ(filter[static_cast<std::size_t>(OccupancyFilter::tricubic)], "tricubic");
    const auto rule = names("bake.*", "rule", "occupancy");
    EXPECT_EQ(rule[static_cast<std::size_t>(OccupancyRule::thesis)], "thesis");
    const auto contents = names("bake.*", "contents", "occupancy");
    EXPECT_EQ(contents[static_cast<std::size_t>(OccupancyContent::occupied)], "occupied");
    EXPECT_EQ(contents[static_cast<std::size_t>(OccupancyContent::leap)], "leap");
    EXPECT_EQ(contents[static_cast<std::size_t>(OccupancyContent::minimum)], "minimum");
    EXPECT_EQ(contents[static_cast<std::size_t>(OccupancyContent::maximum)], "maximum");
}

}  // namespace
}  // namespace skybake::config

// The tables as data: what every row must have.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "config/field_reader.h"
#include "config/fields.h"

namespace skybake::config {
namespace {

TEST(FieldTables, KeysAreUniqueAndDocumented) {
    for (const Section& section : sections()) {
        std::set<std::string_view> keys;
        for (const Field& field : section.fields) {
            EXPECT_TRUE(keys.insert(field.key).second) << section.path << '.' << field.key;
            EXPECT_FALSE(field.documentation.empty()) << field.key;
            EXPECT_NE(field.documentation.back(), '.') << field.key;
            EXPECT_EQ(field.kind == Kind::choice, !field.choices.empty()) << field.key;
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
}

}  // namespace
}  // namespace skybake::config

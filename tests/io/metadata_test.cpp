#include "bakers/io/manifest/metadata.h"

#include "bakers/math/hash.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

std::string attribute(const Attributes& attributes, const std::string& name) {
    for (const auto& [key, value] : attributes) {
        if (key == name) return value;
    }
    return "(none)";
}

TEST(Metadata, SaysEverythingOfATable) {
    const BakedTable table = testing::sample_table();
    const Attributes attributes = exr_attributes(table);
    EXPECT_EQ(attribute(attributes, "skybake/kind"), "transmittance");
    EXPECT_EQ(attribute(attributes, "skybake/content"), table.content);
    EXPECT_EQ(attribute(attributes, "skybake/channels"), "R G B");
    EXPECT_EQ(attribute(attributes, "skybake/mapping"), "bruneton");
    EXPECT_EQ(attribute(attributes, "skybake/mapping_u"),
              "cos_zenith from 1 to -0.1, end points on texel centres: "
              "x_mu = (d - d_min) / (d_max - d_min)");
    EXPECT_EQ(
        attribute(attributes, "skybake/error"),
        "texel max 1e-07 rms 3.25e-08 (128 points); lookup max 0.0071 rms 0.0002 (1024 points); "
        "reference: adaptive quadrature; scale: 1 is full transmittance; worst at cos_zenith "
        "-0.01");
    EXPECT_EQ(attribute(attributes, "skybake/details"), "nodes = 12\n");
    EXPECT_EQ(attribute(attributes, "skybake/range"), "below_normal 0, above_range 0");
    EXPECT_EQ(attribute(attributes, "skybake/parameters"), table.parameters);
    EXPECT_NE(attribute(attributes, "skybake/units").find("E = 1"), std::string::npos);
    EXPECT_EQ(attribute(attributes, "skybake/content_hash"),
              xxh3_hex(stored_bytes(table.image, table.pixel_type)));
}

TEST(Metadata, UnitsAreThoseOfTheAsset) {
    Conventions of_radiance = {"km", "1/km", "cosine", "1/sr", {1, 1, 1}};
    EXPECT_EQ(units_line(of_radiance),
              "lengths and altitudes km, coefficients 1/km, angles as cosines, radiance 1/sr for a "
              "solar irradiance E = 1");
    of_radiance.solar_irradiance = {1.474, 1.8504, 1.91198};
    of_radiance.radiance_unit = "solar_irradiance/sr";
    of_radiance.angle_unit = "deg";
    EXPECT_EQ(units_line(of_radiance),
              "lengths and altitudes km, coefficients 1/km, angles deg, radiance "
              "solar_irradiance/sr for a solar irradiance E = 1.474, 1.8504, 1.91198");
    EXPECT_EQ(units_line({}), "");
}

TEST(Metadata, NamesFitIntoOldReaders) {
    for (const auto& [name, value] : exr_attributes(testing::sample_table())) {
        EXPECT_LE(name.size(), 31u);
        EXPECT_EQ(name.rfind("skybake/", 0), 0u);
    }
}

TEST(Metadata, SaysWhenNothingWasMeasured) {
    BakedTable table = testing::sample_table();
    table.certified = false;
    EXPECT_EQ(attribute(exr_attributes(table), "skybake/error"), "not measured");
}

TEST(Metadata, TheContentHashIsOfTheTexelsAlone) {
    BakedTable table = testing::sample_table();
    const std::string hash = describe(table).content_hash;
    table.compression = config::Compression::piz;
    table.name = "other";
    EXPECT_EQ(describe(table).content_hash, hash);
    table.image.texels[3] += 1;
    EXPECT_NE(describe(table).content_hash, hash);
}

// The file's own values are in its manifest: both come from one description.
TEST(Metadata, FileAndManifestAgree) {
    const auto table = encode_table(testing::sample_table());
    ASSERT_TRUE(table.value.has_value());
    const auto image = decode_exr(table.value->bytes, "sample.exr");
    ASSERT_TRUE(image.value.has_value());
    EXPECT_EQ(image.value->attributes, exr_attributes(table.value->asset));
    EXPECT_EQ(table.value->asset.files[0].bytes, table.value->bytes.size());
    EXPECT_EQ(table.value->asset.files[0].xxh3, xxh3_hex(table.value->bytes));
}

TEST(Metadata, AnUnstorableTableNamesItsFile) {
    BakedTable table = testing::sample_table();
    table.pixel_type = config::PixelType::half;
    table.image.texels[0] = 1e6f;
    const auto encoded = encode_table(table);
    ASSERT_EQ(testing::first_code(encoded.diagnostics), "E0402");
    EXPECT_EQ(encoded.diagnostics[0].where.source, "transmittance.exr");
}

}  // namespace
}  // namespace skybake

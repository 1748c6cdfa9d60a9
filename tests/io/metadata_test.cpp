#include "bakers/io/manifest/metadata.h"

#include "bakers/math/hash.h"
#include "tests/io/files.h"
#include "tests/support/exr_image.h"

namespace skybake {
namespace {

std::string line_of(const Baked& table, const std::string& name) {
    const ManifestAsset asset = describe_with_files(table);
    for (const auto& [key, text] : entry_lines(asset, asset.files[0])) {
        if (key == name) return text;
    }
    return "(none)";
}

TEST(Metadata, TellsPeopleEverythingOfATable) {
    const Baked table = testing::sample_table();
    EXPECT_EQ(line_of(table, "kind"), "transmittance");
    EXPECT_EQ(line_of(table, "content"), table.content);
    EXPECT_EQ(line_of(table, "channels"), "R G B");
    EXPECT_EQ(line_of(table, "mapping"), "bruneton");
    EXPECT_EQ(line_of(table, "size"), "16 x 8");
    EXPECT_EQ(line_of(table, "mapping_u"),
              "cos_zenith from 1 to -0.1, end points on texel centres: "
              "x_mu = (d - d_min) / (d_max - d_min)");
    EXPECT_EQ(
        line_of(table, "error"),
        "lookup max 0.0071 rms 0.0002 (1024 points); texel max 1e-07 rms 3.25e-08 (128 points); "
        "reference: adaptive quadrature; scale: 1 is full transmittance; worst at cos_zenith "
        "-0.01");
    EXPECT_EQ(line_of(table, "details"), "nodes = 12\n");
    EXPECT_EQ(line_of(table, "range"), "below_normal 0, above_range 0");
    EXPECT_EQ(line_of(table, "parameters"), table.parameters);
    EXPECT_NE(line_of(table, "units").find("E = 1"), std::string::npos);
    EXPECT_EQ(line_of(table, "content_hash"),
              xxh3_hex(stored_bytes(table.image(), table.pixel_type)));
}

TEST(Metadata, TheSkyErrorStandsFirst) {
    Baked table = testing::sample_table();
    table.certificate.sky = SkyError{0.004,
                                     0.01,
                                     0.05,
                                     210,
                                     "4000 paths of light in each of 70 places in the mean",
                                     0.006,
                                     3,
                                     "altitude_km 0.5"};
    EXPECT_TRUE(line_of(table, "error")
                    .starts_with("sky median 0.004 ninth decile 0.01 max 0.05 standard error 0.006 "
                                 "(210 values), reference: 4000 paths of light in each of 70 "
                                 "places in the mean; lookup max 0.0071"))
        << line_of(table, "error");
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

TEST(Metadata, SaysWhenNothingWasMeasured) {
    Baked table = testing::sample_table();
    table.certified = false;
    EXPECT_EQ(line_of(table, "error"), "not measured");
}

TEST(Metadata, TheContentHashIsOfTheTexelsAlone) {
    Baked table = testing::sample_table();
    const std::string hash = describe(table).content_hash;
    table.compression = config::Compression::piz;
    table.name = "other";
    testing::set_sample_image(table.image(), table);
    EXPECT_EQ(describe(table).content_hash, hash);
    Image2<float> image = table.image();
    image.texels[3] += 1;
    testing::set_sample_image(image, table);
    EXPECT_NE(describe(table).content_hash, hash);
}

// The metadata of a file reads back as what the manifest says, in every format that carries it.
TEST(Metadata, FileAndManifestAgree) {
    const testing::TemporaryFolder folder;
    Baked table = testing::sample_table();
    for (const auto& [format, type] : {std::pair{config::FileFormat::exr, config::PixelType::half},
                                       {config::FileFormat::png, config::PixelType::unorm16}}) {
        table.formats = {format};
        table.pixel_type = type;
        testing::set_sample_image(table.image(), table);
        const ManifestAsset asset = describe_with_files(table);
        const std::filesystem::path path = folder / asset.files[0].path;
        testing::write_bytes(path, "");
        ASSERT_EQ(write_asset_file(table, asset, asset.files[0], 1, nullptr, path).value, true);
        const auto entry = entry_of_file(path);
        ASSERT_TRUE(entry.value.has_value());
        EXPECT_EQ(file_entry_json(*entry.value, entry.value->files[0]),
                  file_entry_json(asset, asset.files[0]));
        EXPECT_EQ(entry.value->name, "transmittance");
        EXPECT_EQ(entry.value->levels[0].probes.size(), 16u);
    }
}

TEST(Metadata, FilesOfOthersSayNothing) {
    const testing::TemporaryFolder folder;
    ExrImage image;
    image.pixels = testing::sample_image(2, 2, 1);
    image.channel_names = {"Y"};
    for (const char* text : {"", "{}", "[1]", "no JSON", "{\"files\": []}"}) {
        image.attributes = {{"skybake/asset", text}};
        testing::write_bytes(folder / "a.exr", encode_exr(image));
        EXPECT_EQ(testing::first_code(entry_of_file(folder / "a.exr").diagnostics), "E0304")
            << text;
    }
    testing::write_bytes(folder / "a.bin", "1234");
    EXPECT_EQ(testing::first_code(entry_of_file(folder / "a.bin").diagnostics), "E0304");
    EXPECT_EQ(testing::first_code(entry_of_file(folder / "b.bin").diagnostics), "E0300");
}

}  // namespace
}  // namespace skybake

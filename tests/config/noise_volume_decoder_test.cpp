
#include <gtest/gtest.h>

#include "config/assets/noise_volume.h"
#include "tests/config/noises.h"

namespace skybake::config {
namespace {

using testing::only_diagnostic;
using testing::parse;
using testing::valid;
using testing::volume_recipe;

NoiseVolumeBake volume(const std::string& keys, const std::string& noise = "") {
    const Recipe recipe =
        valid(volume_recipe(keys, "type = 'worley'\nfrequency = 1") + "[noise.n]\n" + noise + "\n");
    if (recipe.parameters.bakes.size() != 1) return {};
    return recipe.parameters.bakes[0].as<NoiseVolumeBake>();
}

Diagnostic fault(const std::string& keys) {
    return only_diagnostic(volume_recipe(keys, "type = 'worley'\nfrequency = 1"));
}

using Size = std::array<int, 3>;
using Formats = std::vector<FileFormat>;

TEST(NoiseVolumeDecoder, HasTheDefaultsOfTheIssue) {
    const NoiseVolumeBake bake = volume("", "size = [32, 16, 8]");
    EXPECT_EQ(bake.noise, "n");
    EXPECT_EQ(bake.size, (Size{32, 16, 8})) << "the noise's";
    EXPECT_EQ(bake.formats, Formats{FileFormat::exr});
    EXPECT_EQ(bake.pixel_type, PixelType::half);
    EXPECT_EQ(bake.layout, SheetLayout::stack);
    EXPECT_EQ(bake.columns, 0);
    EXPECT_EQ(bake.mips, 1);
    EXPECT_EQ(bake.compression, Compression::zip);
    EXPECT_EQ(bake.vdb_compression, VdbCompression::blosc);
}

TEST(NoiseVolumeDecoder, ReadsEveryKey) {
    const NoiseVolumeBake bake = volume(
        "size = [64, 32, 16]\nformats = ['vdb', 'exr']\npixel_type = 'float'\nlayout = 'atlas'\n"
        "columns = 4\nmips = 3\ncompression = 'piz'\nvdb_compression = 'none'");
    EXPECT_EQ(testing::to_string(bake), "n [64, 32, 16] 0 1 4 3 3 0 1 0");
    EXPECT_EQ(volume("formats = 'bin'\npixel_type = 'unorm8'").formats, Formats{FileFormat::bin});
    EXPECT_EQ(volume("formats = ['bin']\npixel_type = 'unorm16'").pixel_type, PixelType::unorm16);
}

TEST(NoiseVolumeDecoder, AllLevelsGoDownToOneVoxel) {
    EXPECT_EQ(volume("mips = 'all'").mips, 8);
    EXPECT_EQ(volume("mips = 'all'\nsize = [1, 1, 1]").mips, 1);
    EXPECT_EQ(volume("mips = 'all'\nsize = [5, 300, 7]").mips, 9);
    EXPECT_EQ(fault("flip = true\nformats = ['bin', 'dds']").code, "E0131") << "no reader would see it";
    EXPECT_TRUE(volume("flip = true\nformats = ['bin', 'exr']").flip);
    EXPECT_EQ(volume("mips = 'all'\nsize = [16384, 4, 1]", "").mips, 15);
    EXPECT_EQ(volume("mips = 8").mips, 8);
    EXPECT_EQ(fault("mips = 9").code, "E0110");
    EXPECT_EQ(fault("mips = 9").label, "128x128x128 has 8 levels down to one voxel");
    EXPECT_EQ(fault("mips = 0").code, "E0110");
    EXPECT_EQ(fault("mips = 16").code, "E0110");
    EXPECT_EQ(fault("mips = 'some'").code, "E0103");
    EXPECT_EQ(fault("mips = 1.5").code, "E0103");
}

TEST(NoiseVolumeDecoder, SizesHaveRanges) {
    for (const char* size : {"[0, 1, 1]", "[-1, 1, 1]", "[1, 1, 2147483648]", "[16385, 1, 1]"}) {
        EXPECT_EQ(fault(std::string("size = ") + size).code, "E0110") << size;
    }
    EXPECT_EQ(fault("size = [1, 1]").code, "E0108");
    EXPECT_EQ(fault("size = 64").code, "E0103");
    EXPECT_EQ(fault("size = [1.0, 1, 1]").code, "E0103");
}

TEST(NoiseVolumeDecoder, LargeVolumesSayWhatTheyWouldNeed) {
    const Diagnostic diagnostic = fault("size = [10000, 10000, 10000]");
    EXPECT_EQ(diagnostic.code, "E0126");
    EXPECT_EQ(diagnostic.message,
              "[bake.n] has 1000000000000 voxels (10000x10000x10000) and would need 2000000000000 "
              "bytes (1.82 TiB)");
    EXPECT_EQ(diagnostic.where.line, 4);
    EXPECT_TRUE(fault("size = [16384, 16384, 16384]\npixel_type = 'float'")
                    .message.find("17592186044416 bytes (16 TiB)") != std::string::npos);
    EXPECT_EQ(fault("size = [4096, 4096, 4097]").code, "E0126");
    EXPECT_EQ(volume("size = [4096, 4096, 4096]\nformats = 'bin'").size[0], 4096)
        << "2^36 voxels are allowed";
}

// A packed noise has one channel; four channels need four times as much.
TEST(NoiseVolumeDecoder, BytesCountTheChannelsOfTheFile) {
    const auto message = [](const std::string& preset) {
        return only_diagnostic("[noise.n]\npreset = '" + preset +
                               "'\n[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n"
                               "size = [16384, 16384, 16384]\n")
            .message;
    };
    EXPECT_NE(message("nubis_shape").find("need 35184372088832 bytes"), std::string::npos);
    EXPECT_NE(message("takram_shape").find("need 8796093022208 bytes"), std::string::npos);
}

TEST(NoiseVolumeDecoder, FormatsAreASet) {
    EXPECT_EQ(fault("formats = []").code, "E0108");
    EXPECT_EQ(fault("formats = ['exr', 'exr']").code, "E0108");
    EXPECT_EQ(fault("formats = ['exr', 'vbd']").label, "did you mean `vdb`?");
    EXPECT_EQ(fault("formats = 3").code, "E0103");
}

TEST(NoiseVolumeDecoder, FormatsHaveTheirPixelTypes) {
    const Diagnostic diagnostic = fault("formats = ['exr', 'bin', 'vdb']\npixel_type = 'unorm16'");
    EXPECT_EQ(diagnostic.code, "E0131");
    EXPECT_EQ(diagnostic.message, "`bake.n.pixel_type`: exr and vdb files cannot hold unorm16");
    EXPECT_EQ(diagnostic.where.line, 5);
    EXPECT_EQ(fault("pixel_type = 'unorm8'").code, "E0131");
}

TEST(NoiseVolumeDecoder, ColumnsAreOfAnAtlas) {
    EXPECT_EQ(fault("columns = 4").code, "E0111");
    EXPECT_EQ(fault("layout = 'atlas'\ncolumns = 0").code, "E0110");
    EXPECT_EQ(fault("layout = 'atlas'\ncolumns = 129").label, "the volume has 128 slices");
    EXPECT_EQ(volume("layout = 'atlas'\ncolumns = 128").columns, 128);
    EXPECT_EQ(fault("layout = 'atlas'\nsize = [16384, 16, 128]\ncolumns = 65").label,
              "an atlas is at most 1048576 voxels wide, which is 64 columns");
    EXPECT_EQ(volume("layout = 'atlas'").columns, 0);
}

TEST(NoiseVolumeDecoder, ItsNoiseIsThere) {
    const Diagnostic missing = only_diagnostic(
        "[noise.wisps.channels.Y]\ntype = 'worley'\n[bake.n]\nasset = 'noise_volume'\n");
    EXPECT_EQ(missing.code, "E0105");
    const Diagnostic slip = only_diagnostic(
        "[noise.wisps.channels.Y]\ntype = 'worley'\n[bake.n]\nasset = 'noise_volume'\n"
        "noise = 'wips'\n");
    EXPECT_EQ(slip.code, "E0130");
    EXPECT_EQ(slip.label, "did you mean `wisps`?");
    EXPECT_EQ(slip.where.line, 5);
    EXPECT_EQ(only_diagnostic("[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n").label,
              "the recipe has no [noise.NAME]");
    EXPECT_EQ(
        only_diagnostic("[noise]\nn = 3\n[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n").code,
        "E0103");
}

TEST(NoiseVolumeDecoder, WarnsOnceOfAliasing) {
    const auto outcome = parse(
        "[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\nsize = [32, 32, 32]\n"
        "[noise.n.channels.R]\ntype = 'perlin_worley'\nfrequency = 2\noctaves = 4\n"
        "worley_frequencies = [[8, 8, 9], 40]\n"
        "[noise.n.channels.G]\ntype = 'worley'\nfrequencies = [64, 2]\ngains = [0, 1]\n"
        "[noise.n.channels.B]\ntype = 'worley'\nfrequencies = [[1, 1, 90]]\n");
    ASSERT_TRUE(outcome.value);
    ASSERT_EQ(outcome.diagnostics.size(), 1u);
    EXPECT_EQ(outcome.diagnostics[0].code, "W0203");
    EXPECT_EQ(outcome.diagnostics[0].severity, Severity::warning);
    EXPECT_EQ(outcome.diagnostics[0].message,
              "4 octaves are too fine for 32x32x32: `n` needs 160x160x360");
    EXPECT_EQ(outcome.diagnostics[0].where.line, 4);
    EXPECT_EQ(only_diagnostic(volume_recipe("size = [32, 32, 1]", "type = 'worley'\nfrequency = 9"))
                  .message,
              "1 octave is too fine for 32x32x1: `n` needs 36x36x1");
}

// A source that aliases is copied as it is; a bake below its own size is a draft of it.
TEST(NoiseVolumeDecoder, SomeNoisesAliasByIntention) {
    const auto codes = [](const std::string& size) {
        std::string text;
        for (const Diagnostic& diagnostic :
             parse(volume_recipe(size, "type = 'worley'\nfrequency = 9") +
                   "[noise.n]\naliases = true\nsize = [32, 32, 32]\n")
                 .diagnostics) {
            text += diagnostic.code;
        }
        return text;
    };
    EXPECT_EQ(codes(""), "");
    EXPECT_EQ(codes("size = [32, 32, 32]"), "");
    EXPECT_EQ(codes("size = [33, 32, 32]"), "");
    EXPECT_EQ(codes("size = [32, 32, 31]"), "W0203");
    for (const char* preset : {"thesis", "takram_shape", "takram_detail"}) {
        const auto outcome = parse("[noise.n]\npreset = '" + std::string(preset) +
                                   "'\n[bake.n]\nasset = 'noise_volume'\nnoise = 'n'\n");
        EXPECT_TRUE(outcome.diagnostics.empty()) << preset;
    }
}

TEST(NoiseVolumeDecoder, WarnsOfOctavesOfNothing) {
    const auto code = [](const std::string& noise, const std::string& channel) {
        const auto outcome =
            parse(volume_recipe("size = [32, 32, 32]", channel) + "[noise.n]\n" + noise);
        EXPECT_TRUE(outcome.value) << channel;
        const auto& diagnostics = outcome.diagnostics;
        return diagnostics.empty() ? "none" : diagnostics[0].code;
    };
    EXPECT_EQ(code("", "type = 'perlin'\nfrequency = 64"), "W0208");
    EXPECT_EQ(code("", "type = 'perlin'\nfrequency = 2\noctaves = 6"), "W0208");
    EXPECT_EQ(code("", "type = 'perlin_worley'\nfrequency = 64\nfractal = 'ridged'"), "W0208");
    EXPECT_EQ(code("sampling = 'corners'", "type = 'perlin'\nfrequency = 32"), "W0208");
    EXPECT_EQ(code("", "type = 'perlin'\nfrequency = 32"), "W0203");
    EXPECT_EQ(code("", "type = 'perlin'\nfrequency = [64, 64, 63]"), "W0203");
    EXPECT_EQ(code("", "type = 'worley'\nfrequency = 64"), "W0203");
    // The gradients themselves, which curl noise is made of, do not vanish on the lattice.
    EXPECT_EQ(code("", "type = 'curl'\nfrequency = 64"), "W0203");
    EXPECT_EQ(code("", "type = 'perlin'\nfrequencies = [2, 64]\ngains = [1, 0]"), "none");
    const auto message = [](const std::string& channel) {
        return parse(volume_recipe("size = [32, 32, 32]", channel)).diagnostics.at(0).message;
    };
    EXPECT_EQ(message("type = 'perlin'\nfrequency = 2\noctaves = 6"),
              "octave 6 of channel Y of noise `n` adds nothing at size 32x32x32: every voxel falls "
              "on a lattice point");
    EXPECT_EQ(message("type = 'perlin'\nfrequency = 2\noctaves = 8"),
              "octave 6 of channel Y of noise `n` and 2 others add nothing at size 32x32x32: every "
              "voxel falls on a lattice point");
}

// Nobody has said how: then so that engines can import it.
TEST(NoiseVolumeDecoder, AStackThatWouldBeTooHighIsAnAtlas) {
    const NoiseVolumeBake high = volume("size = [64, 256, 128]");
    EXPECT_EQ(high.layout, SheetLayout::atlas);
    EXPECT_EQ(high.columns, 0) << "each level chooses its own";
    EXPECT_EQ(volume("size = [64, 128, 128]").layout, SheetLayout::stack) << "16384 rows fit";
    EXPECT_EQ(volume("size = [64, 256, 128]\nformats = 'bin'").layout, SheetLayout::stack);
    const Diagnostic asked = fault("layout = 'stack'\nsize = [64, 256, 128]");
    EXPECT_EQ(asked.code, "W0212");
    EXPECT_EQ(asked.severity, Severity::warning);
    EXPECT_NE(asked.message.find("64 columns and 32768 rows"), std::string::npos) << asked.message;
    EXPECT_EQ(fault("layout = 'atlas'\ncolumns = 128\nsize = [256, 64, 128]").code, "W0212");
}

TEST(NoiseVolumeDecoder, WarnsOfEmptyCells) {
    const Diagnostic empty = fault("layout = 'atlas'\ncolumns = 12\nsize = [64, 64, 128]");
    EXPECT_EQ(empty.code, "W0213");
    EXPECT_NE(empty.message.find("132 cells for 128 slices"), std::string::npos) << empty.message;
    EXPECT_EQ(empty.label, "columns = 16 leaves no cell empty");
    const Diagnostic prime = fault("layout = 'atlas'\nsize = [128, 128, 131]");
    EXPECT_EQ(prime.code, "W0213");
    EXPECT_EQ(prime.label, "131 slices fill no atlas of at most 16384 by 16384 texels");
    EXPECT_EQ(volume("layout = 'atlas'\nsize = [64, 64, 131]").layout, SheetLayout::atlas)
        << "in one row";
}

}  // namespace
}  // namespace skybake::config

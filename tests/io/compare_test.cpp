#include "bakers/io/manifest/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bakers/io/files/to_string.h"
#include "tests/io/files.h"

namespace skybake {
namespace {

ExrImage sample() {
    ExrImage image;
    image.pixels = testing::sample_image(8, 4, 3);
    image.channel_names = {"R", "G", "B"};
    image.attributes = {{"skybake/kind", "transmittance"}};
    return image;
}

// Rows of an image in memory, in pieces of three.
ComparedImage rows(const ExrImage& image) {
    return {{image.pixels.width, image.pixels.height, image.channel_names.size(), 3,
             [&image](int first, int count, float* texels) -> std::optional<config::Diagnostic> {
                 const float* from = image.pixels.texel(0, first);
                 std::copy_n(from, image.pixels.texel(0, first + count) - from, texels);
                 return std::nullopt;
             }},
            image.channel_names,
            image.pixel_type,
            std::string(to_string(image.compression)),
            image.attributes};
}

ImageDifference compare_images(const ExrImage& first, const ExrImage& second) {
    return *compare_images(rows(first), rows(second)).value;
}

TEST(Compare, EqualImagesAreEqual) {
    const ImageDifference difference = compare_images(sample(), sample());
    EXPECT_TRUE(equal_within(difference, 0));
    EXPECT_TRUE(difference.attributes.empty());
    EXPECT_EQ(difference.channels.size(), 3u);
}

TEST(Compare, FindsTheLargestDifference) {
    ExrImage other = sample();
    other.pixels.texel(5, 2)[1] += 0.25f;
    other.pixels.texel(1, 1)[1] += 0.125f;
    const ImageDifference difference = compare_images(sample(), other);
    const ChannelDifference& green = difference.channels[1];
    EXPECT_EQ(green.max_absolute, 0.25);
    EXPECT_EQ(green.worst, (std::vector{5, 2}));
    EXPECT_EQ(green.differing, 2);
    EXPECT_NEAR(green.rms, std::sqrt((0.0625 + 0.015625) / 32), 1e-15);
    EXPECT_EQ(difference.channels[0].differing, 0);
    EXPECT_TRUE(equal_within(difference, 0.25));
    EXPECT_FALSE(equal_within(difference, 0.2));
}

TEST(Compare, NotANumberEqualsItselfOnly) {
    ExrImage first = sample();
    first.pixels.texels[0] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(equal_within(compare_images(first, first), 0));
    EXPECT_FALSE(equal_within(compare_images(first, sample()), 1e30));
}

TEST(Compare, NamesWhatMakesImagesIncomparable) {
    ExrImage other = sample();
    other.pixels = testing::sample_image(8, 5, 3);
    const ImageDifference difference = compare_images(sample(), other);
    EXPECT_EQ(difference.layout, "8 x 4 R G B against 8 x 5 R G B");
    EXPECT_FALSE(equal_within(difference, 1e30));
}

TEST(Compare, ListsMetadata) {
    ExrImage other = sample();
    other.attributes = {{"skybake/kind", "other"}, {"skybake/new", "x"}};
    other.pixel_type = config::PixelType::half;
    const ImageDifference difference = compare_images(sample(), other);
    ASSERT_EQ(difference.attributes.size(), 3u);
    EXPECT_EQ(difference.attributes[0].name, "pixel type");
    EXPECT_EQ(difference.attributes[1].second, "other");
    EXPECT_EQ(difference.attributes[2].first, std::nullopt);
    EXPECT_TRUE(equal_within(difference, 0));
}

TEST(Compare, PassesOnWhatCannotBeRead) {
    const ExrImage image = sample();
    ComparedImage broken = rows(image);
    broken.rows.read = [](int, int, float*) {
        return config::Diagnostic{{}, "E0304", "no", {}, {}};
    };
    EXPECT_EQ(testing::first_code(compare_images(rows(image), broken).diagnostics), "E0304");
}

}  // namespace
}  // namespace skybake

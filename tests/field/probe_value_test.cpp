#include "bakers/field/choose_probes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bakers/field/interpolation.h"

namespace skybake {
namespace {

TEST(ProbeValue, AllowsForFilteringInTwoHundredAndFiftySixths) {
    Image2<float> image(4, 4, 1);
    for (std::size_t i = 0; i < image.texels.size(); ++i) {
        image.texels[i] = static_cast<float>(i * i);
    }
    const ProbedTexture texture = {readable_texture(image), 2, config::PixelType::float32, {225}};
    for (double u = 0.05; u < 1; u += 0.09) {
        for (double v = 0.05; v < 1; v += 0.13) {
            const ProbeValue probe = probe_value(texture, {{{u, v, 0.5}}});
            // A lookup whose weights are rounded to multiples of 1/256.
            const auto rounded = [](double t, int size) {
                return (std::round((t * size - 0.5) * 256) / 256 + 0.5) / size;
            };
            double value = 0;
            bilinear(image, rounded(u, 4), rounded(v, 4), &value);
            EXPECT_NEAR(value, probe.value[0], probe.tolerance[0]);
            // Half a texel off is not allowed for.
            bilinear(image, u + 0.125, v, &value);
            if (u > 0.125 && u < 0.75) {
                EXPECT_GT(std::fabs(value - probe.value[0]), probe.tolerance[0]);
            }
        }
    }
}

}  // namespace
}  // namespace skybake

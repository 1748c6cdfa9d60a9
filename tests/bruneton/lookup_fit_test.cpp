#include "bakers/assets/bruneton/table_content.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/light/sky_media.h"

namespace skybake {
namespace {

// The largest relative error of linear lookups of an exponential, at texels and between.
double worst_lookup(double rate, const std::vector<double>& scales) {
    double worst = 0;
    const int last = static_cast<int>(scales.size()) - 1;
    for (double x = 2; x <= last - 2; x += 0.125) {
        const int i = std::min(static_cast<int>(x), last - 1);
        const auto value = [&](int at) {
            return scales[static_cast<std::size_t>(at)] * std::exp(rate * at);
        };
        const double found = (i + 1 - x) * value(i) + (x - i) * value(i + 1);
        worst = std::max(worst, std::fabs(found / std::exp(rate * x) - 1));
    }
    return worst;
}

TEST(LookupFit, HalvesTheErrorOfSteepLight) {
    for (const double rate : {-1.2, -0.6, 0.3, 1.0}) {
        std::vector<double> line;
        for (int i = 0; i < 12; ++i) line.push_back(std::exp(rate * i));
        const double plain = worst_lookup(rate, std::vector<double>(12, 1.0));
        EXPECT_LT(worst_lookup(rate, lookup_scales(line)), 0.62 * plain) << rate;
    }
}

TEST(LookupFit, LeavesStraightLinesAndDarkTexelsAlone) {
    for (const double scale : lookup_scales({5, 5, 5, 5})) EXPECT_NEAR(scale, 1, 1e-12);
    for (const double scale : lookup_scales({0, 0, 0})) EXPECT_EQ(scale, 1);
    for (const double scale : lookup_scales({0, 3, 0})) EXPECT_EQ(scale, 1);
    EXPECT_EQ(lookup_scales({1e-15, 0.03, 0.2, 0.3}), lookup_scales({0, 0.03, 0.2, 0.3}));
    EXPECT_EQ(lookup_scales({7}).front(), 1);
    EXPECT_NEAR(lookup_scales({2, 2})[1], 1, 1e-12);
}

RC_GTEST_PROP(LookupFit, StaysWithinAQuarterWhateverTheTexels, ()) {
    std::vector<double> line;
    const int count = *rc::gen::inRange(1, 40);
    for (int i = 0; i < count; ++i) {
        line.push_back(*rc::gen::inRange(0, 4) == 0 ? 0 : test::log_uniform(1e-40, 1e3));
    }
    for (const double scale : lookup_scales(line)) {
        RC_ASSERT(scale >= 0.75);
        RC_ASSERT(scale <= 1.25);
    }
}

}  // namespace
}  // namespace skybake

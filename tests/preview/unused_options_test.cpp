#include "bakers/preview/check_options.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace skybake {
namespace {

struct Case {
    const char* name;
    std::function<void(PreviewOptions&)> give;
    bool sky;     // whether pictures of a sky use it
    bool clouds;  // whether pictures of a cloud do
};

const Case cases[] = {
    {"sun-elevation", [](PreviewOptions& options) { options.sun_elevations_deg = {3}; }, true,
     true},
    {"exposure", [](PreviewOptions& options) { options.exposure_stops = 0; }, true, true},
    {"tone-curve", [](PreviewOptions& options) { options.tone_curve = ToneCurve::agx; }, true,
     true},
    {"glare", [](PreviewOptions& options) { options.glare = Glare::none; }, true, false},
    {"altitude", [](PreviewOptions& options) { options.altitude_m = 0; }, true, false},
    {"sun-azimuth", [](PreviewOptions& options) { options.sun_azimuth_deg = 0; }, false, true},
    {"camera", [](PreviewOptions& options) { options.camera.emplace(); }, false, true},
    {"size",
     [](PreviewOptions& options) {
         options.picture_size = {16, 16};
     },
     false, true},
    {"single", [](PreviewOptions& options) { options.single = true; }, false, true},
    {"turntable", [](PreviewOptions& options) { options.turntable = 8; }, false, true},
    {"at", [](PreviewOptions& options) { options.at.emplace(); }, true, true},
    {"place", [](PreviewOptions& options) { options.place.emplace(); }, true, true},
};

TEST(UnusedOptions, AreThoseThatNoPictureUses) {
    for (const Case& one : cases) {
        PreviewOptions options;
        one.give(options);
        for (const bool sky : {false, true}) {
            for (const bool clouds : {false, true}) {
                const auto problems = unused_options({sky, clouds, false}, options);
                const bool used = (sky && one.sky) || (clouds && one.clouds);
                ASSERT_EQ(problems.size(), used ? 0U : 1U) << one.name << sky << clouds;
                if (used) continue;
                EXPECT_EQ(problems[0].code, "E0001");
                EXPECT_NE(problems[0].message.find(std::string("--") + one.name),
                          std::string::npos);
            }
        }
    }
    EXPECT_TRUE(unused_options({}, PreviewOptions{}).empty());
}

// A contact sheet shows the clouds of variants that have both, and has a size whatever it shows.
TEST(UnusedOptions, OfASweepAreThoseOfItsContactSheet) {
    PreviewOptions options;
    options.altitude_m = 100;
    EXPECT_TRUE(unused_options({true, false, true}, options).empty());
    EXPECT_EQ(unused_options({true, true, true}, options).size(), 1U);
    options = {};
    options.picture_size = {64, 64};
    EXPECT_TRUE(unused_options({false, false, true}, options).empty());
}

}  // namespace
}  // namespace skybake

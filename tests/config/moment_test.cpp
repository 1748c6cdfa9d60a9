#include "config/text/moment.h"

#include <gtest/gtest.h>

#include <string>

namespace skybake::config {
namespace {

// Seconds since 1970 by `date -u -d ... +%s`.
TEST(Moment, IsReadInEachForm) {
    const struct {
        const char* text;
        double clock;
        std::optional<double> offset;
    } cases[] = {
        {"1970-01-01 00:00Z", 0, 0.0},
        {"2003-10-17T12:30:30-07:00", 1066393830, -25200.0},
        {"2026-06-21 18:30", 1782066600, std::nullopt},
        {"  2026-06-21  18:30 +02:00 ", 1782066600, 7200.0},
        {"2024-02-29 23:59:59 +05:45", 1709251199, 20700.0},
        {"1900-01-01 00:00 Z", -2208988800, 0.0},
        {"2100-12-31 00:00 Z", 4133894400, 0.0},
    };
    for (const auto& one : cases) {
        const auto moment = parse_moment(one.text);
        ASSERT_TRUE(moment) << one.text;
        EXPECT_EQ(moment->clock_seconds, one.clock) << one.text;
        EXPECT_EQ(moment->offset_seconds, one.offset) << one.text;
    }
}

TEST(Moment, IsNoOtherText) {
    for (const char* text : {"",
                             "18:30",
                             "2026-06-21",
                             "2026-06-21 ",
                             "2026-6-21 18:30",
                             "26-06-21 18:30",
                             "2026-13-21 18:30",
                             "2026-02-29 18:30",
                             "2026-06-31 18:30",
                             "2026-06-00 18:30",
                             "2026-06-21 24:00",
                             "2026-06-21 18:60",
                             "2026-06-21 18:30:60",
                             "2026-06-21 1830",
                             "2026-06-21 18:30 CET",
                             "2026-06-21 18:30 +2",
                             "2026-06-21 18:30 +02:00 x",
                             "2026-06-21 18:30Zx",
                             "1899-12-31 18:30",
                             "2101-01-01 00:00",
                             "+026-06-21 18:30"}) {
        EXPECT_FALSE(parse_moment(text)) << text;
    }
}

TEST(Moment, IsMeanSolarTimeWithoutAnOffset) {
    EXPECT_EQ(utc_seconds({86400, 3600.0}, 90), 82800);
    EXPECT_EQ(utc_seconds({86400, std::nullopt}, 90), 86400 - 6 * 3600);
    EXPECT_EQ(utc_seconds({86400, std::nullopt}, -15), 86400 + 3600);
}

TEST(Moment, IsSpelledToTheMinute) {
    for (const char* text : {"2026-06-21 16:30", "1970-01-01 00:00", "1969-12-31 23:59",
                             "1900-03-01 00:00", "2000-02-29 12:07"}) {
        EXPECT_EQ(utc_text(parse_moment(text + std::string("Z"))->clock_seconds),
                  text + std::string(" UTC"));
    }
    EXPECT_EQ(utc_text(59.0), "1970-01-01 00:01 UTC");
    EXPECT_EQ(utc_text(-31.0), "1969-12-31 23:59 UTC");
}

}  // namespace
}  // namespace skybake::config

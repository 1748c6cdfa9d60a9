#include "bakers/math/facts.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

TEST(Facts, TextsAreThoseOfTheValues) {
    EXPECT_EQ(fact_text("words"), "words");
    EXPECT_EQ(fact_text(12.0), "12");
    EXPECT_EQ(fact_text(0.1), "0.1");
    EXPECT_EQ(fact_text(std::vector<double>{30, 3, -4.5}), "30, 3, -4.5");
    EXPECT_EQ(fact_text(std::vector<double>()), "");
    const Facts facts = {{"a", 1.0}, {"b", "two"}};
    EXPECT_EQ(fact_named(facts, "b"), "two");
    EXPECT_EQ(fact_named(facts, "c"), "");
}

TEST(Facts, RoundsToDecimalDigits) {
    EXPECT_EQ(to_digits(10.000000000000002, 9), 10);
    EXPECT_EQ(to_digits(1.0 / 3, 3), 0.333);
    EXPECT_EQ(to_digits(-6360123.4567, 9), -6360123.46);
    EXPECT_EQ(to_digits(0, 9), 0);
    EXPECT_EQ(to_digits(std::vector<double>{1.26, 0.0126}, 2), (std::vector<double>{1.3, 0.013}));
    EXPECT_EQ(to_shortest(0.3f), 0.3);
    EXPECT_NE(to_shortest(0.3f), double{0.3f});
}

}  // namespace
}  // namespace skybake

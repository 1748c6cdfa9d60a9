#include "bakers/math/hash.h"

#include <gtest/gtest.h>

namespace skybake {
namespace {

// From the test vectors of the XXH3 specification: the empty input with seed 0.
TEST(Hash, EqualsTheSpecification) { EXPECT_EQ(xxh3_hex(""), "99aa06d3014798d86001c324468d497f"); }

TEST(Hash, ChangesWithEachBit) {
    EXPECT_NE(xxh3_hex("skybake"), xxh3_hex("skybakf"));
    EXPECT_EQ(xxh3_hex("skybake").size(), 32u);
}

}  // namespace
}  // namespace skybake

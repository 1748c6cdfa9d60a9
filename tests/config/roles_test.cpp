#include "config/fields/roles.h"

#include <gtest/gtest.h>

#include <array>

namespace skybake::config {
namespace {

ResolvedValue value_of(const std::string& section, Role role) {
    ResolvedValue value;
    value.section = section;
    value.role = role;
    return value;
}

TEST(ResolvedValue, IsReadBySectionAndRole) {
    const std::array reads = {Read{""}, Read{"atmosphere.layers.*", {Role::geometry, Role::phase}},
                              Read{"noise.\"a.b\"", Roles::all()}};
    const auto read = [&](const std::string& section, Role role) {
        return is_read(value_of(section, role), reads);
    };
    EXPECT_TRUE(read("", Role::content)) << "the recipe as a whole";
    EXPECT_FALSE(read("", Role::usual));
    EXPECT_TRUE(read("atmosphere.layers.mie", Role::geometry));
    EXPECT_TRUE(read("atmosphere.layers.mie", Role::phase));
    EXPECT_FALSE(read("atmosphere.layers.mie", Role::content));
    EXPECT_FALSE(read("atmosphere.layers", Role::geometry));
    EXPECT_FALSE(read("atmosphere", Role::geometry));
    for (const Role role : {Role::content, Role::files, Role::usual}) {
        EXPECT_TRUE(read("noise.\"a.b\"", role));
    }
    EXPECT_FALSE(read("noise.a.b", Role::content)) << "a channel of another noise";
    EXPECT_FALSE(is_read(value_of("", Role::content), {}));
}

}  // namespace
}  // namespace skybake::config

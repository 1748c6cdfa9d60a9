#include "tests/support/recipes.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace skybake::test {

std::string recipe_text(const std::string& name) {
    std::ifstream file(SKYBAKE_TEST_RECIPES "/" + name + ".toml");
    if (!file) throw std::runtime_error("no recipe " + name);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace skybake::test

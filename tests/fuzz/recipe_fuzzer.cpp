// Recipes: whatever the bytes, either errors or values in range.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "tests/fuzz/properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    // A fuzzer must not wander through the file system.
    if (text.find("include") != std::string_view::npos ||
        text.find('\\') != std::string_view::npos) {
        return 0;
    }
    skybake::config::fuzzing::check_outcome(skybake::config::parse_recipe(text, "fuzz.toml"));
    return 0;
}

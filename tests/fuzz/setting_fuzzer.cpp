// --set texts, one a line, over preset earth.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::string_view text(reinterpret_cast<const char*>(data), size);
    // A fuzzer must not wander through the file system.
    if (text.find("include") != std::string_view::npos ||
        text.find('\\') != std::string_view::npos) {
        return 0;
    }
    std::vector<std::string> settings;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        settings.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    skybake::config::fuzzing::check_outcome(skybake::config::parse_recipe(
        "preset = \"earth_hillaire\"\n[bake.transmittance]\n", "fuzz.toml", {}, settings));
    return 0;
}

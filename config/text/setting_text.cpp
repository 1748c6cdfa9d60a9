#include "config/text/setting_text.h"

namespace skybake::config {

std::string_view trim(std::string_view text) {
    constexpr std::string_view blanks = " \t";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::size_t find_equals(std::string_view setting) {
    bool quoted = false;
    for (std::size_t i = 0; i < setting.size(); ++i) {
        if (quoted && setting[i] == '\\') {
            ++i;
        } else if (setting[i] == '"') {
            quoted = !quoted;
        } else if (setting[i] == '=' && !quoted) {
            return i;
        }
    }
    return std::string_view::npos;
}

}  // namespace skybake::config

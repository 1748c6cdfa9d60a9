#include "bakers/preview/page_text.h"

#include <fmt/format.h>

#include "bakers/io/files/to_string.h"
#include "bakers/io/manifest/release.h"

namespace skybake {

std::string generator() { return fmt::format("{} {} preview", tool_name(), release()); }

std::string html_text(std::string_view text) {
    static const std::map<char, std::string_view> entities = {
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
    std::string escaped;
    for (const char c : text) {
        const auto entity = entities.find(c);
        entity == entities.end() ? void(escaped += c) : void(escaped += entity->second);
    }
    return escaped;
}

std::string safe_in_script(std::string_view text) {
    std::string safe;
    safe.reserve(text.size());
    for (const char c : text) {
        if (c == '<') {
            safe += "\\u003c";
        } else {
            safe += c;
        }
    }
    return safe;
}

std::string filled(std::string_view form, const std::map<std::string_view, std::string>& values) {
    std::string text;
    for (std::size_t at = 0;;) {
        const std::size_t open = form.find("{{", at);
        const std::size_t close = form.find("}}", open);
        if (close == std::string_view::npos) return text.append(form.substr(at));
        text.append(form.substr(at, open - at));
        text.append(values.at(form.substr(open + 2, close - open - 2)));
        at = close + 2;
    }
}

}  // namespace skybake

#include "config/text/text_layout.h"

namespace skybake::config {
namespace {

std::size_t characters(std::string_view text) {
    std::size_t count = 0;
    for (const char c : text) count += (static_cast<unsigned char>(c) & 0xc0) != 0x80 ? 1 : 0;
    return count;
}

std::string wrap_line(std::string_view text, std::string_view prefix, std::size_t width) {
    std::string result;
    std::string line(prefix);
    bool empty = true;
    while (!text.empty()) {
        const std::string_view word = text.substr(0, text.find(' '));
        text.remove_prefix(std::min(word.size() + 1, text.size()));
        if (!empty && characters(line) + 1 + characters(word) > width) {
            result += line + '\n';
            line = prefix;
            empty = true;
        }
        if (!empty) line += ' ';
        line += word;
        empty = false;
    }
    return result + line + '\n';
}

}  // namespace

std::string wrap(std::string_view text, std::string_view prefix, std::size_t width) {
    std::string result;
    while (true) {
        const std::size_t end = text.find('\n');
        result += wrap_line(text.substr(0, end), prefix, width);
        if (end == std::string_view::npos) return result;
        text.remove_prefix(end + 1);
    }
}

}  // namespace skybake::config

#include "config/diagnostics/diagnostic.h"

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "config/text/key_path.h"
#include "config/text/text.h"

namespace skybake::config {
namespace {

constexpr std::size_t most_diagnostics = 1000;
constexpr std::size_t longest_line = 1000;

// Returns the line as a terminal and a JSON document can take it. Tabs stay; if there is anything else
// that is no text, all of that is escaped.
std::string shown(std::string_view line) {
    const bool has_control = std::ranges::any_of(line, [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return (byte < 0x20 && c != '\t') || byte == 0x7f;
    });
    return has_control || find_invalid_utf8(line) ? printable(line) : std::string(line);
}

std::string_view line_of(std::string_view text, int line) {
    for (int i = 1; i < line; ++i) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return "";
        text.remove_prefix(end + 1);
    }
    text = text.substr(0, text.find('\n'));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
}

}  // namespace

void DiagnosticList::error(std::string code, const Place& place, std::string message,
                           std::string label) {
    ++errors_;
    add({Severity::error, std::move(code), std::move(message), place, std::move(label)});
}

void DiagnosticList::warning(std::string code, const Place& place, std::string message,
                             std::string label) {
    add({Severity::warning, std::move(code), std::move(message), place, std::move(label)});
}

void DiagnosticList::add(Item item) {
    if (items_.size() < most_diagnostics) {
        items_.push_back(std::move(item));
    } else {
        ++left_out_;
    }
}

std::vector<Diagnostic> DiagnosticList::take() {
    std::ranges::stable_sort(items_, {}, [](const Item& item) {
        return std::tuple(item.severity == Severity::error, reading_order(item.place));
    });
    std::vector<Diagnostic> diagnostics;
    for (Item& item : items_) {
        diagnostics.push_back({item.severity, std::move(item.code), std::move(item.message),
                               source_range(item.place), std::move(item.label)});
    }
    if (left_out_ > 0) {
        diagnostics.push_back(diagnosis(
            "E0123", "too many errors: " + std::to_string(left_out_) + " more not shown"));
    }
    items_.clear();
    return diagnostics;
}

SourceRange source_range(const Place& place) {
    SourceRange range;
    if (!place.source) return range;
    range.source = place.source->name;
    if (place.source->kind == Source::Kind::setting) return range;
    range.line = place.line;
    range.column = place.column;
    range.length = place.length;
    if (place.line > 0) {
        const std::string_view line = line_of(place.source->text, place.line);
        if (line.size() <= longest_line) range.line_text = shown(line);
    }
    return range;
}

}  // namespace skybake::config

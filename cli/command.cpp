#include "cli/command.h"

#include <utility>

namespace skybake::cli {

std::string Invocation::value(std::string_view option) const {
    const auto given = options_.find(option);
    if (given != options_.end() && !given->second.empty()) return given->second.back();
    const auto fallback = fallbacks_.find(option);
    return fallback != fallbacks_.end() ? fallback->second : std::string();
}

std::vector<std::string> Invocation::values(std::string_view option) const {
    const auto given = options_.find(option);
    return given != options_.end() ? given->second : std::vector<std::string>();
}

void Invocation::add_option(std::string_view name, std::vector<std::string> values) {
    options_.insert_or_assign(std::string(name), std::move(values));
}

void Invocation::add_fallback(std::string_view name, std::string_view value) {
    fallbacks_.insert_or_assign(std::string(name), std::string(value));
}

}  // namespace skybake::cli

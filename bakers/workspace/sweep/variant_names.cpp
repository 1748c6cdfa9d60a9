#include "bakers/workspace/sweep/variant_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "config/text/key_path.h"

namespace skybake {
namespace {

constexpr std::size_t longest_name = 100;

using Names = std::vector<std::string>;

std::string tail_of(const Names& names, std::size_t length) {
    std::string tail;
    for (std::size_t i = names.size() - std::min(length, names.size()); i < names.size(); ++i) {
        tail += (tail.empty() ? "" : ".") + names[i];
    }
    return tail;
}

bool is_plain(char c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    return letter || digit || std::string_view("+-.,_").find(c) != std::string_view::npos;
}

// "8 km" becomes "8km", "[16, 16, 8]" "16,16,8", "4e-6 /m" "4e-6perm"; anything else is a dash.
std::string safe(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (is_plain(c)) {
            result += c;
        } else if (c == '/') {
            result += "per";
        } else if (c == '%') {
            result += "pct";
        } else if (std::string_view(" []\"").find(c) == std::string_view::npos) {
            result += '-';
        }
    }
    return result;
}

}  // namespace

std::vector<std::string> distinguishing_names(const std::vector<std::string>& paths) {
    std::vector<Names> split;
    for (const std::string& path : paths) split.push_back(*config::split_path(path));
    std::vector<std::string> result;
    for (std::size_t i = 0; i < split.size(); ++i) {
        std::size_t length = 1;
        const auto is_taken = [&](std::size_t other) {
            return other != i && tail_of(split[other], length) == tail_of(split[i], length);
        };
        while (length < split[i].size()) {
            bool taken = false;
            for (std::size_t other = 0; other < split.size(); ++other) {
                taken = taken || is_taken(other);
            }
            if (!taken) break;
            ++length;
        }
        result.push_back(tail_of(split[i], length));
    }
    return result;
}

VariantNames::VariantNames(const config::Sweep& sweep)
    : sweep_(sweep), keys_(distinguishing_names(swept_paths(sweep))) {
    for (int rest = (variant_count(sweep) - 1) / 10'000; rest > 0; rest /= 10) ++digits_;
}

std::string VariantNames::name(int index) const {
    std::string name = fmt::format("{:0{}}", index, digits_);
    const std::vector<config::SweepValue> values = variant_values(sweep_, index);
    for (std::size_t i = 0; i < keys_.size(); ++i) {
        name += fmt::format("_{}={}", safe(keys_[i]), safe(values[i].plain));
    }
    name.resize(std::min(name.size(), longest_name));
    while (name.back() == '.') name.pop_back();  // which Windows would drop
    return name;
}

}  // namespace skybake

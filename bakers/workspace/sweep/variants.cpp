#include "bakers/workspace/sweep/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "bakers/field/finish_volume.h"
#include "bakers/io/files/atomic_file.h"
#include "bakers/io/files/file_io.h"
#include "bakers/io/files/output_folder.h"
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

// Makes a value fit for a name: "8 km" becomes "8km", "[16, 16, 8]" becomes "16,16,8", "4e-6 /m"
// becomes "4e-6perm"; other characters become dashes.
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

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uintmax_t largest_failure = 1 << 20;

Json to_json(const Diagnostic& error) {
    return {{"code", error.code},           {"message", error.message},
            {"file", error.where.source},   {"line", error.where.line},
            {"column", error.where.column}, {"length", error.where.length},
            {"label", error.label}};
}

std::string text_at(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
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
    while (name.back() == '.') name.pop_back();  // Windows would drop these dots
    return name;
}

std::string failure_json(const std::vector<Diagnostic>& diagnostics) {
    Json errors = Json::array();
    for (const Diagnostic& diagnostic : diagnostics) {
        if (diagnostic.severity == Severity::error) errors.push_back(to_json(diagnostic));
    }
    const Json json = {{"format", 1}, {"errors", std::move(errors)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<Diagnostic> read_failure(const fs::path& folder) {
    const auto text = read_file(folder / failure_name, largest_failure);
    const Json json = text.value ? Json::parse(*text.value, nullptr, false) : Json();
    const auto errors = json.is_object() ? json.find("errors") : json.end();
    std::vector<Diagnostic> diagnostics;
    if (!json.is_object() || errors == json.end() || !errors->is_array()) return diagnostics;
    for (const Json& error : *errors) {
        if (!error.is_object()) continue;
        diagnostics.push_back(
            file_error(text_at(error, "code"), text_at(error, "file"), text_at(error, "message")));
        diagnostics.back().label = text_at(error, "label");
    }
    return diagnostics;
}

std::vector<Diagnostic> write_failure(const fs::path& folder,
                                      const std::vector<Diagnostic>& diagnostics) {
    const auto made = create_output_folder(folder);
    if (!made.value) return made.diagnostics;
    return write_file_atomically(folder / failure_name, failure_json(diagnostics)).diagnostics;
}

void remove_failure(const fs::path& folder) {
    std::error_code ignored;
    fs::remove(folder / failure_name, ignored);
}

VariantAsset variant_asset(const ManifestAsset& entry) {
    VariantAsset asset;
    asset.name = entry.name;
    asset.kind = entry.kind;
    asset.key = entry.key;
    asset.size = entry.size;
    asset.content_hash = entry.content_hash;
    asset.timing = entry.timing;
    for (const ManifestFile& file : entry.files) {
        asset.files.push_back(file.path);
        asset.bytes += file.bytes;
    }
    if (entry.error) {
        if (entry.error->sky && entry.error->sky->points > 0) asset.sky_error = entry.error->sky;
        asset.lookup_error = entry.error->lookup;
        asset.texel_error = entry.error->texel;
    }
    asset.cover = number_named(entry.details, covered_columns);
    return asset;
}

std::string_view to_string(VariantStatus status) {
    switch (status) {
        case VariantStatus::done:
            return "done";
        case VariantStatus::failed:
            return "failed";
        case VariantStatus::missing:
            break;
    }
    return "missing";
}

std::string first_error(const VariantResult& variant) {
    if (variant.status != VariantStatus::failed) return "";
    for (const Diagnostic& diagnostic : variant.diagnostics) {
        if (diagnostic.severity != Severity::error) continue;
        return fmt::format("{}: {}", diagnostic.code, diagnostic.message);
    }
    return "";
}

}  // namespace skybake

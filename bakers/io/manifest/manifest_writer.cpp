
#include <array>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/manifest_members.h"
#include "config/diagnostics/toml_source.h"
#include "config/text/key_path.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;  // keys stay in the order of the schema

// Writes whole numbers without a decimal point, as people write counts.
Json number_json(double number) {
    constexpr double largest_whole = 9007199254740992;  // 2^53; beyond this, doubles skip numbers
    const bool whole = std::trunc(number) == number && std::fabs(number) <= largest_whole;
    if (!whole || (number == 0 && std::signbit(number))) return number;
    return static_cast<std::int64_t>(number);
}

Json numbers_json(const std::vector<double>& numbers) {
    Json json = Json::array();
    for (const double number : numbers) json.push_back(number_json(number));
    return json;
}

// Writes one object, member by member (manifest_members.h).
class MemberWriter {
  public:
    const bool of_volume;

    explicit MemberWriter(bool is_of_volume) : of_volume(is_of_volume) {}

    // Returns the object of a struct.
    template <class Struct>
    static Json object_of(const Struct& value, bool of_volume) {
        MemberWriter writer(of_volume);
        members(writer, value);
        return writer.json_;
    }

    void operator()(const char* name, const auto& value, const auto&... more) {
        json_[name] = to_json(value);
        if constexpr (sizeof...(more) > 0) (*this)(more...);
    }
    void extent(const char* name, int count) { json_[name] = count; }
    void path(const char* name, const std::string& path) { json_[name] = path; }
    void format(const char* name, const std::string& format) { json_[name] = format; }
    void uv(const char* name, const auto& uvw) { json_[name] = {uvw[0], uvw[1]}; }
    void plain(const char* name, const std::vector<double>& numbers) {
        if (!numbers.empty()) json_[name] = numbers_json(numbers);
    }
    bool holds(const char*, bool there) const { return there; }
    void when(bool there, const char* name, const auto& value) {
        if (there) (*this)(name, value);
    }
    void where(bool there, bool, const char* name, const auto& value) { when(there, name, value); }
    void or_null(const char* name, const auto& value) {
        json_[name] = value ? to_json(*value) : Json();
    }
    void object(const char* name, const auto& list) {
        MemberWriter inner(of_volume);
        list(inner);
        json_[name] = inner.json_;
    }
    void each(const char* name, std::size_t count, const auto& list) {
        json_[name] = Json::array();
        for (std::size_t i = 0; i < count; ++i) {
            MemberWriter inner(of_volume);
            list(inner, i);
            json_[name].push_back(inner.json_);
        }
    }

  private:
    template <class T>
    Json to_json(const T& value) const {
        if constexpr (std::is_enum_v<T>) {
            return skybake::to_string(value);
        } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
            return value;
        } else {
            return object_of(value, of_volume);
        }
    }
    template <class T>
    Json to_json(const std::optional<T>& value) const {
        return to_json(*value);
    }
    template <class T>
    Json to_json(const std::vector<T>& elements) const {
        Json json = Json::array();
        for (const T& element : elements) json.push_back(to_json(element));
        return json;
    }
    template <std::size_t n>
    Json to_json(const std::array<double, n>& numbers) const {
        return numbers;
    }
    Json to_json(const std::array<int, 3>& size) const {
        return std::vector<int>(size.begin(), size.begin() + (of_volume ? 3 : 2));
    }
    Json to_json(const std::vector<std::pair<std::string, double>>& place) const {
        Json json = Json::object();
        for (const auto& [quantity, value] : place) json[quantity] = value;
        return json;
    }
    Json to_json(const FactValue& value) const {
        if (const auto* text = std::get_if<std::string>(&value)) return *text;
        if (const auto* number = std::get_if<double>(&value)) return number_json(*number);
        return numbers_json(std::get<std::vector<double>>(value));
    }
    Json to_json(const Facts& facts) const {
        Json json = Json::object();
        for (const auto& [name, value] : facts) json[name] = to_json(value);
        return json;
    }

    Json json_ = Json::object();
};

Json to_json(const ManifestAsset& asset) {
    Json json = MemberWriter::object_of(asset, asset.is_volume());
    json["hash"] = entry_hash(json);
    return json;
}

Json to_json(const config::Value& value) {
    struct Visitor {
        Json operator()(std::monostate) const { return nullptr; }
        Json operator()(bool flag) const { return flag; }
        Json operator()(std::int64_t number) const { return number; }
        Json operator()(double number) const { return number; }
        Json operator()(const std::string& text) const { return text; }
        Json operator()(const config::Array& array) const {
            Json result = Json::array();
            for (const config::Value& element : array) result.push_back(to_json(element));
            return result;
        }
        Json operator()(const config::Table& table) const {
            Json result = Json::object();
            for (const config::Entry& entry : table) result[entry.key] = to_json(entry.value);
            return result;
        }
    };
    return std::visit(Visitor{}, value.data);
}

// Invalid UTF-8 in a string must not cause an exception, so it is replaced by U+FFFD.
std::string text_of(const Json& json, int indent) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json sky_error_json(const SkyError& error) { return MemberWriter::object_of(error, false); }

Json warning_json(const config::Diagnostic& warning) {
    return MemberWriter::object_of(warning, false);
}

std::string manifest_json(const Manifest& manifest) {
    Json assets = Json::array();
    for (const ManifestAsset& asset : manifest.assets) assets.push_back(to_json(asset));
    Json parameters = Json::parse(manifest.parameters, nullptr, false);
    if (!parameters.is_object()) parameters = Json::object();
    Json json = {{"format", manifest_format},
                 {"tool", {{"name", manifest.tool_name}, {"version", manifest.tool_version}}},
                 {"parameters", std::move(parameters)},
                 {"assets", std::move(assets)}};
    for (const RetiredFile& file : manifest.retired) {
        json["retired"].push_back(MemberWriter::object_of(file, false));
    }
    json["hash"] = manifest_hash(json);
    return text_of(json, 2) + "\n";
}

std::string file_entry_json(const ManifestAsset& asset, const ManifestFile& file) {
    ManifestAsset of_file = asset;
    of_file.files = {file};
    const auto first = asset.levels.begin() + file.level;
    of_file.levels = {first, first + file.levels};
    of_file.size = size_of(asset, file);
    of_file.content_hash = first->content_hash;
    Json json = to_json(of_file);
    for (const char* changing :
         {"timing", "lookup_cost", "hash", "key", "certification", "inputs", "warnings"}) {
        json.erase(changing);
    }
    for (const char* changing : {"path", "bytes", "xxh3"}) json["files"][0].erase(changing);
    return text_of(json, -1);
}

std::string parameters_json(std::span<const config::ResolvedValue> values) {
    Json root = Json::object();
    for (const config::ResolvedValue& value : values) {
        const auto path = config::split_path(value.path);
        if (!path || path->empty()) continue;
        Json* table = &root;
        for (std::size_t i = 0; i + 1 < path->size(); ++i) {
            Json& next = (*table)[(*path)[i]];
            if (!next.is_object()) next = Json::object();
            table = &next;
        }
        const auto parsed = config::parse_toml_value(value.canonical);
        (*table)[path->back()] = parsed ? to_json(*parsed) : Json(value.canonical);
    }
    return text_of(root, -1);
}

}  // namespace skybake

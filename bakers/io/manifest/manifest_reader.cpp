// Reads manifests, which may be damaged, of another tool or malicious. Each field is checked for
// its type and bounds, and the diagnostic names the place of the first wrong one.
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/manifest_members.h"
#include "bakers/io/manifest/release.h"
#include "bakers/io/targets/sidecar.h"
#include "config/sections/file_formats.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

// An exception for damaged manifests. It is caught in this file and becomes a diagnostic.
struct Damage : std::runtime_error {
    using std::runtime_error::runtime_error;
};

// A JSON value and its place, "assets[0].size".
class Node {
  public:
    Node(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw Damage(fmt::format("`{}`: {}", place_.empty() ? "the whole" : place_, what));
    }

    Node operator[](const char* key) const {
        if (!json_->is_object()) fail("an object is expected");
        const auto member = json_->find(key);
        if (member == json_->end()) fail(fmt::format("`{}` is missing", key));
        return {*member, place_.empty() ? key : fmt::format("{}.{}", place_, key)};
    }

    bool has(const char* key) const { return json_->is_object() && json_->contains(key); }

    std::string text() const {
        if (!json_->is_string()) fail("a string is expected");
        return json_->get<std::string>();
    }
    bool flag() const {
        if (!json_->is_boolean()) fail("true or false is expected");
        return json_->get<bool>();
    }
    double number() const {
        if (!json_->is_number()) fail("a number is expected");
        return json_->get<double>();
    }
    template <class Integer>
    Integer integer(Integer minimum) const {
        // All whole numbers of a manifest fit into 64 bits, signed or unsigned.
        if (json_->is_number_unsigned()) {
            const auto value = json_->get<std::uint64_t>();
            if (value <= static_cast<std::uint64_t>(std::numeric_limits<Integer>::max()) &&
                static_cast<Integer>(value) >= minimum) {
                return static_cast<Integer>(value);
            }
        }
        fail(fmt::format("a whole number of at least {} is expected", minimum));
    }

    std::vector<Node> elements() const {
        if (!json_->is_array()) fail("an array is expected");
        std::vector<Node> nodes;
        for (std::size_t i = 0; i < json_->size(); ++i) {
            nodes.emplace_back((*json_)[i], fmt::format("{}[{}]", place_, i));
        }
        return nodes;
    }
    std::vector<Node> elements(std::size_t count) const {
        auto nodes = elements();
        if (nodes.size() != count) fail(fmt::format("{} values are expected", count));
        return nodes;
    }
    std::vector<std::pair<std::string, Node>> members() const {
        if (!json_->is_object()) fail("an object is expected");
        std::vector<std::pair<std::string, Node>> nodes;
        for (const auto& [key, value] : json_->items()) {
            nodes.emplace_back(key, Node(value, fmt::format("{}.{}", place_, key)));
        }
        return nodes;
    }
    std::size_t count() const { return elements().size(); }
    bool is_text() const { return json_->is_string(); }
    bool is_number() const { return json_->is_number(); }
    bool is_null() const { return json_->is_null(); }
    std::string dump() const { return json_->dump(-1, ' ', false, Json::error_handler_t::replace); }

  private:
    const Json* json_;
    std::string place_;
};

// Returns a path within the manifest's folder. A manifest must not make its reader open files
// anywhere else.
std::string path_within_folder(const Node& node) {
    std::string text = node.text();
    const std::filesystem::path path(text);
    const bool climbs = std::find(path.begin(), path.end(), "..") != path.end();
    if (text.empty() || path.is_absolute() || climbs || text.find('\0') != std::string::npos) {
        node.fail("a path within the manifest's folder is expected");
    }
    return text;
}

// Reads a count of voxels or cells. It is bounded so that the product of three fits into 64 bits.
int extent(const Node& node) {
    constexpr int largest = 65536;
    const int value = node.integer<int>(1);
    if (value > largest) node.fail(fmt::format("at most {} are read", largest));
    return value;
}

// Reads one object, member by member (manifest_members.h).
class MemberReader {
  public:
    const bool of_volume;

    MemberReader(Node node, bool is_of_volume) : of_volume(is_of_volume), node_(std::move(node)) {}

    void operator()(const char* name, auto& value, auto&&... more) const {
        read(node_[name], value);
        if constexpr (sizeof...(more) > 0) (*this)(more...);
    }
    void extent(const char* name, int& count) const { count = skybake::extent(node_[name]); }
    void path(const char* name, std::string& path) const { path = path_within_folder(node_[name]); }
    void format(const char* name, std::string& format) const {
        format = node_[name].text();
        const bool is_text = format == "json" || format == sidecar_format;
        if (find_format(format) == nullptr && !is_text) {
            node_[name].fail("there is no such format");
        }
    }
    void uv(const char* name, std::array<double, 3>& uvw) const {
        std::array<double, 2> uv{};
        read(node_[name], uv);
        uvw = {uv[0], uv[1], 0.5};
    }
    void plain(const char* name, std::vector<double>& numbers) const { when(true, name, numbers); }
    bool holds(const char* name, bool) const { return node_.has(name); }
    void when(bool, const char* name, auto& value) const {
        if (node_.has(name)) read(node_[name], value);
    }
    void where(bool, bool wanted, const char* name, auto& value) const {
        if (wanted) read(node_[name], value);
    }
    void or_null(const char* name, auto& value) const {
        if (!node_[name].is_null()) read(node_[name], value);
    }
    void object(const char* name, const auto& list) const {
        const MemberReader inner(node_[name], of_volume);
        list(inner);
    }
    void each(const char* name, std::size_t count, const auto& list) const {
        const std::vector<Node> nodes = node_[name].elements(count);
        for (std::size_t i = 0; i < count; ++i) {
            const MemberReader inner(nodes[i], of_volume);
            list(inner, i);
        }
    }

  private:
    void read(const Node& node, std::string& text) const { text = node.text(); }
    void read(const Node& node, bool& flag) const { flag = node.flag(); }
    void read(const Node& node, double& number) const { number = node.number(); }
    template <std::integral Integer>
    void read(const Node& node, Integer& count) const {
        count = node.integer<Integer>(0);
    }
    template <class Struct>
    void read(const Node& node, Struct& value) const {
        const MemberReader inner(node, of_volume);
        members(inner, value);
    }
    template <class T>
    void read(const Node& node, std::optional<T>& value) const {
        read(node, value.emplace());
    }
    template <class T>
    void read(const Node& node, std::vector<T>& values) const {
        for (const Node& element : node.elements()) read(element, values.emplace_back());
    }
    template <std::size_t n>
    void read(const Node& node, std::array<double, n>& numbers) const {
        const std::vector<Node> elements = node.elements(n);
        for (std::size_t i = 0; i < n; ++i) numbers[i] = elements[i].number();
    }
    void read(const Node& node, std::array<int, 3>& size) const {
        const std::vector<Node> elements = node.elements(of_volume ? 3 : 2);
        size[2] = 1;
        for (std::size_t i = 0; i < elements.size(); ++i) size[i] = skybake::extent(elements[i]);
    }

    // Reads a word and takes the enumerator that `of` finds for it.
    template <class Enum>
    static void read_word(const Node& node, std::optional<Enum> (*of)(std::string_view),
                          const char* otherwise, Enum& value) {
        const std::optional<Enum> found = of(node.text());
        if (!found) node.fail(otherwise);
        value = *found;
    }
    void read(const Node& node, PixelType& type) const {
        read_word(node, pixel_type_of, "there is no such pixel type", type);
    }
    void read(const Node& node, config::SheetLayout& layout) const {
        read_word(node, sheet_layout_of, "there is no such layout", layout);
    }
    void read(const Node& node, TexelConvention& end_points) const {
        read_word(node, end_points_of, "no such word is known", end_points);
    }
    void read(const Node& node, AxisWrap& wrap) const {
        read_word(node, axis_wrap_of, "no such word is known", wrap);
    }
    void read(const Node& node, AxisFilter& filter) const {
        read_word(node, axis_filter_of, "no such word is known", filter);
    }
    void read(const Node& node, TextureParts& parts) const {
        read_word(node, texture_parts_of, "there is no such texture", parts);
        if (parts == TextureParts::none) node.fail("there is no such texture");
    }

    void read(const Node& node, FactValue& value) const {
        if (node.is_text()) {
            value = node.text();
        } else if (node.is_number()) {
            value = node.number();
        } else {
            read(node, value.emplace<std::vector<double>>());
        }
    }
    // Reads an object whose members have names of any kind: facts, or the place of a probe.
    template <class T>
    void read(const Node& node, std::vector<std::pair<std::string, T>>& values) const {
        for (const auto& [name, value] : node.members()) {
            read(value, values.emplace_back(name, T()).second);
        }
    }

    Node node_;
};

// Checks the numbers of values that others depend on.
void check_counts(const Node& node, const ManifestAsset& asset) {
    const Conventions& conventions = asset.conventions;
    if (conventions.color) {
        node["conventions"]["color"]["weights"].elements(3 * conventions.wavelengths_nm.size());
    }
    node["statistics"].elements(asset.channels.size());
    for (const Node& mip : node["mips"].elements()) {
        mip["statistics"].elements(asset.channels.size());
    }
    for (const ManifestFile& file : asset.files) {
        const std::int64_t end = std::int64_t{file.level} + file.levels;
        if (end > static_cast<std::int64_t>(asset.levels.size())) {
            node["files"].fail(fmt::format("`{}` is of level {}", file.path, end - 1));
        }
        const Format* format = find_format(file.format);
        const bool has_grids = format != nullptr && format->grids != nullptr;
        if (has_grids && file.grids.size() != asset.channels.size()) {
            node["files"].fail(fmt::format("`{}` has {} grids for {} channels", file.path,
                                           file.grids.size(), asset.channels.size()));
        }
    }
}

ManifestAsset read_asset(const Node& node) {
    ManifestAsset asset;
    const bool of_volume = node["size"].count() == 3;
    asset.axes.resize(of_volume ? 3 : 2);
    asset.levels.resize(1 + node["mips"].count());
    const MemberReader reader(node, of_volume);
    members(reader, asset);
    node["hash"].text();
    asset.levels[0].content_hash = asset.content_hash;
    const std::array<int, 3>& size = asset.levels[0].size;
    asset.size.assign(size.begin(), size.begin() + (of_volume ? 3 : 2));
    check_counts(node, asset);
    return asset;
}

void check_tool(const Node& node) {
    if (node["tool"]["name"].text() != tool_name()) {
        node["tool"]["name"].fail(fmt::format("not of {}'s", tool_name()));
    }
}

// Refuses manifests of another format. They are not damaged, but this release cannot read them.
void check_format(const Node& node) {
    const int format = node["format"].integer<int>(0);
    if (format == manifest_format) return;
    node["format"].fail(fmt::format(
        "release {} wrote format {}, and this release reads format {}; {}",
        node["tool"]["version"].text(), format, manifest_format,
        format < manifest_format ? "bake the recipe into this folder again to bring it up to date"
                                 : "use that release or a later one"));
}

std::vector<RetiredFile> read_retired(const Node& node) {
    std::vector<RetiredFile> files;
    if (!node.has("retired")) return files;
    for (const Node& file : node["retired"].elements()) {
        const MemberReader reader(file, false);
        members(reader, files.emplace_back());
    }
    return files;
}

Manifest read_whole(const Json& json) {
    const Node node(json, "");
    Manifest manifest;
    check_tool(node);
    check_format(node);
    manifest.tool_name = node["tool"]["name"].text();
    manifest.tool_version = node["tool"]["version"].text();
    node["parameters"].members();  // must be an object
    manifest.parameters = node["parameters"].dump();
    for (const Node& asset : node["assets"].elements()) {
        manifest.assets.push_back(read_asset(asset));
    }
    manifest.retired = read_retired(node);
    node["hash"].text();
    manifest.alterations = manifest_alterations(json);
    return manifest;
}

std::optional<Manifest> read_earlier_claims(const Json& json) {
    const Node node(json, "");
    Manifest manifest;
    check_tool(node);
    if (node["format"].integer<int>(0) >= manifest_format) return std::nullopt;
    for (const Node& asset : node["assets"].elements()) {
        for (const Node& file : asset["files"].elements()) {
            manifest.retired.push_back({path_within_folder(file["path"]), file["xxh3"].text()});
        }
    }
    for (RetiredFile& file : read_retired(node)) manifest.retired.push_back(std::move(file));
    return manifest;
}

// Returns the place of a byte in the text: "line 3, column 14".
std::string place_in(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is 0: the first line
    return fmt::format("line {}, column {}", line, before.size() - start + 1);
}

// Refuses objects with duplicate keys. Some readers take the first value and others the last, so
// that no hash could tell what was read.
class KeysOnce {
  public:
    void read(Json::parse_event_t event, const Json& parsed) {
        if (event == Json::parse_event_t::object_start) objects_.emplace_back();
        if (event == Json::parse_event_t::object_end) objects_.pop_back();
        if (event != Json::parse_event_t::key) return;
        const auto key = parsed.get<std::string>();
        if (!objects_.back().insert(key).second) {
            throw Damage(fmt::format("`{}` stands twice in one object", key));
        }
    }

  private:
    std::vector<std::set<std::string>> objects_;  // the keys of the objects that are open
};

// Parses JSON and refuses texts that nest deeper than any manifest does. Copies, texts and hashes
// of a JSON value are made by recursion and could exhaust the stack.
Json parse_json(std::string_view text) {
    constexpr int most = 100;
    KeysOnce keys;
    return Json::parse(text, [&](int around, Json::parse_event_t event, const Json& parsed) {
        const bool opens =
            event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (opens && around >= most) {
            throw Damage(fmt::format("its objects and arrays nest more than {} deep", most));
        }
        keys.read(event, parsed);
        return true;
    });
}

}  // namespace

Outcome<Manifest> parse_manifest(std::string_view text, const std::string& name) {
    const auto damaged = [&name](const std::string& reason) -> Outcome<Manifest> {
        return file_error("E0304", name,
                          fmt::format("cannot read `{}` as a manifest: {}", name, reason));
    };
    try {
        return {read_whole(parse_json(text)), {}};
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
        return damaged(fmt::format("not JSON at {}", place_in(text, byte)));
    } catch (const std::exception& error) {
        return damaged(error.what());
    }
}

Outcome<ManifestAsset> parse_file_entry(std::string_view text, const std::string& name) {
    try {
        // The entry in a file does not contain times, hashes or the file's own name, length and
        // level, so these are filled in.
        Json json = parse_json(text);
        json["timing"] = {{"light_s", 0.0},       {"colors_s", 0.0}, {"texels_s", 0.0},
                          {"certificate_s", 0.0}, {"write_s", 0.0},  {"threads", 0U}};
        json["hash"] = "";
        for (Json& file : json.at("files")) {
            file["path"] = std::filesystem::path(name).filename().string();
            file["bytes"] = 0U;
            file["level"] = 0U;
            file["xxh3"] = "";
        }
        ManifestAsset asset = read_asset(Node(json, ""));
        if (asset.files.size() != 1) throw Damage("it names other files");
        return {std::move(asset), {}};
    } catch (const std::exception& error) {
        return file_error("E0304", name, fmt::format("`{}`: {}", name, error.what()));
    }
}

std::optional<Manifest> parse_earlier_claims(std::string_view text) {
    try {
        return read_earlier_claims(parse_json(text));
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace skybake

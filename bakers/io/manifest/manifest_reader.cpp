// Reads manifests, which may be damaged, of another tool or malicious. Each field is checked for
// its type and bounds, and the diagnostic names the place of the first wrong one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "bakers/io/files/file_io.h"
#include "bakers/io/files/to_string.h"
#include "bakers/io/formats/texture.h"
#include "bakers/io/manifest/manifest.h"
#include "bakers/io/manifest/release.h"
#include "bakers/io/targets/sidecar.h"
#include "config/sections/file_formats.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

// An exception for damaged manifests. It is caught in this file and becomes a diagnostic.
struct Damage {
    std::string what;
};

// A JSON value and its place, "assets[0].size".
class Node {
  public:
    Node(const Json& json, std::string place) : json_(&json), place_(std::move(place)) {}

    [[noreturn]] void fail(const std::string& what) const {
        throw Damage{fmt::format("`{}`: {}", place_.empty() ? "the whole" : place_, what)};
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

std::vector<double> numbers(const Node& node) {
    std::vector<double> values;
    for (const Node& element : node.elements()) values.push_back(element.number());
    return values;
}

std::vector<std::string> texts(const Node& node) {
    std::vector<std::string> values;
    for (const Node& element : node.elements()) values.push_back(element.text());
    return values;
}

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

SheetGrid read_layout(const Node& node) {
    const auto kind = sheet_layout_of(node["kind"].text());
    if (!kind) node["kind"].fail("there is no such layout");
    return {*kind, extent(node["columns"]), extent(node["rows"]),
            node.has("flipped") && node["flipped"].flag()};
}

TextureParts read_texture_parts(const Node& node) {
    const auto parts = texture_parts_of(node.text());
    if (!parts || *parts == TextureParts::none) node.fail("there is no such texture");
    return *parts;
}

ManifestFile read_file_entry(const Node& node) {
    ManifestFile file;
    file.path = path_within_folder(node["path"]);
    file.format = node["format"].text();
    const Format* format = find_format(file.format);
    const bool is_text = file.format == "json" || file.format == sidecar_format;
    if (format == nullptr && !is_text) node["format"].fail("there is no such format");
    const auto type = pixel_type_of(node["pixel_type"].text());
    if (!type) node["pixel_type"].fail("there is no such pixel type");
    file.pixel_type = *type;
    file.bytes = node["bytes"].integer<std::uint64_t>(0);
    file.xxh3 = node["xxh3"].text();
    file.level = node["level"].integer<int>(0);
    if (node.has("levels")) file.levels = extent(node["levels"]);
    file.compression = node["compression"].text();
    if (format == nullptr) return file;
    if (config::facts_of(format->format).is_image) file.layout = read_layout(node["layout"]);
    if (format->grids != nullptr) file.grids = texts(node["grids"]);
    if (node.has("texture")) file.texture = read_texture_parts(node["texture"]);
    return file;
}

FactValue read_fact(const Node& node) {
    if (node.is_text()) return node.text();
    if (node.is_number()) return node.number();
    return numbers(node);
}

Facts read_facts(const Node& node) {
    Facts facts;
    for (const auto& [name, value] : node.members()) facts.emplace_back(name, read_fact(value));
    return facts;
}

// Reads a word and returns its enumerator, which `of` looks up.
template <class Enum>
Enum read_word(const Node& node, std::optional<Enum> (*of)(std::string_view)) {
    const std::optional<Enum> value = of(node.text());
    if (!value) node.fail("no such word is known");
    return *value;
}

AxisMapping read_axis(const Node& node) {
    AxisMapping axis;
    axis.quantity = node["quantity"].text();
    axis.formula = node["formula"].text();
    axis.convention = node["convention"].text();
    axis.first = node["first"].number();
    axis.last = node["last"].number();
    axis.end_points = read_word(node["end_points"], end_points_of);
    axis.wrap = read_word(node["wrap"], axis_wrap_of);
    axis.filter = read_word(node["filter"], axis_filter_of);
    axis.constants = read_facts(node["constants"]);
    return axis;
}

// Three weights for each wavelength.
ColorConvention read_color(const Node& node, std::size_t wavelengths) {
    ColorConvention color = {node["space"].text(), node["white"].text(), node["sun"].text(),
                             node["observer"].text(), node["is_applied"].flag()};
    for (const Node& weight : node["weights"].elements(3 * wavelengths)) {
        color.weights.push_back(weight.number());
    }
    return color;
}

ColorError read_color_error(const Node& node) {
    ColorError error;
    error.median = node["median"].number();
    error.ninth_decile = node["ninth_decile"].number();
    error.max = node["max"].number();
    const std::vector<Node> disc = node["disc_at_5_1_0_deg"].elements(error.disc.size());
    for (std::size_t i = 0; i < disc.size(); ++i) error.disc[i] = disc[i].number();
    error.skies = node["skies"].integer<int>(0);
    return error;
}

Conventions read_conventions(const Node& node) {
    const auto text = [&node](const char* name) {
        return node.has(name) ? node[name].text() : std::string();
    };
    const auto list = [&node](const char* name) {
        return node.has(name) ? numbers(node[name]) : std::vector<double>();
    };
    node["texel_origin"].text();
    Conventions conventions = {text("length_unit"),      text("coefficient_unit"),
                               text("angle_unit"),       text("radiance_unit"),
                               list("solar_irradiance"), list("wavelengths_nm")};
    if (node.has("color")) {
        conventions.color = read_color(node["color"], conventions.wavelengths_nm.size());
    }
    conventions.up_axis = text("up_axis");
    return conventions;
}

std::optional<Certificate> read_certificate(const Node& node) {
    if (node.is_null()) return std::nullopt;
    Certificate certificate;
    certificate.texel = {node["texel"]["max"].number(), node["texel"]["rms"].number()};
    certificate.lookup = {node["lookup"]["max"].number(), node["lookup"]["rms"].number()};
    certificate.reference = node["reference"].text();
    certificate.lookup_points = node["points"].integer<int>(0);
    certificate.texel_points = node["texel_points"].integer<int>(0);
    certificate.scale = node["scale"].text();
    certificate.worst = node["worst"].text();
    certificate.advice = node["advice"].text();
    if (node.has("sky")) {
        const Node sky = node["sky"];
        certificate.sky = SkyError{sky["median"].number(),
                                   sky["ninth_decile"].number(),
                                   sky["max"].number(),
                                   sky["points"].integer<int>(0),
                                   sky["reference"].text(),
                                   sky["standard_error"].number(),
                                   sky["left_out"].integer<int>(0),
                                   sky["worst"].text()};
        if (sky.has("worst_sun_elevation_deg")) {
            certificate.sky->worst_sun_deg = sky["worst_sun_elevation_deg"].number();
        }
        if (sky.has("better")) certificate.sky->better = sky["better"].text();
    }
    if (node.has("color")) certificate.color = read_color_error(node["color"]);
    return certificate;
}

std::vector<std::pair<std::string, double>> read_place(const Node& node) {
    std::vector<std::pair<std::string, double>> place;
    for (const auto& [quantity, value] : node.members()) {
        place.emplace_back(quantity, value.number());
    }
    return place;
}

std::array<double, 3> read_uvw(const Node& node) {
    const auto uvw = node.elements(3);
    return {uvw[0].number(), uvw[1].number(), uvw[2].number()};
}

Probe read_probe(const Node& node, bool of_volume) {
    Probe probe;
    probe.at = read_place(node["at"]);
    if (of_volume) {
        probe.uvw = read_uvw(node["uvw"]);
    } else {
        const auto uv = node["uv"].elements(2);
        probe.uvw = {uv[0].number(), uv[1].number(), 0.5};
    }
    if (node.has("blend")) {
        const Node blend = node["blend"];
        probe.blend = BlendedLookup{read_uvw(blend["uvw"]), blend["share"].number()};
    }
    probe.value = numbers(node["value"]);
    probe.tolerance = numbers(node["tolerance"]);
    if (node.has("column_km")) probe.column_km = numbers(node["column_km"]);
    return probe;
}

ValueStatistics read_statistics(const Node& node) {
    ValueStatistics statistics;
    statistics.min = node["min"].number();
    statistics.max = node["max"].number();
    statistics.mean = node["mean"].number();
    const auto range = node["histogram"]["range"].elements(2);
    statistics.histogram_range = {range[0].number(), range[1].number()};
    for (const Node& count : node["histogram"]["counts"].elements()) {
        statistics.histogram.push_back(count.integer<std::int64_t>(0));
    }
    return statistics;
}

// Reads a level from its own object, or level 0 from the object of its asset.
ManifestLevel read_level(const Node& node, std::size_t channels, bool of_volume) {
    ManifestLevel level;
    const auto size = node["size"].elements(of_volume ? 3 : 2);
    level.size = {extent(size[0]), extent(size[1]), of_volume ? extent(size[2]) : 1};
    level.content_hash = node["content_hash"].text();
    for (const Node& entry : node["statistics"].elements(channels)) {
        level.statistics.push_back(read_statistics(entry));
    }
    for (const Node& probe : node["probes"].elements()) {
        level.probes.push_back(read_probe(probe, of_volume));
    }
    level.catches = texts(node["catches"]);
    return level;
}

void read_levels(const Node& node, ManifestAsset& asset) {
    const bool of_volume = asset.is_volume();
    asset.levels.push_back(read_level(node, asset.channels.size(), of_volume));
    for (const Node& mip : node["mips"].elements()) {
        asset.levels.push_back(read_level(mip, asset.channels.size(), of_volume));
    }
    const std::array<int, 3>& size = asset.levels[0].size;
    asset.size.assign(size.begin(), size.begin() + (of_volume ? 3 : 2));
    if (of_volume) asset.seam_error = node["seam_error"].number();
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

void read_identity(const Node& node, ManifestAsset& asset) {
    asset.key = node["key"].text();
    asset.certification = node["certification"].text();
    for (const Node& input : node["inputs"].elements()) {
        asset.inputs.push_back({input["file"].text(), input["xxh3"].text()});
    }
}

ManifestAsset read_asset(const Node& node) {
    ManifestAsset asset;
    const bool of_volume = node["size"].count() == 3;
    asset.name = node["name"].text();
    asset.kind = node["kind"].text();
    asset.content = node["content"].text();
    for (const Node& file : node["files"].elements()) {
        asset.files.push_back(read_file_entry(file));
    }
    asset.channels = texts(node["channels"]);
    asset.mapping = node["mapping"]["name"].text();
    asset.axes = {read_axis(node["mapping"]["u"]), read_axis(node["mapping"]["v"])};
    if (of_volume) asset.axes.push_back(read_axis(node["mapping"]["w"]));
    const Node timing = node["timing"];
    asset.timing = {{timing["light_s"].number(), timing["colors_s"].number(),
                     timing["texels_s"].number(), timing["certificate_s"].number()},
                    timing["write_s"].number(),
                    timing["threads"].integer<int>(0)};
    asset.error = read_certificate(node["error"]);
    asset.range = {node["range"]["below_normal"].integer<long>(0),
                   node["range"]["above_range"].integer<long>(0)};
    asset.conventions = read_conventions(node["conventions"]);
    asset.details = read_facts(node["details"]);
    asset.parameters = node["parameters"].text();
    asset.content_hash = node["content_hash"].text();
    asset.release = node["release"].text();
    if (node.has("key")) read_identity(node, asset);
    node["hash"].text();
    read_levels(node, asset);
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
        files.push_back({path_within_folder(file["path"]), file["xxh3"].text()});
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
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
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
            throw Damage{fmt::format("`{}` stands twice in one object", key)};
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
            throw Damage{fmt::format("its objects and arrays nest more than {} deep", most)};
        }
        keys.read(event, parsed);
        return true;
    });
}

}  // namespace

config::Outcome<Manifest> parse_manifest(std::string_view text, const std::string& name) {
    const auto damaged = [&name](const std::string& reason) -> config::Outcome<Manifest> {
        return {{},
                {file_error("E0304", name,
                            fmt::format("cannot read `{}` as a manifest: {}", name, reason))}};
    };
    try {
        return {read_whole(parse_json(text)), {}};
    } catch (const Damage& damage) {
        return damaged(damage.what);
    } catch (const nlohmann::json::parse_error& error) {
        const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
        return damaged(fmt::format("not JSON at {}", place_in(text, byte)));
    } catch (const std::exception& error) {
        return damaged(error.what());
    }
}

config::Outcome<ManifestAsset> parse_file_entry(std::string_view text, const std::string& name) {
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
        if (asset.files.size() != 1) throw Damage{"it names other files"};
        return {std::move(asset), {}};
    } catch (const Damage& damage) {
        return {{}, {file_error("E0304", name, fmt::format("`{}`: {}", name, damage.what))}};
    } catch (const std::exception& error) {
        return {{}, {file_error("E0304", name, fmt::format("`{}`: {}", name, error.what()))}};
    }
}

std::optional<Manifest> parse_earlier_claims(std::string_view text) {
    try {
        return read_earlier_claims(parse_json(text));
    } catch (const Damage&) {
        return std::nullopt;
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace skybake

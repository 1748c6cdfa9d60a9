#include "bakers/io/manifest/manifest_hash.h"

#include <fmt/format.h>

#include "bakers/math/hash.h"

namespace skybake {
namespace {

using Json = nlohmann::ordered_json;

std::string hash_of_text(const Json& json) {
    return xxh3_hex(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

std::string entry_hash(const Json& entry) {
    Json rest = entry;
    rest.erase("hash");
    return hash_of_text(rest);
}

std::string manifest_hash(const Json& manifest) {
    Json rest = Json::object();
    for (const auto& [key, value] : manifest.items()) {
        if (key == "hash") continue;
        if (key != "assets") {
            rest[key] = value;
            continue;
        }
        rest[key] = Json::array();
        for (const Json& entry : value) rest[key].push_back(entry.at("hash"));
    }
    return hash_of_text(rest);
}

std::vector<std::string> manifest_alterations(const Json& manifest) {
    std::vector<std::string> alterations;
    const Json& entries = manifest.at("assets");
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const std::string found = entry_hash(entries[i]);
        if (found == entries[i].at("hash")) continue;
        alterations.push_back(fmt::format(
            "`assets[{}]`, the entry of `{}`, has been changed since the bake wrote it: its hash "
            "is {}, and `hash` says {}; bake again to get a true entry",
            i, entries[i].at("name").get<std::string>(), found,
            entries[i].at("hash").get<std::string>()));
    }
    const std::string found = manifest_hash(manifest);
    if (found != manifest.at("hash")) {
        alterations.push_back(fmt::format(
            "the manifest has been changed since the bake wrote it, outside of the entries of its "
            "assets or in their number: its hash is {}, and `hash` says {}; bake again to get a "
            "true manifest",
            found, manifest.at("hash").get<std::string>()));
    }
    return alterations;
}

}  // namespace skybake

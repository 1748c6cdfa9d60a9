// By what a manifest tells that it has been changed since it was written.
//
// Each asset's entry has a `hash` of all else in it, and the manifest has one of all else in it, in
// which entries are represented by their hashes: so a change is told once, at its place. Hashes are
// xxh3_hex of compact JSON text in the order of the file, so that spaces and line breaks do not
// matter and all else does: wall times too.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace skybake {

// Of an asset's entry, with or without a `hash`.
std::string entry_hash(const nlohmann::ordered_json& entry);

// Of a whole manifest, with or without a `hash`, whose entries have theirs.
std::string manifest_hash(const nlohmann::ordered_json& manifest);

// One sentence for each hash that is not that of its content. The manifest has been read: every
// entry has its hash.
std::vector<std::string> manifest_alterations(const nlohmann::ordered_json& manifest);

}  // namespace skybake

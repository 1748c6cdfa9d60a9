// Which key of a recipe a path in [sweep] means.
#pragma once

#include <optional>
#include <string>

#include "config/fields/section_decoder.h"

namespace skybake::config {

struct SweptKey {
    std::string path;                  // as join_path spells it
    std::string table;                 // the same without the key
    const Section* section = nullptr;  // of the table
    const Field* field = nullptr;
};

// Finds the key that a path means in a merged recipe, whose layers, noises, clouds and bakes are
// those there are. None, and E0102 at the place, if there is no such key or no such table.
std::optional<SweptKey> find_swept_key(const Table& root, const std::string& path,
                                       const Place& place, Decoder& decoder);

}  // namespace skybake::config

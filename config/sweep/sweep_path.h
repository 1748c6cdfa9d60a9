// This header finds the key of a recipe that a path in [sweep] means.
#pragma once

#include <optional>
#include <string>

#include "config/fields/section_decoder.h"

namespace skybake::config {

struct SweptKey {
    std::string path;                  // in the spelling of join_path
    std::string table;                 // the path without the key
    const Section* section = nullptr;  // the section of the table
    const Field* field = nullptr;
};

// Finds the key that a path means in a merged recipe. The recipe's own layers, noises, clouds and
// bakes are the ones that a path can name. It returns none and reports E0102 at the place if there
// is no such key or no such table.
std::optional<SweptKey> find_swept_key(const Table& root, const std::string& path,
                                       const Place& place, Decoder& decoder);

}  // namespace skybake::config

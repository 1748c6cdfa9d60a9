#include "config/fields/roles.h"

#include <algorithm>

#include "config/text/key_path.h"

namespace skybake::config {

bool is_read(const ResolvedValue& value, std::span<const Read> reads) {
    return std::any_of(reads.begin(), reads.end(), [&value](const Read& read) {
        if (!read.roles.has(value.role)) return false;
        // The recipe's own section has no name to match.
        return value.section == read.section || path_matches(value.section, read.section);
    });
}

}  // namespace skybake::config

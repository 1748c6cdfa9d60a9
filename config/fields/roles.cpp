#include "config/fields/roles.h"

#include <algorithm>

#include "config/text/key_path.h"

namespace skybake::config {

bool is_read(const ResolvedValue& value, std::span<const Read> reads) {
    return std::ranges::any_of(reads, [&value](const Read& read) {
        if (!read.roles.has(value.role)) return false;
        // The recipe's own section has no name to match.
        if (value.section == read.section) return true;
        return read.section.find('*') != std::string::npos &&
               path_matches(value.section, read.section);
    });
}

}  // namespace skybake::config

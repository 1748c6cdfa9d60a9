#include "bakers/io/volumes/value_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace skybake {

std::string words_of_fault(const ValueFaults::Kind& kind, const char* what) {
    const std::string first =
        fmt::format("its voxel ({}) is {}", fmt::join(kind.index, ", "), kind.value);
    return kind.count == 1
               ? first
               : fmt::format("{}, the first of {} that are {}", first, kind.count, what);
}

std::string refusal_of(const ValueFaults& faults) {
    return words_of_fault(faults.not_finite, "not finite") +
           "; not_finite = \"background\" takes the background in their place";
}

}  // namespace skybake

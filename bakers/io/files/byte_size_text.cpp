#include "bakers/io/files/byte_size_text.h"

#include <fmt/format.h>

namespace skybake {

std::string byte_size_text(double bytes) {
    constexpr double kib = 1024;
    if (bytes < kib) return fmt::format("{:.0f} B", bytes);
    if (bytes < kib * kib) return fmt::format("{:.0f} KiB", bytes / kib);
    if (bytes < kib * kib * kib) return fmt::format("{:.1f} MiB", bytes / (kib * kib));
    return fmt::format("{:.1f} GiB", bytes / (kib * kib * kib));
}

}  // namespace skybake

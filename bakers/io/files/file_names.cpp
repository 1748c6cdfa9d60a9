#include "bakers/io/files/file_names.h"

#include <fmt/format.h>

#include "config/assets/asset_kind.h"
#include "config/assets/bruneton.h"

namespace skybake {

std::string file_name(const std::string& name, config::FileFormat format, int level) {
    const std::string_view extension = config::facts_of(format).name;
    if (level == 0) return fmt::format("{}.{}", name, extension);
    return fmt::format("{}.mip{}.{}", name, level, extension);
}

std::string companion_file_name(const std::string& name, const std::string& format) {
    return fmt::format("{}.{}", name, format);
}

std::vector<std::string> file_names(const config::Bake& bake) {
    const config::AssetFiles& files = config::files_of(bake);
    std::vector<std::string> names;
    for (const config::FileFormat format : files.formats) {
        const int count = config::facts_of(format).has_all_levels ? 1 : files.mips;
        for (int level = 0; level < count; ++level) {
            names.push_back(file_name(bake.name, format, level));
        }
    }
    const auto* bruneton = bake.find<config::BrunetonBake>();
    if (bruneton && config::has_companion(*bruneton)) {
        names.push_back(companion_file_name(bake.name, "json"));
    }
    return names;
}

}  // namespace skybake

#include "bakers/io/files/file_names.h"

#include <fmt/format.h>

#include <variant>

#include "bakers/io/files/spelling.h"
#include "config/assets/bruneton.h"
#include "config/assets/volume_files.h"

namespace skybake {

std::string table_file_name(const std::string& name) { return name + ".exr"; }

std::string volume_file_name(const std::string& name, config::VolumeFormat format, int level) {
    if (level == 0) return fmt::format("{}.{}", name, spell(format));
    return fmt::format("{}.mip{}.{}", name, level, spell(format));
}

std::string companion_file_name(const std::string& name, const std::string& format) {
    return fmt::format("{}.{}", name, format);
}

std::vector<std::string> file_names(const config::Bake& bake) {
    const config::VolumeFiles* volume = config::volume_files(bake);
    if (volume == nullptr) return {table_file_name(bake.name)};
    std::vector<std::string> names;
    for (const config::VolumeFormat format : volume->formats) {
        for (int level = 0; level < volume->mips; ++level) {
            names.push_back(volume_file_name(bake.name, format, level));
        }
    }
    const auto* bruneton = bake.find<config::BrunetonBake>();
    if (bruneton && config::has_companion(*bruneton)) {
        names.push_back(companion_file_name(bake.name, "json"));
    }
    return names;
}

}  // namespace skybake

// Which assets are volumes.
#pragma once

#include <type_traits>

#include "config/parameters.h"

namespace skybake::config {

// What the files of a volume are like; null of a bake that makes a table.
inline const VolumeFiles* volume_files(const Bake& bake) {
    return std::visit(
        []<class Asset>(const Asset& asset) -> const VolumeFiles* {
            if constexpr (std::is_base_of_v<VolumeFiles, Asset>) return &asset;
            return nullptr;
        },
        bake.asset);
}

}  // namespace skybake::config

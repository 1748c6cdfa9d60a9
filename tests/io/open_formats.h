// Reads files by their paths, as the product reads files that are open.
#pragma once

#include <filesystem>
#include <utility>

#include "bakers/io/files/file_io.h"
#include "bakers/io/formats/format.h"

namespace skybake::testing {

inline Outcome<FileFacts> inspect_file(const Format& format, const std::filesystem::path& path) {
    auto file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    return format.inspect(*file.value);
}

inline Outcome<bool> read_file_of(const Format& format, const std::filesystem::path& path,
                                  const FileShape& shape, int level, const VoxelVisitor& visit) {
    auto file = FileInput::open(path);
    if (!file.value) return {{}, std::move(file.diagnostics)};
    return format.read(*file.value, shape, level, visit);
}

}  // namespace skybake::testing

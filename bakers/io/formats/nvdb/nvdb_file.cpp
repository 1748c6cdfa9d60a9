#include "bakers/io/formats/nvdb/nvdb_file.h"

#include "bakers/io/formats/nvdb/nvdb_reader.h"
#include "bakers/io/formats/nvdb/nvdb_writer.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "config/sections/file_formats.h"

namespace skybake {

Format nvdb_format() {
    return {.format = config::FileFormat::nvdb,
            .write = write_nvdb,
            .inspect = inspect_nvdb,
            .read = [](const std::filesystem::path& path, const FileShape& shape, int,
                       const VoxelVisitor& visit) { return read_nvdb(path, shape, visit); },
            .grids = vdb_grid_names};
}

}  // namespace skybake

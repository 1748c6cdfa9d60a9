#include "bakers/io/formats/nvdb/nvdb_file.h"

#include "bakers/io/formats/nvdb/nvdb_writer.h"
#include "bakers/io/formats/vdb/vdb_file.h"
#include "bakers/io/volumes/grid_files.h"
#include "config/sections/file_formats.h"

namespace skybake {

Format nvdb_format() {
    return {.format = config::FileFormat::nvdb,
            .write = write_nvdb,
            .inspect = inspect_grids,
            .read = read_grid_voxels,
            .grids = vdb_grid_names};
}

}  // namespace skybake

#include <fmt/format.h>

#include <algorithm>

#include "bakers/io/files/file_diagnostic.h"
#include "bakers/io/formats/bin/bin.h"
#include "bakers/io/formats/dds/dds.h"
#include "bakers/io/formats/exr/exr_file.h"
#include "bakers/io/formats/format.h"
#include "bakers/io/formats/png/png_file.h"
#include "bakers/io/formats/vdb/vdb_file.h"

namespace skybake {

std::span<const Format> formats() {
    static const std::array all = {exr_format(), vdb_format(), bin_format(), png_format(),
                                   dds_format()};
    return all;
}

const Format& format_of(config::FileFormat format) {
    const auto rows = formats();
    return *std::find_if(rows.begin(), rows.end(),
                         [format](const Format& row) { return row.format == format; });
}

const Format* find_format(std::string_view word) {
    for (const Format& row : formats()) {
        if (config::facts_of(row.format).name == word) return &row;
    }
    return nullptr;
}

config::Diagnostic other_size(const std::filesystem::path& path) {
    return file_error("E0304", path.string(),
                      fmt::format("`{}` is not of the size that its manifest says", path.string()));
}

config::Diagnostic contradiction(const std::filesystem::path& path, const std::string& what) {
    return file_error("E0500", path.string(), what);
}

}  // namespace skybake

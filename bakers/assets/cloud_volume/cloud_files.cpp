#include "bakers/assets/cloud_volume/cloud_files.h"

#include "bakers/io/formats/png/map_image.h"
#include "bakers/io/volumes/volume_reader.h"

namespace skybake {

using config::CloudMap;
using config::VolumeFile;

std::vector<Diagnostic> check_cloud_files(const Parameters& parameters) {
    std::vector<Diagnostic> problems;
    for (const Cloud& cloud : parameters.clouds) {
        for (const CloudMap* map : {&cloud.coverage_map, &cloud.type_map}) {
            if (map->file.empty()) continue;
            const Outcome<MapImage> image = read_map_image(*map);
            problems.insert(problems.end(), image.diagnostics.begin(), image.diagnostics.end());
        }
    }
    for (const VolumeFile& volume : parameters.volumes) {
        const Outcome<SourceVoxels> source = open_volume(volume);
        problems.insert(problems.end(), source.diagnostics.begin(), source.diagnostics.end());
    }
    return problems;
}

}  // namespace skybake

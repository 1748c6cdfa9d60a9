// Many paths of light at once: what SinglePath::walk does with one, in stages that all paths take
// together.
//
// No path waits for its own last stage while others can go on, geometry and angles are computed for
// a vector of paths at a time, and packets of wavelengths, which fill a vector, path by path. Paths
// that have ended are removed before each flight, so that the rest stays dense. Every number of a
// path is that of SinglePath::walk, which is the specification, whatever the instruction set and the
// other paths of the batch.
#pragma once

#include <array>
#include <cstddef>

#include "bakers/light/path_tracer/path_medium.h"
#include "bakers/light/path_tracer/path_numbers.h"

namespace skybake {

struct PathBatch {
    static constexpr std::size_t kPaths = BatchNumbers::kPaths;

    explicit PathBatch(BatchNumbers of_paths) : numbers(std::move(of_paths)) {}

    BatchNumbers numbers;
    std::array<std::size_t, kPaths> heroes{};
    std::array<PathStart, kPaths> starts;
    // The first flight, if all paths share their start; else null, and starts have no length limit.
    const PathMedium::Flight* first = nullptr;

    // The results of walk_batch.
    std::array<PathLight, kPaths> light;
    std::array<Spectrum, kPaths> second_flight{};  // the weight with which each path begins it
};

// Walks the paths of a batch, as many as there are numbers for.
void walk_batch(const PathMedium& medium, const PathSource& source, const PathRules& rules,
                PathBatch& batch);

}  // namespace skybake

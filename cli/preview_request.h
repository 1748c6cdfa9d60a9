// What `preview` was asked for.
#pragma once

#include <filesystem>
#include <vector>

#include "bakers/preview/make_preview.h"
#include "cli/command.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake::cli {

struct PreviewRequest {
    enum class Subject { recipe, folder, sweep, files };
    Subject subject = Subject::recipe;
    std::vector<std::filesystem::path> paths;  // one, but of files
    std::filesystem::path output;
    bool force = false;
    bool report = false;
    bool watch = false;
    int draft_edge = 64;  // voxels along the longest edge of a draft's volumes
    PreviewOptions options;
};

// A folder or a manifest.json is a folder; .exr, .vdb and .bin are files; anything else is a
// recipe. E0001: what cannot go together, what is no number or out of range.
config::Outcome<PreviewRequest> preview_request(const Invocation& invocation);

}  // namespace skybake::cli

// Baked files from the disk, as a preview looks at them.
#pragma once

#include <filesystem>
#include <span>

#include "bakers/io/manifest/manifest.h"
#include "bakers/math/bake_options.h"
#include "bakers/preview/bake_assets.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// All assets of a folder of a bake, the recipe that its manifest recorded and the plots of a report
// that lies there; `path` is the folder or the manifest. E0300, E0304 as the readers of manifests
// and files; E0304 where the manifest has no assets. Warnings W0304, which are notes, too: a shown
// file is not that of which the manifest speaks.
config::Outcome<PreviewAssets> load_folder(const std::filesystem::path& path);

// Single files of every format, each with what the manifest of its folder says of it; where none
// claims it, with what it says of itself. The recipe is that of the first file's folder, or what
// a single file says of it. E0300; E0304, too, where a file says nothing of itself, or other things
// than it holds. Warnings as of load_folder.
config::Outcome<PreviewAssets> load_files(std::span<const std::filesystem::path> files);

// Plots of speed against error that `report` draws. Adds the plots of the assets that an earlier
// `report` left in the folder, or in `report` below it. Files of these names that are none of its
// drawings are passed over.
void find_plots(const std::filesystem::path& folder, PreviewAssets& assets);

// Measures each asset of the recipe by a quick report and adds its plot; assets that have nothing
// to plot get none. Errors as of report_asset; none and assets without plots: the user has
// interrupted.
[[nodiscard]] std::vector<config::Diagnostic> measure_plots(PreviewAssets& assets, int threads,
                                                            Progress* progress);

}  // namespace skybake

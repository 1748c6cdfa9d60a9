// This header fills in what a [bake.NAME] leaves to its name: the volume of the cloud or of the noise
// of that name.
#pragma once

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Adds `asset` and `cloud`, or `asset` and `noise`, to each [bake.NAME] of the merged recipe that
// names no asset and whose NAME is that of a [clouds.NAME] or a [noise.NAME], but no asset's. Adds
// `cloud` or `noise` alone where the asset is the volume of one. The values have the place of NAME.
// Reports (E0118) a NAME that is both a cloud's and a noise's.
void name_bakes_of_sections(Table& root, DiagnosticList& diagnostics);

}  // namespace skybake::config

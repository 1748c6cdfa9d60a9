// This header turns the merged tree of a recipe into its parameters.
#pragma once

#include "config/fields/section_decoder.h"
#include "config/sections/parameters.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// The parameters are complete only if no error was reported. `source` is the place that errors
// about missing sections point to.
Parameters decode_recipe(const Table& root, const Source& source, Decoder& decoder);

// Fills in what a [bake.NAME] leaves to its name: the volume of the cloud or of the noise of that name,
// and what a cloud says of its volumes.
//
// Gives the bakes of a cloud's volume what the cloud says of them: its `cover`, and its `size` unless
// they have one or a `voxel_size`.
//
// Adds `asset` and `cloud`, or `asset` and `noise`, to each [bake.NAME] of the merged recipe that
// names no asset and whose NAME is that of a [clouds.NAME] or a [noise.NAME], but no asset's. Adds
// `cloud` or `noise` alone where the asset is the volume of one. The values have the place of NAME.
// Reports (E0118) a NAME that is both a cloud's and a noise's.
//
// A [bake.NAME] with a `preset` of a cloud or a noise was swapped with the section that it is meant
// for. This is the one fault that is reported of both (E0102), and both are left out.
//
// Returns false if a section is left out, so that others may miss what it says.
bool name_bakes_of_sections(Table& root, DiagnosticList& diagnostics);

}  // namespace skybake::config

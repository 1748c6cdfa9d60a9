// This header merges the sources of a recipe, and lays named sections over the presets that they
// start from.
//
// When one source is laid over another, tables are merged key by key, and any other value is
// replaced. Some keys exclude others (extinction, absorption, single_scattering_albedo; size,
// max_error), and some select what others mean (profile, phase). Such a key drops what earlier
// sources said about the alternatives. A key that others need drops those when it is taken away
// (detail = ""). Another `asset` starts its section afresh.
#pragma once

#include <deque>
#include <string_view>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Returns the table under a key, or null.
Table* table_at(Table& parent, std::string_view key);

// Lays `over` over `base`.
void merge(Table& base, const Table& over);

// Reports (E0109) each table of one source that names two keys that exclude each other.
void check_exclusive_keys(const Table& root, DiagnosticList& diagnostics);

// Replaces every `phase = { mie = NAME }` of a source's layers by the keys phase = "mie" and
// particles = NAME. So a layer's `phase` drops the keys of the phase function of an earlier source.
void name_particles_of_layers(Table& root);

// Whether a layer's table says that its coefficients follow from particles.
bool names_particles(const Table& layer);

// Lays each section of the merged recipe that has `preset = "..."` over the preset that it names.
// Noises, clouds, particles and layers can start from a preset. The texts of the presets are added
// to the sources, which own what places point to. The [preview] of a cloud's preset becomes that of the
// recipe if it has no other cloud; the recipe's own keys override it. Returns false if a preset is unknown (E0115,
// reported here) or is not a text, so that keys may be missing for that reason.
bool lay_sections_over_presets(Table& root, std::deque<Source>& sources,
                               DiagnosticList& diagnostics);

}  // namespace skybake::config

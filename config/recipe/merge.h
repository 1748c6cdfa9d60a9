// Laying one source over another.
//
// Tables merge key by key; anything else replaces. A key that excludes others (extinction,
// absorption, single_scattering_albedo; size, max_error), or that selects what others mean
// (profile, phase), drops what earlier sources said about the alternatives; so does one that others
// need and that is taken away (detail = ""). Another `asset` starts its section afresh.
#pragma once

#include <deque>

#include "config/diagnostics/diagnostic.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Lays `over` over `base`.
void merge(Table& base, const Table& over);

// Reports (E0109) each table of one source that names two keys which exclude each other.
void check_exclusive_keys(const Table& root, DiagnosticList& diagnostics);

// Layers of particles as recipes write them.

// Makes every `phase = { mie = NAME }` of a source's layers the keys phase = "mie" and particles =
// NAME, so that one layer's key drops what belonged to the phase function of an earlier source.
void name_particles_of_layers(Table& root);

// Whether a layer's table says that its coefficients follow from particles.
bool names_particles(const Table& layer);

// Noises, clouds, particles and layers that start from a preset: [noise.NAME] and so on with
// `preset = "..."`.

// Lays each such section of the merged recipe over the preset that it names. The presets'
// texts join the sources, which own what places point to. False if one is unknown, which is
// reported (E0115), or is no text, so that keys may be missing for that reason.
bool lay_sections_over_presets(Table& root, std::deque<Source>& sources,
                               DiagnosticList& diagnostics);

}  // namespace skybake::config

// Laying one source over another.
//
// Tables merge key by key; anything else replaces. A key that excludes others (extinction,
// absorption, single_scattering_albedo; size, max_error), or that selects what others mean
// (profile, phase), drops what earlier sources said about the alternatives; so does one that others
// need and that is taken away (detail = ""). Another `asset` starts its section afresh.
#pragma once

#include "config/diagnostics/diagnostic_list.h"
#include "config/text/value_tree.h"

namespace skybake::config {

// Lays `over` over `base`.
void merge(Table& base, const Table& over);

// Reports (E0109) each table of one source that names two keys which exclude each other.
void check_exclusive_keys(const Table& root, DiagnosticList& diagnostics);

}  // namespace skybake::config

// Layers of particles as recipes write them.
#pragma once

#include "config/text/value_tree.h"

namespace skybake::config {

// Makes every `phase = { mie = NAME }` of a source's layers the keys phase = "mie" and particles =
// NAME, so that one layer's key drops what belonged to the phase function of an earlier source.
void name_particles_of_layers(Table& root);

// Whether a layer's table says that its coefficients follow from particles.
bool names_particles(const Table& layer);

}  // namespace skybake::config

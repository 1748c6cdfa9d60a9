// How pictures show light, as GLSL for other programs.
#pragma once

#include <string>

#include "bakers/preview/load_assets.h"

namespace skybake {

// Returns GLSL that shows light as pictures of these assets do: with daylight as white, by the curve film.
// It is empty if there are no two tables of three or four channels, by which rays are marched.
std::string film_lookup(const PreviewAssets& assets, int threads);

}  // namespace skybake

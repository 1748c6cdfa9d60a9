// Says what to do about an asset whose certificate shows that it is of little use.
#pragma once

#include <string>
#include <vector>

#include "bakers/field/conventions.h"
#include "config/diagnostics/diagnostic.h"
#include "config/sections/forward.h"

namespace skybake {

struct Baked;

// Returns a share in percent to two digits, which prints as 190 and not as 1.9e+02.
double to_percent(double share);

// A figure of a certificate that is too large.
struct LargeError {
    std::string code;  // W0214 lookups, W0220 texels, W0221 the sky, W0222 colours
    std::string text;  // the figures
};
std::vector<LargeError> large_errors(const Certificate& certificate);

// Returns a warning for each large error, with what would help. That is the certificate's `advice`, too,
// if it has none; so is why paths of light found nothing to compare with.
std::vector<Diagnostic> warn_of_large_errors(const Parameters& parameters, Baked& baked);

}  // namespace skybake

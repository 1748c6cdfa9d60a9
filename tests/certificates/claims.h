// Random bakes of every asset whose certificate searches the errors of its lookups: what their
// certificates claim, and what dense measurements find.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "bakers/field/baked.h"
#include "bakers/math/bake_options.h"
#include "config/diagnostics/diagnostic.h"
#include "tests/certificates/random_cases.h"

namespace skybake::test {

// The claim of a certificate, the result of a dense measurement, and the claim of points spread evenly.
struct Claim {
    ErrorFigures claimed;
    ErrorFigures dense;
    ErrorFigures even;
};

// Tables.
Claim claim_of_transmittance(RandomCase& random);
Claim claim_of_multiple_scattering(RandomCase& random);
Claim claim_of_solved_scattering(RandomCase& random);
Claim claim_of_sky_view(RandomCase& random);
Claim claim_of_environment(RandomCase& random);
Claim claim_of_irradiance(RandomCase& random);
Claim claim_of_phase(RandomCase& random);

// Volumes.
Claim claim_of_single_mie(RandomCase& random);
Claim claim_of_aerial_perspective(RandomCase& random);
Claim claim_of_optical_depth(RandomCase& random);

// Shared by both kinds.
inline constexpr BakeOptions kClaimOptions{.threads = 2, .certification = Certification::quick};

inline Baked empty_table() {
    Baked table;
    table.name = std::string("a");
    table.channel_names = {"R", "G", "B"};
    return table;
}

}  // namespace skybake::test
